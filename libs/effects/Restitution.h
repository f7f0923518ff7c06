// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// restitution { normal e; }: rebound after an impact. The law itself is that of dynamics/Impact.h.
#pragma once

#include "effects/EffectType.h"

namespace drystone
{

/// Rebound after an impact (Newton): the points of a contact part with `normal` times the velocity at which
/// they met.
struct Restitution
{
    double normal = 0; ///< coefficient, 0 to 1
};

void declare(Options& options, Restitution& restitution);

/// Its entry of the list.
template<int Dim>
EffectType<Dim> restitutionType();

} // namespace drystone
