// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A load that moves over the structure, as a vehicle over a bridge: one live load for each of its places.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <optional>
#include <utility>
#include <vector>

namespace drystone
{

/// `type moving;` of the live load.
template<int Dim>
struct MovingLoadSettings
{
    Vector<Dim> from = Vector<Dim>::Zero();       ///< of the path, above the blocks or on them [m]
    Vector<Dim> to = Vector<Dim>::Zero();         ///< its end [m]
    int positions = 41;                           ///< at equal distances, both ends included
    Vector<Dim> value = Vector<Dim>::Zero();      ///< of an axle [N]
    std::vector<std::pair<double, double>> axles; ///< offset from the position, along the path [m], and
                                                  ///< factor on `value`; empty: one at the position
    double loadedLength = 0;                      ///< of an axle on the path, along it [m]
    double loadedWidth = 0;                       ///< in space across it [m]
    double spread = 0; ///< by how much the load widens on each side per depth below the path [-]
};

template<int Dim>
void declare(Options& options, MovingLoadSettings<Dim>& settings);

/// An axle on the structure.
template<int Dim>
struct AxlePlace
{
    Vector<Dim> place = Vector<Dim>::Zero(); ///< where its middle meets a block [m]
    int block = -1;
    double factor = 1; ///< on `value`
};

/// One place of the load.
template<int Dim>
struct LoadPosition
{
    double distance = 0;                     ///< along the path from its beginning [m]
    Vector<Dim> place = Vector<Dim>::Zero(); ///< on the path [m]
    std::vector<int> blocks;           ///< that carry an axle, one each; all that carry one that spreads
    std::vector<AxlePlace<Dim>> axles; ///< those that meet a free block
    Eigen::VectorXd live;              ///< rows as LoadVectors
    double beside = 0;                 ///< share of the axles' force that meets no free block
};

/// The live load of each position. An axle goes along its force from the path to the first block that is in
/// its way; on a fixed block, or on none, it loads nothing. Where it meets a joint it may act on any of the
/// blocks there: such a position comes once for each, and for each choice of all axles that are at joints;
/// were these more than 64, all axles take the block of the lowest index, then of the next. Positions that
/// load nothing are left out.
///
/// With `spread` or `loadedLength` the force of an axle is uniform, at a depth t below the path, over
/// loadedLength + 2 spread t along the path, and in space over loadedWidth + 2 spread t across it, all of it
/// in the direction of `value`: the dispersal of codes through fill (1:2 is `spread 0.5`). Each part of it
/// goes along its own ray through the fill to the first block in its way; what meets a fixed block or none
/// loads nothing. It is cut where the block changes that rays meet, in the plane by halving, in space in
/// strips along the path that are finer where the blocks of two differ or their borders bend: the share of a
/// block is exact but for what it may be next to a joint, unless a block is narrower than a hundredth, in
/// space a 24th, of the loaded length.
template<int Dim>
std::vector<LoadPosition<Dim>> movingLoad(const Assembly<Dim>& assembly,
                                          const MovingLoadSettings<Dim>& settings);

/// The places that were left out, by their distances along the path, ascending [m]. \param positions what
/// movingLoad returned
template<int Dim>
std::vector<double> placesWithoutLoad(const std::vector<LoadPosition<Dim>>& positions,
                                      const MovingLoadSettings<Dim>& settings);

} // namespace drystone
