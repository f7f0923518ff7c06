// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of tension; what it does is in contact/JointLaws for structures at rest, in JointBonds for
/// motion.
#include "effects/Tension.h"

#include "effects/JointStrength.h"

namespace drystone
{

void declareTension(Options& options, JointProperties& properties)
{
    options.optional("tension", properties.tension, "normal stress that holds the joint together");
}

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
        },
        [](const ContactProperties& contact)
        { return contact.tension.has_value() || isInJoints(contact, &JointProperties::tension); });
}

template EffectType<2> tensionType<2>();
template EffectType<3> tensionType<3>();

} // namespace drystone
