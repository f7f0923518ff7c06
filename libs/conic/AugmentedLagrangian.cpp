// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Semismooth Newton's method within each round, its steps by regula falsi; limits bound the projections.
#include "conic/AugmentedLagrangian.h"

#include "conic/Certificate.h"
#include "conic/form/FormOperators.h"
#include "conic/form/FormSchur.h"

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
constexpr int mostRounds = 100;

/// Upper bounds that take the place of limits: of rays, and of the shear of discs, whose first component
/// exerts no force. Infinite where there are none.
struct Bounds
{
    VectorXd rays;             ///< or empty
    std::vector<double> discs; ///< of round cones; or empty
};

/// Nearest point of the disc |(x1 x2)| <= radius, and the derivative there: 1 inside; outside nothing along
/// (x1 x2) and radius / |(x1 x2)| across it.
ConeProjection projectOntoDisc(const Eigen::Vector3d& x, double radius)
{
    const double size = x.tail<2>().norm();
    ConeProjection projection{x, {}};
    projection.point[0] = 0;
    if (size > radius)
    {
        projection.point.tail<2>() *= radius / size;
        projection.derivative = {x.tail<2>() / size, {0, 0, radius / size}};
    }
    return projection;
}

template<int Rows>
class AugmentedLagrangian
{
public:
    /// \param ofLoad rounding of the load
    AugmentedLagrangian(const Form<Rows>& ofForm, Bounds limits, double ofLoad, SchurSystem<Rows>& withSystem,
                        const AugmentedLagrangianSettings& toSettings)
        : form(ofForm),
          cones(ofForm.cones()),
          bounds(std::move(limits)),
          loadRounding(ofLoad),
          system(withSystem),
          settings(toSettings)
    {
        d.rounds.resize(static_cast<std::size_t>(cones.rounds));
    }

    void start(VectorXd forces);

    /// One round: the minimum for fixed multipliers, then new multipliers and a larger penalty.
    /// \return whether the minimum was found in the iterations allowed
    bool round();

    /// Whether the last round changed the multipliers by so little that the program may be solved.
    bool isSettled() const { return error <= settings.tolerance; }

    const VectorXd& forces() const { return s; }
    const VectorXd& displacement() const { return y; }

    int iterations = 0;
    int factorisations = 0;

private:
    ConeProjection project(std::size_t round, const Eigen::Vector3d& x) const
    {
        return bounds.discs.empty() || std::isinf(bounds.discs[round])
                   ? projectOntoCone(x)
                   : projectOntoDisc(x, bounds.discs[round]);
    }
    bool minimise();
    void computeGradient();
    bool factorise();
    double slopeAt(double step) const;
    double bestStep() const;

    const Form<Rows>& form;
    const ConeRanges cones;
    const Bounds bounds;
    const double loadRounding; ///< of the gradient, where strengths are large compared with the load
    SchurSystem<Rows>& system;
    AugmentedLagrangianSettings settings;
    double sigma = 1;
    VectorXd s;        ///< multipliers of the round
    VectorXd y;        ///< Rows (bodies + 1), the ground at rest
    VectorXd w;        ///< s + sigma (B'y - g), kept by increments: sigma times a difference loses no digits
    VectorXd pressing; ///< w projected onto the cones, and no more than a ray or a disc may carry
    VectorXd gradient; ///< M y - f + B pressing
    ConeWeights<double> d;                 ///< sigma times the derivative of the projection
    VectorXd direction, closing, momentum; ///< Newton's step, B' and M of it
    double curvature = 0;                  ///< direction' M direction
    double slope = 0;                      ///< direction' (M y - f), without the cones
    double error = 0;        ///< how far the points that press are from closed, and the others from open
    double coneRounding = 0; ///< of the projections: a point that slides has w on both sides of its cone
    double penaltyLimit = largestPenalty;
};

template<int Rows>
void AugmentedLagrangian<Rows>::computeGradient()
{
    pressing = w.cwiseMax(0.0);
    if (bounds.rays.size() > 0)
    {
        pressing.head(cones.rays) = pressing.head(cones.rays).cwiseMin(bounds.rays).eval();
    }
    coneRounding = 0;
    for (std::size_t round = 0; round < d.rounds.size(); ++round)
    {
        const Eigen::Index at = cones.at(static_cast<Eigen::Index>(round));
        const Eigen::Vector3d force = w.segment<3>(at);
        const ConeProjection projection = project(round, force);
        pressing.segment<3>(at) = projection.point;
        d.rounds[round] = projection.derivative;
        d.rounds[round].eigenvalues *= sigma;
        if (smallerEigenvalue(force) < 0 && projection.point[0] > 0)
        {
            coneRounding = std::max(coneRounding, 1e-15 * force.norm());
        }
    }
    gradient = -form.load;
    addForces(form, pressing, gradient);
    addInertia(form, y, gradient);
    gradient.tail<Rows>().setZero();
}

