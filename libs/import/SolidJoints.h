// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Joints of blocks from the interfaces of a file of solids.
#pragma once

#include "import/SolidBlocks.h"

#include <vector>

namespace drystone
{

/// A place of the file in metres, z upwards. \param ofFile in units of the file
Vector<3> inMetres(const Vector<3>& ofFile, const SolidSettings& settings);

/// Joints are the interfaces of the file, where it has any and the settings do not say otherwise: the normal
/// of each is that of its outline, turned into the block with the lower index. What is done is said on the
/// log. \param assembly its blocks are complete; its statedJoints on return \param solidOf index in
/// Solids::solids of each block, in ascending order \throws FatalIOError where contacts are requested of a
/// file without interfaces; where an interface has no area, or lies along no face of its blocks
void chooseJoints(Assembly<3>& assembly, const Solids& solids, const std::vector<int>& solidOf,
                  const SolidSettings& settings, const ImportedFile& file);

} // namespace drystone
