// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What ParaView shows, the boundary between the model and file formats: the blocks where they are, and the
/// forces at their contact points.
#pragma once

#include "contact/ContactState.h"
#include "io/VtkFile.h"

#include <vector>

namespace drystone
{

/// The blocks in the order of Assembly::blocks, in the plane one polygon each, in space one for each face,
/// with the cell data `blockId`, `support` (index, -1 for a free block), `displacement[m]` of the mass
/// centre and `rotation[rad]` (in space the rotation vector), followed by `fields`, each with one value per
/// block. The points have `pointDisplacement[m]` from where they were built, by which viewers magnify the
/// motion: points moved by a further k times this show it (k + 1)-fold. A concave polygon without a corner
/// from which all of it is visible is written as several triangles, since viewers would fill it incorrectly
/// otherwise. The ground is shown only under the structure and a little to its sides.
///
/// \param placements one per block, or none at all for the structure as built
template<int Dim>
PolyData<Dim> blockFrame(const Assembly<Dim>& assembly, const std::vector<Placement<Dim>>& placements = {},
                         std::vector<Field> fields = {});

/// One point per contact, at its position, with the point data `contactForce[N]` (on `block`, global frame),
/// `state` (0 open, 1 sticking, 2 sliding), `normalForce[N]`, `tangentialForce[N]` (in space its size),
/// `gap[m]`, `block`, `neighbour`, followed by `fields`.
///
/// \param forces (normal, tangent) of each point, in space (normal, tangent1, tangent2) [N]
template<int Dim>
PolyData<Dim> contactFrame(const std::vector<ContactPoint<Dim>>& points,
                           const std::vector<Vector<Dim>>& forces, const std::vector<ContactState>& states,
                           std::vector<Field> fields = {});

} // namespace drystone
