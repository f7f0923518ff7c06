// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/InteriorPoint.h"

#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"
#include "conic/Divergence.h"
#include "conic/ExtendedInteriorPoint.h"
#include "conic/RayOperators.h"
#include "conic/UpperBounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// Added to the diagonal of the scaled Schur system: without it the factorisation fails near the optimum,
/// where bodies of the mechanism are held by nothing but the forces that vanish there. Refinement takes its
/// effect out of the steps.
constexpr double proximal = 1e-9;

/// Likewise on the rays: where one presses, s / z grows without limit, and with it the rounding of the
/// system. A compliance rho spoils the steps where rho s exceeds z = mu / s, so it is this number over the
/// square of the largest force: harmless down to mu of this order.
constexpr double compliance = 1e-10;

/// An iterate, or a step between two: forces s >= 0 on the rays, their openings z >= 0, displacements y,
/// multiplier.
struct Iterate
{
    VectorXd s;
    VectorXd z;
    VectorXd y;
    double alpha = 0;
};

/// Where to begin.
enum class Start
{
    leastSquares, ///< Mehrotra's: fewest iterations; with `compliance`
    unit ///< all forces and openings 1, no compliance: slower, but it reaches some that the other does not
};

/// A start whose certificate's worst figure e is at most the first of these is worth a try, for some
/// iterations. Its complementarity is of second order in e: both forces and openings are wrong by about as
/// much. Measured on the paper's walls in collapse at steps of 0.002 s, certified to 1e-6: 5 to 8 iterations
/// a step instead of 14 to 16; with 0.01 to 1 times e^2 within 10%. On walls of 80 units that begin to fall,
/// where e is 0.04 to 0.2, no complementarity was found from which the iterations end: short steps tell,
/// after 4 to 17 factorisations. From such solutions what the last step passed on its way is the better
/// start (below): with 0.01 instead of 0.03 walls of 20 and 40 units that fell took 14.7 and 14.3
/// factorisations a step instead of 15.3 and 16.9, and those of the paper as many.
constexpr double nearEnough = 0.01;
constexpr int mostFromNear = 30;
constexpr int mostShortSteps = 3;
constexpr double shortStep = 0.2;
constexpr double complementarityOfNear = 0.1; // times e^2, and within these:
constexpr double leastOfNear = 1e-6;
constexpr double largestOfNear = 1e-2;

/// The first iterate with a complementarity of at most this is kept for the next program: near enough to the
/// end to save iterations, and far enough from it that what has changed since leaves it inside its cones.
/// Steps of walls of 20, 40 and 80 units that fall take 18, 19 and 18 factorisations from nothing, and 14, 15
/// and 13 from there; with 1e-1 instead of 1e-2 the first two take 4 and 11% more, with 3e-4 the last two 14
/// and 17% more.
constexpr double complementarityOfInterior = 1e-2;
constexpr int mostFromInterior = 60;
constexpr int mostShortStepsFromInterior = 6;
/// An opening that the displacements make larger than so much of what was kept is taken from them, within:
constexpr double partOfOpening = 0.5;
constexpr double largestOpening = 10; // times what was kept

/// Complementarity above which a Newton step needs no refinement.
constexpr double firmComplementarity = 1e-7;

/// Complementarity above which a corrector needs no more than single precision: what little it spoils the
/// next predictor mends. Walls of 40 to 80 units take as many factorisations as without. With 1e-6 those of
/// 80 units take 19.4 instead of 17.2, and steps of one that falls 13.8 instead of 12.2.
constexpr double roughComplementarity = 1e-4;

/// Tolerance of the scaled residuals, of that of the certificate.
constexpr double ofResiduals = 0.7;

/// Largest flexibility of a ray when forces are balanced that are right but for that. From 1e4 to 1e6 they
/// are as soon; with 1e8 the system is no longer definite for rounding.
constexpr double evenFlexibility = 1e5;
constexpr int mostMends = 4;
constexpr int passesOfMend = 6;

/// Newton's step removes as much of what is missing from the balance as it is long. Steps that are nearly
/// whole and leave more than this share of it show that the Schur system is not solved to any digit.
constexpr double wholeStep = 0.9;
constexpr double shareLeft = 0.5;
constexpr int mostStalls = 5;

/// Complementarity below which cancellation often makes a pivot negative, and what the diagonal is raised by
/// against it.
constexpr double cancellingComplementarity = 1e-6;
constexpr double leastRounding = 1e-15;

/// How one factorisation is used. Mehrotra (1992) aims at sigma mu, where sigma is the cube of what the
/// predictor would leave of mu. Each of Gondzio's (1996) correctors asks for steps so much longer than the
/// last one allows, and pulls the products s z at their end into a box about an aim of its own. Unlike there
/// a corrector is taken even if it shortens the step, but not to less than a part: what it does for the
/// centring pays at the next iterate.
struct Centring
{
    double partOfCube; ///< sigma over Mehrotra's
    double aim;        ///< of the correctors, times sigma mu, but at least this times mu:
    double leastAim;
    double relativeGrowth; ///< of the step asked for,
    double stepGrowth;     ///< and so much on top
    double leastProduct;   ///< of the box, times the aim
    double largestProduct;
    double largestLoss; ///< what is left of a step at least
    double longStep;    ///< needs no more correctors
};

/// Chosen over the paper's walls, square walls of 20 to 80 units and the first steps of falling walls of 30
/// to 60, by factorisations and solves as these cost time (counts of one wall scatter by a fifth): the best
/// of some 160 settings drawn at random in limit analysis, within 2% of the best of 50 in steps. `narrow`
/// costs 1.15 times as much in limit analysis and 1.25 in steps. That was before corrections were divided by
/// what products answer (below); of 130 more settings with that none gained more than 2.5%.
constexpr Centring wide{.partOfCube = 0.25,
                        .aim = 5,
                        .leastAim = 1e-3,
                        .relativeGrowth = 1.15,
                        .stepGrowth = 0.5,
                        .leastProduct = 0.2,
                        .largestProduct = 8,
                        .largestLoss = 0.3,
                        .longStep = 0.86};

/// Where iterations begin near the solution, or those from nothing have broken down: near, with `wide` the
/// paper's walls in motion take 1.1 to 1.3 times as many factorisations.
constexpr Centring narrow{.partOfCube = 1,
                          .aim = 1,
                          .leastAim = 1e-3,
                          .relativeGrowth = 1.075,
                          .stepGrowth = 0.3,
                          .leastProduct = 0.3,
                          .largestProduct = 3,
                          .largestLoss = 0.5,
                          .longStep = 0.95};

constexpr double fullCorrection = 0.9; ///< a correction gets at least this weight when steps are long

/// Solves that a factorisation must cost, in multiplications, for all correctors to be tried; else half of
/// them are (Gondzio 1996 goes by the same ratio). The paper's walls have 5, square walls of 20, 40, 60, 80
/// and 160 units 13, 24, 31, 38 and 64. With eight correctors instead of four those of 20 and 40 units take
/// 11.7 and 15.1 factorisations instead of 12.4 and 16.2, and as long, the paper's as many; those of 160 and
/// 320 units 18.8 and 23 instead of 23.6 and 36, and 0.92 and 0.75 of the time.
constexpr double dearFactorisation = 30;

