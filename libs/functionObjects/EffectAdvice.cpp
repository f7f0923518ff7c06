// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Computes the advice of `-dry-run` by limit analyses of the scene, and words it.
#include "functionObjects/EffectAdvice.h"

#include "contact/SupportPaths.h"
#include "effects/GroundMotion.h"
#include "quantities/LimitAnalysisFigures.h"
#include "statics/LimitAnalysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

constexpr double border = 0.05;
constexpr std::size_t mostPoints = 100000; // above this the advice could take longer than a run
constexpr double solverTolerance = 1e-8;
constexpr double demandTolerance = 1e-4; // of mu, relative
constexpr double leastFriction = 1e-4;
constexpr std::array unlimitedFrictions{100.0, 30.0, 10.0}; // the first that the solver solves is used

/// The structure under loads of the ground that grow in one direction.
struct Statics
{
    PlaneConeProgram program;
    InteriorPointSettings settings;

    /// The largest feasible multiple of a load; 0 when the dead load is infeasible.
    double capacity(const Eigen::VectorXd& load, double mu)
    {
        std::fill(program.friction.begin(), program.friction.end(), mu);
        if (load.isZero(0))
        {
            program.liveLoad.resize(0);
            return solveInteriorPoint(program, settings).status == SolveStatus::infeasible
                       ? 0
                       : std::numeric_limits<double>::infinity();
        }
        program.liveLoad = load;
        const LimitAnalysis result = solveLimitAnalysis(program, settings);
        return result.status == CollapseStatus::unstable ? 0 : tabledAlpha(result);
    }
};

/// The corners of the box between minus and plus the peaks of the components [m/s2].
std::vector<Vector<2>> corners(const DynamicCase<2>& scene)
{
    std::vector<Vector<2>> result{Vector<2>::Zero()};
    const GroundMotion ground = groundMotionOf(scene.effects);
    for (const GroundMotion::Component& component : ground.components)
    {
        const Vector<2> peak = ground.factor * component.acceleration->peak() * component.direction.head<2>();
        std::vector<Vector<2>> more;
        for (const Vector<2>& corner : result)
        {
            more.emplace_back(corner + peak);
            more.emplace_back(corner - peak);
        }
        result = std::move(more);
    }
    return result;
}

/// The smallest mu that carries a load, or the part of it that can be carried with any mu. \param known a
/// demand that another load has, below which it is not sought [-] \return not a number where it is unknown
double frictionDemand(Statics& statics, const Eigen::VectorXd& load, double known)
{
    double unlimited = std::numeric_limits<double>::quiet_NaN();
    double enough = 0;
    for (std::size_t i = 0; i < unlimitedFrictions.size() && std::isnan(unlimited); ++i)
    {
        enough = unlimitedFrictions[i];
        unlimited = statics.capacity(load, enough);
    }
    if (unlimited == 0) // no friction keeps the blocks at rest
    {
        return known;
    }
    if (std::isnan(unlimited))
    {
        return unlimited;
    }
    const double share = std::min(1.0, unlimited) * (1 - 1e-6);
    const auto suffices = [&](double mu) { return statics.capacity(load, mu) >= share; };
    double demand = std::max(known, leastFriction);
    if (suffices(demand))
    {
        return demand == leastFriction ? 0 : demand;
    }
    while (enough > demand * (1 + demandTolerance))
    {
        const double middle = std::sqrt(demand * enough);
        (suffices(middle) ? enough : demand) = middle;
    }
    return enough;
}

bool isAtRest(const DynamicState<2>& state)
{
    const auto isMoved = [](const Placement<2>& placement)
    { return placement.translation != Vector<2>::Zero() || placement.rotation != 0; };
    return state.velocity.isZero(0)
           && std::none_of(state.placements.begin(), state.placements.end(), isMoved);
}

std::string reasonAgainst(const DynamicCase<2>& scene, const DynamicState<2>& start,
                          const std::vector<ContactPoint<2>>& points)
{
    if (!isAtRest(start))
    {
        return "the blocks do not start at rest as built";
    }
    if (traitsOf(scene.effects).movesSupports)
    {
        return "supports move";
    }
    if (traitsOf(scene.effects).isCompliant)
    {
        return "elastic joints amplify the motion of the ground, which the criteria for rigid blocks do not "
               "include";
    }
    if (traitsOf(scene.effects).holdsJoints || !scene.jointFriction.empty())
    {
        return "joints have cohesion, tension or friction of their own, which the criteria do not include; "
               "limitAnalysis does";
    }
    if (points.size() > mostPoints)
    {
        return fmt::format("more than {} contact points", mostPoints);
    }
    if (groundMotionOf(scene.effects).components.size() > 4)
    {
        return "the ground moves along more than four directions";
    }
    if (const std::string touching = touchWithoutJoint(scene.assembly, points); !touching.empty())
    {
        return fmt::format("they know joints only, and {}", touching);
    }
    return "";
}

} // namespace

Margin margin(double demand, double available)
{
    if (std::isfinite(available) && std::abs(demand - available) <= border * available)
    {
        return Margin::nearLimit;
    }
    return demand < available ? Margin::below : Margin::above;
}

