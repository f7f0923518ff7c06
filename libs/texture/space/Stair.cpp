// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `stair` from its settings.
#include "texture/space/Stair.h"

#include <string>

namespace drystone
{

void declare(Options& options, Stair& stair)
{
    options.required("steps", stair.steps, "their number").atLeast(1).atMost(1000000).example("8");
    options.optional("going", stair.going, "from the front of a step to that of the next").unit("m").above(0);
    options.optional("rise", stair.rise, "height of a step").unit("m").above(0);
    options.optional("width", stair.width, "from the wall to the free end of a step").unit("m").above(0);
    options.optional("overlap", stair.overlap, "by which a step lies on the one below").unit("m").atLeast(0);
    options.optional("bearing", stair.bearing, "by which a step is built into the wall").unit("m").above(0);
    options.check("overlap",
                  [&stair]() -> std::string
                  {
                      return stair.overlap < stair.going
                                 ? ""
                                 : "The overlap must be below the going: a step would lie on two others.";
                  });
}

Assembly<3> makeAssembly(const Stair& stair)
{
    Assembly<3> assembly;
    const auto front = [&](int step) { return step * stair.going; };
    const auto level = [&](int step) { return step * stair.rise; };
    for (int i = 0; i < stair.steps; ++i)
    {
        assembly.blocks.push_back({makeBox({front(i), -stair.bearing, level(i)},
                                           {front(i + 1) + stair.overlap, stair.width, level(i + 1)})});
    }
    // Each course of the wall is as high as a step, with a stone in front of the step's end and one behind
    // it.
    const double begin = front(0) - stair.going;
    const double end = front(stair.steps + 1) + stair.overlap;
    assembly.supports = {{"wall", "blocks"}};
    for (int i = 0; i < stair.steps; ++i)
    {
        assembly.blocks.push_back(
            {makeBox({begin, -stair.bearing, level(i)}, {front(i), 0, level(i + 1)}), 0});
        assembly.blocks.push_back(
            {makeBox({front(i + 1) + stair.overlap, -stair.bearing, level(i)}, {end, 0, level(i + 1)}), 0});
    }
    assembly.blocks.push_back({makeBox({begin, -stair.bearing, -stair.rise}, {end, 0, 0}), 0});
    assembly.blocks.push_back(
        {makeBox({begin, -stair.bearing, level(stair.steps)}, {end, 0, level(stair.steps + 1)}), 0});
    return assembly;
}

} // namespace drystone
