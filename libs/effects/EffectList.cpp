// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The list of effects, and how a case is read with it.
#include "effects/EffectList.h"

#include "assembly/CaseFile.h"
#include "effects/Cohesion.h"
#include "effects/Crushing.h"
#include "effects/Deletion.h"
#include "effects/Friction.h"
#include "effects/GroundMotion.h"
#include "effects/JointBonds.h"
#include "effects/JointElasticity.h"
#include "effects/JointModel.h"
#include "effects/MassDamping.h"
#include "effects/Restitution.h"
#include "effects/SupportMotion.h"
#include "effects/Tension.h"

#include <fmt/format.h>

namespace drystone
{

template<int Dim>
const std::vector<EffectType<Dim>>& effectTypes()
{
    static const std::vector<EffectType<Dim>> types{
        frictionType<Dim>(), restitutionType<Dim>(),  cohesionType<Dim>(),      tensionType<Dim>(),
        crushingType<Dim>(), jointModelType<Dim>(),   bondsType<Dim>(),         elasticityType<Dim>(),
        dampingType<Dim>(),  groundMotionType<Dim>(), supportMotionType<Dim>(), deletionType<Dim>()};
    return types;
}

template<int Dim>
CaseEffects<Dim>::CaseEffects(const std::vector<EffectType<Dim>>& types)
{
    for (const EffectType<Dim>& type : types)
    {
        declared.push_back(type());
    }
}

template<int Dim>
void declare(Options& options, CaseEffects<Dim>& effects)
{
    for (const DeclaredEffect<Dim>& effect : effects.declared)
    {
        effect.declare(options, effects.contact);
    }
}

void declare(Options& options, JointProperties& properties)
{
    for (const EffectType<2>& type : effectTypes<2>()) // the keys are the same in space
    {
        if (const DeclaredEffect<2> effect = type(); effect.ofJoints.declare)
        {
            effect.ofJoints.declare(options, properties);
        }
    }
}

namespace
{

/// The dictionary, with what is there of effects that are absent from this version refused.
Dictionary readContactDictionary(const std::filesystem::path& caseDirectory)
{
    Dictionary dictionary = readCaseFile(caseDirectory, "constant/contactProperties",
                                         "friction { type Coulomb; mu 0.65; flowRule associative; }");
    for (const AbsentEffect& effect : absentEffects())
    {
        if (const Entry* entry = dictionary.findExact(effect.name))
        {
            throw FatalIOError(
                fmt::format("This version does not simulate {} ({}). Remove the entry to compute "
                            "without it; simulated are: friction restitution cohesion tension crushing "
                            "elasticity damping deletion.",
                            effect.name, effect.summary),
                entry->location());
        }
    }
    return dictionary;
}

template<int Dim>
CaseEffects<Dim> readContactFile(const std::filesystem::path& caseDirectory,
                                 const std::vector<EffectType<Dim>>& types)
{
    const Dictionary dictionary = readContactDictionary(caseDirectory);
    CaseEffects<Dim> effects(types);
    readOptions(dictionary, effects);
    effects.contact.locations = EntryLocations(dictionary);
    return effects;
}

} // namespace

template<int Dim>
CaseEffects<Dim> readCaseEffects(const std::filesystem::path& caseDirectory,
                                 const std::vector<EffectType<Dim>>& types)
{
    CaseEffects<Dim> effects = readContactFile(caseDirectory, types);
    for (const DeclaredEffect<Dim>& declared : effects.declared)
    {
        if (declared.readFile)
        {
            declared.readFile(caseDirectory);
        }
    }
    return effects;
}

template<int Dim>
Effects<Dim> makeEffects(const CaseEffects<Dim>& read, const EffectSource<Dim>& source)
{
    Effects<Dim> effects;
    for (const DeclaredEffect<Dim>& declared : read.declared)
    {
        if (auto effect = declared.make(source))
        {
            effects.push_back(std::move(effect));
        }
    }
    return effects;
}

template<int Dim>
EffectNames effectNames(const CaseEffects<Dim>& effects)
{
    EffectNames names;
    for (const DeclaredEffect<Dim>& effect : effects.declared)
    {
        if (!effect.name.empty())
        {
            (effect.isGiven(effects.contact) ? names.simulated : names.absent).push_back(effect.name);
        }
    }
    for (const AbsentEffect& effect : absentEffects())
    {
        names.absent.emplace_back(effect.name);
    }
    return names;
}

ContactProperties readContactProperties(const std::filesystem::path& caseDirectory)
{
    return readContactFile(caseDirectory, effectTypes<2>()).contact;
}

EffectNames withSimulated(EffectNames names, const std::string& name)
{
    std::erase(names.absent, name);
    if (std::find(names.simulated.begin(), names.simulated.end(), name) == names.simulated.end())
    {
        names.simulated.push_back(name);
    }
    return names;
}

const std::vector<AbsentEffect>& absentEffects()
{
    static const std::vector<AbsentEffect> effects{
        {"rollingResistance",
         "a moment that resists rolling: blocks with corners touch at points and do not roll"},
    };
    return effects;
}

void refuseEffect(const ContactProperties& contact, const std::string& computation, const std::string& key)
{
    if (contact.locations.has(key))
    {
        throw FatalIOError(
            fmt::format("{} does not simulate {}. Remove the entry to compute without it.", computation, key),
            contact.locations.of(key));
    }
    for (const auto& [name, properties] : contact.joints)
    {
        if (const std::string entry = "joints/" + name.text + "/" + key; contact.locations.has(entry))
        {
            throw FatalIOError(
                fmt::format("{} does not simulate {}, which joint {} has. Remove the entry to compute "
                            "without it.",
                            computation, key, name.text),
                contact.locations.of(entry));
        }
    }
}

EffectNames effectNamesAtRest(const ContactProperties& contact)
{
    CaseEffects<2> none; // the names are the same in space
    none.contact = contact;
    return effectNames(none);
}

template const std::vector<EffectType<2>>& effectTypes<2>();
template struct CaseEffects<2>;
template void declare(Options& options, CaseEffects<2>& effects);
template CaseEffects<2> readCaseEffects(const std::filesystem::path& caseDirectory,
                                        const std::vector<EffectType<2>>& types);
template Effects<2> makeEffects(const CaseEffects<2>& read, const EffectSource<2>& source);
template EffectNames effectNames(const CaseEffects<2>& effects);
template const std::vector<EffectType<3>>& effectTypes<3>();
template struct CaseEffects<3>;
template void declare(Options& options, CaseEffects<3>& effects);
template CaseEffects<3> readCaseEffects(const std::filesystem::path& caseDirectory,
                                        const std::vector<EffectType<3>>& types);
template Effects<3> makeEffects(const CaseEffects<3>& read, const EffectSource<3>& source);
template EffectNames effectNames(const CaseEffects<3>& effects);

} // namespace drystone
