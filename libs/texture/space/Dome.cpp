// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `dome` from its settings.
#include "texture/space/Dome.h"

#include "texture/Limits.h"
#include "texture/space/Ring.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace drystone
{

void declare(Options& options, Drum& drum)
{
    options.required("height", drum.height, "of the drum").unit("m").above(0).example("0.5");
    options.optional("courses", drum.courses, "of the drum").atLeast(1).atMost(maximumBlocks);
    options
        .optional("thickness", drum.thickness,
                  "outwards from the inner side of the dome; absent: that of the dome")
        .unit("m")
        .above(0)
        .example("0.2");
}

void declare(Options& options, Dome& dome)
{
    options.required("radius", dome.radius, "of the middle surface").unit("m").above(0).example("1");
    options.required("thickness", dome.thickness, "in the radial direction")
        .unit("m")
        .above(0)
        .example("0.1");
    options.required("around", dome.around, "blocks of a ring").atLeast(3).atMost(100000).example("8");
    options.required("rows", dome.rows, "rings").atLeast(1).atMost(100000).example("8");
    options
        .optional("cap", dome.cap,
                  "polar angle of the edge of the closing stone, in degrees; this or the oculus")
        .above(0)
        .below(90)
        .example("10");
    options.optional("oculus", dome.oculus, "polar angle of the edge of an opening at the top, in degrees")
        .above(0)
        .below(90)
        .example("20");
    options.optional("drum", dome.drum, "a ring wall under the dome; absent: none");
    options.check("thickness",
                  [&dome]() -> std::string
                  {
                      return dome.thickness >= 2 * dome.radius ? fmt::format(
                                 "A dome of radius {:g} m cannot be {:g} m thick: the thickness must be "
                                 "below twice the radius.",
                                 dome.radius, dome.thickness)
                                                               : "";
                  });
    options.check("rows",
                  [&dome]
                  {
                      const int rings = dome.rows + (dome.drum ? dome.drum->courses : 0);
                      return countFault(double(rings) * dome.around,
                                        fmt::format("A dome of {} rings of {} blocks, those of its drum "
                                                    "included,",
                                                    rings, dome.around));
                  });
    options.check(
        "rows",
        [&dome]() -> std::string
        {
            if (dome.cap.has_value() == dome.oculus.has_value())
            {
                return "A dome has a closing stone or an opening at its top: give either cap or oculus.";
            }
            return {};
        });
}

Assembly<3> makeAssembly(const Dome& dome)
{
    const double inner = dome.radius - dome.thickness / 2;
    const double outer = dome.radius + dome.thickness / 2;
    const double top = dome.cap.value_or(dome.oculus.value_or(0));
    const double springing = dome.drum ? dome.drum->height : 0;
    Assembly<3> assembly;
    if (dome.drum)
    {
        Ring ring;
        ring.sides = dome.around;
        ring.innerRadius = inner;
        ring.outerRadius = inner + dome.drum->thickness.value_or(dome.thickness);
        for (int course = 0; course < dome.drum->courses; ++course)
        {
            ring.lower = springing * course / dome.drum->courses;
            ring.upper = springing * (course + 1) / dome.drum->courses;
            ring.joints =
                (dome.drum->courses - course) % 2 == 1 ? RingJoints::atMidSides : RingJoints::atCorners;
            addRing(assembly.blocks, ring);
        }
    }
    // Corner k of the n-gon on the sphere of a radius, at ring edge i from the springing up.
    const auto corner = [&](int k, int i, double radius) -> Vector<3>
    {
        const double height = (90 - top) * i / dome.rows * EIGEN_PI / 180; // angle above the springing
        const Vector<2> plan = ringPoint(dome.around, k, radius * std::cos(height));
        return {plan.x(), plan.y(), springing + radius * std::sin(height)};
    };
    for (int i = 0; i < dome.rows; ++i)
    {
        for (int k = 0; k < dome.around; ++k)
        {
            const auto face = [&](int row) -> std::vector<Vector<3>>
            {
                return {corner(k, row, inner), corner(k, row, outer), corner(k + 1, row, outer),
                        corner(k + 1, row, inner)};
            };
            assembly.blocks.push_back({makePrism(face(i), face(i + 1))});
        }
    }
    if (dome.cap)
    {
        std::vector<Vector<3>> below;
        std::vector<Vector<3>> above;
        for (int k = 0; k < dome.around; ++k)
        {
            below.push_back(corner(k, dome.rows, inner));
            above.push_back(corner(k, dome.rows, outer));
        }
        assembly.blocks.push_back({makePrism(below, above)});
    }
    return assembly;
}

} // namespace drystone
