// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What several effects are together.
#include "effects/Effect.h"

namespace drystone
{
namespace
{

/// What the first effect that has any has of something: one moves the supports. \param of an effect
template<int Dim, class Of>
auto firstThatHasAny(const Effects<Dim>& effects, const Of& of) -> decltype(of(*effects.front()))
{
    for (const auto& effect : effects)
    {
        auto own = of(*effect);
        if (!own.empty())
        {
            return own;
        }
    }
    return {};
}

} // namespace

template<int Dim>
EffectTraits traitsOf(const Effects<Dim>& effects)
{
    EffectTraits all;
    all.isIdleAtRest = true;
    for (const auto& effect : effects)
    {
        const EffectTraits own = effect->traits();
        all.isCompliant = all.isCompliant || own.isCompliant;
        all.holdsJoints = all.holdsJoints || own.holdsJoints;
        all.actsOnBlocks = all.actsOnBlocks || own.actsOnBlocks;
        all.movesSupports = all.movesSupports || own.movesSupports;
        all.isIdleAtRest = all.isIdleAtRest && own.isIdleAtRest;
        all.stiffness += own.stiffness;
        all.damping += own.damping;
    }
    return all;
}

template<int Dim>
std::vector<SupportStep<Dim>> supportSteps(const Effects<Dim>& effects, const Structure<Dim>& structure,
                                           const std::vector<Placement<Dim>>& placements, double from,
                                           double to)
{
    return firstThatHasAny<Dim>(effects, [&](const Effect<Dim>& effect)
                                { return effect.supportSteps(structure, placements, from, to); });
}

template<int Dim>
std::vector<BlockVector<Dim>> supportVelocities(const Effects<Dim>& effects, const Structure<Dim>& structure,
                                                const std::vector<Placement<Dim>>& placements, double from,
                                                double to)
{
    auto velocities =
        firstThatHasAny<Dim>(effects, [&](const Effect<Dim>& effect)
                             { return effect.supportVelocities(structure, placements, from, to); });
    velocities.resize(structure.assembly.blocks.size(),
                      BlockVector<Dim>::Zero()); // at rest where there are none
    return velocities;
}

template EffectTraits traitsOf(const Effects<2>& effects);
template std::vector<SupportStep<2>> supportSteps(const Effects<2>& effects, const Structure<2>& structure,
                                                  const std::vector<Placement<2>>& placements, double from,
                                                  double to);
template std::vector<BlockVector<2>> supportVelocities(const Effects<2>& effects,
                                                       const Structure<2>& structure,
                                                       const std::vector<Placement<2>>& placements,
                                                       double from, double to);
template EffectTraits traitsOf(const Effects<3>& effects);
template std::vector<SupportStep<3>> supportSteps(const Effects<3>& effects, const Structure<3>& structure,
                                                  const std::vector<Placement<3>>& placements, double from,
                                                  double to);
template std::vector<BlockVector<3>> supportVelocities(const Effects<3>& effects,
                                                       const Structure<3>& structure,
                                                       const std::vector<Placement<3>>& placements,
                                                       double from, double to);

} // namespace drystone