/// Likewise for forces that carry the dead load to be looked for longer.
constexpr double factorisationOverRest = 10;

/// Whether an iterate that is passed well inside the cones is kept. Iterations that begin near the solution
/// pass none.
enum class Passed
{
    kept,
    left
};

/// What is left of the optimality conditions.
struct Residuals
{
    VectorXd balance; ///< f + L alpha - M y - B s
    VectorXd opening; ///< g - B'y - z
    double work = 0;  ///< w - L'y
};

/// offset + w slope: the inverse of the step that one ray allows, where w is the weight of a correction.
struct Line
{
    double offset;
    double slope;
};

/// Steps beyond the optimality conditions' own, which is 1, are not needed; knowing that they could be taken
/// tells that 1 is safe.
constexpr double farthest = 1.02;

class InteriorPoint
{
public:
    InteriorPoint(const RayProgram& rays, SchurSystem<3>& system, const InteriorPointSettings& settings,
                  Sought sought)
        : rays_(rays), system_(system), settings_(settings), sought_(sought)
    {
    }

    /// Iterates until the scaled residuals meet the tolerance. \return whether they did
    bool run(Start from, const Centring& centring);

    /// Iterates likewise from about forces s and displacements y. \param error e of their certificate
    bool runFrom(const VectorXd& s, const VectorXd& y, double error);

    /// Iterates likewise from where an earlier program passed. \param interior its y from that of the
    /// solution; rays without force or opening are new \param heading about the y to come
    bool runFrom(Iterate interior, const VectorXd& heading);

    /// Forces that balance f alone, found on the way; empty when none were.
    const VectorXd& resting() const { return resting_; }
    const Iterate& iterate() const { return at_; }

    /// Whether the last iterations ended with displacements that show that nothing balances the loads.
    bool falls() const { return falls_; }

    /// Whether they ended with a multiplier so large that there may be no largest one.
    bool grows() const { return grows_; }

    /// Whether they ended since full steps no longer balanced the loads: for rounding, or as nothing does.
    bool isStalled() const { return stalls_ > mostStalls; }

    /// An iterate well inside the cones that was passed on the way, or with empty vectors where none was.
    const Iterate& interior() const { return interior_; }
    int iterations() const { return iterations_; }
    int factorisations() const { return factorisations_; }
    int solves() const { return solves_; }

private:
    void begin(double rayCompliance, Passed passed);
    bool start(Start from);
    bool iterate(const Centring& centring, int mostIterations, int shortStepsAllowed);
    void computeResiduals();
    bool factorise();
    void tryResting();
    /// Forces of later iterates are too near the surface of their cones.
    bool isRestingSought() const
    {
        return rays_.hasMultiplier() && rays_.rayCount() > 0 && resting_.size() == 0 && iterations_ <= 1
               && sought_ == Sought::solution;
    }
    void predict(Iterate& step);
    template<typename Products>
    void correct(const Products& products, Iterate& step);
    void finishStep(double reduction, Iterate& step);
    bool addCorrection(double least, double largestLoss, Iterate& step);
    void measureSteps(const Iterate& step);
    void solveSchur(VectorXd& x);
    void solveSchur(VectorXd& one, VectorXd& other);
    void solveSchurRoughly(VectorXd& x);
    double takeLiveWork(VectorXd& y) const;
    double complementarity() const { return rays_.rayCount() ? at_.s.dot(at_.z) / rays_.rayCount() : 0; }
    double objectiveSize() const;
    bool converged();
    bool isCompatible(double tolerance) const;
    bool isBalanceMissing() const;
    double forceSize() const { return std::max(1.0, std::abs(at_.alpha)); }
    bool mendBalance();
    bool isObjectiveReached(double tolerance);
    bool diverges() const;
    bool isFalling(double error) const;

    const RayProgram& rays_;
    SchurSystem<3>& system_;
    InteriorPointSettings settings_;
    Sought sought_;
    Iterate at_;
    Residuals residuals_;
    VectorXd flexibility_;     ///< 1 / (z + rho s)
    VectorXd d_;               ///< s / (z + rho s)
    VectorXd liveSolution_;    ///< S^-1 L
    double liveStiffness_ = 0; ///< L' S^-1 L
    VectorXd resting_;         ///< s >= 0 with B s = f, or empty
    double compliance_ = 0;
    double mu_ = 0; ///< complementarity of the iterate
    int iterations_ = 0;
    int factorisations_ = 0;
    int solves_ = 0;
    bool falls_ = false;
    bool grows_ = false;
    int waits_ = 0;       ///< iterations that objectives which differ have been given to meet
    int stalls_ = 0;      ///< full steps that left the balance as it was
    int mends_ = 0;       ///< attempts to balance forces that are right but for that
    double rounding_ = 0; ///< share that the diagonal of the Schur system is raised by
    double primal_ = 0;   ///< how far the forces of the step in hand may go, at most `farthest`
    double dual_ = 0;     ///< likewise its openings
    Iterate correction_;
    Iterate interior_;
    Passed passed_ = Passed::left;
    std::vector<Line> blocking_;
    VectorXd rayWork_, rayWork2_, trialRays_, rowWork_, remainder_;
};

/// Largest step, at most `farthest`, that keeps x + step dx >= 0.
double stepToBoundary(const VectorXd& x, const VectorXd& dx)
{
    // Largest -dx/x, found without a branch so that it vectorises.
    const double steepest = x.size() ? (-dx.array() / x.array()).maxCoeff() : 0;
    return 1 / std::max(steepest, 1 / farthest);
}

/// Collects how rays limit a step dx + w c for a w from `least` to 1: those that may do so more than others.
/// \param floor the steepest line is nowhere below it: 1 / farthest, or what an earlier call returned for the
/// same lines \return the same with these
double collectBlocking(const VectorXd& x, const VectorXd& dx, const VectorXd& c, double least, double floor,
                       std::vector<Line>& lines)
{
    const auto add = [&](double offset, double slope)
    {
        const double one = offset + slope;
        const double other = offset + least * slope;
        if (std::max(one, other) > floor)
        {
            lines.push_back({offset, slope});
            floor = std::max(floor, std::min(one, other));
        }
    };
    constexpr int lanes = 4; // looked at together: few rays block
    using Lanes = Eigen::Array<double, lanes, 1>;
    Eigen::Index ray = 0;
    for (; ray + lanes <= x.size(); ray += lanes)
    {
        const Lanes slope = -c.segment<lanes>(ray).array();
        const Lanes offset = -dx.segment<lanes>(ray).array();
        const Lanes most = (offset + slope).max(offset + least * slope);
        if ((most - floor * x.segment<lanes>(ray).array()).maxCoeff() > 0)
        {
            for (int lane = 0; lane < lanes; ++lane)
            {
                add(offset[lane] / x[ray + lane], slope[lane] / x[ray + lane]);
            }
        }
    }
    for (; ray < x.size(); ++ray)
    {
        add(-dx[ray] / x[ray], -c[ray] / x[ray]);
    }
    return floor;
}

