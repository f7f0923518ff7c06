// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Columns of the equilibrium matrix.
#include "contact/Equilibrium.h"

namespace drystone
{

template<>
std::vector<ContactColumns<2>> equilibriumColumns(const Assembly<2>& assembly,
                                                  const std::vector<BlockMass<2>>& masses,
                                                  const std::vector<ContactPoint<2>>& points)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    std::vector<ContactColumns<2>> columns;
    columns.reserve(points.size());
    for (const ContactPoint<2>& point : points)
    {
        ContactColumns<2> entry;
        entry.block = freeIndex[point.block];
        entry.neighbour = freeIndex[point.neighbour];
        const Vector<2> armOnBlock = point.position - masses[point.block].centroid;
        const Vector<2> armOnNeighbour = point.position - masses[point.neighbour].centroid;
        const Vector<2> directions[] = {point.normal, tangent(point)};
        for (int j = 0; j < 2; ++j)
        {
            const Vector<2>& force = directions[j];
            entry.onBlock.col(j) << -force, -cross(armOnBlock, force);
            entry.onNeighbour.col(j) << force, cross(armOnNeighbour, force);
        }
        columns.push_back(entry);
    }
    return columns;
}

} // namespace drystone
