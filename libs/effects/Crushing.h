// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// crushing { strength f; }: pressure that joints bear, of structures at rest; motion refuses it.
#pragma once

#include "effects/EffectType.h"

namespace drystone
{

/// Its entry of the list.
template<int Dim>
EffectType<Dim> crushingType();

} // namespace drystone
