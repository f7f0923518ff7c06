// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What Drystone shows in ParaView: the blocks where they are, and the forces at their contact points.
#pragma once

#include "assembly/ContactState.h"
#include "io/VtkFile.h"

#include <filesystem>
#include <vector>

namespace drystone
{

/// One polygon a block, in the order of Assembly::blocks, with the cell data `blockId`, `support` (index, -1
/// for a free block), `displacement` [m] of the mass centre and `rotation` [rad], followed by `fields`, of
/// which each has one value a block. A concave block that has no corner from which all of it is seen is
/// written as several triangles, each with the values of the block: viewers would fill it wrongly otherwise.
/// Of the ground only what is under the structure and a little beside it is shown.
///
/// \param placements one a block, or none at all for the structure as built
PolyData blockFrame(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements = {},
                    std::vector<Field> fields = {});

/// One point a contact, at its position, with the point data `contactForce` (on `block`, global frame) [N],
/// `state` (0 open, 1 sticking, 2 sliding), `normalForce`, `tangentialForce` [N], `gap` [m], `block`,
/// `neighbour`, followed by `fields`.
///
/// \param forces (normal, tangent) of each point [N]
PolyData contactFrame(const std::vector<ContactPoint<2>>& points, const std::vector<Vector<2>>& forces,
                      const std::vector<ContactState>& states, std::vector<Field> fields = {});

/// The structure as built, as `VTK/assembly.vtp`.
void writeAssembly(const std::filesystem::path& file, const Assembly<2>& assembly);

} // namespace drystone
