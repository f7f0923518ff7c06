// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the supports of a blockTextureDict, the ground included, once the texture has made its blocks.
#include "texture/Supports.h"

#include "assembly/BlockShape.h"
#include "import/Zones.h"
#include "texture/Limits.h"
#include "texture/space/Boxes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// Upwards is the last coordinate: y in the plane, z in space.
template<int Dim>
constexpr int up = Dim - 1;

/// Rejects a structure that the ground would cut into. Supports of it, which the ground does not touch, may
/// have been measured to no more than what counts as a joint.
template<int Dim>
void rejectBlocksUnderGround(const Assembly<Dim>& assembly, const SourceLocation& place)
{
    const Box<Dim> box = boundingBox(assembly);
    const double tolerance = 1e-9 * (box.upper - box.lower).maxCoeff();
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const double allowed = assembly.blocks[i].support >= 0
                                   ? std::max(tolerance, assembly.jointTolerance.value_or(0))
                                   : tolerance;
        if (boundingBox(assembly.blocks[i]).lower[up<Dim>] < -allowed)
        {
            const double lowest = box.lower[up<Dim>];
            throw FatalIOError(
                fmt::format(
                    "Block {} reaches below {} = 0, where the ground lies, down to {:.6g} m. {}, or raise "
                    "the structure by as much (`offset ({} {:.6g});` in an import).",
                    i, Dim == 2 ? "y" : "z", lowest,
                    assembly.blocks[i].support >= 0
                        ? "It is a support that the texture has of its own: leave the ground out"
                        : "Fix blocks with \"type blocks;\" instead",
                    Dim == 2 ? "0" : "0 0", -lowest),
                place);
        }
    }
}

/// The number of ground blocks. A remainder below a millionth of a segment is rounding, not a block.
double segmentCount(double length, double segment)
{
    return std::max(1.0, std::ceil(length / segment - 1e-6));
}

template<int Dim>
void removeAbutmentsUnderGround(Assembly<Dim>& assembly)
{
    const bool hasAbutments =
        !assembly.supports.empty()
        && std::all_of(assembly.supports.begin(), assembly.supports.end(),
                       [](const Support& support) { return support.type == "abutments"; });
    const auto isAboveGround = [](const Block<Dim>& block)
    { return block.support >= 0 && boundingBox(block).upper[up<Dim>] > 0; };
    if (hasAbutments && std::none_of(assembly.blocks.begin(), assembly.blocks.end(), isAboveGround))
    {
        std::erase_if(assembly.blocks, [](const Block<Dim>& block) { return block.support >= 0; });
        assembly.supports.clear();
    }
}

/// Makes room for a ground, or rejects the structure.
template<int Dim>
void prepareGround(Assembly<Dim>& assembly, const SourceLocation& place)
{
    const auto hasGround = [](const Support& support) { return support.type == "ground"; };
    if (std::any_of(assembly.supports.begin(), assembly.supports.end(), hasGround))
    {
        throw FatalIOError("There is a ground already: two would lie in the same place. Remove one.", place);
    }
    removeAbutmentsUnderGround(assembly);
    rejectBlocksUnderGround(assembly, place);
}

SupportMaker<2> makeGround(const Ground& ground, const Dictionary& dictionary)
{
    return [ground, place = dictionary.location(), segmentPlace = dictionary.locationOf("segment")](
               Assembly<2>& assembly, const std::string& name, double unit)
    {
        prepareGround(assembly, place);
        Ground inMetres = ground;
        const BoundingBox box = boundingBox(assembly);
        if (ground.segment)
        {
            inMetres.segment = *ground.segment * unit;
            if (segmentCount(box.upper.x() - box.lower.x(), *inMetres.segment) > maximumBlocks)
            {
                throw FatalIOError(
                    fmt::format(
                        "A segment of {:g} units splits the ground into more than {} blocks: make it longer.",
                        *ground.segment, maximumBlocks),
                    segmentPlace);
            }
        }
        if (ground.margin)
        {
            inMetres.margin = *ground.margin * unit;
        }
        addGround(assembly, name, inMetres);
    };
}

SupportMaker<3> makeGroundSlab(const GroundSlab& ground, const Dictionary& dictionary)
{
    return [ground, place = dictionary.location()](Assembly<3>& assembly, const std::string& name, double)
    {
        prepareGround(assembly, place);
        addGround(assembly, name, ground);
    };
}

SupportMaker<3> makeFixedBoxes(const FixedBoxes& fixed)
{
    return [fixed](Assembly<3>& assembly, const std::string& name, double)
    {
        const int support = static_cast<int>(assembly.supports.size());
        assembly.supports.push_back({name, "blocks"});
        for (const auto& [lower, upper] : fixed.blocks)
        {
            assembly.blocks.push_back({makeBox(lower, upper), support});
        }
    };
}

