// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The effects that time stepping knows, and what a case says of them in constant/contactProperties.
#pragma once

#include "conic/SolverChoice.h"
#include "contact/ContactProperties.h"
#include "dictionary/EntryLocations.h"
#include "effects/Effect.h"

#include <algorithm>
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
    /// Its keys: of what joints carry into the contact properties, else into settings of its own.
    std::function<void(Options&, ContactProperties&)> declare;
    std::function<bool(const ContactProperties&)> isGiven; ///< once the dictionary was read
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
            name,
            [name, doc, settings](Options& options, ContactProperties&)
            { options.optional(name, *settings, doc); },
            [settings](const ContactProperties&) { return settings->has_value(); },
            [make, settings](const EffectSource<Dim>& source) -> std::shared_ptr<const Effect<Dim>>
            { return *settings ? make(**settings, source) : nullptr; }};
    };
}

/// An effect whose settings are contact properties, which structures at rest have, too. \param make see
/// DeclaredEffect; by default nothing: it is a parameter of the program, not a term
template<int Dim>
EffectType<Dim> jointEffectType(
    std::string name, std::function<void(Options&, ContactProperties&)> declare,
    std::function<bool(const ContactProperties&)> isGiven,
    std::function<std::shared_ptr<const Effect<Dim>>(const EffectSource<Dim>&)> make =
        [](const EffectSource<Dim>&) -> std::shared_ptr<const Effect<Dim>> { return nullptr; })
{
    return [name, declare, isGiven, make] { return DeclaredEffect<Dim>{name, declare, isGiven, make}; };
}

/// Whether some joint has a property of its own.
template<class Property>
bool isInJoints(const ContactProperties& contact, std::optional<Property> JointProperties::*property)
{
    return std::any_of(contact.joints.begin(), contact.joints.end(),
                       [property](const auto& joint) { return (joint.second.*property).has_value(); });
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
struct EffectNames
{
    std::vector<std::string> simulated;
    std::vector<std::string> absent;
};
template<int Dim>
EffectNames effectNames(const CaseEffects<Dim>& effects);

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

/// All of them: asking for one is an error, so that nobody takes a result for what it is not.
const std::vector<AbsentEffect>& absentEffects();

/// Refuses effects that an application does not simulate, so that nobody takes a result for what it is not.
/// \param names of sub-dictionaries or entries of constant/contactProperties
/// \throws FatalIOError for the first of them that the case gives
void refuseEffects(const std::filesystem::path& caseDirectory, const std::string& application,
                   const std::vector<std::string>& names);

} // namespace drystone
