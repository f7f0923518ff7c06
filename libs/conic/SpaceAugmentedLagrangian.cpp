// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The augmented Lagrangian solver for contact points of space, where friction cones are round.
#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"
#include "conic/SpaceForm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace drystone
{
namespace
{

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double largestPenalty = 1e11;
/// Where rounding keeps the penalty low each round leaves some half of the error: a tolerance of 1e-11
/// took 35.
constexpr int mostRounds = 100;

/// Of the penalty, from round to round.
constexpr double growth = 10;

class SpaceAugmentedLagrangian
{
public:
    SpaceAugmentedLagrangian(const SpaceForm& form, SchurSystem<6>& system,
                             const AugmentedLagrangianSettings& settings)
        : form_(form), system_(system), settings_(settings), d_(form.points.size())
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

    const SpaceForm& form_;
    SchurSystem<6>& system_;
    AugmentedLagrangianSettings settings_;
    double sigma_ = 1;
    VectorXd s_;        ///< multipliers of the round
    VectorXd y_;        ///< 6 (bodies + 1), the ground at rest
    VectorXd w_;        ///< s + sigma (B'y - g), kept by increments: sigma times a difference loses no digits
    VectorXd pressing_; ///< w projected onto the cones
    VectorXd gradient_; ///< M y - f + B pressing
    std::vector<FramedMatrix> d_;  ///< sigma times the derivative of the projection
    VectorXd direction_, closing_; ///< Newton's step, and B' of it
    double curvature_ = 0;         ///< direction' M direction
    double slope_ = 0;             ///< direction' (M y - f), without the contact points
    int iterations_ = 0;
    int factorisations_ = 0;
    double error_ = 0;
    double rounding_ = 0; ///< of the projections: a point that slides has w on both sides of its cone
    double penaltyLimit_ = largestPenalty;
};

void SpaceAugmentedLagrangian::computeGradient()
{
    pressing_.resize(w_.size());
    rounding_ = 0;
    for (std::size_t point = 0; point < d_.size(); ++point)
    {
        const auto row = 3 * static_cast<Eigen::Index>(point);
        const ConeProjection projection = projectOntoCone(w_.segment<3>(row));
        pressing_.segment<3>(row) = projection.point;
        d_[point] = projection.derivative;
        d_[point].eigenvalues *= sigma_;
        if (smallerEigenvalue(w_.segment<3>(row)) < 0 && projection.point[0] > 0)
        {
            rounding_ = std::max(rounding_, 1e-15 * w_.segment<3>(row).norm());
        }
    }
    gradient_.setZero(form_.load.size());
    addForces(form_, pressing_, gradient_);
    addInertia(form_, y_, gradient_);
    gradient_ -= form_.load;
}

bool SpaceAugmentedLagrangian::factorise()
{
    double rounding = 0;
    do
    {
        if (rounding > 1e-6)
        {
            return false;
        }
        assembleSchur(form_, d_, 0, rounding, system_);
        ++factorisations_;
        rounding = rounding == 0 ? 1e-15 : 10 * rounding;
    } while (!system_.factorise());
    return true;
}

/// Derivative of the function along the direction: continuous and increasing.
double SpaceAugmentedLagrangian::slopeAt(double step) const
{
    double slope = slope_ + step * curvature_;
    for (Eigen::Index row = 0; row < w_.size(); row += 3)
    {
        const Vector3d closing = closing_.segment<3>(row);
        slope += projectOntoCone(w_.segment<3>(row) + (step * sigma_) * closing).point.dot(closing);
    }
    return slope;
}

/// Where the derivative vanishes. Newton's full step when that hardly changes anything; else by regula falsi
/// (Illinois).
double SpaceAugmentedLagrangian::bestStep() const
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

bool SpaceAugmentedLagrangian::minimise()
{
    const double enough = 0.01 * settings_.tolerance;
    double before = std::numeric_limits<double>::infinity();
    for (;;)
    {
        computeGradient();
        const double now = gradient_.lpNorm<Eigen::Infinity>();
        if (now <= enough || (now <= settings_.tolerance && now > 0.5 * before))
        {
            return true;
        }
        if (now <= 10 * rounding_)
        {
            // No more digits with this penalty: s is a difference of two numbers of the size of sigma z.
            penaltyLimit_ = std::max(settings_.penalty, 0.1 * sigma_ * std::min(1.0, enough / now));
            return true;
        }
        before = now;
        if (iterations_ == settings_.maximumIterations || !factorise())
        {
            return false;
        }
        ++iterations_;
        direction_ = -gradient_;
        system_.solve(direction_.head(6 * form_.bodies));
        applyTransposed(form_, direction_, closing_);
        VectorXd momentum = VectorXd::Zero(direction_.size());
        addInertia(form_, direction_, momentum);
        curvature_ = momentum.dot(direction_);
        slope_ = momentum.dot(y_) - form_.load.dot(direction_);
        const double step = bestStep();
        if (!std::isfinite(step))
        {
            return false;
        }
        y_ += step * direction_;
        w_ += (step * sigma_) * closing_;
    }
}

void SpaceAugmentedLagrangian::start(VectorXd forces)
{
    sigma_ = settings_.penalty;
    s_ = std::move(forces);
    y_ = VectorXd::Zero(form_.load.size());
}

bool SpaceAugmentedLagrangian::round()
{
    applyTransposed(form_, y_, closing_);
    w_ = s_ + sigma_ * (closing_ - form_.gap);
    if (!minimise())
    {
        return false;
    }
    error_ = s_.size() > 0 ? (pressing_ - s_).lpNorm<Eigen::Infinity>() / sigma_ : 0;
    s_ = pressing_;
    sigma_ = std::min(growth * sigma_, penaltyLimit_);
    return true;
}

} // namespace

ConeSolution solveAugmentedLagrangian(const SpaceConeProgram& program, const ConeSolution& start,
                                      const AugmentedLagrangianSettings& settings)
{
    if (!program.hasInertia() || program.hasMultiplier())
    {
        throw std::invalid_argument("solveAugmentedLagrangian needs inertia and no multiplier");
    }
    // In increments from where the blocks are heading, as in the plane.
    SpaceConeProgram increment = program;
    const bool heads = start.displacement.size() == program.load.size();
    if (heads)
    {
        increment.load -= applyInertia(program, start.displacement);
        increment.gap = (program.gap.size() > 0 ? program.gap : VectorXd::Zero(3 * program.points()))
                        - applyTransposed(program, start.displacement);
    }
    SpaceForm form = makeSpaceForm(increment);
    SchurSystem<6> system = makeSchurSystem(form);
    SpaceAugmentedLagrangian solver(form, system, settings);
    VectorXd forces = VectorXd::Zero(3 * program.points());
    if (start.contactForce.size() == forces.size())
    {
        forces = toCones(program, form, start.contactForce);
        for (Eigen::Index row = 0; row < forces.size(); row += 3)
        {
            forces.segment<3>(row) = projectOntoCone(forces.segment<3>(row)).point;
        }
    }
    solver.start(std::move(forces));
    ConeSolution solution;
    for (int rounds = 0; rounds < mostRounds && solution.status != SolveStatus::optimal; ++rounds)
    {
        const bool isMinimum = solver.round();
        if (isMinimum && !solver.isSettled() && rounds + 1 < mostRounds)
        {
            continue;
        }
        solution = fromCones(program, form, solver.forces(), solver.displacement(), 0);
        if (heads)
        {
            solution.displacement += start.displacement;
        }
        const bool isSolved = isMinimum && certifyOptimal(program, solution).worst() <= settings.tolerance;
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
