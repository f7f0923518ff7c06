// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Compliance of contact points, and what it stores.
#include "effects/JointElasticity.h"

#include "effects/ContactProperties.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// What elastic contact points do not go together with.
template<int Dim>
void refuseCombinations(const EffectSource<Dim>& source)
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
                contact.locations.of(effect));
        }
    }
    for (const auto& [name, properties] : contact.joints)
    {
        if (properties.cohesion || properties.tension)
        {
            throw FatalIOError(fmt::format("Joints are either elastic or hold by cohesion and tension, which "
                                           "are rigid until they break: remove elasticity, or those of {}.",
                                           name.text),
                               contact.locations.of("joints/" + name.text));
        }
    }
    if (contact.restitution)
    {
        throw FatalIOError("Elastic contact points rebound by themselves: remove restitution, or elasticity.",
                           contact.locations.of("restitution"));
    }
    if (source.theta < 1)
    {
        throw FatalIOError("Elastic contact points are integrated with theta 1 only: set `theta 1;` in "
                           "system/schemes, or remove elasticity.",
                           contact.locations.of("elasticity"));
    }
    if (source.solver == SolverType::interiorPoint || source.solver == SolverType::augmentedLagrangian)
    {
        throw FatalIOError(
            "Elastic contact points are solved by Newton's method of their own, or by gaussSeidel: set "
            "`solver automatic;` for contactDynamics in system/solution, or remove elasticity.",
            contact.locations.of("elasticity"));
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

template<int Dim>
void JointElasticity<Dim>::contribute(const EffectContext<Dim>& context, EffectState&,
                                      StepProgram<Dim>& program) const
{
    program.compliance.resize(Dim * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        program.compliance.template segment<Dim>(Dim * point) = compliance;
        program.gap.template segment<Dim - 1>(Dim * point + 1) -=
            compliance[1] * context.forcesBefore.template segment<Dim - 1>(Dim * point + 1);
    }
}

template<int Dim>
void JointElasticity<Dim>::account(const EffectContext<Dim>& context, const EffectSolution& solution,
                                   StepEnergy& energy) const
{
    Vector<Dim> stored = Vector<Dim>::Zero();
    Vector<Dim> before = Vector<Dim>::Zero();
    Vector<Dim> lost = Vector<Dim>::Zero();
    for (Eigen::Index row = 0; row < solution.contactForce.size(); row += Dim)
    {
        const Vector<Dim> now = solution.contactForce.segment<Dim>(row);
        const Vector<Dim> then = context.forcesBefore.template segment<Dim>(row);
        stored += now.cwiseAbs2();
        before += then.cwiseAbs2();
        lost += (now - then).cwiseAbs2();
    }
    const Vector<Dim> change = 0.5 * compliance.cwiseProduct(stored - before);
    const Vector<Dim> algorithmic = 0.5 * compliance.cwiseProduct(lost);
    energy.normalLoss -= change[0] + algorithmic[0];
    energy.frictionLoss -= (change + algorithmic).template tail<Dim - 1>().sum();
    // Points that are no longer there take what they had stored with them.
    Vector<Dim> all = Vector<Dim>::Zero();
    for (const Vector<Dim>& force : context.allForcesBefore)
    {
        all += force.cwiseAbs2();
    }
    const double gone = 0.5 * compliance.dot(all - before);
    energy.elasticChange += change.sum() - gone;
    energy.algorithmicLoss += algorithmic.sum() + gone;
}

template<int Dim>
EffectType<Dim> elasticityType()
{
    return effectType<Dim, Elasticity>("elasticity",
                                       "contact points that give way under force, in motion with theta 1 and "
                                       "without restitution, cohesion and tension; absent: rigid",
                                       [](const Elasticity& elasticity, const EffectSource<Dim>& source)
                                       {
                                           refuseCombinations(source);
                                           return std::make_shared<JointElasticity<Dim>>(elasticity);
                                       });
}

template class JointElasticity<2>;
template EffectType<2> elasticityType<2>();
template class JointElasticity<3>;
template EffectType<3> elasticityType<3>();

} // namespace drystone
