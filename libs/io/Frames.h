// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What Drystone shows in ParaView: the blocks where they are, and the forces at their contact points.
#pragma once

#include "assembly/ContactPoint.h"
#include "io/VtkFile.h"

#include <filesystem>
#include <vector>

namespace drystone
{

/// The outline of a block where it is now: turned about its mass centre, then moved [m].
Polygon placedOutline(const Block<2>& block, const Placement<2>& placement);

/// One polygon a block, in the order of Assembly::blocks, with the cell data `blockId`, `support` (index, -1
/// for a free block), `displacement` [m] of the mass centre and `rotation` [rad], followed by `fields`, of
/// which each has one value a block. A concave block that has no corner from which all of it is seen is
/// written as several triangles, each with the values of the block: viewers would fill it wrongly otherwise.
/// Of the ground only what is under the structure and a little beside it is shown.
///
/// \param placements one a block, or none at all for the structure as built
PolyData blockFrame(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements = {},
                    std::vector<Field> fields = {});

/// What a contact point does.
enum class ContactState
{
    open = 0,     ///< carries nothing
    sticking = 1, ///< presses, and its shear stays below the strength
    sliding = 2,  ///< its shear has reached the strength
};

/// Forces of the points one by one, from n t n t ... as solvers have them.
std::vector<Vector<2>> pointForces(const Eigen::VectorXd& contactForce);

/// State of each point from its force (normal, tangent) [N]. A point is open when its normal force is below
/// `tolerance` times the largest, and slides when its shear comes within `tolerance` of mu n.
///
/// \param friction coefficient mu of each point
std::vector<ContactState> contactStates(const std::vector<Vector<2>>& forces,
                                        const std::vector<double>& friction, double tolerance = 1e-6);

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
