// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/InteriorPoint.h"

#include "conic/Certificate.h"
#include "conic/RayProgram.h"

#include <algorithm>
#include <cmath>

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

/// Complementarity above which a Newton step needs no refinement.
constexpr double firmComplementarity = 1e-7;

/// What the live load does on the displacements: one unit (a mechanism), or nothing (a ray).
enum class LiveWork
{
    unit,
    none
};

/// What is left of the optimality conditions.
struct Residuals
{
    VectorXd balance; ///< f + L alpha - M y - B s
    VectorXd opening; ///< g - B'y - z
    double work = 0;  ///< w - L'y
};

class InteriorPoint
{
public:
    InteriorPoint(const RayProgram& rays, SchurSystem<3>& system, const InteriorPointSettings& settings)
        : rays_(rays), system_(system), settings_(settings)
    {
    }

    /// Iterates until the scaled residuals meet the tolerance. \return whether they did
    bool run(Start from);

    /// Forces that balance f alone, found on the way; empty when none were.
    const VectorXd& resting() const { return resting_; }
    const Iterate& iterate() const { return at_; }
    int iterations() const { return iterations_; }
    int factorisations() const { return factorisations_; }
    int solves() const { return solves_; }

private:
    bool start(Start from);
    void computeResiduals();
    bool factorise();
    void tryResting();
    /// Forces of later iterates are too near the surface of their cones.
    bool isRestingSought() const
    {
        return rays_.hasMultiplier() && rays_.rayCount() > 0 && resting_.size() == 0 && iterations_ <= 4;
    }
    void solveNewton(const VectorXd& complementarity, double reduction, Iterate& step);
    void solveSchur(VectorXd& x);
    double complementarity() const { return rays_.rayCount() ? at_.s.dot(at_.z) / rays_.rayCount() : 0; }
    double objectiveSize() const;
    bool converged() const;
    bool diverges() const;

    const RayProgram& rays_;
    SchurSystem<3>& system_;
    InteriorPointSettings settings_;
    Iterate at_;
    Residuals residuals_;
    VectorXd stiffness_;       ///< z + rho s
    VectorXd d_;               ///< s / stiffness
    VectorXd liveSolution_;    ///< S^-1 L
    double liveStiffness_ = 0; ///< L' S^-1 L
    VectorXd resting_;         ///< s >= 0 with B s = f, or empty
    double compliance_ = 0;
    double mu_ = 0; ///< complementarity of the iterate
    int iterations_ = 0;
    int factorisations_ = 0;
    int solves_ = 0;
    VectorXd rayWork_, rayWork2_, trialRays_, rowWork_, right_, remainder_;
};

/// Largest step in [0, 1] that keeps x + step dx >= 0.
double stepToBoundary(const VectorXd& x, const VectorXd& dx)
{
    // Largest -dx/x, found without a branch so that it vectorises.
    const double steepest = x.size() ? (-dx.array() / x.array()).maxCoeff() : 0;
    return steepest > 1 ? 1 / steepest : 1;
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
    balance.segment<3>(3 * rays_.bodies).setZero();
    applyRaysTransposed(rays_, at_.y, rayWork_);
    residuals_.opening = rays_.gap - rayWork_ - at_.z;
}

/// What the gap is compared with, as in Certificate.h.
double InteriorPoint::objectiveSize() const
{
    return rays_.hasMultiplier() ? std::max(rays_.liveWork * std::max(1e-3, std::abs(at_.alpha)),
                                            std::abs(rays_.load.dot(at_.y)))
                                 : 1.0;
}

bool InteriorPoint::converged() const
{
    const double tolerance = 0.7 * settings_.tolerance;
    if (!rays_.hasMultiplier() && !rays_.hasInertia() && rays_.gap.isZero(0))
    {
        return residuals_.balance.lpNorm<Eigen::Infinity>()
               <= tolerance; // any forces will do: y = 0 completes them
    }
    const double displacement =
        std::max({at_.y.lpNorm<Eigen::Infinity>(), rays_.gap.lpNorm<Eigen::Infinity>(),
                  rays_.hasInertia() ? 1.0 : 0.0});
    const double force = std::max(1.0, std::abs(at_.alpha));
    return residuals_.balance.lpNorm<Eigen::Infinity>() <= tolerance * force
           && residuals_.opening.lpNorm<Eigen::Infinity>() <= tolerance * displacement
           && std::abs(residuals_.work) <= tolerance * std::max(1.0, rays_.liveWork)
           && at_.s.dot(at_.z) <= tolerance * objectiveSize();
}

