// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The list of effects, and how a case is read with it.
#include "effects/EffectList.h"

#include "effects/Deletion.h"
#include "effects/JointBonds.h"
#include "effects/JointElasticity.h"
#include "effects/MassDamping.h"

namespace drystone
{

template<int Dim>
const std::vector<EffectType<Dim>>& effectTypes()
{
    static const std::vector<EffectType<Dim>> types{bondsType<Dim>(), elasticityType<Dim>(),
                                                    dampingType<Dim>(), deletionType<Dim>()};
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
    declare(options, effects.contact);
    for (const DeclaredEffect<Dim>& effect : effects.declared)
    {
        effect.declare(options);
    }
}

template<int Dim>
CaseEffects<Dim> readCaseEffects(const std::filesystem::path& caseDirectory,
                                 const std::vector<EffectType<Dim>>& types)
{
    const Dictionary dictionary = readContactDictionary(caseDirectory);
    CaseEffects<Dim> effects(types);
    readOptions(dictionary, effects);
    effects.locations = EntryLocations(dictionary);
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
    EffectNames ofMotion;
    for (const DeclaredEffect<Dim>& effect : effects.declared)
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
