// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// cohesion { strength c; }: shear that joints carry in addition to friction, until they break
/// (JointBonds.h).
#pragma once

#include "effects/EffectType.h"

namespace drystone
{

/// Of a joint [Pa].
double cohesionOf(const JointOfCase& joint);

/// Its entry of the list.
template<int Dim>
EffectType<Dim> cohesionType();

} // namespace drystone
