// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Tension: its keys, and its part in the laws of joints; what it does in motion is in JointBonds.
#include "effects/Tension.h"

#include "effects/Cohesion.h"
#include "effects/JointLaws.h"

#include <fmt/format.h>

namespace drystone
{

namespace
{

/// The surface |t| = cohesion + mu n ends where it meets the axis.
void refuseBeyondCohesion(const JointOfCase& joint, double tension, double mu)
{
    const double cohesion = cohesionOf(joint);
    if (tension * mu > cohesion * (1 + 1e-12))
    {
        throw FatalIOError(
            fmt::format("Joint {} has a tension of {:g} Pa, but its cohesion of {:g} Pa and its friction "
                        "coefficient of {:g} end at {:g} Pa. Give cohesion {{ strength {:g}; }} or more.",
                        joint.name(), tension, cohesion, mu, cohesion / mu, tension * mu),
            joint.contact.locations.of(joint.own.tension ? "joints/" + joint.entry : "tension"));
    }
}

} // namespace

template<int Dim>
EffectType<Dim> tensionType()
{
    return jointEffectType<Dim>(
        "tension",
        [](Options& options, ContactProperties& contact)
        {
            options.optional("tension", contact.tension,
                             "normal stress that holds joints together, at most cohesion over mu, in motion "
                             "until they break; absent: none");
            options.question("tension", [&contact] { return doubtAboutBond(contact.tension, "tension"); });
        },
        [](const ContactProperties& contact)
        { return contact.tension.has_value() || isInJoints(contact, &JointProperties::tension); },
        noEffect<Dim>,
        {[](Options& options, JointProperties& properties)
         {
             options.optional("tension", properties.tension, "normal stress that holds the joint together");
             options.question("tension",
                              [&properties] { return doubtAboutBond(properties.tension, "tension"); });
         },
         [](const JointOfCase& joint, double area, PointLaw& law)
         {
             const double tension = stressOf(joint.own.tension, joint.contact.tension).value_or(0);
             refuseBeyondCohesion(joint, tension, law.mu);
             law.tension = tension * area;
         }});
}

template EffectType<2> tensionType<2>();
template EffectType<3> tensionType<3>();

} // namespace drystone
