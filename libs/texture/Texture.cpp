// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registries of textures and supports, and the structure made from a whole blockTextureDict.
#include "texture/Texture.h"

#include "core/ShownList.h"
#include "import/Import.h"
#include "import/plane/Photograph.h"
#include "texture/Arch.h"
#include "texture/Courses.h"
#include "texture/Polygons.h"
#include "texture/RunningBond.h"
#include "texture/plane/PlaneRubble.h"
#include "texture/space/BarrelVault.h"
#include "texture/space/Boxes.h"
#include "texture/space/Column.h"
#include "texture/space/CrossVault.h"
#include "texture/space/Dome.h"
#include "texture/space/Extrusion.h"
#include "texture/space/PolyhedronBlocks.h"
#include "texture/space/Rubble.h"
#include "texture/space/Stair.h"
#include "texture/space/Tower.h"
#include "texture/space/Walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace drystone
{

namespace
{

/// A texture of space, whose lengths are in metres.
template<Declared Settings>
Model<Texture<3>> spaceModel(std::string name, std::string summary)
{
    return model<Texture<3>, Settings>(std::move(name), std::move(summary),
                                       [](const Settings& settings) -> Texture<3> {
                                           return {makeAssembly(settings), 1};
                                       });
}

/// Stones by chance: what came of them that the dictionary does not say.
Texture<2> planeRubble(const PlaneRubble& rubble, const Dictionary& dictionary)
{
    Texture<2> texture{makeAssembly(rubble), 1};
    if (const std::string loss = lossOfStones(rubble, texture.assembly); !loss.empty())
    {
        printWarningOnce(loss, dictionary.locationOf("stones"));
    }
    return texture;
}

Texture<3> spaceRubble(const Rubble& rubble, const Dictionary& dictionary)
{
    Texture<3> texture{makeAssembly(rubble), 1};
    if (const std::string fault = faultOfStones(rubble, texture.assembly); !fault.empty())
    {
        throw FatalIOError(fault, dictionary.locationOf("seed"));
    }
    return texture;
}

/// A texture whose blocks are in a file.
template<int Dim, Declared Settings>
Model<Texture<Dim>> fileModel(std::string name, std::string summary)
{
    return model<Texture<Dim>, Settings>(std::move(name), std::move(summary),
                                         [](const Settings& settings, const Dictionary& dictionary)
                                         {
                                             Texture<Dim> texture;
                                             texture.readBlocks =
                                                 [settings, place = dictionary.locationOf("file")](
                                                     const std::filesystem::path& caseDirectory)
                                             { return makeAssembly(settings, caseDirectory, place); };
                                             return texture;
                                         });
}

Texture<2> readPhotograph(const Photograph& photograph, const Dictionary& dictionary)
{
    Texture<2> texture;
    texture.readBlocks =
        [photograph, file = dictionary.locationOf("file"),
         points = dictionary.locationOf("points")](const std::filesystem::path& caseDirectory)
    { return makeAssembly(photograph, caseDirectory, file, points); };
    return texture;
}

} // namespace

template<>
const Registry<Texture<2>>& textureTypes()
{
    static const Registry<Texture<2>> registry{
        "texture",
        {
            model<Texture<2>, RunningBond>("runningBond", "courses of equal blocks, shifted by half a block",
                                           [](const RunningBond& bond) -> Texture<2> {
                                               return {makeAssembly(bond), bond.unit.x()};
                                           }),
            model<Texture<2>, Courses>("courses", "courses given block by block",
                                       [](const Courses& courses) -> Texture<2> {
                                           return {makeAssembly(courses), courses.unit.x()};
                                       }),
            model<Texture<2>, Polygons>("polygons", "blocks of any shape, corner by corner",
                                        [](const Polygons& polygons) -> Texture<2> {
                                            return {makeAssembly(polygons), 1};
                                        }),
            model<Texture<2>, Arch>("arch", "an arch of voussoirs between two abutments",
                                    [](const Arch& arch) -> Texture<2> {
                                        return {makeAssembly(arch), 1};
                                    }),
            model<Texture<2>, PlaneRubble>("rubble", "irregular stones, the Voronoi cells of seeded points",
                                           planeRubble),
            fileModel<2, Import<2>>("import", "blocks of a drawing that another program made"),
            model<Texture<2>, Photograph>("image", "stones of a photograph", readPhotograph),
        }};
    return registry;
}

template<>
const Registry<Texture<3>>& textureTypes()
{
    static const Registry<Texture<3>> registry{
        "texture",
        {
            spaceModel<Boxes>("boxes", "boxes along the axes, corner by corner"),
            spaceModel<PolyhedronBlocks>("polyhedra", "blocks of any shape, by vertices and faces"),
            model<Texture<3>, Extrusion>("extrusion", "a texture of the plane, given depth",
                                         [](const Extrusion& extrusion) -> Texture<3>
                                         {
                                             if (!extrusion.of.readBlocks)
                                             {
                                                 return {makeAssembly(extrusion), 1};
                                             }
                                             Texture<3> texture;
                                             texture.readBlocks =
                                                 [extrusion](const std::filesystem::path& caseDirectory)
                                             {
                                                 Extrusion complete = extrusion;
                                                 complete.of.assembly =
                                                     extrusion.of.readBlocks(caseDirectory);
                                                 return makeAssembly(complete);
                                             };
                                             return texture;
                                         }),
            spaceModel<Walls>("walls", "walls of bricks in a bond, toothed where they meet"),
            spaceModel<BarrelVault>("barrelVault", "an arch, given length, in slices"),
            spaceModel<CrossVault>("crossVault", "two barrels that cross each other in groins"),
            spaceModel<Dome>("dome", "rings of blocks between two spheres, on a drum or not"),
            spaceModel<Tower>("tower", "rings of blocks on each other, round or polygonal"),
            spaceModel<Column>("column", "columns of drums, alone or under an architrave"),
            model<Texture<3>, Rubble>("rubble", "irregular stones, the Voronoi cells of seeded points",
                                      spaceRubble),
            spaceModel<Stair>("stair", "steps that cantilever from a wall"),
            fileModel<3, Import<3>>("import", "blocks of a file that another program made"),
        }};
    return registry;
}

int dimensionsOf(const Dictionary& dictionary)
{
    const Entry* entry = dictionary.find("dimensions");
    const int dimensions = entry ? entry->as<int>() : 2;
    if (dimensions != 2 && dimensions != 3)
    {
        throw FatalIOError(
            fmt::format("dimensions is {}: structures are built in 2 (the plane x-y) or 3.", dimensions),
            entry->location());
    }
    return dimensions;
}

template<int Dim>
void declare(Options& options, BlockTexture<Dim>& blockTexture)
{
    if (Dim == 2)
    {
        options.optional("dimensions", blockTexture.dimensions, "2: the plane x-y");
    }
    else
    {
        options.required("dimensions", blockTexture.dimensions, "3: space, z upwards").example("3");
    }
    options.required("texture", blockTexture.texture, textureTypes<Dim>(), "how the blocks are made");
    options.optional("supports", blockTexture.supports, supportTypes<Dim>(),
                     "the supports of the structure; any names");
    options
        .optional("zones", blockTexture.zones, zoneTypes<Dim>(),
                  "groups of blocks, any names: for densities (materialProperties), joints "
                  "(contactProperties, as footing-shaft) and loads on faces")
        .example("footing");
    options
        .optional(
            "jointTolerance", blockTexture.jointTolerance,
            "faces that are this near are a joint, and those farther apart are so on purpose; absent: 1e-6 "
            "of the mean block size, or 1.5 units of the last digit of the coordinates, and faces that "
            "almost meet are refused")
        .unit("m")
        .above(0)
        .example("1e-5");
    options.check("dimensions",
                  [&blockTexture]() -> std::string
                  {
                      return blockTexture.dimensions == Dim
                                 ? ""
                                 : fmt::format(
                                     "Only dimensions {} are available here: this is read as a structure {}.",
                                     Dim, Dim == 2 ? "in the plane" : "in space");
                  });
}

template void declare(Options& options, BlockTexture<2>& blockTexture);
template void declare(Options& options, BlockTexture<3>& blockTexture);

namespace
{

/// Supports are known by their names: of two with one name the blocks of the first would be free.
template<int Dim>
void refuseSecondSupport(const Assembly<Dim>& assembly, const std::string& name, const SourceLocation& place)
{
    const auto count = std::count_if(assembly.supports.begin(), assembly.supports.end(),
                                     [&](const auto& support) { return support.name == name; });
    if (count > 1)
    {
        throw FatalIOError(
            fmt::format("The texture makes a support {} by itself: give this one another name.", name),
            place);
    }
}

/// Warns of blocks that an imported file marks as supports and that no support of the dictionary takes, as
/// `ground { type import; }` does not where the file has a layer of that name: the structure falls with them.
template<int Dim>
void questionFreeSupports(const Assembly<Dim>& assembly, const SourceLocation& place)
{
    std::vector<int> areFree;
    for (const Zone& zone : assembly.zones)
    {
        if (zone.name == "is_support")
        {
            std::copy_if(zone.blocks.begin(), zone.blocks.end(), std::back_inserter(areFree),
                         [&](int block)
                         { return assembly.blocks[static_cast<std::size_t>(block)].support < 0; });
        }
    }
    if (!areFree.empty())
    {
        printWarning(
            fmt::format("The imported file marks blocks as supports (is_support) that are free here: "
                        "{}. A support `{{ type import; layers (is_support); }}` fixes them.",
                        shownList(areFree, 8, " ")),
            place);
    }
}

/// Textures of space are no typing errors in the plane.
void refuseTextureOfSpace(const Dictionary& dictionary)
{
    const Entry* texture = dictionary.find("texture");
    const Entry* type =
        texture && texture->isDictionary() ? dictionary.subDict("texture").find("type") : nullptr;
    const auto isOneOf = [name = type ? type->as<std::string>() : ""](const auto& registry)
    {
        return std::any_of(registry.models.begin(), registry.models.end(),
                           [&](const auto& model) { return model.name == name; });
    };
    if (isOneOf(textureTypes<3>()) && !isOneOf(textureTypes<2>()))
    {
        const auto isMistyped = [](const Entry& entry)
        { return !nearestWord(entry.keyword(), {"dimensions"}).empty(); };
        if (!dictionary.find("dimensions")
            && std::any_of(dictionary.entries().begin(), dictionary.entries().end(), isMistyped))
        {
            readOptions<BlockTexture<3>>(dictionary); // which names it
        }
        throw FatalIOError(
            fmt::format("The texture {} is one of space: write `dimensions 3;`, or choose another.",
                        type->as<std::string>()),
            type->location());
    }
}

} // namespace

template<int Dim>
Assembly<Dim> makeStructure(const Dictionary& dictionary, const std::filesystem::path& caseDirectory)
{
    if (Dim == 2)
    {
        refuseTextureOfSpace(dictionary);
    }
    BlockTexture<Dim> blockTexture = readOptions<BlockTexture<Dim>>(dictionary);
    if (blockTexture.texture.readBlocks)
    {
        blockTexture.texture.assembly = blockTexture.texture.readBlocks(caseDirectory);
    }
    if (blockTexture.texture.assembly.blocks.empty())
    {
        throw FatalIOError("This texture has no blocks: reduce its openings or voids, or add blocks.",
                           dictionary.locationOf("texture"));
    }
    if (blockTexture.jointTolerance) // else that of an imported file stays
    {
        blockTexture.texture.assembly.jointTolerance = blockTexture.jointTolerance;
    }
    for (const auto& [name, addSupport] : blockTexture.supports)
    {
        addSupport(blockTexture.texture.assembly, name, blockTexture.texture.unit);
        refuseSecondSupport(blockTexture.texture.assembly, name,
                            dictionary.subDict("supports").locationOf(name));
    }
    questionFreeSupports(blockTexture.texture.assembly,
                         dictionary.locationOf(blockTexture.supports.empty() ? "texture" : "supports"));
    for (const auto& [name, addZone] : blockTexture.zones) // ground may take blocks of the texture away
    {
        addZone(blockTexture.texture.assembly, name);
    }
    return std::move(blockTexture.texture.assembly);
}

template Assembly<2> makeStructure(const Dictionary& dictionary, const std::filesystem::path& caseDirectory);
template Assembly<3> makeStructure(const Dictionary& dictionary, const std::filesystem::path& caseDirectory);

} // namespace drystone