template<int Dim>
SupportMaker<Dim> makeFixedBlocks(const FixedBlocks& fixed, const Dictionary& dictionary)
{
    return [fixed, place = dictionary.locationOf("blocks")](Assembly<Dim>& assembly, const std::string& name,
                                                            double)
    {
        const int support = static_cast<int>(assembly.supports.size());
        const int count = static_cast<int>(assembly.blocks.size());
        if (fixed.blocks.empty())
        {
            printWarningOnce(
                fmt::format("The support {} holds no block: name some, as `blocks (0 1);`.", name), place);
        }
        assembly.supports.push_back({name, "blocks"});
        for (const int index : fixed.blocks)
        {
            if (index < 0 || index >= count)
            {
                throw FatalIOError(
                    fmt::format("There is no block {}: blocks are numbered from 0 to {}.", index, count - 1),
                    place);
            }
            if (assembly.blocks[index].support >= 0)
            {
                throw FatalIOError(fmt::format("Block {} is fixed already, by support {}.", index,
                                               assembly.supports[assembly.blocks[index].support].name),
                                   place);
            }
            assembly.blocks[index].support = support;
        }
    };
}

template<int Dim>
std::vector<std::string> namesOfZones(const Assembly<Dim>& assembly)
{
    std::vector<std::string> names;
    for (const Zone& zone : assembly.zones)
    {
        names.push_back(zone.name);
    }
    return names;
}

/// The layers of a support that names none: that of its own name, or what the file marks as supports.
NamePattern usualLayer(const std::string& name, const std::vector<std::string>& zones,
                       const SourceLocation& place)
{
    const auto exists = [&](const std::string& zone)
    { return std::find(zones.begin(), zones.end(), zone) != zones.end(); };
    const std::string usual = exists(name) ? name : "is_support";
    if (!exists(usual))
    {
        throw FatalIOError(
            fmt::format("Nothing in the imported file is marked as a support, and it has no layer {}. Name "
                        "the layers that are fixed with `layers (...);`, or blocks with `type blocks;`.\n\n"
                        "Layers: {}",
                        name, zones.empty() ? "none" : fmt::format("{}", fmt::join(zones, " "))),
            place);
    }
    return {usual, [usual](const std::string& zone) { return zone == usual; }};
}

/// Fixes the blocks of all zones that match, but those of an earlier support. \return whether any matches
template<int Dim>
bool fixZones(Assembly<Dim>& assembly, const NamePattern& pattern, int support)
{
    bool isFound = false;
    for (const Zone& zone : assembly.zones)
    {
        if (!pattern.matches(zone.name))
        {
            continue;
        }
        isFound = true;
        for (const int block : zone.blocks)
        {
            int& of = assembly.blocks[block].support;
            of = of < 0 ? support : of;
        }
    }
    return isFound;
}

template<int Dim>
SupportMaker<Dim> makeFixedZones(const FixedZones& fixed, const Dictionary& dictionary)
{
    return [fixed, place = dictionary.location(), layersPlace = dictionary.locationOf("layers")](
               Assembly<Dim>& assembly, const std::string& name, double)
    {
        const std::vector<std::string> names = namesOfZones(assembly);
        std::vector<NamePattern> patterns = fixed.layers;
        if (patterns.empty())
        {
            patterns.push_back(usualLayer(name, names, place));
        }
        const int support = static_cast<int>(assembly.supports.size());
        assembly.supports.push_back({name, "blocks"});
        for (NamePattern pattern : patterns)
        {
            const std::string zoneOfLayer = zoneName(pattern.text); // `layers ("St 1");` of the zone St_1
            if (std::none_of(names.begin(), names.end(), pattern.matches)
                && std::find(names.begin(), names.end(), zoneOfLayer) != names.end())
            {
                pattern.matches = [zoneOfLayer](const std::string& zone) { return zone == zoneOfLayer; };
            }
            if (!fixZones(assembly, pattern, support))
            {
                throw FatalIOError(unknownWordMessage("layer", pattern.text, names)
                                       + "\n\nThe layers of an OBJ file are its materials, and only where it "
                                         "has none its objects: give the objects that are fixed a material "
                                         "of their own, or name their blocks with `type blocks;`.",
                                   layersPlace);
            }
        }
    };
}

} // namespace

void declare(Options& options, FixedZones& fixed)
{
    options
        .optional(
            "layers", fixed.layers,
            "layers of the imported file whose blocks are fixed: of OBJ its materials or, where it has none, "
            "its objects without their numbers; absent: the layer of the support's own name, or else what "
            "the file marks as supports (is_support)")
        .example("(abutments)");
}

