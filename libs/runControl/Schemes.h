// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How a case is stepped through time: system/schemes.
///
///     timeIntegration { type theta; theta 1; }
///     smallDisplacements no;
#pragma once

#include "dictionary/Registry.h"

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace drystone
{

/// Settings of `timeIntegration { type theta; }`.
struct ThetaIntegration
{
    double theta = 1; ///< weight of the end of a step: 1 backward Euler, 0.5 trapezoidal rule
};
void declare(Options& options, ThetaIntegration& integration);

/// All ways to integrate in time: theta.
const Registry<ThetaIntegration>& timeIntegrationTypes();

/// When blocks collide that meet in the course of a step, where impacts are apart from its program: with
/// restitution, or theta below 1.
enum class ImpactInstant
{
    located,  ///< when they meet: the step is parted there
    stepStart ///< at the start of the step, a little apart: an error of first order in the step
};

constexpr std::array<std::pair<std::string_view, ImpactInstant>, 2> namesOf(ImpactInstant)
{
    return {{{"located", ImpactInstant::located}, {"stepStart", ImpactInstant::stepStart}}};
}

/// Small gaps that a joint has from the start: how much a result depends on perfect fit.
struct InitialGaps
{
    double perturbation = 0; ///< each point's gap is drawn evenly between 0 and this [m]
    int seed = 1;            ///< of the random numbers
};
void declare(Options& options, InitialGaps& gaps);

/// Which effects each step simulates.
enum class EffectSelection
{
    asGiven,   ///< all that the case names, of all blocks, in every step
    automatic, ///< of these those that a step calls for: what is left out provably changes nothing
    everything ///< all that the case names and those that it leaves out although they take no data, likewise
};

constexpr std::array<std::pair<std::string_view, EffectSelection>, 3> namesOf(EffectSelection)
{
    return {{{"asGiven", EffectSelection::asGiven},
             {"automatic", EffectSelection::automatic},
             {"everything", EffectSelection::everything}}};
}

/// `effects { selection automatic; margin 0.05; verifyInterval 100; }`
struct ChosenEffects
{
    EffectSelection selection = EffectSelection::asGiven;
    double margin = 0.05;   ///< share of what a part at rest carries that a proof leaves unused [-]
    int verifyInterval = 0; ///< every so many steps one is solved with all effects of the case, too; 0: none
};
void declare(Options& options, ChosenEffects& effects);

/// Share of a block by which contact points give way.
constexpr double leastContactOverlap = 1e-12; // forces would have four digits only
constexpr double mostContactOverlap = 1e-5;

struct Schemes
{
    ThetaIntegration timeIntegration;
    ImpactInstant impacts = ImpactInstant::located;
    bool smallDisplacements = false; ///< contact points and lever arms stay as built
    double contactTolerance = 1e-7;  ///< error allowed in the gaps at the end of a step [mean block size]
    /// By how much points give way with Coulomb's law, which makes their forces unique [mean block
    /// size]
    double contactOverlap = 3e-10;
    double maxDisplacement = 0.05; ///< of any block in a step, with adjustTimeStep [mean block size]
    double maxDeltaT = std::numeric_limits<double>::infinity(); ///< with adjustTimeStep [s]
    std::optional<InitialGaps> initialGaps;                     ///< with smallDisplacements
    ChosenEffects effects;
};
void declare(Options& options, Schemes& schemes);

/// The schemes of a case: the defaults when there is no file. \throws FatalIOError for what is wrong with it
Schemes readSchemes(const std::filesystem::path& caseDirectory);

} // namespace drystone
