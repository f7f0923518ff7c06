// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How a case is computed: one list of the keys, for a run, for a reference that gives some of them, for a
/// sweep over several values of each, and for what of them is shown.
#pragma once

#include "conic/SolverChoice.h"
#include "dictionary/Options.h"
#include "effects/ContactProperties.h"
#include "effects/Effect.h"
#include "runControl/Schemes.h"

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// \tparam Held what there is for each key: its value, perhaps one, a list, whether it is shown
template<template<class> class Held>
struct RunSettingsOf
{
    Held<double> deltaT{}; ///< [s]
    Held<double> theta{};
    Held<FlowRule> flowRule{};
    Held<SolverType> solver{};
    Held<double> tolerance{};
    Held<int> pointsPerJoint{}; ///< of the plane
    Held<int> pointsPerSide{};  ///< of space: along each side of a joint, in a grid
    Held<Displacements> displacements{};
    Held<ContactFormulation> formulation{};
    Held<double> contactOverlap{}; ///< of a motion by Coulomb's law
    Held<EffectSelection> effects{};

    friend auto operator<=>(const RunSettingsOf&, const RunSettingsOf&) = default;
};

template<class Value>
using OneOf = Value;
template<class Value>
using PerhapsOneOf = std::optional<Value>;
template<class Value>
using ListOf = std::vector<Value>;
template<class>
using FlagOf = bool;

/// How a case is computed. Settings that do not apply to a kind of quantity are 0 (or the first enumerator).
using RunSetting = RunSettingsOf<OneOf>;

/// Calls `visit` for each key with what all of the settings have for it.
template<class Visit, class... Settings>
void forEachKey(const Visit& visit, Settings&&... settings)
{
    visit(settings.deltaT...);
    visit(settings.theta...);
    visit(settings.flowRule...);
    visit(settings.solver...);
    visit(settings.tolerance...);
    visit(settings.pointsPerJoint...);
    visit(settings.pointsPerSide...);
    visit(settings.displacements...);
    visit(settings.formulation...);
    visit(settings.contactOverlap...);
    visit(settings.effects...);
}

/// Declares the keys, none of which need be given. \param docOfStep what `deltaT` is for
template<template<class> class Held>
void declareSettings(Options& options, RunSettingsOf<Held>& settings, const std::string& docOfStep)
{
    constexpr bool isList = requires
    {
        settings.deltaT.begin();
    };
    const auto example = [](const char* list, const char* one) { return isList ? list : one; };
    options.optional("deltaT", settings.deltaT, docOfStep)
        .unit("s")
        .above(0)
        .example(example("(0.02 0.01 0.005)", "1e-4"));
    options.optional("theta", settings.theta, "of a motion")
        .atLeast(0.5)
        .atMost(1)
        .example(example("(0.5 1)", "0.5"));
    options
        .optional("flowRule", settings.flowRule,
                  "associative or nonAssociative: the limits of the two differ")
        .example(example("(associative nonAssociative)", "nonAssociative"));
    options
        .optional("solver", settings.solver,
                  "of a motion: automatic, interiorPoint, augmentedLagrangian or gaussSeidel")
        .example(example("(interiorPoint augmentedLagrangian)", "automatic"));
    options.optional("tolerance", settings.tolerance, "of the solver")
        .above(0)
        .atMost(1e-3)
        .example(example("(1e-4 1e-8)", "1e-11"));
    options
        .optional("pointsPerJoint", settings.pointsPerJoint,
                  "of a multiplier in the plane: contact points a joint")
        .atLeast(2)
        .atMost(1000)
        .example(example("(2 5 21)", "21"));
    options
        .optional("pointsPerSide", settings.pointsPerSide,
                  "of a multiplier in space: `jointPoints { type grid; }` with as many points a side")
        .atLeast(2)
        .atMost(100)
        .example(example("(2 5 9)", "9"));
    options.optional("displacements", settings.displacements, "of a motion: large or small")
        .example(example("(large small)", "large"));
    options
        .optional("formulation", settings.formulation,
                  "of a multiplier: contact by points, or by surface in the stress resultants of the joints")
        .example(example("(points surface)", "points"));
    options
        .optional("contactOverlap", settings.contactOverlap,
                  "of a motion by Coulomb's law: how far points give way, in mean block sizes")
        .atLeast(leastContactOverlap)
        .atMost(mostContactOverlap)
        .example(example("(1e-6 1e-8 3e-10)", "3e-11"));
    options
        .optional("effects", settings.effects,
                  "of a motion: asGiven, all that the case names in every step, automatic, those that a step "
                  "calls for, or everything, also large displacements, Coulomb's law and located impacts, "
                  "whatever displacements and flowRule are")
        .example(example("(asGiven automatic everything)", "asGiven"));
}

} // namespace drystone