/// How much of a correction is added to a step, and how far the sum may go.
struct Weight
{
    double weight = 1;
    double step = 0;
};

/// The weight from `least` to 1 that allows the longest step, and the largest of those that do. It is looked
/// for among a few: to the last digit it is not worth more.
Weight bestWeight(const std::vector<Line>& blocking, double least)
{
    constexpr int intervals = 12;
    Weight best;
    for (int interval = 0; interval <= intervals; ++interval)
    {
        const double weight = 1 - (1 - least) * interval / intervals;
        double steepest = 1 / farthest;
        for (const Line& line : blocking)
        {
            steepest = std::max(steepest, line.offset + weight * line.slope);
        }
        if (1 / steepest > best.step * (1 + 1e-9))
        {
            best = {weight, 1 / steepest};
        }
    }
    return best;
}

/// What the product of a ray at the end of a step becomes larger by for each unit that is asked for in c. In
/// Newton's equations below, the other rays aside, c changes s by (1 - p) c/z and z by p c/s, where p = D
/// b'S^-1 b is the leverage of the ray, and so (s + ds)(z + dz) by c times
///     (1 - p) (z + dz)/z + p (s + ds)/s.
/// Where the one grows to three times what it was and drives the other below zero, asking for what is missing
/// moves the product too far, and where it shrinks, not far enough: the corrections then end after a few,
/// their steps short. The p of all rays are 3 bodies together, which is about half for those that press, and
/// nothing for those that are open: p = s / (2 (s + z)), so that the sum is (z (s + ds) + (s + 2z)(z + dz)) /
/// (2z (s + z)). Its root is taken, since other rays answer too. Square walls of 20, 40, 80 and 160 units
/// take 11, 15, 17 and 18 factorisations with eight correctors so, 13, 17, 20 and 29 with the products as
/// they are; as many as 32 correctors leave the latter at 27.
auto answerOfProducts(const Iterate& at, const Iterate& step, double primal, double dual)
{
    constexpr double least = 0.2;
    const auto s = at.s.array();
    const auto z = at.z.array();
    const auto force = (s + primal * step.s.array()).max(0);
    const auto opening = (z + dual * step.z.array()).max(0);
    return ((z * force + (s + 2 * z) * opening) / (2 * z * (s + z))).max(least).sqrt();
}

void InteriorPoint::computeResiduals()
{
    VectorXd& balance = residuals_.balance;
    balance = rays_.load;
    if (rays_.hasMultiplier())
    {
        balance += at_.alpha * rays_.liveLoad;
        residuals_.work = rays_.liveWork - rays_.liveLoad.dot(at_.y);
    }
    rowWork_.setZero(balance.size());
    addRays(rays_, at_.s, rowWork_);
    if (rays_.hasInertia())
    {
        for (int body = 0; body < rays_.bodies; ++body)
        {
            rowWork_.segment<3>(3 * body) += rays_.inertia[body] * at_.y.segment<3>(3 * body);
        }
    }
    balance -= rowWork_;
    applyRaysTransposed(rays_, at_.y, rayWork_);
    residuals_.opening = rays_.gap - rayWork_ - at_.z;
}

/// What the gap is compared with, as in Certificate.h.
double InteriorPoint::objectiveSize() const
{
    if (rays_.hasMultiplier())
    {
        return std::max(rays_.liveWork * std::max(1e-3, std::abs(at_.alpha)),
                        std::abs(rays_.load.dot(at_.y)));
    }
    if (rays_.hasInertia())
    {
        return std::max(1.0, rays_.load.cwiseProduct(at_.y).lpNorm<1>());
    }
    return std::max(1e-3 * rays_.gap.lpNorm<Eigen::Infinity>(), std::abs(rays_.load.dot(at_.y)));
}

bool InteriorPoint::converged()
{
    const double tolerance = ofResiduals * settings_.tolerance;
    if (!rays_.hasMultiplier() && !rays_.hasInertia() && rays_.gap.isZero(0))
    {
        return residuals_.balance.lpNorm<Eigen::Infinity>()
               <= tolerance; // any forces will do: y = 0 completes them
    }
    if (sought_ == Sought::fall && at_.s.dot(at_.z) <= complementarityOfFall * objectiveSize()
        && isFalling(0.1 * settings_.tolerance))
    {
        return true;
    }
    return residuals_.balance.lpNorm<Eigen::Infinity>() <= tolerance * forceSize() && isCompatible(tolerance)
           && (!rays_.hasMultiplier() || isObjectiveReached(tolerance));
}

/// Whether the displacements are those of a mechanism, and nothing that presses opens.
bool InteriorPoint::isCompatible(double tolerance) const
{
    const double displacement =
        std::max({at_.y.lpNorm<Eigen::Infinity>(), rays_.gap.lpNorm<Eigen::Infinity>(),
                  rays_.hasInertia() ? 1.0 : 0.0});
    return residuals_.opening.lpNorm<Eigen::Infinity>() <= tolerance * displacement
           && std::abs(residuals_.work) <= tolerance * std::max(1.0, rays_.liveWork)
           && at_.s.dot(at_.z) <= tolerance * objectiveSize();
}

bool InteriorPoint::isBalanceMissing() const
{
    const double tolerance = ofResiduals * settings_.tolerance;
    return rays_.hasMultiplier() && !rays_.hasInertia() && mends_ < mostMends && isCompatible(tolerance)
           && residuals_.balance.lpNorm<Eigen::Infinity>() > tolerance * forceSize();
}

/// Newton's steps lose the balance in the end: they change forces that press by D B'dy with D = s/z = s^2/mu,
/// while a rest r of the balance makes a dy of r/mu along the mechanism, whose rounding alone leaves more
/// than r below a mu of about 1e-8 s. When all but the balance meets the tolerance, the forces need no more
/// than a small change that balances them, and nearly any will do: the least one in the metric of W = min(D,
/// a constant), in which rays that press are alike and those that open still hardly change,
///
///     B W B' dy - L da = r,  L'dy = 0,  ds = W B'dy.
///
/// \return whether all residuals meet the tolerance then; else nothing is changed
bool InteriorPoint::mendBalance()
{
    ++mends_;
    const Iterate before = at_;
    d_ = at_.s.cwiseQuotient(at_.z).cwiseMin(evenFlexibility);
    assembleSchur(rays_, d_, proximal, 0, system_);
    ++factorisations_;
    if (!system_.factorise())
    {
        return false;
    }
    liveSolution_ = rays_.liveLoad;
    solveSchur(liveSolution_);
    liveStiffness_ = rays_.liveLoad.dot(liveSolution_);
    const double enough = 0.1 * settings_.tolerance * forceSize();
    for (int pass = 0; pass < passesOfMend && residuals_.balance.lpNorm<Eigen::Infinity>() > enough; ++pass)
    {
        remainder_ = residuals_.balance;
        solveSchur(remainder_);
        at_.alpha += takeLiveWork(remainder_);
        applyRaysTransposed(rays_, remainder_, rayWork2_);
        at_.s = (at_.s + d_.cwiseProduct(rayWork2_)).cwiseMax(0.1 * at_.s);
        computeResiduals();
    }
    if (converged())
    {
        return true;
    }
    at_ = before;
    computeResiduals();
    return false;
}

