// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Columns of the equilibrium matrix.
#include "contact/Equilibrium.h"

namespace drystone
{

template<int Dim>
std::vector<ContactColumns<Dim>> equilibriumColumns(const Assembly<Dim>& assembly,
                                                    const std::vector<BlockMass<Dim>>& masses,
                                                    const std::vector<ContactPoint<Dim>>& points)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    std::vector<ContactColumns<Dim>> columns;
    columns.reserve(points.size());
    for (const ContactPoint<Dim>& point : points)
    {
        ContactColumns<Dim> entry;
        entry.block = freeIndex[point.block];
        entry.neighbour = freeIndex[point.neighbour];
        const Vector<Dim> armOnBlock = point.position - masses[point.block].centroid;
        const Vector<Dim> armOnNeighbour = point.position - masses[point.neighbour].centroid;
        const Eigen::Matrix<double, Dim, Dim> directions = contactFrame(point);
        for (int j = 0; j < Dim; ++j)
        {
            const Vector<Dim> force = directions.col(j);
            entry.onBlock.col(j) << -force, -momentOf(armOnBlock, force);
            entry.onNeighbour.col(j) << force, momentOf(armOnNeighbour, force);
        }
        columns.push_back(entry);
    }
    return columns;
}

template std::vector<ContactColumns<2>> equilibriumColumns(const Assembly<2>& assembly,
                                                           const std::vector<BlockMass<2>>& masses,
                                                           const std::vector<ContactPoint<2>>& points);
template std::vector<ContactColumns<3>> equilibriumColumns(const Assembly<3>& assembly,
                                                           const std::vector<BlockMass<3>>& masses,
                                                           const std::vector<ContactPoint<3>>& points);

} // namespace drystone
