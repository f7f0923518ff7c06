// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The legend of hinges and sliding joints.
#include "io/MarkLegend.h"

#include <algorithm>
#include <tuple>

namespace drystone
{

double paintMarkLegend(Canvas& drawing, const std::vector<JointMark>& marks, const Vector<2>& corner)
{
    double x = corner.x();
    for (const auto& [motion, colour, text] : {std::tuple(JointMotion::hinge, hingeColour, "hinge"),
                                               std::tuple(JointMotion::sliding, slidingColour, "sliding")})
    {
        const auto ofMotion = [motion = motion](const JointMark& mark) { return mark.motion == motion; };
        if (std::any_of(marks.begin(), marks.end(), ofMotion))
        {
            if (std::all_of(marks.begin(), marks.end(),
                            [&](const JointMark& mark)
                            { return !ofMotion(mark) || mark.points.size() == 1; }))
            {
                drawing.circle({x + 9, corner.y() + 6.5}, 3.5, {.fill = colour});
            }
            else
            {
                drawing.line({x, corner.y() + 6.5}, {x + 18, corner.y() + 6.5},
                             {.stroke = colour, .strokeWidth = 2.4});
            }
            drawing.text({x + 23, corner.y() + 11}, text, {.size = 12});
            x += 23 + textWidth(text, 12) + 20;
        }
    }
    return x;
}

} // namespace drystone
