// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of restitution.
#include "effects/Restitution.h"

#include "effects/ContactProperties.h"

namespace drystone
{

void declare(Options& options, Restitution& restitution)
{
    options
        .required("normal", restitution.normal,
                  "parting over closing velocity of an impact; less of it, as the log says, in impacts where "
                  "together with friction all of it would create energy")
        .unit("-")
        .atLeast(0)
        .atMost(1)
        .example("0.5");
}

template<int Dim>
EffectType<Dim> restitutionType()
{
    return jointEffectType<Dim>(
        "restitution",
        [](Options& options, ContactProperties& contact)
        { options.optional("restitution", contact.restitution, "rebound after an impact; absent: none"); },
        [](const ContactProperties& contact) { return contact.restitution.has_value(); }, noEffect<Dim>);
}

template EffectType<2> restitutionType<2>();
template EffectType<3> restitutionType<3>();

} // namespace drystone
