// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading the assembly file.
#include "assembly/AssemblyFile.h"

#include "assembly/AssemblyOrigin.h"
#include "assembly/Outlines.h"
#include "assembly/Plausibility.h"
#include "assembly/Polyhedra.h"
#include "assembly/StatedJoints.h"
#include "dictionary/Dictionary.h"
#include "runControl/Case.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

namespace
{

/// Refuses the entries of a dictionary that nothing has read.
void refuseUnused(const Dictionary& dictionary, const std::vector<std::string>& known)
{
    for (const Entry& entry : dictionary.entries())
    {
        if (!entry.isUsed() && entry.keyword() != "FoamFile")
        {
            throw FatalIOError(unknownWordMessage("key", entry.keyword(), known), entry.location());
        }
    }
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
            fmt::format(
                "thickness has {} values, but there are {} outlines: give one value for all, or one each.",
                thickness.size(), blocks),
            entry.location());
    }
    const auto bad =
        std::find_if(thickness.begin(), thickness.end(), [](double value) { return !(value > 0); });
    if (bad != thickness.end())
    {
        throw FatalIOError(fmt::format("thickness {} of block {} is not positive: it must be above 0.", *bad,
                                       bad - thickness.begin()),
                           entry.location());
    }
    return thickness;
}

template<int Dim>
void readSupport(const Entry& entry, Assembly<Dim>& assembly)
{
    const Dictionary& dictionary = entry.dictionary();
    const int support = static_cast<int>(assembly.supports.size());
    assembly.supports.push_back({entry.keyword(), dictionary.get<std::string>("type")});
    for (const int block : dictionary.get<std::vector<int>>("blocks"))
    {
        if (block < 0 || block >= static_cast<int>(assembly.blocks.size()))
        {
            throw FatalIOError(fmt::format("Support {} fixes block {}, but blocks are numbered from 0 to {}.",
                                           entry.keyword(), block, assembly.blocks.size() - 1),
                               dictionary.locationOf("blocks"));
        }
        if (assembly.blocks[block].support == support)
        {
            throw FatalIOError(
                fmt::format("Support {} names block {} twice. Remove one of them.", entry.keyword(), block),
                dictionary.locationOf("blocks"));
        }
        if (assembly.blocks[block].support >= 0)
        {
            throw FatalIOError(
                fmt::format("Support {} fixes block {}, which support {} fixes already. Leave it "
                            "to one of them.",
                            entry.keyword(), block, assembly.supports[assembly.blocks[block].support].name),
                dictionary.locationOf("blocks"));
        }
        assembly.blocks[block].support = support;
    }
    refuseUnused(dictionary, {"type", "blocks"});
}

/// Zones may share blocks.
template<int Dim>
void readZone(const Entry& entry, Assembly<Dim>& assembly)
{
    const Dictionary& dictionary = entry.dictionary();
    Zone zone{entry.keyword(), dictionary.get<std::vector<int>>("blocks")};
    for (const int block : zone.blocks)
    {
        if (block < 0 || block >= static_cast<int>(assembly.blocks.size()))
        {
            throw FatalIOError(fmt::format("Zone {} has block {}, but blocks are numbered from 0 to {}.",
                                           zone.name, block, assembly.blocks.size() - 1),
                               dictionary.locationOf("blocks"));
        }
    }
    refuseUnused(dictionary, {"blocks"});
    assembly.zones.push_back(std::move(zone));
}

/// A jointTolerance beyond this part of the mean block size would close openings that are meant.
constexpr double largestTolerance = 0.1;

template<int Dim>
void readJointTolerance(const Entry& entry, Assembly<Dim>& assembly)
{
    const auto tolerance = entry.as<double>();
    const double most = largestTolerance * meanBlockSize(assembly);
    const bool isAnyFree = most > 0; // else that is the fault, and is reported
    if (!(tolerance > 0 && (tolerance <= most || !isAnyFree)))
    {
        throw FatalIOError(fmt::format("jointTolerance {:g} is out of range: it must be above 0, and at most "
                                       "{:g} m, a tenth of the mean size of the blocks.",
                                       tolerance, most),
                           entry.location());
    }
    assembly.jointTolerance = tolerance;
}

constexpr std::string_view noBlock = "There is no block in this assembly. Build it again with blockTexture.";

/// The shapes of the blocks, by the dimension's own keys.
void readShapes(const Dictionary& dictionary, Assembly<2>& assembly)
{
    std::vector<Polygon> outlines = dictionary.get<Outlines>("outlines").polygons;
    if (outlines.empty())
    {
        throw FatalIOError(std::string(noBlock), dictionary.locationOf("outlines"));
    }
    const std::vector<double> thickness = readThickness(dictionary.lookup("thickness"), outlines.size());
    for (std::size_t i = 0; i < outlines.size(); ++i)
    {
        assembly.blocks.push_back({std::move(outlines[i]), thickness[i]});
    }
}

