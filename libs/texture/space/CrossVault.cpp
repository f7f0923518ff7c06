// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `crossVault` from its settings.
#include "texture/space/CrossVault.h"

#include "texture/Limits.h"
#include "texture/space/Ring.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace drystone
{

void declare(Options& options, CrossVault& vault)
{
    options.required("radius", vault.radius, "of the middle surface of both barrels")
        .unit("m")
        .above(0)
        .example("1");
    options.required("thickness", vault.thickness, "in the radial direction")
        .unit("m")
        .above(0)
        .example("0.2");
    options.required("voussoirs", vault.voussoirs, "of equal angle across each web; an even number")
        .atLeast(2)
        .atMost(maximumBlocks / 4)
        .example("8");
    options.required("reach", vault.reach, "from the centre to the free edge of each web")
        .unit("m")
        .above(0)
        .example("1.4");
    options.check("voussoirs",
                  [&vault]() -> std::string
                  {
                      return vault.voussoirs % 2 == 0 ? ""
                                                      : "The number of voussoirs is even: one at the crown "
                                                        "would not be plane at the groins.";
                  });
    options.check("thickness",
                  [&vault]() -> std::string
                  {
                      return vault.thickness < 2 * vault.radius
                                 ? ""
                                 : "The thickness must be below twice the radius: nothing is left inside.";
                  });
    options.check(
        "reach",
        [&vault]() -> std::string
        {
            const double outer = vault.radius + vault.thickness / 2;
            return vault.reach > outer
                       ? ""
                       : fmt::format(
                           "The webs end at {:g} m, before the extrados springs at {:g} m: let them "
                           "reach farther.",
                           vault.reach, outer);
        });
}

Assembly<3> makeAssembly(const CrossVault& vault)
{
    const double inner = vault.radius - vault.thickness / 2;
    const double outer = vault.radius + vault.thickness / 2;
    // A corner of the +y web's section at joint k, x-z: parts of 2 n sides of the circle.
    const auto section = [&](int k, double radius) { return ringPoint(2 * vault.voussoirs, k, radius); };
    Assembly<3> assembly;
    for (int web = 0; web < 4; ++web)
    {
        // The webs are the first one turned by quarters of the circle about z.
        const auto turned = [web](const Vector<3>& point) -> Vector<3>
        {
            Vector<2> plan = point.head<2>();
            for (int quarter = 0; quarter < web; ++quarter)
            {
                plan = perpendicular(plan);
            }
            return {plan.x(), plan.y(), point.z()};
        };
        for (int k = 0; k < vault.voussoirs; ++k)
        {
            std::vector<Vector<3>> atEdge;
            std::vector<Vector<3>> atGroin;
            for (const Vector<2>& corner :
                 {section(k, inner), section(k, outer), section(k + 1, outer), section(k + 1, inner)})
            {
                atEdge.push_back(turned({corner.x(), vault.reach, corner.y()}));
                atGroin.push_back(turned({corner.x(), std::abs(corner.x()), corner.y()}));
            }
            assembly.blocks.push_back({makePrism(atEdge, atGroin)});
        }
    }
    return assembly;
}

} // namespace drystone
