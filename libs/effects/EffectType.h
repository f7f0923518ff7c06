// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What an effect has in the list of effects: its keys, whether a case gives it, and how it is made of them.
#pragma once

#include "conic/SolverChoice.h"
#include "dictionary/Options.h"
#include "effects/Effect.h"

#include <filesystem>
#include <optional>

namespace drystone
{

struct ContactProperties;
struct JointProperties;
struct JointOfCase;
struct PointLaw;

/// How a case is computed, for what an effect does not go together with.
template<int Dim>
struct EffectSource
{
    const Structure<Dim>& structure;
    const ContactProperties& contact;
    std::filesystem::path caseDirectory;
    Displacements displacements = Displacements::large;
    double theta = 1;
    SolverType solver = SolverType::automatic;
};

/// What an effect adds to the laws of contact points (JointLaws.h).
struct JointLaw
{
    std::function<void(Options&, JointProperties&)> declare; ///< its key of some joints only
    /// Fills in its part of a law, to which those before it in the list have added theirs already.
    /// \throws FatalIOError for what a joint cannot have
    std::function<void(const JointOfCase&, double area, PointLaw&)> limit;
};

/// An effect whose keys are declared: its settings, until it is made of them.
template<int Dim>
struct DeclaredEffect
{
    std::string name; ///< of its sub-dictionary, or its file in constant; empty: it follows from others
    /// Its keys: of what joints carry into the contact properties, else into settings of its own.
    std::function<void(Options&, ContactProperties&)> declare;
    std::function<bool(const ContactProperties&)> isGiven; ///< once the dictionary was read
    /// \return null where the case does not have it \throws FatalIOError for what it does not go together
    /// with
    std::function<std::shared_ptr<const Effect<Dim>>(const EffectSource<Dim>&)> make;
    /// Reads the file of its own in a case, if that has it; empty: it has none.
    std::function<void(const std::filesystem::path& caseDirectory)> readFile = {};
    /// Of what joints carry: its keys in `joints`, and its part in the law of a point; empty: none
    JointLaw ofJoints = {};
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

/// What a parameter of the program is in motion: no term of its own.
template<int Dim>
std::shared_ptr<const Effect<Dim>> noEffect(const EffectSource<Dim>&)
{
    return nullptr;
}

/// An effect whose settings are contact properties, which structures at rest have, too. \param make see
/// DeclaredEffect
template<int Dim>
EffectType<Dim>
jointEffectType(std::string name, std::function<void(Options&, ContactProperties&)> declare,
                std::function<bool(const ContactProperties&)> isGiven,
                std::function<std::shared_ptr<const Effect<Dim>>(const EffectSource<Dim>&)> make,
                JointLaw ofJoints = {})
{
    return [name, declare, isGiven, make, ofJoints]
    { return DeclaredEffect<Dim>{name, declare, isGiven, make, {}, ofJoints}; };
}

/// An effect that a file constant/<name> describes. \param make from the dictionary in it and an EffectSource
template<int Dim, class Make>
EffectType<Dim> fileEffectType(std::string name, Make make)
{
    return [name, make]
    {
        const auto file = std::make_shared<std::optional<Dictionary>>();
        return DeclaredEffect<Dim>{
            name, [](Options&, ContactProperties&) {},
            [file](const ContactProperties&) { return file->has_value(); },
            [make, file](const EffectSource<Dim>& source) -> std::shared_ptr<const Effect<Dim>>
            { return *file ? make(**file, source) : nullptr; },
            [name, file](const std::filesystem::path& caseDirectory)
            {
                if (const auto path = caseDirectory / "constant" / name; std::filesystem::exists(path))
                {
                    *file = Dictionary::readFile(path);
                }
            }};
    };
}

/// Refuses what a computation does not simulate, so that nobody takes a result for what it is not.
/// \param key of constant/contactProperties, for all joints or for some
/// \throws FatalIOError where the case gives it
void refuseEffect(const ContactProperties& contact, const std::string& computation, const std::string& key);

} // namespace drystone