EffectAdvice adviseEffects(const DynamicCase<2>& scene, const DynamicState<2>& start)
{
    EffectAdvice advice;
    const std::vector<ContactPoint<2>> points = findContactPoints(scene.assembly);
    advice.reason = reasonAgainst(scene, start, points);
    advice.isAssessed = advice.reason.empty();
    if (!advice.isAssessed)
    {
        return advice;
    }
    advice.mu = scene.contact.friction ? scene.contact.friction->mu : 0;

    Statics statics;
    const LoadVectors dead{scene.deadLoad.rows, scene.deadLoad.rows};
    statics.program = limitAnalysisProgram(static_cast<int>(scene.mass.size()) / 3,
                                           equilibriumColumns(scene.assembly, scene.blocks, points),
                                           std::vector<double>(points.size(), advice.mu), dead);
    statics.settings.tolerance = solverTolerance;
    const auto loadOf = [&scene](const Vector<2>& acceleration)
    {
        Eigen::VectorXd load = Eigen::VectorXd::Zero(scene.mass.size());
        for (Eigen::Index row = 0; row < load.size(); row += 3)
        {
            load.segment<2>(row) = -scene.mass[row] * acceleration;
        }
        return load;
    };

    advice.capacity = std::numeric_limits<double>::infinity();
    for (const Vector<2>& corner : corners(scene))
    {
        const Eigen::VectorXd load = loadOf(corner);
        const double capacity = statics.capacity(load, advice.mu);
        if (!(capacity >= advice.capacity)) // also where there is no answer
        {
            advice.capacity = capacity;
            advice.peak = corner.norm();
        }
        advice.peak = std::max(advice.peak, std::isinf(advice.capacity) ? corner.norm() : 0.0);

        advice.frictionDemand = frictionDemand(statics, load, advice.frictionDemand);
        if (std::isnan(advice.frictionDemand))
        {
            break;
        }
    }
    if (std::isnan(advice.capacity))
    {
        advice.isAssessed = false;
        advice.reason = "limit analysis of the structure did not converge";
    }
    return advice;
}

namespace
{

/// What is advised, and what is to be warned of below all advice.
struct Advice
{
    std::string sentences;
    std::string warnings;
};

/// Whether the ground moves the blocks at all.
void adviseOnMotion(const DynamicCase<2>& scene, const EffectAdvice& advice, Advice& text)
{
    const double gravity = scene.gravity.norm();
    const double peak = advice.peak / (gravity > 0 ? gravity : 1);
    const std::string alpha = std::isinf(advice.capacity)
                                  ? "no multiple of it moves the blocks"
                                  : fmt::format("alpha = {:.6g}", advice.capacity * peak);
    if (advice.peak == 0)
    {
        text.sentences +=
            "    The ground is still and the blocks carry their dead load: they stay at rest, and "
            "limitAnalysis suffices.\n";
    }
    else if (advice.capacity > 1)
    {
        text.sentences += fmt::format("    Peak a/g = {:.6g} is below what the blocks carry at rest ({}): "
                                      "limitAnalysis suffices.\n",
                                      peak, alpha);
    }
    else
    {
        text.sentences +=
            fmt::format("    Peak a/g = {:.6g} exceeds what the blocks carry at rest ({}): they may move, "
                        "which requires contactDynamics.\n",
                        peak, alpha);
    }
    if (advice.peak > 0 && margin(1, advice.capacity) == Margin::nearLimit)
    {
        text.warnings +=
            "    Warning: the peak is within 5% of that limit. Tolerances, small gaps and the flow "
            "rule decide there: do not rely on either answer.\n";
    }
    if (scene.flowRule() == FlowRule::nonAssociative && advice.peak > 0 && advice.capacity > 1)
    {
        text.warnings +=
            "    With `flowRule nonAssociative;` blocks may move below alpha as well: limitAnalysis "
            "with that flow rule gives the range.\n";
    }
}

/// Whether joints slide before blocks rock.
void adviseOnFriction(const EffectAdvice& advice, Advice& text)
{
    if (std::isnan(advice.frictionDemand))
    {
        text.sentences +=
            "    The friction demand is not known: limit analysis without sliding did not converge.\n";
        return;
    }
    const bool slides = advice.frictionDemand >= advice.mu;
    text.sentences += fmt::format("    Friction demand {:.4g} is {} mu = {:.6g}: {}.\n",
                                  advice.frictionDemand, slides ? "not below" : "below", advice.mu,
                                  slides ? "joints slide, and the flow rule matters"
                                         : "no joint slides before blocks rock");
    if (advice.frictionDemand > 0 && margin(advice.frictionDemand, advice.mu) == Margin::nearLimit)
    {
        text.warnings += "    Warning: the friction demand is within 5% of mu.\n";
    }
}

} // namespace

std::string adviceText(const DynamicCase<2>& scene, const EffectAdvice& advice)
{
    Advice text{"Advice by closed-form criteria for rigid blocks (no setting is changed):\n", ""};
    if (!advice.isAssessed)
    {
        return text.sentences + fmt::format("    none: {}.\n", advice.reason);
    }
    if (advice.capacity == 0)
    {
        return text.sentences + "    The blocks cannot carry their dead load: they move by themselves.\n";
    }
    adviseOnMotion(scene, advice, text);
    adviseOnFriction(advice, text);
    return text.sentences + text.warnings;
}

} // namespace drystone
