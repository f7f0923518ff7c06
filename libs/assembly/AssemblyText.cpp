// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writing the assembly file.
#include "assembly/AssemblyFile.h"

#include "assembly/AssemblyOrigin.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace drystone
{

std::filesystem::path assemblyFile(const std::filesystem::path& caseDirectory)
{
    return (caseDirectory / "constant" / "assembly" / "blocks").lexically_normal();
}

std::string assemblyText(const Assembly<2>& assembly, const std::vector<InputFile>& builtFrom)
{
    std::string text =
        "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       dictionary;\n"
        "    location    \"constant/assembly\";\n    object      blocks;\n}\n\ndimensions      2;\n\n"
        + originText(builtFrom);
    const auto out = std::back_inserter(text);
    const std::vector<Block<2>>& blocks = assembly.blocks;

    const bool isUniform =
        std::all_of(blocks.begin(), blocks.end(),
                    [&](const Block<2>& block) { return block.thickness == blocks.front().thickness; });
    if (isUniform)
    {
        fmt::format_to(out, "thickness       {};\n\n", blocks.empty() ? 1.0 : blocks.front().thickness);
    }
    else
    {
        fmt::format_to(out, "thickness       {}\n(\n", blocks.size());
        for (const Block<2>& block : blocks)
        {
            fmt::format_to(out, "    {}\n", block.thickness);
        }
        text += ");\n\n";
    }

    if (assembly.jointTolerance)
    {
        fmt::format_to(out, "jointTolerance  {};\n\n", *assembly.jointTolerance);
    }
    text += "supports\n{\n";
    for (std::size_t i = 0; i < assembly.supports.size(); ++i)
    {
        fmt::format_to(out, "    {}\n    {{\n        type    {};\n        blocks  (",
                       assembly.supports[i].name, assembly.supports[i].type);
        const char* separator = "";
        for (std::size_t block = 0; block < blocks.size(); ++block)
        {
            if (blocks[block].support == static_cast<int>(i))
            {
                fmt::format_to(out, "{}{}", separator, block);
                separator = " ";
            }
        }
        text += ");\n    }\n";
    }
    text += "}\n\n";

    fmt::format_to(out, "outlines        {}\n(\n", blocks.size());
    for (const Block<2>& block : blocks)
    {
        const char* separator = "    (";
        for (const Vector<2>& vertex : block.outline)
        {
            // Adding 0 turns -0 into 0.
            fmt::format_to(out, "{}({} {})", separator, vertex.x() + 0.0, vertex.y() + 0.0);
            separator = " ";
        }
        text += ")\n";
    }
    text += ");\n";
    return text;
}

} // namespace drystone
