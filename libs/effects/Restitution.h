// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// restitution { normal e; }: rebound after an impact. The law itself is that of dynamics/Impact.h.
#pragma once

#include "effects/EffectList.h"

namespace drystone
{

void declare(Options& options, Restitution& restitution);

/// Its entry of the list.
template<int Dim>
EffectType<Dim> restitutionType();

} // namespace drystone
