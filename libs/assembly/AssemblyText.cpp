// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writing the assembly file.
#include "assembly/AssemblyFile.h"

#include "assembly/AssemblyOrigin.h"
#include "dictionary/Dictionary.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace drystone
{

std::filesystem::path assemblyFile(const std::filesystem::path& caseDirectory)
{
    return (caseDirectory / "constant" / "assembly" / "blocks").lexically_normal();
}

namespace
{

/// `thickness`, one number or a list.
void writeThickness(std::string& text, const std::vector<Block<2>>& blocks)
{
    const auto out = std::back_inserter(text);
    const bool isUniform =
        std::all_of(blocks.begin(), blocks.end(),
                    [&](const Block<2>& block) { return block.thickness == blocks.front().thickness; });
    if (isUniform)
    {
        fmt::format_to(out, "thickness       {};\n\n", blocks.empty() ? 1.0 : blocks.front().thickness);
        return;
    }
    fmt::format_to(out, "thickness       {}\n(\n", blocks.size());
    for (const Block<2>& block : blocks)
    {
        fmt::format_to(out, "    {}\n", block.thickness);
    }
    text += ");\n\n";
}

void writeThickness(std::string&, const std::vector<Block<3>>&) {}

/// `(0.4 0 0.2)`. Adding 0 turns -0 into 0.
template<int Dim>
void writeVector(std::string& text, const Vector<Dim>& vector)
{
    const char* separator = "(";
    for (int i = 0; i < Dim; ++i)
    {
        fmt::format_to(std::back_inserter(text), "{}{}", separator, vector[i] + 0.0);
        separator = " ";
    }
    text += ")";
}

template<int Dim>
void writeVectors(std::string& text, const std::vector<Vector<Dim>>& vectors)
{
    const char* separator = "(";
    for (const Vector<Dim>& vector : vectors)
    {
        text += separator;
        writeVector<Dim>(text, vector);
        separator = " ";
    }
    text += ")";
}

/// The key of the list of shapes.
std::string_view shapesKey(const Assembly<2>&)
{
    return "outlines";
}

std::string_view shapesKey(const Assembly<3>&)
{
    return "blocks";
}

void writeShape(std::string& text, const Block<2>& block)
{
    text += "    ";
    writeVectors<2>(text, block.outline);
    text += "\n";
}

void writeShape(std::string& text, const Block<3>& block)
{
    text += "    { vertices ";
    writeVectors<3>(text, block.shape.vertices);
    text += "; faces ";
    const char* separator = "(";
    for (const std::vector<int>& face : block.shape.faces)
    {
        fmt::format_to(std::back_inserter(text), "{}({})", separator, fmt::join(face, " "));
        separator = " ";
    }
    text += "); }\n";
}

void writeZones(std::string& text, const std::vector<Zone>& zones)
{
    if (zones.empty())
    {
        return;
    }
    text += "zones\n{\n";
    for (const Zone& zone : zones)
    {
        fmt::format_to(std::back_inserter(text), "    {} {{ blocks ({}); }}\n", zone.name,
                       fmt::join(zone.blocks, " "));
    }
    text += "}\n\n";
}

template<int Dim>
void writeStatedJoints(std::string& text, const std::vector<StatedJoint<Dim>>& joints)
{
    if (joints.empty())
    {
        return;
    }
    fmt::format_to(std::back_inserter(text), "joints          {}\n(\n", joints.size());
    for (const StatedJoint<Dim>& joint : joints)
    {
        fmt::format_to(std::back_inserter(text), "    {{ blocks ({} {}); normal ", joint.block,
                       joint.neighbour);
        writeVector<Dim>(text, joint.normal);
        text += "; points ";
        writeVectors<Dim>(text, joint.points);
        text += "; }\n";
    }
    text += ");\n\n";
}

} // namespace

template<int Dim>
std::string assemblyText(const Assembly<Dim>& assembly, const std::vector<InputFile>& builtFrom)
{
    std::string text = headerText("blocks", "constant/assembly")
                       + fmt::format("\ndimensions      {};\n\n{}", Dim, originText(builtFrom));
    const auto out = std::back_inserter(text);
    const std::vector<Block<Dim>>& blocks = assembly.blocks;
    writeThickness(text, blocks);
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
    writeZones(text, assembly.zones);
    writeStatedJoints(text, assembly.statedJoints);
    fmt::format_to(out, "{:<16}{}\n(\n", shapesKey(assembly), blocks.size());
    for (const Block<Dim>& block : blocks)
    {
        writeShape(text, block);
    }
    text += ");\n";
    return text;
}

template std::string assemblyText(const Assembly<2>& assembly, const std::vector<InputFile>& builtFrom);
template std::string assemblyText(const Assembly<3>& assembly, const std::vector<InputFile>& builtFrom);

} // namespace drystone
