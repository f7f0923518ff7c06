// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declaration and reading of system/schemes.
#include "runControl/Schemes.h"

namespace drystone
{

void declare(Options& options, ThetaIntegration& integration)
{
    options
        .optional("theta", integration.theta,
                  "weight of the end of a step: 1 backward Euler, 0.5 trapezoidal rule")
        .atLeast(0.5)
        .atMost(1);
}

const Registry<ThetaIntegration>& timeIntegrationTypes()
{
    static const Registry<ThetaIntegration> registry{
        "time integration",
        {model<ThetaIntegration, ThetaIntegration>("theta", "the theta method, stable from 0.5 to 1",
                                                   [](ThetaIntegration integration)
                                                   { return integration; })}};
    return registry;
}

void declare(Options& options, InitialGaps& gaps)
{
    options
        .required("perturbation", gaps.perturbation,
                  "the gap of each contact point is drawn evenly between 0 and this")
        .unit("m")
        .atLeast(0)
        .example("1e-9");
    options.optional("seed", gaps.seed, "of the random numbers: the same seed gives the same gaps")
        .atLeast(0);
}

void declare(Options& options, ChosenEffects& effects)
{
    options.optional(
        "selection", effects.selection,
        "asGiven: every step simulates all effects that the case names, of all blocks, and limit analysis "
        "all blocks; automatic: those that it calls for, with a proof that the others would change nothing "
        "beyond the tolerance of the solver; everything: as asGiven, and with large displacements, Coulomb's "
        "law and located impacts where the case leaves them out");
    options
        .optional("margin", effects.margin,
                  "share of what blocks at rest carry that a proof leaves unused, in motion with automatic")
        .atLeast(0)
        .atMost(0.9);
    options
        .optional(
            "verifyInterval", effects.verifyInterval,
            "every so many steps, or answers of limit analysis, one is solved with all effects that the "
            "case names, of all blocks, too, and the largest difference is reported, with automatic; 0: "
            "none")
        .atLeast(0);
    options.check(
        "selection",
        [&effects]() -> std::string
        {
            return effects.verifyInterval > 0 && effects.selection != EffectSelection::automatic
                       ? "verifyInterval needs `selection automatic;`: with the others no step leaves out "
                         "an effect of the case."
                       : "";
        });
    options.check("margin",
                  [&effects]() -> std::string
                  {
                      return effects.margin != ChosenEffects().margin
                                     && effects.selection != EffectSelection::automatic
                                 ? "margin needs `selection automatic;`: with the others there is no proof "
                                   "that could leave any of it unused. Remove it, or choose automatic."
                                 : "";
                  });
}

void declare(Options& options, Schemes& schemes)
{
    options.optional("timeIntegration", schemes.timeIntegration, timeIntegrationTypes(),
                     "how velocities and displacements follow from forces; absent: theta 1");
    options.optional("impacts", schemes.impacts,
                     "when blocks collide that meet in the course of a step, with restitution or theta below "
                     "1: when they do, up to a dozen times a step, or all at its start, as always in a "
                     "structure of which more than two pairs of bodies meet in one step, after a tenth of "
                     "maximumFactorisations has been spent in a step, or where the solver has a tolerance of "
                     "1e-4 or more");
    options.optional(
        "smallDisplacements", schemes.smallDisplacements,
        "contact points and lever arms stay as built: faster, and wrong once a block has moved by "
        "more than a small part of itself");
    options
        .optional("contactTolerance", schemes.contactTolerance,
                  "error allowed in the gaps at the end of a step, in mean block sizes")
        .above(0)
        .atMost(1e-2);
    options
        .optional("contactOverlap", schemes.contactOverlap,
                  "by how much contact points give way at most with `flowRule nonAssociative;` and theta 1, "
                  "so that their forces, and the motion, are unique, in mean block sizes")
        .atLeast(leastContactOverlap)
        .atMost(mostContactOverlap);
    options
        .optional("maxDisplacement", schemes.maxDisplacement,
                  "of any block in a step, with adjustTimeStep, in mean block sizes")
        .above(0)
        .atMost(0.25);
    options.optional("maxDeltaT", schemes.maxDeltaT, "longest step of adjustTimeStep")
        .unit("s")
        .above(0)
        .orInfinite();
    options.optional("initialGaps", schemes.initialGaps,
                     "gaps that the joints have from the start, with smallDisplacements; absent: none");
    options.optional("effects", schemes.effects,
                     "which of the effects that the case names a step simulates; absent: all of them");
    options.check("initialGaps",
                  [&schemes]() -> std::string
                  {
                      if (schemes.initialGaps && schemes.effects.selection == EffectSelection::everything)
                      {
                          return "initialGaps needs small displacements, and `selection everything;` of "
                                 "effects simulates large ones: remove one of the two.";
                      }
                      return schemes.initialGaps && !schemes.smallDisplacements
                                 ? "initialGaps needs `smallDisplacements yes;`: where blocks move, their "
                                   "gaps follow from where they are. Displace blocks in 0/motion instead."
                                 : "";
                  });
}

Schemes readSchemes(const std::filesystem::path& caseDirectory)
{
    return readOptions<Schemes>(Dictionary::readFileIfPresent(caseDirectory / "system/schemes"));
}

} // namespace drystone
