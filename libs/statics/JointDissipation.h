// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What joints with strengths dissipate over their whole faces, not at their contact points alone.
#pragma once

#include "contact/space/PatchCells.h"
#include "statics/JointPoints.h"
#include "statics/StaticProgram.h"

#include <vector>

namespace drystone
{

/// By how much less the joints dissipate over their faces than at their points, with the live load doing unit
/// work: the multiplier of limit analysis minus this is still an upper bound of that of the joints, and never
/// above the first.
///
/// Forces at points carry at least what the stress over their cells does (vertexAreas), so that the
/// multiplier of points is an upper bound. A mechanism gives another one, its dissipation over the work of
/// the live load (Koiter's kinematic theorem). With closing rates c = A' y, linear over a joint since blocks
/// are rigid, a stress n in [-T, N], |t| <= C + mu n dissipates per area at most
///
///     d(c) = C |c_t| + N max(0, w) + T max(0, -w),   w = c_n + mu |c_t|,
///
/// which is convex in c: its integral over a cell is never above the sum over the vertices times their areas.
/// The two differ where d bends within a cell: where a joint is twisted, and at the ends of zones that crush.
/// It is integrated over triangles that are divided until this changes no more, each time from above.
///
/// Of a settlement c = A'y - g for its unit movement: then the base reaction of the points plus this is a
/// lower bound of that of the joints. \param patches with the points of the program, joint after joint, and
/// `strength` of each \param liveLoad that does work on the mechanism; of no meaning for a program with gaps
/// \param mechanism (ux uy uz rx ry rz) of each free block, of any size \return one value >= 0 for each cell
/// of each patch; their sum is what the joints dissipate less
std::vector<std::vector<double>> dissipatedLessByCell(const SpaceConeProgram& program,
                                                      const std::vector<PatchCells>& patches,
                                                      const Eigen::VectorXd& liveLoad,
                                                      const Eigen::VectorXd& mechanism);

/// The same seen from the forces: by how much less work they do where stress can carry them. No mechanism
/// shows that where a joint opens at its points, as where it is twisted and slides on its corners: all its
/// force is at the corners then, each of which stands for a quarter of the face. Of a part of area a round a
/// vertex, with the stress bounded by N, a force c needs c_n / N at least, and as near to the vertex as may
/// be, that is the part shrunk towards the vertex by sqrt(c_n / (N a)), with the centre q on the way to the
/// part's own. The work done there is c . A'y at q, linear over a joint. What it is less is no bound, but
/// falls with the square of the size of cells as the error of the multiplier does. \param contactForce of the
/// answer (n, t1, t2) \return one value >= 0 for each cell; all 0 without crushing
std::vector<std::vector<double>> carriedLessByCell(const SpaceConeProgram& program,
                                                   const std::vector<PatchCells>& patches,
                                                   const Eigen::VectorXd& liveLoad,
                                                   const Eigen::VectorXd& mechanism,
                                                   const Eigen::VectorXd& contactForce);

/// Of all cells.
double sumOf(const std::vector<std::vector<double>>& less);

/// Divides the cells at which most is dissipated in excess, those that have four fifths of it together: a
/// cell's excess falls with the square of its size, so that each time about two fifths are left (the marking
/// of adaptive finite elements, Doerfler 1996). \param less of one mechanism, see dissipatedLessByCell and
/// carriedLessByCell
void refineJoints(JointPoints<3>& joints, const std::vector<std::vector<double>>& less);

} // namespace drystone
