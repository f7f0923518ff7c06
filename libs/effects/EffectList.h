// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The effects that time stepping knows, and what a case says of them in constant/contactProperties.
#pragma once

#include "effects/ContactProperties.h"
#include "effects/EffectType.h"

#include <filesystem>

namespace drystone
{

/// All effects. A new one is a line here, and its two files.
template<int Dim>
const std::vector<EffectType<Dim>>& effectTypes();

/// What a case says of effects: constant/contactProperties with what joints carry, and files of their own.
template<int Dim>
struct CaseEffects
{
    explicit CaseEffects(const std::vector<EffectType<Dim>>& types = effectTypes<Dim>());

    ContactProperties contact;
    std::vector<DeclaredEffect<Dim>> declared;
};
template<int Dim>
void declare(Options& options, CaseEffects<Dim>& effects);

/// Reads the files of a case. \throws FatalError or FatalIOError when one is missing or faulty, or requests
/// an effect that is unknown or absent from this version
template<int Dim>
CaseEffects<Dim> readCaseEffects(const std::filesystem::path& caseDirectory,
                                 const std::vector<EffectType<Dim>>& types = effectTypes<Dim>());

/// The effects that a case has. \throws FatalIOError for those that do not go together
template<int Dim>
Effects<Dim> makeEffects(const CaseEffects<Dim>& read, const EffectSource<Dim>& source);

/// The effects of a case, for the log: which are simulated and which are not.
struct EffectNames
{
    std::vector<std::string> simulated;
    std::vector<std::string> absent;
};
template<int Dim>
EffectNames effectNames(const CaseEffects<Dim>& effects);

/// With an effect among those that are simulated, wherever it was.
EffectNames withSimulated(EffectNames names, const std::string& name);

/// Those of a limit analysis, which has none of motion.
EffectNames effectNamesAtRest(const ContactProperties& contact);

/// What the joints of a case carry, without the effects of motion. \throws as readCaseEffects
ContactProperties readContactProperties(const std::filesystem::path& caseDirectory);

/// An effect that constant/contactProperties knows and this version does not simulate.
struct AbsentEffect
{
    std::string_view name;
    std::string_view summary;
};

/// All of them: to request one is an error, so that nobody takes a result for what it is not.
const std::vector<AbsentEffect>& absentEffects();

} // namespace drystone
