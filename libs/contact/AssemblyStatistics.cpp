// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One pass over the blocks; joints are numbered by their points.
#include "contact/AssemblyStatistics.h"

#include "assembly/BlockShape.h"
#include "contact/ShapeChecks.h"

namespace drystone
{

template<int Dim>
AssemblyStatistics<Dim> countAssembly(const Assembly<Dim>& assembly,
                                      const std::vector<ContactPoint<Dim>>& points)
{
    AssemblyStatistics<Dim> statistics;
    Box<Dim> freeBox;
    for (const Block<Dim>& block : assembly.blocks)
    {
        statistics.vertices += static_cast<int>(cornersOf(block).size());
        statistics.concaveBlocks += isConvexBlock(block) ? 0 : 1;
        if (block.support < 0)
        {
            ++statistics.freeBlocks;
            extend<Dim>(freeBox, boundingBox(block));
        }
    }
    statistics.blocks = static_cast<int>(assembly.blocks.size());
    statistics.supports = static_cast<int>(assembly.supports.size());
    statistics.contactPoints = static_cast<int>(points.size());
    statistics.joints = points.empty() ? 0 : points.back().joint + 1;
    if (statistics.freeBlocks > 0)
    {
        statistics.lower = freeBox.lower;
        statistics.upper = freeBox.upper;
    }
    return statistics;
}

template<int Dim>
AssemblyStatistics<Dim> countAssembly(const Assembly<Dim>& assembly)
{
    return countAssembly(assembly, findContactPoints(assembly));
}

template AssemblyStatistics<2> countAssembly(const Assembly<2>& assembly);
template AssemblyStatistics<3> countAssembly(const Assembly<3>& assembly);
template AssemblyStatistics<2> countAssembly(const Assembly<2>& assembly,
                                             const std::vector<ContactPoint<2>>& points);
template AssemblyStatistics<3> countAssembly(const Assembly<3>& assembly,
                                             const std::vector<ContactPoint<3>>& points);

} // namespace drystone
