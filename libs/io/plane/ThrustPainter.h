// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The line of thrust in a picture of the plane, with the reactions of fixed blocks and what its widths mean.
#pragma once

#include "assembly/Assembly.h"
#include "io/Canvas.h"
#include "io/JointForces.h"
#include "io/plane/PlaneView.h"

#include <vector>

namespace drystone
{

/// Paints the line of thrust (plane/ThrustLine.h), wider where the force is larger, and the forces of fixed
/// blocks on free ones as arrows. Of the lines of a large wall the strongest are painted.
/// \param thrust at least one joint \param blockSize mean size of the blocks [m]
/// \return the largest force [N]
double paintThrust(Canvas& drawing, const Assembly<2>& assembly, const std::vector<JointForce<2>>& thrust,
                   const PlaneView& view, double blockSize);

/// A scale of forces: the widths of the largest one and of a tenth of it. \param largestForce as paintThrust
/// returns it [N] \param corner upper left [px]
void paintThrustLegend(Canvas& drawing, double largestForce, const Vector<2>& corner);

} // namespace drystone
