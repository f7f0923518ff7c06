// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registries of textures and supports, and the structure made from a whole blockTextureDict.
#include "texture/Texture.h"

#include "texture/Arch.h"
#include "texture/Courses.h"
#include "texture/Polygons.h"
#include "texture/RunningBond.h"

namespace drystone
{

const Registry<Texture>& textureTypes()
{
    static const Registry<Texture> registry{
        "texture",
        {
            model<Texture, RunningBond>("runningBond", "courses of equal blocks, shifted by half a block",
                                        [](const RunningBond& bond) -> Texture {
                                            return {makeAssembly(bond), bond.unit.x()};
                                        }),
            model<Texture, Courses>("courses", "courses given block by block",
                                    [](const Courses& courses) -> Texture {
                                        return {makeAssembly(courses), courses.unit.x()};
                                    }),
            model<Texture, Polygons>("polygons", "blocks of any shape, corner by corner",
                                     [](const Polygons& polygons) -> Texture {
                                         return {makeAssembly(polygons), 1};
                                     }),
            model<Texture, Arch>("arch", "an arch of voussoirs between two abutments",
                                 [](const Arch& arch) -> Texture {
                                     return {makeAssembly(arch), 1};
                                 }),
        }};
    return registry;
}

void declare(Options& options, BlockTexture& blockTexture)
{
    options.optional("dimensions", blockTexture.dimensions, "of space");
    options.required("texture", blockTexture.texture, textureTypes(), "how the blocks are made");
    options.optional("supports", blockTexture.supports, supportTypes(),
                     "the supports of the structure; any names");
    options
        .optional(
            "jointTolerance", blockTexture.jointTolerance,
            "faces that are this near are a joint, and those farther apart are so on purpose; absent: 1e-6 "
            "of the mean block size, or 1.5 units of the last digit of the coordinates, and faces that "
            "almost meet are refused")
        .unit("m")
        .above(0)
        .example("1e-5");
    options.check(
        "dimensions",
        [&blockTexture]() -> std::string
        {
            return blockTexture.dimensions == 2
                       ? ""
                       : "Only dimensions 2 are available: this version builds structures in the plane.";
        });
}

Assembly<2> makeStructure(const Dictionary& dictionary)
{
    BlockTexture blockTexture = readOptions<BlockTexture>(dictionary);
    if (blockTexture.texture.assembly.blocks.empty())
    {
        throw FatalIOError("This texture has no blocks: reduce its openings or voids, or add blocks.",
                           dictionary.locationOf("texture"));
    }
    for (const auto& [name, addSupport] : blockTexture.supports)
    {
        addSupport(blockTexture.texture.assembly, name, blockTexture.texture.unit);
    }
    blockTexture.texture.assembly.jointTolerance = blockTexture.jointTolerance;
    return std::move(blockTexture.texture.assembly);
}

} // namespace drystone