/// Without a solution the iterates run off along a ray; that ray is then found, and proved, by a program of
/// its own.
bool InteriorPoint::diverges() const
{
    constexpr double far = 1e13;
    return std::abs(at_.alpha) > far || at_.y.lpNorm<Eigen::Infinity>() > far
           || at_.s.lpNorm<Eigen::Infinity>() > far * std::max(1.0, std::abs(at_.alpha));
}

bool InteriorPoint::factorise()
{
    const double force = std::max(1.0, at_.s.lpNorm<Eigen::Infinity>());
    stiffness_ = at_.z + (compliance_ / (force * force)) * at_.s;
    d_ = at_.s.cwiseQuotient(stiffness_);
    // Cancellation may make a pivot negative: then each is raised by what rounding may have taken from it.
    double rounding = 0;
    do
    {
        if (rounding > 1e-6)
        {
            return false;
        }
        assembleSchur(rays_, d_, proximal, rounding, system_);
        ++factorisations_;
        rounding = rounding == 0 ? 1e-15 : 10 * rounding;
    } while (!system_.factorise());
    if (rays_.hasMultiplier())
    {
        liveSolution_ = rays_.liveLoad;
        solveSchur(liveSolution_);
        liveStiffness_ = rays_.liveLoad.dot(liveSolution_);
    }
    return true;
}