/// What is left of the balance does work on the displacements, and where these are large it keeps the
/// objectives apart, alpha w and g's - f'y, which the certificate compares. A few more iterations mend that,
/// or rounding does not let them.
bool InteriorPoint::isObjectiveReached(double tolerance)
{
    constexpr int mostWaits = 3;
    const double apart = rays_.liveWork * at_.alpha + rays_.load.dot(at_.y) - rays_.gap.dot(at_.s);
    return std::abs(apart) <= tolerance * objectiveSize() || ++waits_ > mostWaits;
}

/// Without a solution the iterates run off along a ray; that ray is then found, and proved, by a program of
/// its own.
bool InteriorPoint::diverges() const
{
    return runsOff(iterations_, at_.y.lpNorm<Eigen::Infinity>(), at_.s.lpNorm<Eigen::Infinity>(),
                   residuals_.balance.lpNorm<Eigen::Infinity>(), at_.alpha, rays_.hasInertia());
}

bool InteriorPoint::isFalling(double error) const
{
    double closing = 0; // what is above B'y, by z
    if (rays_.rayCount() > 0)
    {
        closing = std::max(0.0, (rays_.gap - residuals_.opening).maxCoeff());
    }
    return isFall(rays_.load, rays_.liveLoad, at_.y, closing, rays_.liveWork - residuals_.work, error);
}

bool InteriorPoint::factorise()
{
    const double force = std::max(1.0, at_.s.lpNorm<Eigen::Infinity>());
    flexibility_ = (at_.z + (compliance_ / (force * force)) * at_.s).cwiseInverse();
    d_ = at_.s.cwiseProduct(flexibility_);
    // Cancellation may make a pivot negative: then each is raised by what rounding may have taken from it.
    if (mu_ < cancellingComplementarity)
    {
        rounding_ = std::max(rounding_, leastRounding);
    }
    for (; rounding_ <= 1e-6; rounding_ = std::max(leastRounding, 10 * rounding_))
    {
        assembleSchur(rays_, d_, proximal, rounding_, system_);
        ++factorisations_;
        if (system_.factorise())
        {
            return true;
        }
    }
    return false;
}

/// Are there forces that carry f alone? Those of the iterate are changed by the least, in the metric of D,
/// that balances f without the live load, s + D B' S^-1 (f - B s); rays that come out pulling are reflected,
/// farther than they pull, for the next pass takes most of that back; and so on. Alternating projections find
/// a point in the interior of the intersection in finitely many passes (Bauschke & Borwein 1996), each of
/// which costs a solve. To know none costs a program of its own, some three factorisations: where these are
/// dear, more passes are worth it. Square walls of 20 to 160 units end within nine.
void InteriorPoint::tryResting()
{
    const bool isDear = system_.factorisationOverSolve() > factorisationOverRest;
    // The forces of the start are too even for walls with windows, but right for solid ones.
    const int passes = iterations_ == 0 ? (isDear ? 9 : 3) : (isDear ? 5 : 4);
    constexpr double reflection = 2;
    const double enough = 0.1 * settings_.tolerance;
    VectorXd forces = at_.s;
    for (int pass = 0; pass < passes; ++pass)
    {
        forces = (forces.array() < 0).select(-reflection * forces, forces);
        remainder_ = -rays_.load;
        addRays(rays_, forces, remainder_);
        if (remainder_.lpNorm<Eigen::Infinity>() <= enough)
        {
            resting_ = std::move(forces);
            return;
        }
        solveSchurRoughly(remainder_);
        applyRaysTransposed(rays_, remainder_, rayWork2_);
        forces -= d_.cwiseProduct(rayWork2_);
    }
}

void InteriorPoint::solveSchur(VectorXd& x)
{
    if (rays_.limits.empty())
    {
        system_.solve(x.head(3 * rays_.bodies));
    }
    else
    {
        solveWithLimits(rays_, d_, system_, x);
    }
    ++solves_;
}

/// Moves displacements that balance loads to where the live load does no work on them. \return the change of
/// its multiplier that does so
double InteriorPoint::takeLiveWork(VectorXd& y) const
{
    const double change = -rays_.liveLoad.dot(y) / liveStiffness_;
    y += change * liveSolution_;
    return change;
}

void InteriorPoint::solveSchurRoughly(VectorXd& x)
{
    if (!rays_.limits.empty())
    {
        solveSchur(x);
        return;
    }
    system_.solveRoughly(x.head(3 * rays_.bodies));
    ++solves_;
}

void InteriorPoint::solveSchur(VectorXd& one, VectorXd& other)
{
    if (rays_.limits.empty())
    {
        system_.solve(one.head(3 * rays_.bodies), other.head(3 * rays_.bodies));
        solves_ += 2;
    }
    else
    {
        solveSchur(one);
        solveSchur(other);
    }
}

/// Newton's equations, with R the fraction (`reduction`) of the residuals to remove and c the wished change
/// of s z:
///     M dy + B ds - L da = R balance,  B'dy + dz = R opening,  L'dy = R work,  (z + rho s) ds + s dz = c.
/// With D = s/(z + rho s):  ds = c/(z + rho s) - D (R opening - B'dy), so  (M + B D B') dy - L da = R balance
/// - B (c/(z + rho s) - D R opening).
///
/// The predictor goes straight for the optimum: R = 1 and c = -s z. S^-1 L comes with it.
void InteriorPoint::predict(Iterate& step)
{
    rayWork2_ = -d_.cwiseProduct(at_.z + residuals_.opening);
    step.y.setZero(rays_.load.size());
    addRays(rays_, rayWork2_, step.y);
    step.y = residuals_.balance - step.y;
    if (rays_.hasMultiplier())
    {
        liveSolution_ = rays_.liveLoad;
        solveSchur(step.y, liveSolution_);
        liveStiffness_ = rays_.liveLoad.dot(liveSolution_);
    }
    else
    {
        solveSchur(step.y);
    }
    finishStep(1, step);
}

/// A correction of the products s z by c, with R = 0. \param products c, an array expression: evaluated here,
/// in one pass
template<typename Products>
void InteriorPoint::correct(const Products& products, Iterate& step)
{
    rayWork2_ = products * flexibility_.array();
    step.y.setZero(rays_.load.size());
    addRays(rays_, rayWork2_, step.y);
    step.y = -step.y;
    if (mu_ > roughComplementarity)
    {
        solveSchurRoughly(step.y);
    }
    else
    {
        solveSchur(step.y);
    }
    finishStep(0, step);
}

