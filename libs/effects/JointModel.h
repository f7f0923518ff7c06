// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// contact, pointsPerJoint, jointPoints and joints: what computations know of a joint, and what some joints
/// have instead of what all have. No effect by itself, but keys of the same dictionary.
#pragma once

#include "dictionary/Registry.h"
#include "effects/EffectList.h"

namespace drystone
{

void declare(Options& options, ContactModel& model);
void declare(Options& options, PointGrid& grid);
void declare(Options& options, JointProperties& properties);

/// The points that `jointPoints { type ...; }` chooses from; nothing: the corners alone.
const Registry<std::optional<PointGrid>>& jointPointTypes();

/// Its entry of the list. It refuses in motion what only limit analysis has.
template<int Dim>
EffectType<Dim> jointModelType();

} // namespace drystone
