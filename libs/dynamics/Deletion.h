// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// deletion { box (lower upper); }: blocks that leave a box stop there for good.
#pragma once

#include "dynamics/Motion.h"

namespace drystone
{

/// The blocks whose mass centre has left the box stop where they are, and are left out from now on: they
/// touch nothing and feel no load. Nothing happens in a case without `deletion`.
void deleteBlocks(const DynamicCase& scene, Motion& motion);

/// No load on blocks that are out.
void unloadDeleted(const DynamicCase& scene, const Motion& motion, Eigen::VectorXd& load);

} // namespace drystone
