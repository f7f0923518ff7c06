// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Crushing: its keys, its part in the laws of joints, and its refusal in motion.
#include "effects/Crushing.h"

#include "effects/JointLaws.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

void limitPressure(const JointOfCase& joint, double area, PointLaw& law)
{
    const std::optional<double> strength = stressOf(joint.own.crushing, joint.contact.crushing);
    if (!strength)
    {
        return;
    }
    law.crushing = *strength * area;
    if (law.crushing == 0)
    {
        throw FatalIOError(
            fmt::format("Joint {} bears no pressure: give crushing {{ strength ...; }} above 0.",
                        joint.name()),
            joint.contact.locations.of(joint.own.crushing ? "joints/" + joint.entry : "crushing"));
    }
}

} // namespace

template<int Dim>
EffectType<Dim> crushingType()
{
    return jointEffectType<Dim>(
        "crushing",
        [](Options& options, ContactProperties& contact)
        { options.optional("crushing", contact.crushing, "pressure that the joints bear; absent: any"); },
        [](const ContactProperties& contact)
        { return contact.crushing.has_value() || isInJoints(contact, &JointProperties::crushing); },
        [](const EffectSource<Dim>& source) -> std::shared_ptr<const Effect<Dim>>
        {
            refuseEffect(source.contact, "contactDynamics", "crushing");
            return nullptr;
        },
        {[](Options& options, JointProperties& properties)
         { options.optional("crushing", properties.crushing, "pressure that the joint bears"); },
         [](const JointOfCase& joint, double area, PointLaw& law) { limitPressure(joint, area, law); }});
}

template EffectType<2> crushingType<2>();
template EffectType<3> crushingType<3>();

} // namespace drystone