/// The rest of Newton's equations, once `rayWork2_` has c/(z + rho s) - D R opening and step.y the solution
/// for the right side of the balance.
void InteriorPoint::finishStep(double reduction, Iterate& step)
{
    step.alpha = 0;
    if (rays_.hasMultiplier())
    {
        step.alpha = (reduction * residuals_.work - rays_.liveLoad.dot(step.y)) / liveStiffness_;
        step.y += step.alpha * liveSolution_;
    }
    applyRaysTransposed(rays_, step.y, rayWork_);
    step.s = rayWork2_ + d_.cwiseProduct(rayWork_);
    // Far from the optimum D is even and the factor exact; what little it leaves shows in the residuals of
    // the next iterate.
    const int refinements = mu_ > firmComplementarity ? 0 : 3;
    for (int refinement = 0; refinement < refinements; ++refinement)
    {
        // What rounding and regularisation left of the balance. Corrections are added to ds as they come:
        // computing ds anew from dy would lose them, since D is huge where a ray presses.
        remainder_ = reduction * residuals_.balance;
        if (rays_.hasMultiplier())
        {
            remainder_ += step.alpha * rays_.liveLoad;
        }
        rowWork_.setZero(rays_.load.size());
        addRays(rays_, step.s, rowWork_);
        if (rays_.hasInertia())
        {
            for (int body = 0; body < rays_.bodies; ++body)
            {
                rowWork_.segment<3>(3 * body) += rays_.inertia[body] * step.y.segment<3>(3 * body);
            }
        }
        remainder_ -= rowWork_;
        if (remainder_.lpNorm<Eigen::Infinity>() <= std::max(
                0.1 * settings_.tolerance * forceSize(), 1e-2 * residuals_.balance.lpNorm<Eigen::Infinity>()))
        {
            break;
        }
        solveSchur(remainder_);
        if (rays_.hasMultiplier())
        {
            step.alpha += takeLiveWork(remainder_);
        }
        step.y += remainder_;
        applyRaysTransposed(rays_, remainder_, trialRays_);
        rayWork_ += trialRays_;
        step.s += d_.cwiseProduct(trialRays_);
    }
    step.z = reduction * residuals_.opening - rayWork_;
}

void InteriorPoint::measureSteps(const Iterate& step)
{
    primal_ = stepToBoundary(at_.s, step.s);
    dual_ = stepToBoundary(at_.z, step.z);
    if (rays_.hasInertia())
    {
        primal_ = dual_ = std::min(primal_, dual_); // y stands in the balance too
    }
}

/// Adds the correction in hand to a step, with the weights from `least` to 1 that allow the longest steps
/// (Colombo & Gondzio 2008): a corrector is made for a step that may turn out too long. \return whether it
/// was worth adding
bool InteriorPoint::addCorrection(double least, double largestLoss, Iterate& step)
{
    blocking_.clear();
    const double floor = collectBlocking(at_.s, step.s, correction_.s, least, 1 / farthest, blocking_);
    Weight forces;
    Weight openings;
    if (rays_.hasInertia())
    {
        collectBlocking(at_.z, step.z, correction_.z, least, floor, blocking_);
        forces = openings = bestWeight(blocking_, least);
    }
    else
    {
        forces = bestWeight(blocking_, least);
        blocking_.clear();
        collectBlocking(at_.z, step.z, correction_.z, least, 1 / farthest, blocking_);
        openings = bestWeight(blocking_, least);
    }
    if (forces.step < largestLoss * std::min(1.0, primal_)
        || openings.step < largestLoss * std::min(1.0, dual_))
    {
        return false;
    }
    step.s += forces.weight * correction_.s;
    step.alpha += forces.weight * correction_.alpha;
    step.z += openings.weight * correction_.z;
    step.y += openings.weight * correction_.y;
    primal_ = forces.step;
    dual_ = openings.step;
    return true;
}

void InteriorPoint::begin(double rayCompliance, Passed passed)
{
    compliance_ = rayCompliance;
    passed_ = passed;
    interior_ = {};
    mu_ = 1;
    rounding_ = 0;
    waits_ = 0;
    stalls_ = 0;
    mends_ = 0;
}

/// Mehrotra's start: the least forces that balance the load, and the least openings that are compatible, both
/// pushed inside their cones by as much as they lie outside and then apart until neither is out of proportion
/// to the other.
bool InteriorPoint::start(Start from)
{
    const int rays = rays_.rayCount();
    at_.s = VectorXd::Ones(rays);
    at_.z = VectorXd::Ones(rays);
    at_.y = VectorXd::Zero(rays_.load.size());
    at_.alpha = 0;
    begin(from == Start::leastSquares ? compliance : 0, Passed::kept);
    if (rays == 0 || from == Start::unit)
    {
        return true;
    }
    // With s = z = 1, one Newton step without complementarity: B B' dy = f + ..., s = B' dy.
    if (!factorise())
    {
        return false;
    }
    VectorXd forces = rays_.load;
    if (!rays_.hasMultiplier())
    {
        solveSchur(forces);
    }
    else
    {
        liveSolution_ = rays_.liveLoad;
        solveSchur(forces, liveSolution_);
        liveStiffness_ = rays_.liveLoad.dot(liveSolution_);
        // alpha that makes the forces least: L'(B B')^-1 (f + alpha L) = 0
        at_.alpha = -rays_.liveLoad.dot(forces) / liveStiffness_;
        forces += at_.alpha * liveSolution_;
        at_.y = (rays_.liveWork / liveStiffness_) * liveSolution_;
    }
    applyRaysTransposed(rays_, forces, at_.s);
    if (rays_.gap.lpNorm<Eigen::Infinity>() > 0)
    {
        rowWork_.setZero(rays_.load.size());
        addRays(rays_, rays_.gap, rowWork_);
        solveSchur(rowWork_);
        at_.y += rowWork_;
    }
    applyRaysTransposed(rays_, at_.y, rayWork_);
    at_.z = rays_.gap - rayWork_;

    at_.s.array() += std::max(0.0, -1.5 * at_.s.minCoeff());
    at_.z.array() += std::max(0.0, -1.5 * at_.z.minCoeff());
    const double product = at_.s.dot(at_.z);
    const double sSum = at_.s.sum();
    const double zSum = at_.z.sum();
    at_.s.array() += std::max(zSum > 0 ? 0.5 * product / zSum : 0, 1e-2 * at_.s.maxCoeff() + 1e-2);
    at_.z.array() += std::max(sSum > 0 ? 0.5 * product / sSum : 0, zSum > 0 ? 1e-2 * at_.z.maxCoeff() : 1.0);
    return true;
}

bool InteriorPoint::run(Start from, const Centring& centring)
{
    return start(from) && iterate(centring, settings_.maximumIterations, settings_.maximumIterations);
}

