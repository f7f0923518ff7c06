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
};

template<int Dim>
void declare(Options& options, MovingLoadSettings<Dim>& settings);

/// One place of the load.
template<int Dim>
struct LoadPosition
{
    double distance = 0;                     ///< along the path from its beginning [m]
    Vector<Dim> place = Vector<Dim>::Zero(); ///< on the path [m]
    std::vector<int> blocks;                 ///< that carry an axle, one each
    Eigen::VectorXd live;                    ///< rows as LoadVectors
};

/// The live load of each position. An axle goes along its force from the path to the first block that is in
/// its way; on a fixed block, or on none, it loads nothing. Where it meets a joint it may act on either of
/// the blocks: such a position comes twice, with all axles at joints on the block of the lowest index, then
/// on that of the highest. Positions that load nothing are left out.
template<int Dim>
std::vector<LoadPosition<Dim>> movingLoad(const Assembly<Dim>& assembly,
                                          const MovingLoadSettings<Dim>& settings);

} // namespace drystone
