// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/AugmentedLagrangian.h"

#include "conic/Certificate.h"
#include "conic/RayOperators.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

constexpr double largestPenalty = 1e11;

constexpr int mostRounds = 30;

class AugmentedLagrangian
{
public:
    /// \param most upper bounds of the rays, or empty \param rounding of the load
    AugmentedLagrangian(const RayProgram& rays, VectorXd most, double rounding, SchurSystem<3>& system,
                        const AugmentedLagrangianSettings& settings)
        : rays_(rays), most_(std::move(most)), rounding_(rounding), system_(system), settings_(settings)
    {
    }

    void start(VectorXd forces);

    /// One round: the minimum for fixed multipliers, then new multipliers and a larger penalty.
    /// \return whether the minimum was found in the iterations allowed
    bool round();

    /// Whether the last round changed the multipliers by so little that the program may be solved.
    bool isSettled() const { return error_ <= settings_.tolerance; }

    const VectorXd& forces() const { return s_; }
    const VectorXd& displacement() const { return y_; }
    int iterations() const { return iterations_; }
    int factorisations() const { return factorisations_; }

private:
    bool minimise();
    void computeGradient();
    bool factorise();
    double slopeAt(double step) const;
    double bestStep() const;

    const RayProgram& rays_;
    const VectorXd most_;       ///< upper bounds of the rays, or empty
    const double rounding_ = 0; ///< of the gradient, where strengths are large beside the load
    SchurSystem<3>& system_;
    AugmentedLagrangianSettings settings_;
    double sigma_ = 1;
    VectorXd s_;        ///< multipliers of the round
    VectorXd y_;        ///< 3 (bodies + 1), the ground at rest
    VectorXd w_;        ///< s + sigma (B'y - g), kept by increments: sigma times a difference loses no digits
    VectorXd pressing_; ///< max(0, w), and no more than the ray may carry
    VectorXd gradient_; ///< M y - f + B max(0, w)
    VectorXd d_;        ///< sigma where a ray presses, below its bound, in the factor, else 0
    VectorXd direction_, closing_; ///< Newton's step, and B' of it
    double curvature_ = 0;         ///< direction' M direction
    double slope_ = 0;             ///< direction' (M y - f), without the rays
    int iterations_ = 0;
    int factorisations_ = 0;
    double error_ = 0; ///< how far the rays that press are from closed, and the others from open
};

void AugmentedLagrangian::computeGradient()
{
    pressing_ = w_.cwiseMax(0.0);
    if (most_.size() > 0)
    {
        pressing_ = pressing_.cwiseMin(most_).eval();
    }
    gradient_ = -rays_.load;
    addRays(rays_, pressing_, gradient_);
    for (int body = 0; body < rays_.bodies; ++body)
    {
        gradient_.segment<3>(3 * body) += rays_.inertia[body] * y_.segment<3>(3 * body);
    }
    gradient_.tail<3>().setZero();
}

bool AugmentedLagrangian::factorise()
{
    VectorXd d = (w_.array() > 0).select(VectorXd::Constant(w_.size(), sigma_), 0.0);
    if (most_.size() > 0)
    {
        d = (w_.array() < most_.array()).select(d, 0.0).eval();
    }
    if (factorisations_ > 0 && d == d_)
    {
        return true;
    }
    d_ = std::move(d);
    double rounding = 0;
    do
    {
        if (rounding > 1e-6)
        {
            return false;
        }
        assembleSchur(rays_, d_, 0, rounding, system_);
        ++factorisations_;
        rounding = rounding == 0 ? 1e-15 : 10 * rounding;
    } while (!system_.factorise());
    return true;
}

/// Derivative of the function along the direction: piecewise linear and increasing.
double AugmentedLagrangian::slopeAt(double step) const
{
    const auto there = (w_.array() + (step * sigma_) * closing_.array()).max(0.0);
    return slope_ + step * curvature_
           + (most_.size() > 0 ? there.min(most_.array()).matrix().dot(closing_)
                               : there.matrix().dot(closing_));
}

/// Where the derivative vanishes. Newton's full step when the pieces it crosses hardly matter; else by regula
/// falsi (Illinois), which a piecewise linear function makes quick.
double AugmentedLagrangian::bestStep() const
{
    const double atStart = slopeAt(0);
    if (!(atStart < 0))
    {
        return 1; // all that is left of the slope is rounding: Newton's step can only refine
    }
    double low = 0;
    double slopeLow = atStart;
    double high = 1;
    double slopeHigh = slopeAt(1);
    while (slopeHigh < 0 && high < 64)
    {
        if (slopeHigh > 0.1 * atStart)
        {
            return high;
        }
        low = high;
        slopeLow = slopeHigh;
        high *= 2;
        slopeHigh = slopeAt(high);
    }
    if (slopeHigh <= -0.1 * atStart)
    {
        return high;
    }
    double best = high;
    for (int trial = 0; trial < 40 && slopeHigh > slopeLow; ++trial)
    {
        best = (low * slopeHigh - high * slopeLow) / (slopeHigh - slopeLow);
        const double slope = slopeAt(best);
        if (std::abs(slope) <= -0.01 * atStart)
        {
            break;
        }
        if (slope > 0)
        {
            high = best;
            slopeHigh = slope;
            slopeLow /= 2;
        }
        else
        {
            low = best;
            slopeLow = slope;
            slopeHigh /= 2;
        }
    }
    return best;
}