/// With z = g - B'y for what the displacements open, the forces and openings of each ray are moved to where
/// their product is mu and their difference what it was: (s + z)^2 = (s - z)^2 + 4 mu. What presses keeps its
/// force, what is open its gap, and what may be either gets sqrt(mu) of both (Chen & Harker 1993 smooth
/// complementarity problems so).
bool InteriorPoint::runFrom(const VectorXd& s, const VectorXd& y, double error)
{
    const double mu = std::clamp(complementarityOfNear * error * error, leastOfNear, largestOfNear);
    at_.y = y;
    at_.alpha = 0;
    applyRaysTransposed(rays_, y, rayWork_);
    const Eigen::ArrayXd difference = s - (rays_.gap - rayWork_);
    const Eigen::ArrayXd sum = (difference.square() + 4 * mu).sqrt();
    const Eigen::ArrayXd larger = 0.5 * (sum + difference.abs());
    at_.s = (difference > 0).select(larger, mu / larger); // without cancellation
    at_.z = mu / at_.s.array();
    begin(0, Passed::left);
    return iterate(narrow, std::min(mostFromNear, settings_.maximumIterations), mostShortSteps);
}

/// The displacements are moved on with those to come, and openings follow where they grow; what would close
/// keeps its opening, and the iterations mend the difference. A ray that is new is as open as the
/// displacements say, and has the force for which its product is that of the others.
bool InteriorPoint::runFrom(Iterate interior, const VectorXd& heading)
{
    iterations_ = 0;
    at_ = std::move(interior);
    at_.y += heading;
    at_.alpha = 0;
    applyRaysTransposed(rays_, at_.y, rayWork_);
    rayWork_ = rays_.gap - rayWork_;
    double products = 0;
    int known = 0;
    for (Eigen::Index ray = 0; ray < at_.s.size(); ++ray)
    {
        if (at_.s[ray] > 0 && at_.z[ray] > 0)
        {
            if (rayWork_[ray] > partOfOpening * at_.z[ray])
            {
                at_.z[ray] = std::min(rayWork_[ray], largestOpening * at_.z[ray]);
            }
            products += at_.s[ray] * at_.z[ray];
            ++known;
        }
    }
    const double mu = known > 0 ? products / known : 0;
    if (2 * known < at_.s.size() || !(mu > 0.01 * complementarityOfInterior)
        || !(mu < 100 * complementarityOfInterior))
    {
        return false; // of another structure, or of another step
    }
    for (Eigen::Index ray = 0; ray < at_.s.size(); ++ray)
    {
        if (!(at_.s[ray] > 0 && at_.z[ray] > 0))
        {
            at_.z[ray] = std::max(rayWork_[ray], std::sqrt(mu));
            at_.s[ray] = mu / at_.z[ray];
        }
    }
    begin(0, Passed::kept);
    return iterate(wide, std::min(mostFromInterior, settings_.maximumIterations), mostShortStepsFromInterior);
}

bool InteriorPoint::iterate(const Centring& centring, int mostIterations, int shortStepsAllowed)
{
    const int correctors = system_.factorisationOverSolve() < dearFactorisation
                               ? (settings_.correctors + 1) / 2
                               : settings_.correctors;
    Iterate step;
    double expected = std::numeric_limits<double>::infinity(); // of what is missing from the balance
    for (iterations_ = 0; iterations_ <= mostIterations; ++iterations_)
    {
        computeResiduals();
        const double missing = residuals_.balance.lpNorm<Eigen::Infinity>();
        stalls_ += missing > expected && missing > ofResiduals * settings_.tolerance * forceSize();
        const double mu = mu_ = complementarity();
        falls_ = !rays_.hasInertia() && isFalling(possibleFall);
        grows_ = sought_ == Sought::solution && at_.alpha > possiblyUnlimited;
        if (!std::isfinite(mu) || falls_ || grows_ || diverges())
        {
            return false;
        }
        if (passed_ == Passed::kept && rays_.hasInertia() && interior_.s.size() == 0
            && mu <= complementarityOfInterior)
        {
            interior_ = at_;
        }
        if (converged() || (isBalanceMissing() && mendBalance()))
        {
            return true;
        }
        if (iterations_ == mostIterations || isStalled())
        {
            break;
        }
        if (!factorise())
        {
            return false;
        }

        if (isRestingSought())
        {
            tryResting();
        }

        predict(step);
        measureSteps(step);
        double primal = std::min(1.0, primal_);
        double dual = std::min(1.0, dual_);
        const double muAfter = (at_.s + primal * step.s).dot(at_.z + dual * step.z) / rays_.rayCount();
        // Complementarity must not run ahead of the balance, or the balance can no longer be mended: no
        // further than the tolerance asks.
        const double enough = 0.02 * settings_.tolerance * objectiveSize() / rays_.rayCount();
        const double sigma =
            std::max(centring.partOfCube * std::pow(muAfter / mu, 3), std::min(1.0, enough / mu));

        // Mehrotra's corrector: aims at sigma mu, with the second-order term of the predictor.
        correct((sigma * mu - step.s.array() * step.z.array()) / answerOfProducts(at_, step, 1, 1),
                correction_);
        addCorrection(primal * dual, centring.largestLoss, step);

        // Gondzio's.
        const double aim = std::max(centring.aim * sigma, centring.leastAim) * mu;
        for (int corrector = 0; corrector < correctors && std::min(primal_, dual_) < centring.longStep;
             ++corrector)
        {
            primal = std::min(1.0, centring.relativeGrowth * primal_ + centring.stepGrowth);
            dual = std::min(1.0, centring.relativeGrowth * dual_ + centring.stepGrowth);
            const auto product = (at_.s + primal * step.s).array() * (at_.z + dual * step.z).array();
            const double least = centring.leastProduct * aim;
            const double largest = centring.largestProduct * aim;
            correct((least - product).max((largest - product).min(0.0).max(-largest))
                        / answerOfProducts(at_, step, primal, dual),
                    correction_);
            if (!addCorrection(std::min(primal * dual, fullCorrection), centring.largestLoss, step))
            {
                break;
            }
        }

        if (std::min(primal_, dual_) < shortStep && --shortStepsAllowed < 0)
        {
            return false;
        }
        const double back = std::max(0.99, 1 - mu);
        primal = std::min(1.0, back * primal_);
        dual = std::min(1.0, back * dual_);
        expected = primal >= wholeStep ? shareLeft * missing : std::numeric_limits<double>::infinity();
        at_.s += primal * step.s;
        at_.alpha += primal * step.alpha;
        at_.y += dual * step.y;
        at_.z += dual * step.z;
    }
    return false;
}

InteriorStart interiorStart(const PlaneConeProgram& program, const RayForm& form, const Iterate& iterate,
                            const VectorXd& end)
{
    ConeSolution inside = fromRays(program, form, iterate.s, iterate.y - end, 0);
    return {std::move(inside.contactForce), openingOf(form, iterate.z), std::move(inside.displacement)};
}

Iterate interiorRays(const PlaneConeProgram& program, const RayForm& form, const InteriorStart& start)
{
    return {raysOf(program, form, start.contactForce), raysOfOpening(form, start.opening),
            rowsOf(form, start.displacement), 0};
}

enum class Precision
{
    standard, ///< of double
    extended  ///< see ExtendedInteriorPoint.h
};

/// What a program is solved for, about which multiplier, where that is large, and in which numbers.
struct Aim
{
    Sought sought;
    double multiplier = 0;
    Precision precision = Precision::standard;
};

