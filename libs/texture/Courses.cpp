// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Generator of courses.
#include "texture/Courses.h"

#include <cmath>

namespace drystone
{

Assembly<2> makeAssembly(const Courses& courses)
{
    Assembly<2> assembly;
    for (std::size_t course = 0; course < courses.rows.size(); ++course)
    {
        const double bottom = static_cast<double>(course) * courses.unit.y();
        const double top = static_cast<double>(course + 1) * courses.unit.y();
        double from = 0;
        for (const double length : courses.rows[course])
        {
            const double to = from + std::abs(length);
            if (length > 0)
            {
                const double left = from * courses.unit.x();
                const double right = to * courses.unit.x();
                assembly.blocks.push_back(
                    {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, courses.thickness});
            }
            from = to;
        }
    }
    return assembly;
}

} // namespace drystone
