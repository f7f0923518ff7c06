// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A structure and its motion as a picture (SVG) for papers and web pages, where ParaView is not at hand.
#pragma once

#include "contact/ContactPoint.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// The resultant contact force of one joint.
struct JointForce
{
    Vector<2> centre = Vector<2>::Zero(); ///< centre of pressure [m]
    Vector<2> force = Vector<2>::Zero();  ///< on the first block of the joint [N]
};

/// Resultant and centre of pressure of each joint that carries a load.
/// \param points points of one joint follow each other
/// \param forces (normal, tangent) of each point [N]
std::vector<JointForce> jointForces(const std::vector<ContactPoint<2>>& points,
                                    const std::vector<Vector<2>>& forces);

struct MechanismPicture
{
    std::string title = "";    ///< for instance "masonryPanels/wall1"
    std::string subtitle = ""; ///< for instance "alpha = 0.642859, 33 blocks, 174 contact points"
    double width = 640;        ///< [px]; the height follows from the structure, up to 1.4 times the width
    /// Drawn at the joints as built, as strokes whose length and width grow with the force; none when empty.
    std::vector<JointForce> thrust = {};
};

/// The displaced blocks, shaded by their displacement, over the dashed outline of the structure as built;
/// fixed blocks are hatched. Text of an SVG file.
///
/// \param placements one per block
std::string mechanismSvg(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                         const MechanismPicture& picture);

/// The same as a file, written whole or not at all.
void writeMechanismPicture(const std::filesystem::path& file, const Assembly<2>& assembly,
                           const std::vector<Placement<2>>& placements, const MechanismPicture& picture);

} // namespace drystone