bool AugmentedLagrangian::minimise()
{
    const double enough = std::max(0.01 * settings_.tolerance, rounding_);
    double before = std::numeric_limits<double>::infinity();
    int factorisationsBefore = factorisations_;
    for (;;)
    {
        computeGradient();
        const double now = gradient_.lpNorm<Eigen::Infinity>();
        // A step with the same factor is a refinement; where it gains nothing any more, rounding is all that
        // is left: what was estimated, or some times as much.
        const bool isRefined = factorisations_ == factorisationsBefore && now > 0.5 * before;
        if (now <= enough || (isRefined && now <= std::max(settings_.tolerance, 32 * rounding_)))
        {
            return true;
        }
        before = now;
        factorisationsBefore = factorisations_;
        if (iterations_ == settings_.maximumIterations || !factorise())
        {
            return false;
        }
        ++iterations_;
        direction_ = -gradient_;
        system_.solve(direction_.head(3 * rays_.bodies));
        if (!direction_.allFinite())
        {
            return false; // the penalty is beyond what the factor can carry
        }
        applyRaysTransposed(rays_, direction_, closing_);
        curvature_ = 0;
        slope_ = -rays_.load.dot(direction_);
        for (int body = 0; body < rays_.bodies; ++body)
        {
            const Eigen::Vector3d step = direction_.segment<3>(3 * body);
            const Eigen::Vector3d momentum = rays_.inertia[body] * step;
            curvature_ += step.dot(momentum);
            slope_ += momentum.dot(y_.segment<3>(3 * body));
        }
        const double step = bestStep();
        y_ += step * direction_;
        w_ += (step * sigma_) * closing_;
    }
}

void AugmentedLagrangian::start(VectorXd forces)
{
    sigma_ = settings_.penalty;
    s_ = std::move(forces);
    y_ = VectorXd::Zero(rays_.load.size());
}

bool AugmentedLagrangian::round()
{
    applyRaysTransposed(rays_, y_, closing_);
    w_ = s_ + sigma_ * (closing_ - rays_.gap);
    if (!minimise())
    {
        return false;
    }
    error_ = (pressing_ - s_).lpNorm<Eigen::Infinity>() / sigma_;
    s_ = pressing_;
    sigma_ = std::min(10 * sigma_, largestPenalty);
    return true;
}

/// Limits of single rays become upper bounds of them, one a ray; the form is left without limits. Empty where
/// there are none.
VectorXd takeBounds(RayForm& form)
{
    RayProgram& rays = form.program;
    if (rays.limits.empty())
    {
        return {};
    }
    VectorXd most = VectorXd::Constant(static_cast<Eigen::Index>(rays.rays.size()),
                                       std::numeric_limits<double>::infinity());
    for (const RayProgram::Limit& limit : rays.limits)
    {
        most[limit.ray] = limit.bound / (limit.component * form.scaling.load);
    }
    rays.limits.clear();
    rays.load.conservativeResize(3 * (rays.bodies + 1));
    rays.gap.conservativeResize(most.size());
    return most;
}

} // namespace

AugmentedLagrangianSettings exactSettings(int maximumIterations)
{
    constexpr double allDigits = 1e-13;
    constexpr double stiff = 1e8;
    return {allDigits, maximumIterations, stiff, StopWhen::settled};
}

ConeSolution solveAugmentedLagrangian(const PlaneConeProgram& program, const ConeSolution& start,
                                      const AugmentedLagrangianSettings& settings, SymbolicAnalysis* kept)
{
    if (!program.hasInertia() || program.hasMultiplier())
    {
        throw std::invalid_argument("solveAugmentedLagrangian needs inertia and no multiplier");
    }
    if (program.hasCrushing())
    {
        throw std::invalid_argument("solveAugmentedLagrangian takes cohesion and tension, but no crushing");
    }
    if (program.hasCompliance())
    {
        throw std::invalid_argument("solveAugmentedLagrangian needs rigid points");
    }
    // In increments from where the blocks are heading: the momenta they have drop out of the load, and the
    // figures left are those of one step.
    PlaneConeProgram increment = program;
    const bool heads = start.displacement.size() == program.load.size();
    if (heads)
    {
        increment.load -= applyInertia(program, start.displacement);
        increment.gap = (program.gap.size() > 0 ? program.gap : VectorXd::Zero(2 * program.points()))
                        - applyTransposed(program, start.displacement);
    }
    SymbolicAnalysis own;
    RayForm form = makeRayForm(increment, kept ? *kept : own);
    SchurSystem<3>& system = schurSystem(form, kept ? *kept : own);
    VectorXd most = takeBounds(form);
    constexpr double roundingUnits = 64 * std::numeric_limits<double>::epsilon();
    const double rounding =
        program.hasStrength() ? roundingUnits * form.program.load.lpNorm<Eigen::Infinity>() : 0;
    AugmentedLagrangian solver(form.program, std::move(most), rounding, system, settings);
    VectorXd forces = start.contactForce.size() == 2 * program.points()
                          ? raysOf(program, form, start.contactForce)
                          : VectorXd::Zero(form.program.rayCount());
    solver.start(std::move(forces));
    ConeSolution solution;
    for (int rounds = 0; rounds < mostRounds && solution.status != SolveStatus::optimal; ++rounds)
    {
        const bool isMinimum = solver.round();
        solution = fromRays(program, form, solver.forces(), solver.displacement(), 0);
        if (heads)
        {
            solution.displacement += start.displacement;
        }
        const bool isExact = settings.stop == StopWhen::certified || solver.isSettled();
        const bool isSolved =
            isMinimum && isExact && certifyOptimal(program, solution).worst() <= settings.tolerance;
        solution.status = isSolved ? SolveStatus::optimal : SolveStatus::notConverged;
        if (!isMinimum)
        {
            break;
        }
    }
    solution.iterations = solver.iterations();
    solution.factorisations = solver.factorisations();
    return solution;
}

} // namespace drystone
