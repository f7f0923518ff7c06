// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Cohesion: its keys, and its part in the laws of joints; what it does in motion is in JointBonds.
#include "effects/Cohesion.h"

#include "effects/JointLaws.h"

namespace drystone
{

double cohesionOf(const JointOfCase& joint)
{
    return stressOf(joint.own.cohesion, joint.contact.cohesion).value_or(0);
}

template<int Dim>
EffectType<Dim> cohesionType()
{
    return jointEffectType<Dim>(
        "cohesion",
        [](Options& options, ContactProperties& contact)
        {
            options.optional(
                "cohesion", contact.cohesion,
                "shear of the joints besides friction, in motion until they break; absent: none");
            options.question("cohesion", [&contact] { return doubtAboutBond(contact.cohesion, "cohesion"); });
        },
        [](const ContactProperties& contact)
        { return contact.cohesion.has_value() || isInJoints(contact, &JointProperties::cohesion); },
        noEffect<Dim>,
        {[](Options& options, JointProperties& properties)
         {
             options.optional("cohesion", properties.cohesion, "shear besides friction");
             options.question("cohesion",
                              [&properties] { return doubtAboutBond(properties.cohesion, "cohesion"); });
         },
         [](const JointOfCase& joint, double area, PointLaw& law)
         { law.cohesion = cohesionOf(joint) * area; }});
}

template EffectType<2> cohesionType<2>();
template EffectType<3> cohesionType<3>();

} // namespace drystone
