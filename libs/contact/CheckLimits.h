// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the checks of an assembly take for a fault. In this library, whose searches of joints and overlaps
/// take these limits.
#pragma once

namespace drystone
{

/// The limits of the checks. Sizes are relative to meanBlockSize.
struct CheckLimits
{
    double jointTolerance = 1e-6; ///< edges this near are a joint; deeper overlaps are faults
    double depth = 1e-4;    ///< of the smaller block's extent: tips that reach deeper into a neighbour are
                            ///< faults, however little both have in common
    double gap = 1e-2;      ///< edges nearer than this that are no joint are taken for a fault
    double gapAngle = 0.02; ///< of the edges of such a gap, from parallel [rad]
    double volumeRatio = 1e-10; ///< least volume of a block, relative to the mean
    double gyration = 1e4; ///< largest polar moment of area relative to the area squared (square: 1/6); in
                           ///< space trace of the inertia relative to the volume^(5/3) (cube: 1/2)
    double compactness = 1e-2; ///< least 4 pi area / perimeter^2, in space 36 pi volume^2 / surface^3
    double angle = 1e-2;       ///< least angle at a corner [rad]
    double edge = 1e-4; ///< least length of an edge, relative to the square root of the block's area, or the
                        ///< cube root of its volume
    double duplicate =
        1 - 1e-6; ///< blocks that overlap by more than this part of both are the same block twice
    double jointLength = 1e-3; ///< least length of a joint
};

} // namespace drystone
