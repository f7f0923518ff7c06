// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `boxes` from its settings.
#include "texture/space/Boxes.h"

#include <fmt/format.h>

#include <string>

namespace drystone
{

void declare(Options& options, Boxes& boxes)
{
    options.required("blocks", boxes.blocks, "lower and upper corner of each box [m]")
        .example("(((0 0 0) (0.4 0.2 0.175)) ((0 0 0.175) (0.4 0.2 0.35)))");
    options.check("blocks", [&boxes] { return boxFault(boxes.blocks); });
}

std::string boxFault(const std::vector<std::pair<Vector<3>, Vector<3>>>& boxes)
{
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
        const auto& [lower, upper] = boxes[i];
        if (!(lower.array() < upper.array()).all())
        {
            return fmt::format(
                "Box {} has no volume: give its lower corner, then its upper one, larger in x, y and z.", i);
        }
    }
    return {};
}

Assembly<3> makeAssembly(const Boxes& boxes)
{
    Assembly<3> assembly;
    assembly.blocks.reserve(boxes.blocks.size());
    for (const auto& [lower, upper] : boxes.blocks)
    {
        assembly.blocks.push_back({makeBox(lower, upper)});
    }
    return assembly;
}

} // namespace drystone
