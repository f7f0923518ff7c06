// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of contact properties.
#include "assembly/ContactProperties.h"

#include "assembly/CaseFile.h"

#include <fmt/format.h>

namespace drystone
{

const Registry<CoulombFriction>& frictionTypes()
{
    static const Registry<CoulombFriction> registry{
        "friction",
        {model<CoulombFriction, CoulombFriction>("Coulomb", "shear up to mu times the normal force",
                                                 [](CoulombFriction friction) { return friction; })}};
    return registry;
}

const std::vector<AbsentEffect>& absentEffects()
{
    static const std::vector<AbsentEffect> effects{
        {"cohesion", "shear strength without normal force"},
        {"tension", "tensile strength of the joints"},
        {"crushing", "a limit to the compression that a contact carries"},
        {"elasticity", "joints that give way under load"},
        {"damping", "losses beside friction and impact"},
        {"rollingResistance", "a moment that resists rolling"},
    };
    return effects;
}

void declare(Options& options, CoulombFriction& friction)
{
    options.required("mu", friction.mu, "friction coefficient")
        .unit("-")
        .atLeast(0)
        .atMost(1e6)
        .example("0.65");
    options.optional("flowRule", friction.flowRule, "whether a joint that slides opens");
}

void declare(Options& options, Restitution& restitution)
{
    options.required("normal", restitution.normal, "parting over closing velocity of an impact")
        .unit("-")
        .atLeast(0)
        .atMost(1)
        .example("0.5");
}

void declare(Options& options, ContactProperties& properties)
{
    options.optional("friction", properties.friction, frictionTypes(),
                     "shear at the contacts; absent: frictionless");
    options.optional("restitution", properties.restitution, "rebound after an impact; absent: none");
}

EffectNames effectNames(const ContactProperties& properties)
{
    EffectNames names;
    (properties.friction ? names.simulated : names.absent).emplace_back("friction");
    (properties.restitution ? names.simulated : names.absent).emplace_back("restitution");
    for (const AbsentEffect& effect : absentEffects())
        names.absent.emplace_back(effect.name);
    return names;
}

ContactProperties readContactProperties(const std::filesystem::path& caseDirectory)
{
    const Dictionary dictionary = readCaseFile(caseDirectory, "constant/contactProperties",
                                               "friction { type Coulomb; mu 0.65; flowRule associative; }");
    for (const AbsentEffect& effect : absentEffects())
    {
        if (const Entry* entry = dictionary.findExact(effect.name))
        {
            throw FatalIOError(
                fmt::format("This version does not simulate {} ({}). Remove the entry to compute "
                            "without it; simulated are: friction restitution.",
                            effect.name, effect.summary),
                entry->location());
        }
    }
    return readOptions<ContactProperties>(dictionary);
}

std::vector<double> frictionCoefficients(const ContactProperties& properties, std::size_t points)
{
    return std::vector<double>(points, properties.friction ? properties.friction->mu : 0);
}

} // namespace drystone