template<int Rows>
bool AugmentedLagrangian<Rows>::factorise()
{
    const auto ofRays = w.head(cones.rays).array();
    VectorXd weights = (ofRays > 0).select(VectorXd::Constant(cones.rays, sigma), 0.0);
    if (bounds.rays.size() > 0)
    {
        weights = (ofRays < bounds.rays.array()).select(weights, 0.0).eval();
    }
    // Rays are either in or out: the factor serves until one changes.
    if (factorisations > 0 && cones.rounds == 0 && weights == d.rays)
    {
        return true;
    }
    d.rays = std::move(weights);
    double rounding = 0;
    do
    {
        if (rounding > 1e-6)
        {
            return false;
        }
        assembleSchur(form, d, 0, rounding, system);
        ++factorisations;
        rounding = rounding == 0 ? 1e-15 : 10 * rounding;
    } while (!system.factorise());
    return true;
}

/// Derivative of the function along the direction: continuous and increasing, of rays piecewise linear.
template<int Rows>
double AugmentedLagrangian<Rows>::slopeAt(double step) const
{
    const Eigen::Index rays = cones.rays;
    const auto there = (w.head(rays).array() + (step * sigma) * closing.head(rays).array()).max(0.0);
    double result = slope + step * curvature;
    result += bounds.rays.size() > 0 ? there.min(bounds.rays.array()).matrix().dot(closing.head(rays))
                                     : there.matrix().dot(closing.head(rays));
    for (std::size_t round = 0; round < d.rounds.size(); ++round)
    {
        const Eigen::Index at = cones.at(static_cast<Eigen::Index>(round));
        const Eigen::Vector3d change = closing.segment<3>(at);
        result += project(round, w.segment<3>(at) + (step * sigma) * change).point.dot(change);
    }
    return result;
}

/// Where the derivative vanishes. Newton's full step when the pieces it crosses hardly matter; else by regula
/// falsi (Illinois), which a piecewise linear function makes quick.
template<int Rows>
double AugmentedLagrangian<Rows>::bestStep() const
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
        const double there = slopeAt(best);
        if (std::abs(there) <= -0.01 * atStart)
        {
            break;
        }
        if (there > 0)
        {
            high = best;
            slopeHigh = there;
            slopeLow /= 2;
        }
        else
        {
            low = best;
            slopeLow = there;
            slopeHigh /= 2;
        }
    }
    return best;
}

template<int Rows>
bool AugmentedLagrangian<Rows>::minimise()
{
    const double enough = std::max(0.01 * settings.tolerance, loadRounding);
    double before = std::numeric_limits<double>::infinity();
    int factorisationsBefore = factorisations;
    for (;;)
    {
        computeGradient();
        const double now = gradient.lpNorm<Eigen::Infinity>();
        // A step with the same factor is a refinement; where it gains nothing any more, rounding is all that
        // is left: what was estimated, or some times as much. Round cones change their factor in each step.
        const bool isRefined =
            (factorisations == factorisationsBefore || cones.rounds > 0) && now > 0.5 * before;
        if (now <= enough || (isRefined && now <= std::max(settings.tolerance, 32 * loadRounding)))
        {
            return true;
        }
        if (now <= 10 * coneRounding)
        {
            // No more digits with this penalty: s is a difference of two numbers of the size of sigma z.
            penaltyLimit = std::max(settings.penalty, 0.1 * sigma * std::min(1.0, enough / now));
            return true;
        }
        before = now;
        factorisationsBefore = factorisations;
        if (iterations == settings.maximumIterations || !factorise())
        {
            return false;
        }
        ++iterations;
        direction = -gradient;
        system.solve(direction.head(Rows * form.bodies));
        if (!direction.allFinite())
        {
            return false; // the penalty is beyond what the factor can carry
        }
        applyTransposed(form, direction, closing);
        momentum.setZero(direction.size());
        addInertia(form, direction, momentum);
        curvature = momentum.dot(direction);
        slope = momentum.dot(y) - form.load.dot(direction);
        const double step = bestStep();
        y += step * direction;
        w += (step * sigma) * closing;
    }
}

