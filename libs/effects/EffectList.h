// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The effects that time stepping knows, and what a case says of them in constant/contactProperties.
#pragma once

#include "conic/SolverChoice.h"
#include "contact/ContactProperties.h"
#include "dictionary/EntryLocations.h"
#include "effects/Effect.h"

#include <filesystem>
#include <optional>

namespace drystone
{

/// How a case is computed, for what an effect does not go together with.
template<int Dim>
struct EffectSource
{
    const Structure<Dim>& structure;
    const ContactProperties& contact;
    const EntryLocations& locations; ///< of the entries of constant/contactProperties
    std::filesystem::path caseDirectory;
    Displacements displacements = Displacements::large;
    double theta = 1;
    SolverType solver = SolverType::automatic;
};

/// An effect whose keys are declared: its settings, until it is made of them.
template<int Dim>
struct DeclaredEffect
{
    std::string name; ///< of its sub-dictionary; empty: it follows from others
    std::function<void(Options&)> declare;
    std::function<bool()> isGiven; ///< once the dictionary was read
    /// \return null where the case does not have it \throws FatalIOError for what it does not go together
    /// with
    std::function<std::shared_ptr<const Effect<Dim>>(const EffectSource<Dim>&)> make;
};

/// An entry of the list: makes a declared effect with settings of its own.
template<int Dim>
using EffectType = std::function<DeclaredEffect<Dim>()>;

/// An effect with a sub-dictionary of this name. \param make from its settings and an EffectSource; null for
/// settings that request nothing
template<int Dim, class Settings, class Make>
EffectType<Dim> effectType(std::string name, std::string doc, Make make)
{
    return [name, doc, make]
    {
        const auto settings = std::make_shared<std::optional<Settings>>();
        return DeclaredEffect<Dim>{
            name, [name, doc, settings](Options& options) { options.optional(name, *settings, doc); },
            [settings] { return settings->has_value(); },
            [make, settings](const EffectSource<Dim>& source) -> std::shared_ptr<const Effect<Dim>>
            { return *settings ? make(**settings, source) : nullptr; }};
    };
}

/// All effects. A new one is a line here, and its two files.
template<int Dim>
const std::vector<EffectType<Dim>>& effectTypes();

/// constant/contactProperties as it is read: what joints carry, and the effects of motion.
template<int Dim>
struct CaseEffects
{
    explicit CaseEffects(const std::vector<EffectType<Dim>>& types = effectTypes<Dim>());

    ContactProperties contact;
    std::vector<DeclaredEffect<Dim>> declared;
    EntryLocations locations;
};
template<int Dim>
void declare(Options& options, CaseEffects<Dim>& effects);

/// Reads the file of a case. \throws FatalError or FatalIOError when it is missing or faulty, or requests an
/// effect that is unknown or absent from this version
template<int Dim>
CaseEffects<Dim> readCaseEffects(const std::filesystem::path& caseDirectory,
                                 const std::vector<EffectType<Dim>>& types = effectTypes<Dim>());

/// The effects that a case has. \throws FatalIOError for those that do not go together
template<int Dim>
Effects<Dim> makeEffects(const CaseEffects<Dim>& read, const EffectSource<Dim>& source);

/// The effects of a case, for the log: which are simulated and which are not.
template<int Dim>
EffectNames effectNames(const CaseEffects<Dim>& effects);

/// Those of a limit analysis, which has none of motion.
EffectNames effectNamesAtRest(const ContactProperties& contact);

} // namespace drystone
