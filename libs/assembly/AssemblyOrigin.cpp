// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Shapes, tolerance, supports, zones and stated joints make one fingerprint; files are compared by theirs.
#include "assembly/AssemblyOrigin.h"

#include "core/Log.h"

#include <algorithm>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

void addShape(Fingerprint& print, const Block<2>& block)
{
    print.add(static_cast<double>(block.outline.size()));
    for (const Vector<2>& corner : block.outline)
    {
        print.add(corner.x());
        print.add(corner.y());
    }
    print.add(block.thickness);
}

void addShape(Fingerprint& print, const Block<3>& block)
{
    print.add(static_cast<double>(block.shape.vertices.size()));
    for (const Vector<3>& vertex : block.shape.vertices)
    {
        print.add(vertex.x());
        print.add(vertex.y());
        print.add(vertex.z());
    }
    for (const std::vector<int>& face : block.shape.faces)
    {
        print.add(static_cast<double>(face.size()));
        for (const int vertex : face)
        {
            print.add(static_cast<double>(vertex));
        }
    }
}

} // namespace

template<int Dim>
std::uint64_t fingerprint(const Assembly<Dim>& assembly)
{
    Fingerprint print;
    for (const Block<Dim>& block : assembly.blocks)
    {
        addShape(print, block);
        print.add(static_cast<double>(block.support));
    }
    if (assembly.jointTolerance) // else as before it was one of these
    {
        print.add("jointTolerance\n");
        print.add(*assembly.jointTolerance);
    }
    for (const Support& support : assembly.supports)
    {
        print.add(support.name + "\n");
    }
    for (const Zone& zone : assembly.zones)
    {
        print.add(zone.name + "\n");
        for (const int block : zone.blocks)
        {
            print.add(static_cast<double>(block));
        }
    }
    for (const StatedJoint<Dim>& joint : assembly.statedJoints)
    {
        print.add(static_cast<double>(joint.block));
        print.add(static_cast<double>(joint.neighbour));
        for (int axis = 0; axis < Dim; ++axis)
        {
            print.add(joint.normal[axis]);
            for (const Vector<Dim>& point : joint.points)
            {
                print.add(point[axis]);
            }
        }
    }
    return print.value();
}

template std::uint64_t fingerprint(const Assembly<2>& assembly);
template std::uint64_t fingerprint(const Assembly<3>& assembly);

std::vector<InputFile> originOf(const fs::path& dictionaryFile, const fs::path& caseDirectory)
{
    const fs::path whole = fs::absolute(dictionaryFile).lexically_normal();
    const fs::path inCase = whole.lexically_relative(fs::absolute(caseDirectory / "").lexically_normal());
    const bool isInCase = !inCase.empty() && *inCase.begin() != "..";
    return inputFiles(caseDirectory, {(isInCase ? inCase : whole).string()});
}

std::string originText(const std::vector<InputFile>& builtFrom)
{
    if (builtFrom.empty())
    {
        return {};
    }
    std::string text = "builtFrom\n(\n";
    for (const std::string& line : textsOf(builtFrom))
    {
        text += "    \"" + line + "\"\n";
    }
    return text + ");\n\n";
}

void compareWithOrigin(const Dictionary& blocks, const fs::path& caseDirectory)
{
    std::error_code ignored;
    if (!blocks.found("builtFrom"))
    {
        if (fs::exists(caseDirectory / "system/blockTextureDict", ignored))
        {
            info("{} does not say from which dictionary it was built: changes of system/blockTextureDict "
                 "since are not noticed.\n",
                 blocks.location().file);
        }
        return;
    }
    const std::vector<InputFile> before = inputFilesIn(blocks.get<std::vector<std::string>>("builtFrom"));
    if (before.empty() || !fs::exists(caseDirectory / before.front().name, ignored))
    {
        return;
    }
    const std::vector<InputChange> changes =
        changesOfInput(before, inputFiles(caseDirectory, {before.front().name}));
    if (!changes.empty())
    {
        printWarningOnce(textOf(changes)
                             + " since the blocks were built from it: they are the old ones.\n\nRun "
                               "blockTexture again.",
                         blocks.locationOf("builtFrom"));
    }
}

} // namespace drystone
