// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `tower` from its settings.
#include "texture/space/Tower.h"

#include "texture/Limits.h"
#include "texture/space/Ring.h"

#include <fmt/format.h>

#include <string>

namespace drystone
{

void declare(Options& options, Tower& tower)
{
    options.required("innerRadius", tower.innerRadius, "of the inner corners")
        .unit("m")
        .above(0)
        .example("0.8");
    options.required("outerRadius", tower.outerRadius, "of the outer corners")
        .unit("m")
        .above(0)
        .example("1");
    options.required("around", tower.around, "blocks of a course, sides of its polygon")
        .atLeast(3)
        .atMost(100000)
        .example("8");
    options.required("courses", tower.courses, "number of courses")
        .atLeast(1)
        .atMost(maximumBlocks)
        .example("6");
    options.required("courseHeight", tower.courseHeight, "of each").unit("m").above(0).example("0.25");
    options.optional(
        "bond", tower.bond,
        "turned: odd courses by half a side; toothed: joints at the corners and in the middle of sides in "
        "turn; stacked: joints at the corners");
    options.check(
        "outerRadius",
        [&tower]() -> std::string
        {
            return tower.outerRadius > tower.innerRadius
                       ? ""
                       : "The outer radius must be above the inner one: the wall lies between them.";
        });
    options.check("courses",
                  [&tower]
                  {
                      return countFault(
                          double(tower.courses) * tower.around,
                          fmt::format("A tower of {} courses of {} blocks", tower.courses, tower.around));
                  });
}

Assembly<3> makeAssembly(const Tower& tower)
{
    Assembly<3> assembly;
    Ring ring;
    ring.sides = tower.around;
    ring.innerRadius = tower.innerRadius;
    ring.outerRadius = tower.outerRadius;
    for (int course = 0; course < tower.courses; ++course)
    {
        ring.lower = course * tower.courseHeight;
        ring.upper = (course + 1) * tower.courseHeight;
        ring.turn = course % 2 == 1 && tower.bond == TowerBond::turned ? 0.5 : 0;
        ring.joints = course % 2 == 1 && tower.bond == TowerBond::toothed ? RingJoints::atMidSides
                                                                          : RingJoints::atCorners;
        addRing(assembly.blocks, ring);
    }
    return assembly;
}

} // namespace drystone
