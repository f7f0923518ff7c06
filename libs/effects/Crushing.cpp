// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of crushing, and its refusal in motion; what it does is in contact/JointLaws.
#include "effects/Crushing.h"

#include "effects/JointStrength.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// Nobody is to take a result for what it is not. \return nothing
template<int Dim>
std::shared_ptr<const Effect<Dim>> refuseInMotion(const EffectSource<Dim>& source)
{
    if (source.contact.crushing)
    {
        throw FatalIOError(
            "contactDynamics does not simulate crushing. Remove the entry to compute without it.",
            source.locations.of("crushing"));
    }
    for (const auto& [name, properties] : source.contact.joints)
    {
        if (properties.crushing)
        {
            throw FatalIOError(fmt::format("contactDynamics does not simulate crushing, which joint {} has. "
                                           "Remove the entry to compute without it.",
                                           name.text),
                               source.locations.of("joints/" + name.text + "/crushing"));
        }
    }
    return nullptr;
}

} // namespace

void declareCrushing(Options& options, JointProperties& properties)
{
    options.optional("crushing", properties.crushing, "pressure that the joint bears");
}

template<int Dim>
EffectType<Dim> crushingType()
{
    return jointEffectType<Dim>(
        "crushing",
        [](Options& options, ContactProperties& contact)
        { options.optional("crushing", contact.crushing, "pressure that the joints bear; absent: any"); },
        [](const ContactProperties& contact)
        { return contact.crushing.has_value() || isInJoints(contact, &JointProperties::crushing); },
        refuseInMotion<Dim>);
}

template EffectType<2> crushingType<2>();
template EffectType<3> crushingType<3>();

} // namespace drystone