template<int Rows>
void AugmentedLagrangian<Rows>::start(VectorXd forces)
{
    sigma = settings.penalty;
    s = std::move(forces);
    y = VectorXd::Zero(form.load.size());
}

template<int Rows>
bool AugmentedLagrangian<Rows>::round()
{
    applyTransposed(form, y, closing);
    w = s + sigma * (closing - form.gap);
    if (!minimise())
    {
        return false;
    }
    error = s.size() > 0 ? (pressing - s).lpNorm<Eigen::Infinity>() / sigma : 0;
    s = pressing;
    sigma = std::min(10 * sigma, penaltyLimit);
    return true;
}

/// Limits of single rays and of discs become upper bounds of them; the form is left without limits.
template<int Rows>
Bounds takeBounds(Form<Rows>& form)
{
    constexpr double none = std::numeric_limits<double>::infinity();
    Bounds bounds;
    if (form.limits.empty())
    {
        return bounds;
    }
    const auto rays = static_cast<Eigen::Index>(form.rays.size());
    const auto slacks = static_cast<Eigen::Index>(form.limits.size());
    const Eigen::Index rounds = 3 * static_cast<Eigen::Index>(form.rounds.size());
    bounds.rays = VectorXd::Constant(rays, none);
    bounds.discs.assign(form.rounds.size(), none);
    for (const typename Form<Rows>::Limit& limit : form.limits)
    {
        (limit.round < 0 ? bounds.rays[limit.ray] : bounds.discs[static_cast<std::size_t>(limit.round)]) =
            limit.bound / (limit.component * form.scaling.load);
    }
    form.limits.clear();
    form.load.conservativeResize(form.rows());
    const VectorXd gap = form.gap;
    form.gap.resize(rays + rounds);
    form.gap << gap.head(rays), gap.tail(gap.size() - rays - slacks);
    return bounds;
}

} // namespace

AugmentedLagrangianSettings exactSettings(int maximumIterations)
{
    constexpr double allDigits = 1e-13;
    constexpr double stiff = 1e8;
    return {allDigits, maximumIterations, stiff, StopWhen::settled};
}

template<int Rows, int Forces>
ConeSolution solveAugmentedLagrangian(const ConeProgram<Rows, Forces>& program, const ConeSolution& start,
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
    // In increments from where the blocks move to: the momenta they have drop out of the load, and the
    // figures left are those of one step.
    ConeProgram<Rows, Forces> increment = program;
    const bool heads = start.displacement.size() == program.load.size();
    if (heads)
    {
        increment.load -= applyInertia(program, start.displacement);
        increment.gap = gapAfter(program, start.displacement);
    }
    SymbolicAnalysis own;
    Form<Rows> form = makeForm(increment, kept ? *kept : own);
    SchurSystem<Rows>& system = schurSystem(form, kept ? *kept : own);
    Bounds bounds = takeBounds(form);
    constexpr double roundingUnits = 64 * std::numeric_limits<double>::epsilon();
    const double rounding =
        program.hasStrength() ? roundingUnits * form.load.template lpNorm<Eigen::Infinity>() : 0;
    AugmentedLagrangian<Rows> solver(form, std::move(bounds), rounding, system, settings);
    solver.start(start.contactForce.size() == Forces * program.points()
                     ? conesOf(program, form, start.contactForce)
                     : VectorXd::Zero(form.cones().size()).eval());
    ConeSolution solution;
    for (int rounds = 0; rounds < mostRounds && solution.status != SolveStatus::optimal; ++rounds)
    {
        const bool isMinimum = solver.round();
        solution = solutionOf(program, form, solver.forces(), solver.displacement(), 0.0);
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
    solution.iterations = solver.iterations;
    solution.factorisations = solver.factorisations;
    return solution;
}

template ConeSolution solveAugmentedLagrangian(const PlaneConeProgram&, const ConeSolution&,
                                               const AugmentedLagrangianSettings&, SymbolicAnalysis*);
template ConeSolution solveAugmentedLagrangian(const SpaceConeProgram&, const ConeSolution&,
                                               const AugmentedLagrangianSettings&, SymbolicAnalysis*);

} // namespace drystone
