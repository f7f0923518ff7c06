// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Compliance of contact points, and what it stores.
#include "effects/JointElasticity.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// What elastic contact points do not go together with.
void refuseCombinations(const EffectSource& source)
{
    const ContactProperties& contact = source.contact;
    for (const std::string effect : {"cohesion", "tension"})
    {
        if (effect == "cohesion" ? contact.cohesion : contact.tension)
        {
            throw FatalIOError(
                fmt::format("Joints are either elastic or hold by {0}, which is rigid until it "
                            "breaks: remove elasticity, or {0}.",
                            effect),
                source.locations.of(effect));
        }
    }
    for (const auto& [name, properties] : contact.joints)
    {
        if (properties.cohesion || properties.tension)
        {
            throw FatalIOError(fmt::format("Joints are either elastic or hold by cohesion and tension, which "
                                           "are rigid until they break: remove elasticity, or those of {}.",
                                           name.text),
                               source.locations.of("joints/" + name.text));
        }
    }
    if (contact.restitution)
    {
        throw FatalIOError("Elastic contact points rebound by themselves: remove restitution, or elasticity.",
                           source.locations.of("restitution"));
    }
    if (source.theta < 1)
    {
        throw FatalIOError("Elastic contact points are integrated with theta 1 only: set `theta 1;` in "
                           "system/schemes, or remove elasticity.",
                           source.locations.of("elasticity"));
    }
    if (source.solver == SolverType::interiorPoint || source.solver == SolverType::augmentedLagrangian)
    {
        throw FatalIOError(
            "Elastic contact points are solved by Newton's method of their own, or by gaussSeidel: set "
            "`solver automatic;` for contactDynamics in system/solution, or remove elasticity.",
            source.locations.of("elasticity"));
    }
}

} // namespace

void declare(Options& options, Elasticity& elasticity)
{
    options.required("normal", elasticity.normal, "stiffness of a contact point against pressing")
        .unit("N/m")
        .above(0)
        .example("1e9");
    options.required("tangential", elasticity.tangential, "stiffness of a contact point against shearing")
        .unit("N/m")
        .above(0)
        .example("5e8");
}

void JointElasticity::contribute(const EffectContext& context, EffectState&, PlaneConeProgram& program) const
{
    program.compliance.resize(2 * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        program.compliance.segment<2>(2 * point) = compliance;
        program.gap[2 * point + 1] -= compliance[1] * context.forcesBefore[2 * point + 1];
    }
}

void JointElasticity::account(const EffectContext& context, const EffectSolution& solution,
                              StepEnergy& energy) const
{
    Eigen::Vector2d stored = Eigen::Vector2d::Zero();
    Eigen::Vector2d before = Eigen::Vector2d::Zero();
    Eigen::Vector2d lost = Eigen::Vector2d::Zero();
    for (Eigen::Index row = 0; row < solution.contactForce.size(); row += 2)
    {
        const Eigen::Vector2d now = solution.contactForce.segment<2>(row);
        const Eigen::Vector2d then = context.forcesBefore.segment<2>(row);
        stored += now.cwiseAbs2();
        before += then.cwiseAbs2();
        lost += (now - then).cwiseAbs2();
    }
    const Eigen::Vector2d change = 0.5 * compliance.cwiseProduct(stored - before);
    const Eigen::Vector2d algorithmic = 0.5 * compliance.cwiseProduct(lost);
    energy.normalLoss -= change[0] + algorithmic[0];
    energy.frictionLoss -= change[1] + algorithmic[1];
    // Points that are no longer there take what they had stored with them.
    Eigen::Vector2d all = Eigen::Vector2d::Zero();
    for (const Vector<2>& force : context.allForcesBefore)
    {
        all += force.cwiseAbs2();
    }
    const double gone = 0.5 * compliance.dot(all - before);
    energy.elasticChange += change.sum() - gone;
    energy.algorithmicLoss += algorithmic.sum() + gone;
}

EffectType elasticityType()
{
    return effectType<Elasticity>("elasticity",
                                  "contact points that give way under force, in motion; absent: rigid",
                                  [](const Elasticity& elasticity, const EffectSource& source)
                                  {
                                      refuseCombinations(source);
                                      return std::make_shared<JointElasticity>(elasticity);
                                  });
}

} // namespace drystone