void readShapes(const Dictionary& dictionary, Assembly<3>& assembly)
{
    std::vector<Polyhedron> shapes = dictionary.get<Polyhedra>("blocks").shapes;
    if (shapes.empty())
    {
        throw FatalIOError(std::string(noBlock), dictionary.locationOf("blocks"));
    }
    for (Polyhedron& shape : shapes)
    {
        assembly.blocks.push_back({std::move(shape)});
    }
}

template<int Dim>
std::vector<std::string> keysOfShapes()
{
    if constexpr (Dim == 2)
    {
        return {"outlines", "thickness"};
    }
    else
    {
        return {"blocks", "joints"};
    }
}

} // namespace

Dictionary readFileOfBlocks(const std::filesystem::path& caseDirectory)
{
    return Dictionary::readFile(
        requireCaseFile(caseDirectory, "constant/assembly/blocks",
                        "Run blockTexture first: it builds the blocks of this case."));
}

int dimensionsOfBlocks(const Dictionary& file)
{
    const int dimensions = file.get<int>("dimensions");
    if (dimensions != 2 && dimensions != 3)
    {
        throw FatalIOError(
            fmt::format("dimensions {} are not possible: 2 is the plane, 3 is space.", dimensions),
            file.locationOf("dimensions"));
    }
    return dimensions;
}

int assemblyDimensions(const std::filesystem::path& caseDirectory)
{
    return dimensionsOfBlocks(readFileOfBlocks(caseDirectory));
}

template<int Dim>
Assembly<Dim> readBlocks(const std::filesystem::path& caseDirectory)
{
    const Dictionary dictionary = readFileOfBlocks(caseDirectory);
    if (const int dimensions = dimensionsOfBlocks(dictionary); dimensions != Dim)
    {
        throw FatalIOError(Dim == 2
                               ? "The blocks of this case are in space (dimensions 3), not in the plane."
                               : "The blocks of this case are in the plane (dimensions 2), not in space.",
                           dictionary.locationOf("dimensions"));
    }
    Assembly<Dim> assembly;
    readShapes(dictionary, assembly);
    for (const Entry& entry : dictionary.subDict("supports").entries())
    {
        readSupport(entry, assembly);
    }
    if (const Dictionary* zones = dictionary.findDict("zones"))
    {
        for (const Entry& entry : zones->entries())
        {
            readZone(entry, assembly);
        }
    }
    if constexpr (Dim == 3)
    {
        if (const Entry* joints = dictionary.find("joints"))
        {
            assembly.statedJoints = joints->as<StatedJoints>().joints;
            requireBlocks(assembly, joints->location());
            sortByPair(assembly.statedJoints);
        }
    }
    compareWithOrigin(dictionary, caseDirectory);
    if (const Entry* tolerance = dictionary.find("jointTolerance"))
    {
        readJointTolerance(*tolerance, assembly);
    }
    std::vector<std::string> keys = keysOfShapes<Dim>();
    keys.insert(keys.end(), {"builtFrom", "dimensions", "jointTolerance", "supports", "zones"});
    refuseUnused(dictionary, keys);
    questionSizes(assembly, dictionary.locationOf(keys.front()));
    return assembly;
}

template<>
std::vector<SourceLocation> blockPlaces<2>(const std::filesystem::path& caseDirectory)
{
    return Dictionary::readFile(assemblyFile(caseDirectory)).get<Outlines>("outlines").places;
}

template<>
std::vector<SourceLocation> blockPlaces<3>(const std::filesystem::path& caseDirectory)
{
    return Dictionary::readFile(assemblyFile(caseDirectory)).get<Polyhedra>("blocks").places;
}

template<int Dim>
void requireFreeBlock(const Assembly<Dim>& assembly, const std::filesystem::path& caseDirectory)
{
    if (std::all_of(assembly.blocks.begin(), assembly.blocks.end(),
                    [](const Block<Dim>& block) { return block.support >= 0; }))
    {
        throw FatalIOError(
            "Every block is fixed by a support: there is nothing to compute. Correct the supports of "
            "system/blockTextureDict and run blockTexture again.",
            Dictionary::readFile(assemblyFile(caseDirectory)).locationOf("supports"));
    }
}

template Assembly<2> readBlocks<2>(const std::filesystem::path& caseDirectory);
template Assembly<3> readBlocks<3>(const std::filesystem::path& caseDirectory);
template void requireFreeBlock(const Assembly<2>& assembly, const std::filesystem::path& caseDirectory);
template void requireFreeBlock(const Assembly<3>& assembly, const std::filesystem::path& caseDirectory);

} // namespace drystone
