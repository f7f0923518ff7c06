// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading the assembly file.
#include "assembly/AssemblyFile.h"

#include "core/Dictionary.h"
#include "geometry/PolygonShape.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

namespace
{

std::vector<Polygon> readOutlines(const Entry& entry)
{
    entry.markUsed();
    std::vector<Polygon> outlines;
    TokenCursor cursor(entry);
    const TokenCursor::ListStart start = cursor.openList();
    while (!cursor.isNext(')'))
    {
        const TokenCursor beginning = cursor;
        Polygon outline;
        read(cursor, outline);
        const std::string fault = outlineFault(outline);
        if (!fault.empty())
        {
            beginning.fail(fmt::format("Outline {} {}", outlines.size(), fault));
        }
        if (areaProperties(outline).area < 0)
        {
            std::reverse(outline.begin() + 1, outline.end());
        }
        outlines.push_back(std::move(outline));
    }
    cursor.closeList(start, outlines.size());
    cursor.expectEnd();
    return outlines;
}

/// One number for all blocks, or a list with one for each.
std::vector<double> readThickness(const Entry& entry, std::size_t blocks)
{
    const bool isUniform = entry.tokens().size() == 1;
    const std::vector<double> thickness =
        isUniform ? std::vector<double>(blocks, entry.as<double>()) : entry.as<std::vector<double>>();
    if (thickness.size() != blocks)
    {
        throw FatalIOError(
            fmt::format("thickness has {} values, but there are {} outlines", thickness.size(), blocks),
            entry.location());
    }
    const auto bad =
        std::find_if(thickness.begin(), thickness.end(), [](double value) { return !(value > 0); });
    if (bad != thickness.end())
    {
        throw FatalIOError(
            fmt::format("thickness {} of block {} is not positive", *bad, bad - thickness.begin()),
            entry.location());
    }
    return thickness;
}

void readSupport(const Entry& entry, Assembly<2>& assembly)
{
    const Dictionary& dictionary = entry.dictionary();
    const int support = static_cast<int>(assembly.supports.size());
    assembly.supports.push_back({entry.keyword(), dictionary.get<std::string>("type")});
    for (const int block : dictionary.get<std::vector<int>>("blocks"))
    {
        if (block < 0 || block >= static_cast<int>(assembly.blocks.size()))
        {
            throw FatalIOError(fmt::format("Support {} fixes block {}, but blocks are numbered from 0 to {}",
                                           entry.keyword(), block, assembly.blocks.size() - 1),
                               dictionary.locationOf("blocks"));
        }
        if (assembly.blocks[block].support >= 0)
        {
            throw FatalIOError(fmt::format("Support {} fixes block {}, which support {} fixes already",
                                           entry.keyword(), block,
                                           assembly.supports[assembly.blocks[block].support].name),
                               dictionary.locationOf("blocks"));
        }
        assembly.blocks[block].support = support;
    }
}

} // namespace

Assembly<2> readAssembly(const std::filesystem::path& caseDirectory)
{
    const std::filesystem::path file = assemblyFile(caseDirectory);
    if (!std::filesystem::exists(file))
    {
        throw FatalError(fmt::format(
            "There is no {}. Run blockTexture first: it builds the blocks of this case.", file.string()));
    }
    const Dictionary dictionary = Dictionary::readFile(file);
    const int dimensions = dictionary.get<int>("dimensions");
    if (dimensions != 2)
    {
        throw FatalIOError(
            fmt::format("dimensions {} are not available: this version computes in 2", dimensions),
            dictionary.locationOf("dimensions"));
    }
    Assembly<2> assembly;
    std::vector<Polygon> outlines = readOutlines(dictionary.lookup("outlines"));
    if (outlines.empty())
    {
        throw FatalIOError("There is no block in this assembly", dictionary.locationOf("outlines"));
    }
    const std::vector<double> thickness = readThickness(dictionary.lookup("thickness"), outlines.size());
    for (std::size_t i = 0; i < outlines.size(); ++i)
    {
        assembly.blocks.push_back({std::move(outlines[i]), thickness[i]});
    }
    for (const Entry& entry : dictionary.subDict("supports").entries())
    {
        readSupport(entry, assembly);
    }
    for (const Entry& entry : dictionary.entries())
    {
        if (!entry.isUsed() && entry.keyword() != "FoamFile")
        {
            throw FatalIOError(unknownWordMessage("key", entry.keyword(),
                                                  {"dimensions", "thickness", "supports", "outlines"}),
                               entry.location());
        }
    }
    return assembly;
}

} // namespace drystone
