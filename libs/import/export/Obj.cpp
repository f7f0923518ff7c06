// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Wavefront OBJ, whose vertices are numbered through the whole file.
#include "import/export/Number.h"

#include <iterator>

namespace drystone
{

std::string objText(const std::vector<ExportedSolid>& solids, const WrittenNumbers& numbers)
{
    std::string text = "# blocks of Drystone, in metres, z upwards\n";
    const auto out = std::back_inserter(text);
    std::size_t first = 1;
    for (std::size_t i = 0; i < solids.size(); ++i)
    {
        fmt::format_to(out, "o block_{}\nusemtl {}\n", i, solids[i].layer);
        for (const Vector<3>& vertex : solids[i].shape.vertices)
        {
            fmt::format_to(out, "v {} {} {}\n", writtenInFull(vertex.x(), numbers),
                           writtenInFull(vertex.y(), numbers), writtenInFull(vertex.z(), numbers));
        }
        for (const std::vector<int>& face : solids[i].shape.faces)
        {
            text += "f";
            for (const int vertex : face)
            {
                fmt::format_to(out, " {}", first + static_cast<std::size_t>(vertex));
            }
            text += "\n";
        }
        first += solids[i].shape.vertices.size();
    }
    return text;
}

} // namespace drystone
