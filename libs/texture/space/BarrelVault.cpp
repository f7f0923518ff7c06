// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `barrelVault` from its settings.
#include "texture/space/BarrelVault.h"

#include "texture/Limits.h"
#include "texture/space/Extrusion.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

void declare(Options& options, BarrelVault& vault)
{
    declareSection(options, vault.arch);
    options.required("length", vault.length, "along the axis, which is y").unit("m").above(0).example("2");
    options.optional("slices", vault.slices, "voussoirs along the axis in each row")
        .atLeast(1)
        .atMost(maximumBlocks);
    options.optional("staggered", vault.staggered,
                     "whether the joints of every second row lie in the middle of those of its neighbours");
    options.check("slices",
                  [&vault]
                  {
                      return countFault(double(vault.arch.voussoirs) * vault.slices,
                                        fmt::format("A vault of {} voussoirs by {} slices",
                                                    vault.arch.voussoirs, vault.slices));
                  });
}

Assembly<3> makeAssembly(const BarrelVault& vault)
{
    const Assembly<2> section = makeAssembly(vault.arch);
    Assembly<3> assembly;
    assembly.supports = section.supports;
    for (std::size_t row = 0; row < section.blocks.size(); ++row)
    {
        const Block<2>& block = section.blocks[row];
        if (block.support >= 0)
        {
            assembly.blocks.push_back({extruded(block.outline, 0, vault.length), block.support});
            continue;
        }
        // Joints in half slices, so that those of all rows have the same digits.
        const int end = 2 * vault.slices;
        const auto place = [&](int halfSlices) { return vault.length * halfSlices / end; };
        const int first = vault.staggered && row % 2 == 1 ? 1 : 2;
        for (int from = 0, to = first; from < end; from = to, to = std::min(end, to + 2))
        {
            assembly.blocks.push_back({extruded(block.outline, place(from), place(to))});
        }
    }
    return assembly;
}

} // namespace drystone