void declare(Options& options, Ground& ground)
{
    options
        .optional("segment", ground.segment, "length of one ground block, in units; a single block if absent")
        .above(0)
        .example("0.5");
    options.optional("depth", ground.depth, "of the ground; a tenth of the structure's size if absent")
        .unit("m")
        .above(0)
        .example("0.2");
    options
        .optional("margin", ground.margin,
                  "by how far the ground extends past each end, in units; three times the structure's size "
                  "if absent")
        .atLeast(0)
        .example("10");
}

void declare(Options& options, GroundSlab& ground)
{
    options.optional("depth", ground.depth, "of the slab; a tenth of the structure's size if absent")
        .unit("m")
        .above(0)
        .example("0.2");
    options
        .optional("margin", ground.margin,
                  "by how far the slab extends past the structure on each side; three times the structure's "
                  "size if absent")
        .unit("m")
        .atLeast(0)
        .example("10");
}

void declare(Options& options, FixedBlocks& fixed)
{
    options.required("blocks", fixed.blocks, "indices of the blocks that are fixed").example("(0 1)");
}

void declare(Options& options, FixedBoxes& fixed)
{
    options.required("blocks", fixed.blocks, "lower and upper corner of each box [m]")
        .example("(((-0.5 -0.5 -0.2) (0.5 0.5 0)))");
    options.check("blocks", [&fixed] { return boxFault(fixed.blocks); });
}

void addGround(Assembly<2>& assembly, const std::string& name, const Ground& ground)
{
    removeAbutmentsUnderGround(assembly);
    const BoundingBox box = boundingBox(assembly);
    double thickness = 0;
    for (const Block<2>& block : assembly.blocks)
    {
        thickness = std::max(thickness, block.thickness);
    }
    const double left = box.lower.x();
    const double right = box.upper.x();
    const double size = (box.upper - box.lower).maxCoeff();
    const double bottom = -ground.depth.value_or(0.1 * size);
    const double margin = ground.margin.value_or(3 * size);
    const double segment = ground.segment.value_or(right - left);
    const int count = static_cast<int>(segmentCount(right - left, segment));

    const int support = static_cast<int>(assembly.supports.size());
    assembly.supports.push_back({name, "ground"});
    for (int i = 0; i < count; ++i)
    {
        const double from = i == 0 ? left - margin : left + i * segment;
        const double to = i + 1 == count ? right + margin : left + (i + 1) * segment;
        assembly.blocks.push_back({{{from, bottom}, {to, bottom}, {to, 0}, {from, 0}}, thickness, support});
    }
}

void addGround(Assembly<3>& assembly, const std::string& name, const GroundSlab& ground)
{
    removeAbutmentsUnderGround(assembly);
    const Box<3> box = boundingBox(assembly);
    const double size = (box.upper - box.lower).maxCoeff();
    const double margin = ground.margin.value_or(3 * size);
    const int support = static_cast<int>(assembly.supports.size());
    assembly.supports.push_back({name, "ground"});
    assembly.blocks.push_back(
        {makeBox({box.lower.x() - margin, box.lower.y() - margin, -ground.depth.value_or(0.1 * size)},
                 {box.upper.x() + margin, box.upper.y() + margin, 0}),
         support});
}

template<>
const Registry<SupportMaker<2>>& supportTypes()
{
    static const Registry<SupportMaker<2>> registry{
        "support",
        {
            model<SupportMaker<2>, Ground>("ground", "fixed blocks under y = 0", makeGround),
            model<SupportMaker<2>, FixedBlocks>("blocks", "blocks of the texture, fixed", makeFixedBlocks<2>),
            model<SupportMaker<2>, FixedZones>("import", "blocks that an imported file marks, fixed",
                                               makeFixedZones<2>),
        }};
    return registry;
}

template<>
const Registry<SupportMaker<3>>& supportTypes()
{
    static const Registry<SupportMaker<3>> registry{
        "support",
        {
            model<SupportMaker<3>, GroundSlab>("ground", "one fixed slab under z = 0", makeGroundSlab),
            model<SupportMaker<3>, FixedBlocks>("blocks", "blocks of the texture, fixed", makeFixedBlocks<3>),
            model<SupportMaker<3>, FixedBoxes>(
                "boxes", "fixed boxes in addition to the blocks of the texture", makeFixedBoxes),
            model<SupportMaker<3>, FixedZones>("import", "blocks that an imported file marks, fixed",
                                               makeFixedZones<3>),
        }};
    return registry;
}

} // namespace drystone
