// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `courses` from its settings.
#include "texture/Courses.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace drystone
{

void declare(Options& options, Courses& courses)
{
    options.required("unit", courses.unit, "unit of the lengths in rows, height of a course")
        .unit("m")
        .above(0)
        .example("(0.4 0.175)");
    options.optional("thickness", courses.thickness, "out of plane").unit("m").above(0);
    options.required("rows", courses.rows, "lengths in units, bottom course first; negative: a void")
        .example("((0.5 1 1 0.5) (1 -1 1))");
    options.check("rows",
                  [&courses]() -> std::string
                  {
                      for (std::size_t row = 0; row < courses.rows.size(); ++row)
                      {
                          for (const double length : courses.rows[row])
                          {
                              if (length == 0)
                              {
                                  return fmt::format("A block of row {} has the length 0.", row);
                              }
                          }
                      }
                      return {};
                  });
}

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
