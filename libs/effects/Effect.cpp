// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What several effects are together.
#include "effects/Effect.h"

namespace drystone
{

template<int Dim>
EffectTraits traitsOf(const Effects<Dim>& effects)
{
    EffectTraits all;
    for (const auto& effect : effects)
    {
        const EffectTraits own = effect->traits();
        all.isCompliant = all.isCompliant || own.isCompliant;
        all.holdsJoints = all.holdsJoints || own.holdsJoints;
        all.actsOnBlocks = all.actsOnBlocks || own.actsOnBlocks;
    }
    return all;
}

template EffectTraits traitsOf(const Effects<2>& effects);
template EffectTraits traitsOf(const Effects<3>& effects);

} // namespace drystone