bool mayBeExtended(const PlaneConeProgram& program, const InteriorPointSettings& settings,
                   const SymbolicAnalysis& symbolic)
{
    return settings.arithmetic == Arithmetic::adaptive && isExtendedAffordable(program, symbolic);
}

/// Solves one program in ray form; `optimal` in its status means that the scaled residuals met the tolerance,
/// `unbounded` that there may be no largest multiplier.
/// \param near to begin with, or null
ConeSolution solveOnce(const PlaneConeProgram& program, const InteriorPointSettings& settings, const Aim& aim,
                       SymbolicAnalysis& symbolic, const ConeSolution* near = nullptr)
{
    RayForm form = makeRayForm(program, symbolic, aim.multiplier);
    if (aim.sought == Sought::fall || aim.sought == Sought::carried)
    {
        form.program.liveWork = 0;
    }
    SchurSystem<3>& system = schurSystem(form, symbolic);
    if (aim.precision == Precision::extended)
    {
        return solveInExtendedPrecision(program, form, settings, aim.sought);
    }
    InteriorPoint solver(form.program, system, settings, aim.sought);
    // The least forces of a time step say little: they leave inertia out. Wall 6 collapsing: 20.6
    // factorisations a step from `unit`, 33.2 from `leastSquares`, which fails in one step of seventeen.
    bool converged = false;
    int before = 0; // iterations of starts that failed
    if (near)
    {
        const double error = certifyOptimal(program, *near).worst();
        const VectorXd heading = rowsOf(form, near->displacement);
        if (error <= nearEnough)
        {
            converged = solver.runFrom(raysOf(program, form, near->contactForce), heading, error);
            before += converged ? 0 : solver.iterations();
        }
        if (!converged && near->interior.contactForce.size() == 2 * program.points())
        {
            converged = solver.runFrom(interiorRays(program, form, near->interior), heading);
            before += converged ? 0 : solver.iterations();
        }
    }
    converged = converged
                || (program.hasInertia()
                        ? solver.run(Start::unit, wide) || solver.run(Start::leastSquares, narrow)
                        : solver.run(Start::leastSquares, wide)
                              || (!solver.falls() && !solver.grows()
                                  && !(solver.isStalled() && mayBeExtended(program, settings, symbolic))
                                  && solver.run(Start::unit, narrow)));
    const Iterate& at = solver.iterate();
    ConeSolution solution = fromRays(program, form, at.s, at.y, at.alpha);
    if (solver.resting().size() > 0)
    {
        solution.restingForce = fromRays(program, form, solver.resting(), at.y, 0).contactForce;
    }
    if (converged && !program.hasStrength() && solver.interior().s.size() > 0)
    {
        solution.interior = interiorStart(program, form, solver.interior(), at.y);
    }
    solution.iterations = before + solver.iterations();
    solution.factorisations = solver.factorisations();
    solution.solves = solver.solves();
    solution.status = converged        ? SolveStatus::optimal
                      : solver.grows() ? SolveStatus::unbounded
                                       : SolveStatus::notConverged;
    return solution;
}

/// A solution and the worst figure of what proves it.
struct Proved
{
    ConeSolution solution;
    double worst = std::numeric_limits<double>::infinity();
};

/// As solveOnce, to a certificate: what the scaled residuals promise, the certificate may miss by a little
/// (others are the largest of its terms), and what proves nothing at one tolerance may do so at a tighter
/// one. Then it is solved again, ten times as well, where that is not hopeless. \param worst figure of the
/// certificate of a solution \return the last solution, with all the work counted
template<class Worst>
Proved solveToCertificate(const PlaneConeProgram& program, InteriorPointSettings settings, const Aim& aim,
                          SymbolicAnalysis& symbolic, const Worst& worst, const ConeSolution* near = nullptr)
{
    constexpr int attempts = 3;
    constexpr double hopeless = 1e4; // times the tolerance
    const double tolerance = settings.tolerance;
    Proved proved;
    proved.solution = solveOnce(program, settings, aim, symbolic, near);
    proved.worst = worst(proved.solution);
    for (int attempt = 1; attempt < attempts && proved.solution.status == SolveStatus::optimal
                          && proved.worst > tolerance && proved.worst <= hopeless * tolerance;
         ++attempt)
    {
        settings.tolerance /= 10;
        Proved better;
        better.solution = solveOnce(program, settings, aim, symbolic);
        better.worst = worst(better.solution);
        if (better.solution.status != SolveStatus::optimal && better.worst > tolerance)
        {
            addWork(proved.solution, better.solution);
            break; // beyond what rounding allows
        }
        addWork(better.solution, proved.solution);
        proved = std::move(better);
        proved.solution.status = SolveStatus::optimal;
    }
    return proved;
}

/// Any forces that balance the load will do: y = 0 completes them.
bool isBalanceAlone(const PlaneConeProgram& program)
{
    return !program.hasMultiplier() && !program.hasInertia() && program.gap.size() == 0;
}

/// The worst figure of the certificate of an optimum, which the solution is completed for.
double worstOfOptimum(const PlaneConeProgram& program, ConeSolution& found)
{
    if (isBalanceAlone(program))
    {
        found.displacement.setZero();
    }
    return certifyOptimal(program, found).worst();
}

/// Where rounding may have ended the iterations: the same in extended precision, its optimum or the proof
/// that there is none. \param solution gets the work, and what is answered with its status
void answerInExtendedPrecision(const PlaneConeProgram& program, const InteriorPointSettings& settings,
                               SymbolicAnalysis& symbolic, ConeSolution& solution)
{
    if (!mayBeExtended(program, settings, symbolic))
    {
        return;
    }
    Proved proved =
        solveToCertificate(program, settings, {Sought::solution, 0, Precision::extended}, symbolic,
                           [&](ConeSolution& found) { return worstOfOptimum(program, found); });
    addWork(solution, proved.solution);
    if (proved.worst <= settings.tolerance)
    {
        solution.status = SolveStatus::optimal;
        solution.multiplier = proved.solution.multiplier;
        solution.contactForce = std::move(proved.solution.contactForce);
        solution.displacement = std::move(proved.solution.displacement);
        return;
    }
    if (program.hasInertia() || proved.solution.status == SolveStatus::unbounded)
    {
        return;
    }
    const Proved moved = solveToCertificate(
        withUnitInertia(program), settings, {Sought::fall, 0, Precision::extended}, symbolic,
        [&](const ConeSolution& found) { return certifyInfeasible(program, found.displacement).worst(); });
    addWork(solution, moved.solution);
    if (moved.worst <= settings.tolerance)
    {
        solution.status = SolveStatus::infeasible;
        solution.displacement = moved.solution.displacement;
    }
}

