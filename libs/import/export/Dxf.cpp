// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// DXF in the form of AutoCAD R12, which all programs read.
#include "import/export/Number.h"

#include <iterator>
#include <set>

namespace drystone
{

namespace
{

std::string group(int code, std::string_view value)
{
    return fmt::format("{:3}\n{}\n", code, value);
}

std::string header(const std::set<std::string>& layers)
{
    std::string text = group(999, "blocks of Drystone, in metres") + group(0, "SECTION") + group(2, "HEADER")
                       + group(9, "$ACADVER") + group(1, "AC1009") + group(0, "ENDSEC") + group(0, "SECTION")
                       + group(2, "TABLES") + group(0, "TABLE") + group(2, "LAYER")
                       + group(70, fmt::format("{}", layers.size()));
    int colour = 1;
    for (const std::string& layer : layers)
    {
        constexpr int colours = 7;
        text += group(0, "LAYER") + group(2, layer) + group(70, "0") + group(62, fmt::format("{}", colour))
                + group(6, "CONTINUOUS");
        colour = colour % colours + 1;
    }
    return text + group(0, "ENDTAB") + group(0, "ENDSEC") + group(0, "SECTION") + group(2, "ENTITIES");
}

const std::string_view end = "  0\nENDSEC\n  0\nEOF\n";

} // namespace

std::string dxfText(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                    const WrittenNumbers& numbers)
{
    const std::vector<std::string> layers = layersOf(assembly);
    std::string text = header({layers.begin(), layers.end()});
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<2>& block = assembly.blocks[i];
        text += group(0, "POLYLINE") + group(8, layers[i]) + group(66, "1") + group(70, "1") + group(10, "0")
                + group(20, "0") + group(30, "0");
        for (const Vector<2>& corner :
             placements.empty() ? block.outline : placedOutline(block, placements[i]))
        {
            text += group(0, "VERTEX") + group(8, layers[i]) + group(10, written(corner.x(), numbers))
                    + group(20, written(corner.y(), numbers)) + group(30, "0");
        }
        text += group(0, "SEQEND") + group(8, layers[i]);
    }
    return text.append(end);
}

std::string dxfText(const std::vector<ExportedSolid>& solids, const WrittenNumbers& numbers)
{
    std::set<std::string> layers;
    for (const ExportedSolid& solid : solids)
    {
        layers.insert(solid.layer);
    }
    std::string text = header(layers);
    for (const ExportedSolid& solid : solids)
    {
        for (const std::vector<int>& face : solid.shape.faces)
        {
            for (const std::array<int, 3>& triangle : trianglesOf(solid.shape, face))
            {
                text += group(0, "3DFACE") + group(8, solid.layer);
                for (int k = 0; k < 4; ++k) // the fourth corner repeats the third
                {
                    const Vector<3>& place = solid.shape.vertices[static_cast<std::size_t>(
                        triangle[static_cast<std::size_t>(std::min(k, 2))])];
                    for (int axis = 0; axis < 3; ++axis)
                    {
                        text += group(10 * (axis + 1) + k, written(place[axis], numbers));
                    }
                }
            }
        }
    }
    return text.append(end);
}

} // namespace drystone
