// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Load vectors.
#include "assembly/Loads.h"

#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"

#include <algorithm>

namespace drystone
{

Eigen::VectorXd gravityLoad(const Assembly<2>& assembly, const std::vector<double>& masses,
                            const Vector<2>& gravity)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    std::vector<double> rows;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (freeIndex[i] >= 0)
        {
            rows.insert(rows.end(), {masses[i] * gravity.x(), masses[i] * gravity.y(), 0});
        }
    }
    return Eigen::VectorXd::Map(rows.data(), static_cast<Eigen::Index>(rows.size()));
}

Eigen::VectorXd inertialLoad(const Assembly<2>& assembly, const std::vector<double>& masses,
                             const Vector<2>& gravity, const Vector<2>& direction)
{
    return gravityLoad(assembly, masses, gravity.norm() * direction.normalized());
}

std::optional<int> findLoadedBlock(const Assembly<2>& assembly, const Vector<2>& point, double tolerance)
{
    std::optional<int> nearest;
    double least = tolerance;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<2>& block = assembly.blocks[i];
        if (block.support >= 0 || !contains(enlarged(boundingBox(block.outline), tolerance), {point, point}))
        {
            continue;
        }
        // Inside counts as no distance at all, so that among blocks which hold the point the first is taken.
        const double away = std::max(0.0, signedDistance(block.outline, point));
        if (away < least || (away <= least && !nearest))
        {
            least = away;
            nearest = static_cast<int>(i);
        }
    }
    return nearest;
}

Eigen::VectorXd pointLoad(const Assembly<2>& assembly, int block, const Vector<2>& point,
                          const Vector<2>& force)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    const auto freeBlocks =
        std::count_if(freeIndex.begin(), freeIndex.end(), [](int index) { return index >= 0; });
    Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * freeBlocks);
    const Vector<2> arm = point - blockMass(assembly.blocks[block]).centroid;
    load.segment<3>(3 * freeIndex[block]) << force, cross(arm, force);
    return load;
}

} // namespace drystone