/// Where r of the least-squares program does not vanish but is small, its y is good for a proof only if it is
/// exact to the square of r: that takes an active set. Loads out of balance by 1e-5 of their size at best are
/// so told from such as are carried.
/// \param moving the program with unit inertia \param moved its solution, nearly
void answerExactly(const PlaneConeProgram& program, const PlaneConeProgram& moving, const ConeSolution& moved,
                   const InteriorPointSettings& settings, SymbolicAnalysis& symbolic, ConeSolution& solution)
{
    ConeSolution exact =
        solveAugmentedLagrangian(moving, moved, exactSettings(settings.maximumIterations), &symbolic);
    addWork(solution, exact);
    if (certifyInfeasible(program, exact.displacement).worst() <= settings.tolerance)
    {
        solution.status = SolveStatus::infeasible;
        solution.displacement = std::move(exact.displacement);
        return;
    }
    exact.displacement.setZero();
    if (certifyOptimal(program, exact).worst() <= settings.tolerance)
    {
        solution.status = SolveStatus::optimal;
        solution.contactForce = std::move(exact.contactForce);
        solution.displacement = std::move(exact.displacement);
    }
}

/// Where the interior point has not reached the tolerance: the multiplier by upper bounds, if there is one,
/// in programs small enough for some hundred factorisations.
void boundMultiplier(const PlaneConeProgram& program, const InteriorPointSettings& settings,
                     ConeSolution& solution)
{
    constexpr int mostPoints = 5000;
    if (!hasUpperBounds(program) || program.points() > mostPoints)
    {
        return;
    }
    ConeSolution bounded =
        solveByUpperBounds(program, solution.multiplier, settings.tolerance, settings.maximumIterations);
    addWork(solution, bounded);
    if (bounded.status == SolveStatus::optimal)
    {
        solution.status = SolveStatus::optimal;
        solution.multiplier = bounded.multiplier;
        solution.contactForce = std::move(bounded.contactForce);
        solution.displacement = std::move(bounded.displacement);
    }
}

/// Forces that carry the live load alone are the ray; they grow without limit where crushing sets none.
/// \param solution gets the work, and the ray and its status where there is one \return whether there is
bool proveUnbounded(const PlaneConeProgram& program, const InteriorPointSettings& settings,
                    SymbolicAnalysis& symbolic, ConeSolution& solution)
{
    PlaneConeProgram live = liveLoadAlone(program);
    live.strength.clear();
    for (int point = 0; program.hasStrength() && point < program.points(); ++point)
    {
        if (program.strength[point].isBounded())
        {
            live.contacts[point].onFirst.setZero();
            live.contacts[point].onSecond.setZero();
        }
    }
    Proved carried =
        solveToCertificate(live, settings, {Sought::carried}, symbolic,
                           [&](ConeSolution& found)
                           {
                               for (int point = 0; program.hasStrength() && point < program.points(); ++point)
                               {
                                   if (program.strength[point].isBounded())
                                   {
                                       found.contactForce.segment<2>(2 * point).setZero();
                                   }
                               }
                               return certifyUnbounded(program, found.contactForce).worst();
                           });
    addWork(solution, carried.solution);
    if (!(carried.worst <= settings.tolerance))
    {
        return false;
    }
    solution.status = SolveStatus::unbounded;
    solution.contactForce = std::move(carried.solution.contactForce);
    return true;
}

/// Whether forces balance the loads at a large multiplier. \param solution gets the work
bool isLargeMultiplierCarried(const PlaneConeProgram& program, const InteriorPointSettings& settings,
                              SymbolicAnalysis& symbolic, ConeSolution& solution)
{
    const PlaneConeProgram loaded = atLargeMultiplier(program);
    const Proved balanced = solveToCertificate(loaded, settings, {Sought::solution}, symbolic,
                                               [&](ConeSolution& found)
                                               {
                                                   found.displacement.setZero();
                                                   return certifyOptimal(loaded, found).worst();
                                               });
    addWork(solution, balanced.solution);
    return balanced.worst <= settings.tolerance;
}

} // namespace

ConeSolution solveInteriorPoint(const PlaneConeProgram& program, const InteriorPointSettings& settings,
                                SymbolicAnalysis* kept, const ConeSolution* near)
{
    SymbolicAnalysis own;
    SymbolicAnalysis& symbolic = kept ? *kept : own;
    if (program.hasCompliance())
    {
        throw std::invalid_argument("solveInteriorPoint needs rigid points");
    }
    if (near && (!program.hasInertia() || program.hasMultiplier() || program.hasStrength()))
    {
        throw std::invalid_argument(
            "solveInteriorPoint begins near a solution with inertia, cones and no multiplier only");
    }
    const auto solveFor = [&](const Aim& aim)
    {
        return solveToCertificate(
            program, settings, aim, symbolic,
            [&](ConeSolution& found) { return worstOfOptimum(program, found); }, near);
    };
    Proved proved = solveFor({Sought::solution});
    if (proved.solution.status == SolveStatus::unbounded)
    {
        ConeSolution& growing = proved.solution;
        if (isLargeMultiplierCarried(program, settings, symbolic, growing)
            && proveUnbounded(program, settings, symbolic, growing))
        {
            return std::move(growing);
        }
        // First in units of what breaks a point, then as iterates only passed such a multiplier.
        const std::vector<double> expected =
            program.hasStrength() ? std::vector<double>{growing.multiplier, 0} : std::vector<double>{0};
        for (const double multiplier : expected)
        {
            Proved farther = solveFor({Sought::farther, multiplier});
            addWork(farther.solution, proved.solution);
            proved = std::move(farther);
            if (proved.worst <= settings.tolerance)
            {
                break;
            }
        }
    }
    ConeSolution& solution = proved.solution;
    if (solution.status == SolveStatus::optimal)
    {
        if (proved.worst > settings.tolerance)
        {
            solution.status = SolveStatus::notConverged;
            answerInExtendedPrecision(program, settings, symbolic, solution);
        }
        if (solution.status == SolveStatus::notConverged)
        {
            boundMultiplier(program, settings, solution);
        }
        return std::move(solution);
    }
    if (program.hasInertia())
    {
        answerInExtendedPrecision(program, settings, symbolic, solution);
        return std::move(solution);
    }

    // Least r with r + A c = f + alpha L: where it does not vanish, y = Mbar^-1 r proves that nothing
    // balances f, since the optimality conditions are -A'y in the dual cone, L'y = 0 and f'y = r' Mbar^-1 r >
    // 0.
    const PlaneConeProgram moving = withUnitInertia(program);
    const Proved moved = solveToCertificate(
        moving, settings, {Sought::fall}, symbolic,
        [&](const ConeSolution& found) { return certifyInfeasible(program, found.displacement).worst(); });
    addWork(solution, moved.solution);
    if (moved.worst <= settings.tolerance)
    {
        solution.status = SolveStatus::infeasible;
        solution.displacement = moved.solution.displacement;
        return std::move(solution);
    }
    answerInExtendedPrecision(program, settings, symbolic, solution);
    if (solution.status != SolveStatus::notConverged)
    {
        return std::move(solution);
    }
    if (isBalanceAlone(program) && !program.hasCrushing())
    {
        answerExactly(program, moving, moved.solution, settings, symbolic, solution);
    }
    if (!program.hasMultiplier())
    {
        return std::move(solution);
    }
    proveUnbounded(program, settings, symbolic, solution);
    if (solution.status == SolveStatus::notConverged)
    {
        boundMultiplier(program, settings, solution);
    }
    return std::move(solution);
}

} // namespace drystone
