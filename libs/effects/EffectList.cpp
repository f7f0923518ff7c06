// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The list of effects, and how a case is read with it.
#include "effects/EffectList.h"

#include "effects/Deletion.h"
#include "effects/JointBonds.h"
#include "effects/JointElasticity.h"
#include "effects/MassDamping.h"

namespace drystone
{

const std::vector<EffectType>& effectTypes()
{
    static const std::vector<EffectType> types{bondsType(), elasticityType(), dampingType(), deletionType()};
    return types;
}

CaseEffects::CaseEffects(const std::vector<EffectType>& types)
{
    for (const EffectType& type : types)
    {
        declared.push_back(type());
    }
}

void declare(Options& options, CaseEffects& effects)
{
    declare(options, effects.contact);
    for (const DeclaredEffect& effect : effects.declared)
    {
        effect.declare(options);
    }
}

CaseEffects readCaseEffects(const std::filesystem::path& caseDirectory, const std::vector<EffectType>& types)
{
    const Dictionary dictionary = readContactDictionary(caseDirectory);
    CaseEffects effects(types);
    readOptions(dictionary, effects);
    effects.locations = EntryLocations(dictionary);
    return effects;
}

Effects makeEffects(const CaseEffects& read, const EffectSource& source)
{
    Effects effects;
    for (const DeclaredEffect& declared : read.declared)
    {
        if (auto effect = declared.make(source))
        {
            effects.push_back(std::move(effect));
        }
    }
    return effects;
}

EffectNames effectNames(const CaseEffects& effects)
{
    EffectNames ofMotion;
    for (const DeclaredEffect& effect : effects.declared)
    {
        if (!effect.name.empty())
        {
            (effect.isGiven() ? ofMotion.simulated : ofMotion.absent).push_back(effect.name);
        }
    }
    return effectNames(effects.contact, ofMotion);
}

EffectNames effectNamesAtRest(const ContactProperties& contact)
{
    CaseEffects none;
    none.contact = contact;
    return effectNames(none);
}

} // namespace drystone
