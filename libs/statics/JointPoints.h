// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact points of joints with strengths, which limit analysis adds to where they count.
#pragma once

#include "conic/ConeProgram.h"
#include "contact/ContactPoint.h"
#include "contact/space/PatchCells.h"

#include <vector>

namespace drystone
{

/// Contact points of joints, and what each carries; points of one joint follow each other.
template<int Dim>
struct JointPoints;

template<>
struct JointPoints<2>
{
    std::vector<ContactPoint<2>> points; ///< from end to end
    std::vector<double> friction;
    std::vector<Strength> strength; ///< of its part of the joint, see pointAreas
};

template<>
struct JointPoints<3>
{
    std::vector<PatchCells> patches; ///< one a joint; the points are their vertices, see pointsOf
    std::vector<ContactPoint<3>> points;
    std::vector<double> friction;
    std::vector<Strength> strength; ///< of its part of the joint, see vertexAreas
};

/// Shares what each joint has out to the points of its patch, by their areas.
/// \param joints of which the points, frictions and strengths are those of the patches before some were
/// divided; those of a patch with as many vertices as before stay what they are \param pointsBefore how many
/// each patch had
void shareOut(JointPoints<3>& joints, const std::vector<std::size_t>& pointsBefore);

} // namespace drystone
