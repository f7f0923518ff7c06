// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/ExtendedInteriorPoint.h"

#include "conic/RayOperators.h"
#include "linear/DoubleDouble.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace drystone
{
namespace
{

using Vector = RayVector<DoubleDouble>;

/// Multiplications of a factorisation, each some 40 of double precision: half a second.
constexpr double affordableOperations = 2e7;

/// Added to the diagonal of the Schur system, for bodies that nothing holds, and the share that pivots are
/// raised by where rounding makes one negative.
constexpr double proximal = 1e-28;
constexpr double leastRounding = 1e-31;
constexpr double largestRounding = 1e-24;

/// Iterations more than these have not been seen to end.
constexpr int mostIterations = 100;

/// Part of the way to the boundary that is gone.
constexpr double back = 0.995;

/// Weights of the corrector that are tried: the first that shortens neither step to less than half.
constexpr std::array weights{1.0, 0.5, 0.25, 0.1};

/// Tolerance of the scaled residuals, of that of the certificate.
constexpr double ofResiduals = 0.5;

double largest(const Vector& values)
{
    double result = 0;
    for (const DoubleDouble& value : values)
    {
        result = std::max(result, std::abs(value.high));
    }
    return result;
}

/// Largest step, at most 1, that keeps x + step dx >= 0.
double stepToBoundary(const Vector& x, const Vector& dx)
{
    double step = 1 / back;
    for (Eigen::Index i = 0; i < x.size(); ++i)
    {
        if (dx[i].high < 0)
        {
            step = std::min(step, -x[i].high / dx[i].high);
        }
    }
    return std::min(1.0, back * step);
}

struct Iterate
{
    Vector s; ///< forces of the rays
    Vector z; ///< their openings
    Vector y; ///< displacements
    DoubleDouble alpha;
};

enum class Ending
{
    converged,
    falls, ///< displacements show that nothing balances the loads
    grows, ///< there may be no largest multiplier
    lost
};

class Extended
{
public:
    Extended(const RayProgram& rays, SchurSystem<3, DoubleDouble>& system, double tolerance, Sought sought)
        : rays_(rays),
          system_(system),
          tolerance_(tolerance),
          sought_(sought),
          load_(rays.load.cast<DoubleDouble>()),
          liveLoad_(rays.liveLoad.cast<DoubleDouble>()),
          gap_(rays.gap.cast<DoubleDouble>())
    {
    }

    Ending run(int maximumIterations);
    const Iterate& iterate() const { return at_; }
    int iterations() const { return iterations_; }
    int factorisations() const { return factorisations_; }

private:
    bool start();
    bool factorise();
    void computeResiduals();
    void solve(Vector& x);
    void complete(const DoubleDouble& reduction, Vector& onRays, Iterate& step);
    void addCorrection(const Iterate& correction, Iterate& step);
    void measure(const Iterate& step);
    double objectiveSize() const;
    bool isConverged() const;
    bool isFalling(double error) const;
    void addInertia(const Vector& y, Vector& rows) const;

    const RayProgram& rays_;
    SchurSystem<3, DoubleDouble>& system_;
    double tolerance_;
    Sought sought_;
    Vector load_, liveLoad_, gap_;
    Iterate at_;
    Vector balance_;        ///< f + L alpha - M y - B s
    Vector opening_;        ///< g - B'y - z
    DoubleDouble work_ = 0; ///< w - L'y
    Vector d_;              ///< s / z
    Vector liveSolution_;   ///< S^-1 L
    DoubleDouble liveStiffness_ = 0;
    double primal_ = 0;
    double dual_ = 0;
    double rounding_ = 0;
    int iterations_ = 0;
    int factorisations_ = 0;
    Vector rayWork_, rowWork_;
};

void Extended::addInertia(const Vector& y, Vector& rows) const
{
    for (int body = 0; rays_.hasInertia() && body < rays_.bodies; ++body)
    {
        rows.segment<3>(3 * body) += rays_.inertia[body].cast<DoubleDouble>() * y.segment<3>(3 * body);
    }
}

void Extended::computeResiduals()
{
    rowWork_.setZero(load_.size());
    addRays(rays_, at_.s, rowWork_);
    addInertia(at_.y, rowWork_);
    balance_ = load_ - rowWork_;
    if (rays_.hasMultiplier())
    {
        balance_ += at_.alpha * liveLoad_;
        work_ = rays_.liveWork - liveLoad_.dot(at_.y);
    }
    applyRaysTransposed(rays_, at_.y, rayWork_);
    opening_ = gap_ - rayWork_ - at_.z;
}

/// What the gap is compared with, as in Certificate.h.
double Extended::objectiveSize() const
{
    if (rays_.hasMultiplier())
    {
        return std::max(rays_.liveWork * std::max(1e-3, std::abs(at_.alpha.high)),
                        std::abs(load_.dot(at_.y).high));
    }
    return rays_.hasInertia() ? std::max(1.0, load_.cwiseProduct(at_.y).lpNorm<1>().high) : 1.0;
}

bool Extended::isFalling(double error) const
{
    double closing = 0; // what is above B'y, by z
    for (Eigen::Index ray = 0; ray < gap_.size(); ++ray)
    {
        closing = std::max(closing, (gap_[ray] - opening_[ray]).high);
    }
    const Eigen::VectorXd y = at_.y.cast<double>();
    return isFall(rays_.load, rays_.liveLoad, y, closing, (rays_.liveWork - work_).high, error);
}

bool Extended::isConverged() const
{
    const double forceSize = std::max(1.0, std::abs(at_.alpha.high));
    if (!rays_.hasMultiplier() && !rays_.hasInertia() && rays_.gap.isZero(0))
    {
        return largest(balance_) <= tolerance_; // any forces will do: y = 0 completes them
    }
    const double product = at_.s.dot(at_.z).high;
    if (sought_ == Sought::fall && product <= complementarityOfFall * objectiveSize()
        && isFalling(0.1 * tolerance_))
    {
        return true;
    }
    const double displacement = std::max({largest(at_.y), largest(gap_), rays_.hasInertia() ? 1.0 : 0.0});
    const double apart =
        (rays_.liveWork * at_.alpha + load_.dot(at_.y) - gap_.dot(at_.s)).high; // of the objectives
    return largest(balance_) <= tolerance_ * forceSize && largest(opening_) <= tolerance_ * displacement
           && std::abs(work_.high) <= tolerance_ * std::max(1.0, rays_.liveWork)
           && product <= tolerance_ * objectiveSize()
           && (!rays_.hasMultiplier() || std::abs(apart) <= tolerance_ * objectiveSize());
}

bool Extended::factorise()
{
    d_ = at_.s.cwiseQuotient(at_.z);
    for (; rounding_ <= largestRounding; rounding_ = std::max(leastRounding, 10 * rounding_))
    {
        assembleSchur(rays_, d_, proximal, rounding_, system_);
        ++factorisations_;
        if (system_.factorise())
        {
            if (rays_.hasMultiplier())
            {
                liveSolution_ = liveLoad_;
                solve(liveSolution_);
                liveStiffness_ = liveLoad_.dot(liveSolution_);
            }
            return true;
        }
    }
    return false;
}

void Extended::solve(Vector& x)
{
    if (rays_.limits.empty())
    {
        system_.solve(x.head(3 * rays_.bodies));
    }
    else
    {
        solveWithLimits(rays_, d_, system_, x);
    }
}

/// Newton's equations as in InteriorPoint.cpp, without compliance: a step that removes the fraction
/// `reduction` of the residuals. \param onRays c/z - D R opening, where c is the wished change of s z
void Extended::complete(const DoubleDouble& reduction, Vector& onRays, Iterate& step)
{
    rowWork_.setZero(load_.size());
    addRays(rays_, onRays, rowWork_);
    step.y = reduction * balance_ - rowWork_;
    solve(step.y);
    step.alpha = 0;
    if (rays_.hasMultiplier())
    {
        step.alpha = (reduction * work_ - liveLoad_.dot(step.y)) / liveStiffness_;
        step.y += step.alpha * liveSolution_;
    }
    applyRaysTransposed(rays_, step.y, rayWork_);
    step.s = onRays + d_.cwiseProduct(rayWork_);
    step.z = reduction * opening_ - rayWork_;
}

void Extended::measure(const Iterate& step)
{
    primal_ = stepToBoundary(at_.s, step.s);
    dual_ = stepToBoundary(at_.z, step.z);
    if (rays_.hasInertia())
    {
        primal_ = dual_ = std::min(primal_, dual_); // y stands in the balance too
    }
}

void Extended::addCorrection(const Iterate& correction, Iterate& step)
{
    const double primal = primal_;
    const double dual = dual_;
    Iterate sum;
    for (const DoubleDouble weight : weights)
    {
        sum.s = step.s + weight * correction.s;
        sum.z = step.z + weight * correction.z;
        measure(sum);
        if (primal_ >= 0.5 * primal && dual_ >= 0.5 * dual)
        {
            step.s = std::move(sum.s);
            step.z = std::move(sum.z);
            step.y += weight * correction.y;
            step.alpha += weight * correction.alpha;
            return;
        }
    }
    measure(step);
}

/// Mehrotra's start, as in InteriorPoint.cpp; with inertia all forces and openings 1.
bool Extended::start()
{
    const int rays = rays_.rayCount();
    at_.s = Vector::Constant(rays, 1);
    at_.z = Vector::Constant(rays, 1);
    at_.y = Vector::Zero(load_.size());
    at_.alpha = 0;
    if (rays == 0 || rays_.hasInertia())
    {
        return true;
    }
    if (!factorise())
    {
        return false;
    }
    Vector forces = load_;
    solve(forces);
    if (rays_.hasMultiplier())
    {
        at_.alpha = -liveLoad_.dot(forces) / liveStiffness_;
        forces += at_.alpha * liveSolution_;
        at_.y = (rays_.liveWork / liveStiffness_) * liveSolution_;
    }
    applyRaysTransposed(rays_, forces, at_.s);
    if (largest(gap_) > 0)
    {
        rowWork_.setZero(load_.size());
        addRays(rays_, gap_, rowWork_);
        solve(rowWork_);
        at_.y += rowWork_;
    }
    applyRaysTransposed(rays_, at_.y, rayWork_);
    at_.z = gap_ - rayWork_;

    const auto pushInside = [](Vector& values, double least)
    { values.array() += DoubleDouble(std::max(0.0, -1.5 * least)); };
    pushInside(at_.s, at_.s.minCoeff().high);
    pushInside(at_.z, at_.z.minCoeff().high);
    const double product = at_.s.dot(at_.z).high;
    const double sSum = at_.s.sum().high;
    const double zSum = at_.z.sum().high;
    at_.s.array() +=
        DoubleDouble(std::max(zSum > 0 ? 0.5 * product / zSum : 0, 1e-2 * largest(at_.s) + 1e-2));
    at_.z.array() +=
        DoubleDouble(std::max(sSum > 0 ? 0.5 * product / sSum : 0, zSum > 0 ? 1e-2 * largest(at_.z) : 1.0));
    return true;
}

Ending Extended::run(int maximumIterations)
{
    if (!start())
    {
        return Ending::lost;
    }
    Iterate step;
    Iterate correction;
    for (iterations_ = 0; iterations_ <= maximumIterations; ++iterations_)
    {
        computeResiduals();
        const double rays = std::max(1, rays_.rayCount());
        const double mu = at_.s.dot(at_.z).high / rays;
        if (!std::isfinite(mu))
        {
            return Ending::lost;
        }
        if (isConverged())
        {
            return Ending::converged;
        }
        if (!rays_.hasInertia() && isFalling(possibleFall))
        {
            return Ending::falls;
        }
        if (sought_ == Sought::solution && at_.alpha.high > possiblyUnlimited)
        {
            return Ending::grows;
        }
        if (iterations_ == maximumIterations || !factorise())
        {
            break;
        }
        Vector onRays = -(at_.s + d_.cwiseProduct(opening_));
        complete(1, onRays, step);
        measure(step);
        const double after =
            (at_.s + DoubleDouble(primal_) * step.s).dot(at_.z + DoubleDouble(dual_) * step.z).high / rays;
        const double enough = 0.02 * tolerance_ * objectiveSize() / rays;
        const double sigma = std::max(std::pow(after / mu, 3), std::min(1.0, enough / mu));
        onRays =
            (Vector::Constant(at_.s.size(), sigma * mu) - step.s.cwiseProduct(step.z)).cwiseQuotient(at_.z);
        complete(0, onRays, correction);
        addCorrection(correction, step);
        at_.s += DoubleDouble(primal_) * step.s;
        at_.alpha += primal_ * step.alpha;
        at_.y += DoubleDouble(dual_) * step.y;
        at_.z += DoubleDouble(dual_) * step.z;
    }
    return Ending::lost;
}

} // namespace

bool isExtendedAffordable(const PlaneConeProgram& program, const SymbolicAnalysis& symbolic)
{
    // Blocks that enter each other have hundreds of points each, and no digits would help them.
    constexpr int pointsPerBody = 40;
    return symbolic.system && symbolic.system->operations() <= affordableOperations
           && program.points() <= pointsPerBody * program.bodies;
}

ConeSolution solveInExtendedPrecision(const PlaneConeProgram& program, const RayForm& form,
                                      const InteriorPointSettings& settings, Sought sought)
{
    SchurSystem<3, DoubleDouble> system(program.bodies, form.couplings);
    Extended solver(form.program, system, ofResiduals * settings.tolerance, sought);
    const Ending ending = solver.run(std::min(mostIterations, settings.maximumIterations));
    const Iterate& at = solver.iterate();
    ConeSolution solution = fromRays(program, form, at.s, at.y, at.alpha);
    solution.iterations = solver.iterations();
    solution.factorisations = solver.factorisations();
    solution.status = ending == Ending::converged ? SolveStatus::optimal
                      : ending == Ending::grows   ? SolveStatus::unbounded
                                                  : SolveStatus::notConverged;
    return solution;
}

} // namespace drystone
