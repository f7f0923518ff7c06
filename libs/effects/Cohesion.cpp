// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of cohesion; what it does is in contact/JointLaws for structures at rest, in JointBonds for
/// motion.
#include "effects/Cohesion.h"

#include "effects/JointStrength.h"

namespace drystone
{

void declareCohesion(Options& options, JointProperties& properties)
{
    options.optional("cohesion", properties.cohesion, "shear beside friction");
}

template<int Dim>
EffectType<Dim> cohesionType()
{
    return jointEffectType<Dim>(
        "cohesion",
        [](Options& options, ContactProperties& contact)
        {
            options.optional("cohesion", contact.cohesion,
                             "shear of the joints beside friction, in motion until they break; absent: none");
        },
        [](const ContactProperties& contact)
        { return contact.cohesion.has_value() || isInJoints(contact, &JointProperties::cohesion); });
}

template EffectType<2> cohesionType<2>();
template EffectType<3> cohesionType<3>();

} // namespace drystone