/// Are there forces that carry f alone? Those of the iterate are changed by the least, in the metric of D,
/// that balances f without the live load, s + D B' S^-1 (f - B s); rays that come out pulling are reflected,
/// and so on. Alternating projections find a point in the interior of the intersection in finitely many
/// passes (Bauschke & Borwein 1996), a few here; each costs a solve. It says nothing when it finds none.
void InteriorPoint::tryResting()
{
    // The forces of the start are too even for walls with windows, but right for solid ones.
    const int passes = iterations_ == 0 ? 3 : 10;
    constexpr double reflection = 1.2;
    const double enough = 0.1 * settings_.tolerance;
    VectorXd forces = at_.s;
    for (int pass = 0; pass < passes; ++pass)
    {
        const bool pulls = forces.minCoeff() < 0;
        if (pulls)
        {
            forces = (forces.array() < 0).select(-reflection * forces, forces);
        }
        remainder_ = -rays_.load;
        addRays(rays_, forces, remainder_);
        remainder_.segment<3>(3 * rays_.bodies).setZero();
        if (!pulls && remainder_.lpNorm<Eigen::Infinity>() <= enough)
        {
            resting_ = std::move(forces);
            return;
        }
        solveSchur(remainder_);
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

/// Newton's equations, with R the fraction (`reduction`) of the residuals to remove and c the wished change
/// of s z:
///     M dy + B ds - L da = R balance,  B'dy + dz = R opening,  L'dy = R work,  (z + rho s) ds + s dz = c.
/// With D = s/(z + rho s):  ds = c/(z + rho s) - D (R opening - B'dy), so  (M + B D B') dy - L da = R balance
/// - B (c/(z + rho s) - D R opening).
void InteriorPoint::solveNewton(const VectorXd& complementarity, double reduction, Iterate& step)
{
    rayWork2_ = complementarity.cwiseQuotient(stiffness_) - reduction * d_.cwiseProduct(residuals_.opening);
    right_.setZero(rays_.load.size());
    addRays(rays_, rayWork2_, right_);
    right_ = reduction * residuals_.balance - right_;
    right_.segment<3>(3 * rays_.bodies).setZero();

    step.y = right_;
    solveSchur(step.y);
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
        rowWork_.setZero(right_.size());
        addRays(rays_, step.s, rowWork_);
        if (rays_.hasInertia())
        {
            for (int body = 0; body < rays_.bodies; ++body)
            {
                rowWork_.segment<3>(3 * body) += rays_.inertia[body] * step.y.segment<3>(3 * body);
            }
        }
        remainder_ -= rowWork_;
        remainder_.segment<3>(3 * rays_.bodies).setZero();
        const double force = std::max(1.0, std::abs(at_.alpha));
        if (remainder_.lpNorm<Eigen::Infinity>() <= std::max(
                0.1 * settings_.tolerance * force, 1e-2 * residuals_.balance.lpNorm<Eigen::Infinity>()))
        {
            break;
        }
        solveSchur(remainder_);
        if (rays_.hasMultiplier())
        {
            const double change = -rays_.liveLoad.dot(remainder_) / liveStiffness_;
            remainder_ += change * liveSolution_;
            step.alpha += change;
        }
        step.y += remainder_;
        applyRaysTransposed(rays_, remainder_, trialRays_);
        rayWork_ += trialRays_;
        step.s += d_.cwiseProduct(trialRays_);
    }
    step.z = reduction * residuals_.opening - rayWork_;
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
    compliance_ = from == Start::leastSquares ? compliance : 0;
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
    solveSchur(forces);
    if (rays_.hasMultiplier())
    {
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

bool InteriorPoint::run(Start from)
{
    Iterate step;
    Iterate trial;
    VectorXd target;
    if (!start(from))
    {
        return false;
    }
    for (iterations_ = 0; iterations_ <= settings_.maximumIterations; ++iterations_)
    {
        computeResiduals();
        const double mu = mu_ = complementarity();
        if (!std::isfinite(mu) || diverges())
        {
            return false;
        }
        if (converged())
        {
            return true;
        }
        if (iterations_ == settings_.maximumIterations)
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

        // Predictor: straight for the optimum.
        target = -at_.s.cwiseProduct(at_.z);
        solveNewton(target, 1, step);
        double primal = stepToBoundary(at_.s, step.s);
        double dual = stepToBoundary(at_.z, step.z);
        const double muAfter = (at_.s + primal * step.s).dot(at_.z + dual * step.z) / rays_.rayCount();
        // Complementarity must not run ahead of the balance, or the balance can no longer be mended: no
        // further than the tolerance asks.
        const double enough =
            rays_.hasMultiplier() ? 0.02 * settings_.tolerance * objectiveSize() / rays_.rayCount() : 0;
        const double sigma = std::max(std::pow(muAfter / mu, 3), std::min(1.0, enough / mu));

        // Corrector: aims at sigma mu, with the second-order term of the predictor.
        target = (sigma * mu - at_.s.array() * at_.z.array() - step.s.array() * step.z.array()).matrix();
        solveNewton(target, 1, step);
        primal = stepToBoundary(at_.s, step.s);
        dual = stepToBoundary(at_.z, step.z);

        // Gondzio's correctors: widen the step by pulling outlying products s z at its far end back into a
        // box about the target; each costs one solve.
        for (int corrector = 0; corrector < settings_.correctors && std::min(primal, dual) < 0.95;
             ++corrector)
        {
            const double primalTry = std::min(1.0, 1.1 * primal + 0.1);
            const double dualTry = std::min(1.0, 1.1 * dual + 0.1);
            const double aim = std::max(sigma, 1e-3) * mu;
            rayWork_ = (at_.s + primalTry * step.s).cwiseProduct(at_.z + dualTry * step.z);
            VectorXd correction =
                (rayWork_.array().max(0.1 * aim).min(10 * aim) - rayWork_.array()).max(-10 * aim);
            const VectorXd wider = target + correction;
            solveNewton(wider, 1, trial);
            const double primalNew = stepToBoundary(at_.s, trial.s);
            const double dualNew = stepToBoundary(at_.z, trial.z);
            if (primalNew + dualNew < primal + dual + 0.01)
            {
                break;
            }
            std::swap(step, trial);
            target = wider;
            primal = primalNew;
            dual = dualNew;
        }

        if (rays_.hasInertia())
        {
            primal = dual = std::min(primal, dual); // y stands in the balance too
        }
        const double back = std::max(0.9, 1 - mu);
        primal = std::min(1.0, std::max(0.99, back) * primal);
        dual = std::min(1.0, std::max(0.99, back) * dual);
        at_.s += primal * step.s;
        at_.alpha += primal * step.alpha;
        at_.y += dual * step.y;
        at_.z += dual * step.z;
    }
    return false;
}

/// The program with inertia of order one in every row: how the blocks would start to move (Gauss's principle
/// of least constraint). It always has a solution.
PlaneConeProgram withUnitInertia(const PlaneConeProgram& program)
{
    PlaneConeProgram result = program;
    const double lever = meanLeverArm(program);
    result.inertia.assign(program.bodies, Eigen::Vector3d(1, 1, lever * lever).asDiagonal().toDenseMatrix());
    return result;
}

/// Solves one program in ray form; `optimal` in its status means that the scaled residuals met the tolerance.
ConeSolution solveOnce(const PlaneConeProgram& program, const InteriorPointSettings& settings,
                       LiveWork liveWork, SymbolicAnalysis& symbolic)
{
    RayForm form = makeRayForm(program, symbolic);
    if (liveWork == LiveWork::none)
    {
        form.program.liveWork = 0;
    }
    SchurSystem<3>& system = schurSystem(form, symbolic);
    InteriorPoint solver(form.program, system, settings);
    // The least forces of a time step say little: they leave inertia out. Wall 6 collapsing: 20.6
    // factorisations a step from `unit`, 33.2 from `leastSquares`, which fails in one step of seventeen.
    const bool converged = program.hasInertia() ? solver.run(Start::unit) || solver.run(Start::leastSquares)
                                                : solver.run(Start::leastSquares) || solver.run(Start::unit);
    const Iterate& at = solver.iterate();
    ConeSolution solution = fromRays(program, form, at.s, at.y, at.alpha);
    if (solver.resting().size() > 0)
    {
        solution.restingForce = fromRays(program, form, solver.resting(), at.y, 0).contactForce;
    }
    solution.iterations = solver.iterations();
    solution.factorisations = solver.factorisations();
    solution.solves = solver.solves();
    solution.status = converged ? SolveStatus::optimal : SolveStatus::notConverged;
    return solution;
}

/// As solveOnce, to a certificate: what the scaled residuals promise, the certificate may miss by a little
/// (others are the largest of its terms), and what proves nothing at one tolerance may do so at a tighter
/// one. Then it is solved again, ten times as well, where that is not hopeless. \param worst figure of the
/// certificate of a solution \return the last solution, with all the work counted
template<class Worst>
ConeSolution solveToCertificate(const PlaneConeProgram& program, InteriorPointSettings settings,
                                LiveWork liveWork, SymbolicAnalysis& symbolic, const Worst& worst)
{
    constexpr int attempts = 3;
    constexpr double hopeless = 1e4; // times the tolerance
    const double tolerance = settings.tolerance;
    ConeSolution solution = solveOnce(program, settings, liveWork, symbolic);
    for (int attempt = 1; attempt < attempts && solution.status == SolveStatus::optimal; ++attempt)
    {
        const double reached = worst(solution);
        if (!(reached > tolerance && reached <= hopeless * tolerance))
        {
            break;
        }
        settings.tolerance /= 10;
        ConeSolution better = solveOnce(program, settings, liveWork, symbolic);
        better.iterations += solution.iterations;
        better.factorisations += solution.factorisations;
        better.solves += solution.solves;
        if (better.status != SolveStatus::optimal && worst(better) > tolerance)
        {
            break; // beyond what rounding allows
        }
        solution = std::move(better);
        solution.status = SolveStatus::optimal;
    }
    return solution;
}

} // namespace

ConeSolution solveInteriorPoint(const PlaneConeProgram& program, const InteriorPointSettings& settings,
                                SymbolicAnalysis* kept)
{
    SymbolicAnalysis own;
    SymbolicAnalysis& symbolic = kept ? *kept : own;
    if (program.hasCompliance())
    {
        throw std::invalid_argument("solveInteriorPoint needs rigid points");
    }
    // Any forces that balance the load will do: y = 0 completes them.
    const bool isBalanceAlone = !program.hasMultiplier() && !program.hasInertia() && program.gap.size() == 0;
    ConeSolution solution = solveToCertificate(program, settings, LiveWork::unit, symbolic,
                                               [&](ConeSolution& found)
                                               {
                                                   if (isBalanceAlone)
                                                   {
                                                       found.displacement.setZero();
                                                   }
                                                   return certifyOptimal(program, found).worst();
                                               });
    if (solution.status == SolveStatus::optimal)
    {
        if (certifyOptimal(program, solution).worst() > settings.tolerance)
        {
            solution.status = SolveStatus::notConverged;
        }
        return solution;
    }
    if (program.hasInertia())
    {
        return solution;
    }

    // Least r with r + A c = f + alpha L: where it does not vanish, y = Mbar^-1 r proves that nothing
    // balances f, since the optimality conditions are -A'y in the dual cone, L'y = 0 and f'y = r' Mbar^-1 r >
    // 0.
    const ConeSolution moved = solveToCertificate(
        withUnitInertia(program), settings, LiveWork::none, symbolic,
        [&](const ConeSolution& found) { return certifyInfeasible(program, found.displacement).worst(); });
    solution.factorisations += moved.factorisations;
    solution.solves += moved.solves;
    if (certifyInfeasible(program, moved.displacement).worst() <= settings.tolerance)
    {
        solution.status = SolveStatus::infeasible;
        solution.displacement = moved.displacement;
        return solution;
    }
    if (!program.hasMultiplier())
    {
        return solution;
    }
    // Forces that carry the live load alone are the ray; they grow without limit where crushing sets none.
    PlaneConeProgram live = program;
    live.load = program.liveLoad;
    live.liveLoad.resize(0);
    live.gap.resize(0);
    live.strength.clear();
    for (int point = 0; program.hasStrength() && point < program.points(); ++point)
    {
        if (program.strength[point].isBounded())
        {
            live.contacts[point].onFirst.setZero();
            live.contacts[point].onSecond.setZero();
        }
    }
    ConeSolution carried =
        solveToCertificate(live, settings, LiveWork::none, symbolic,
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
    solution.factorisations += carried.factorisations;
    solution.solves += carried.solves;
    if (certifyUnbounded(program, carried.contactForce).worst() <= settings.tolerance)
    {
        solution.status = SolveStatus::unbounded;
        solution.contactForce = carried.contactForce;
    }
    return solution;
}

} // namespace drystone
