// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Groups of blocks, by index or by place.
#include "texture/BlockZones.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{
namespace
{

template<int Dim>
void addZone(Assembly<Dim>& assembly, const std::string& name, std::vector<int> blocks,
             const SourceLocation& place)
{
    const auto isTaken = [&](const auto& named) { return named.name == name; };
    if (std::any_of(assembly.zones.begin(), assembly.zones.end(), isTaken))
    {
        throw FatalIOError(fmt::format("The texture has a zone {} already: choose another name.", name),
                           place);
    }
    if (blocks.empty())
    {
        throw FatalIOError(fmt::format("There is no block in the zone {}. VTK/assembly.vtp shows where the "
                                       "blocks are.",
                                       name),
                           place);
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    assembly.zones.push_back({name, std::move(blocks)});
}

template<int Dim>
ZoneMaker<Dim> makeListed(const ListedBlocks& listed, const Dictionary& dictionary)
{
    return [blocks = listed.blocks, place = dictionary.locationOf("blocks")](Assembly<Dim>& assembly,
                                                                             const std::string& name)
    {
        const int count = static_cast<int>(assembly.blocks.size());
        for (const int index : blocks)
        {
            if (index < 0 || index >= count)
            {
                throw FatalIOError(
                    fmt::format("There is no block {}: blocks are numbered from 0 to {}.", index, count - 1),
                    place);
            }
        }
        addZone(assembly, name, blocks, place);
    };
}

template<int Dim>
ZoneMaker<Dim> makeInBox(const BlocksInBox<Dim>& inBox, const Dictionary& dictionary)
{
    return [box = inBox.box, place = dictionary.locationOf("box")](Assembly<Dim>& assembly,
                                                                   const std::string& name)
    {
        std::vector<int> blocks;
        for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
        {
            const Vector<Dim> centre = blockMass(assembly.blocks[i]).centroid;
            if ((centre - box.first).minCoeff() >= 0 && (box.second - centre).minCoeff() >= 0)
            {
                blocks.push_back(static_cast<int>(i));
            }
        }
        addZone(assembly, name, std::move(blocks), place);
    };
}

} // namespace

void declare(Options& options, ListedBlocks& listed)
{
    options.required("blocks", listed.blocks, "indices of the blocks").example("(0 1 2)");
}

template<int Dim>
void declare(Options& options, BlocksInBox<Dim>& inBox)
{
    options
        .required("box", inBox.box, "lower and upper corner; blocks whose mass centre lies in it are chosen")
        .unit("m")
        .example(Dim == 2 ? "((0 0) (2 0.5))" : "((0 0 0) (2 1 0.5))");
    options.check("box",
                  [&inBox]() -> std::string
                  {
                      return (inBox.box.second - inBox.box.first).minCoeff() > 0
                                 ? ""
                                 : "The second corner of a box must be above the first in every direction.";
                  });
}

template<int Dim>
const Registry<ZoneMaker<Dim>>& zoneTypes()
{
    static const Registry<ZoneMaker<Dim>> registry{
        "zone",
        {
            model<ZoneMaker<Dim>, ListedBlocks>("blocks", "blocks by index", makeListed<Dim>),
            model<ZoneMaker<Dim>, BlocksInBox<Dim>>("box", "blocks in a box", makeInBox<Dim>),
        }};
    return registry;
}

template void declare(Options& options, BlocksInBox<2>& inBox);
template void declare(Options& options, BlocksInBox<3>& inBox);
template const Registry<ZoneMaker<2>>& zoneTypes();
template const Registry<ZoneMaker<3>>& zoneTypes();

} // namespace drystone
