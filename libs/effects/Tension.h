// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// tension { strength s; }: normal stress that holds joints together until they break (JointBonds.h).
#pragma once

#include "effects/EffectType.h"

namespace drystone
{

/// Its entry of the list.
template<int Dim>
EffectType<Dim> tensionType();

} // namespace drystone
