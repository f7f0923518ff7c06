// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of 0/motion.
#include "dynamics/InitialMotion.h"

#include "dictionary/EntryLocations.h"
#include "dynamics/StartCheck.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

void declare(Options& options, BlockStart& start)
{
    options.optional("displacement", start.displacement, "of the mass centre, from as built").unit("m");
    options.optional("rotation", start.rotation, "positive counter-clockwise").unit("rad");
    options
        .optional("about", start.about,
                  "point that it turns about, as built, before it is displaced; absent: its mass centre")
        .unit("m")
        .example("(0.25 0)");
    options.check(
        "about",
        [&start]
        {
            return start.about && start.rotation == 0
                       ? "There is a point to turn about, but no rotation. Add for instance `rotation 0.1;`."
                       : "";
        });
    options.optional("velocity", start.velocity, "of the mass centre, relative to the ground").unit("m/s");
    options.optional("angularVelocity", start.angularVelocity, "positive counter-clockwise").unit("rad/s");
}

namespace
{

/// Where a start places a block.
Placement<2> placementOf(const BlockStart& start, const Block<2>& block)
{
    Placement<2> placement{start.displacement, start.rotation};
    if (start.about)
    {
        const Vector<2> arm =
            areaProperties(block.outline).centroid - Vector<2>((*start.about)[0], (*start.about)[1]);
        const double cosine = std::cos(start.rotation);
        const double sine = std::sin(start.rotation);
        const Vector<2> turned(cosine * arm.x() - sine * arm.y(), sine * arm.x() + cosine * arm.y());
        placement.translation += turned - arm;
    }
    return placement;
}

} // namespace

void declare(Options& options, InitialMotion& motion)
{
    options.each(motion.blocks, "of the block with this index, or of the blocks that the pattern matches");
}

InitialState readInitialMotion(const std::filesystem::path& caseDirectory, const std::string& timeName,
                               const Assembly<2>& assembly)
{
    DynamicState state = stateAtRest(assembly);
    const Dictionary dictionary = Dictionary::readFileIfPresent(caseDirectory / timeName / "motion");
    const auto motion = readOptions<InitialMotion>(dictionary);
    const std::vector<int> free = freeIndices(assembly);
    const EntryLocations locations(dictionary);
    std::vector<SourceLocation> places(dictionary.empty() ? 0 : free.size(), dictionary.location());
    std::vector<char> isMatched(motion.blocks.size(), false);
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        const std::string index = std::to_string(block);
        const std::pair<NamePattern, BlockStart>* chosen = nullptr;
        for (std::size_t i = 0; i < motion.blocks.size(); ++i)
        {
            const NamePattern& name = motion.blocks[i].first;
            if (name.matches(index))
            {
                isMatched[i] = true;
                // A pattern that holds supports as well, ".*" say, gives them nothing.
                const bool isExact = name.text == index;
                if (isExact || (free[block] >= 0 && !(chosen && chosen->first.text == index)))
                {
                    chosen = &motion.blocks[i];
                }
            }
        }
        if (chosen && free[block] < 0)
        {
            throw FatalIOError(
                fmt::format("Block {} is fixed: it belongs to the support {}. Only free blocks "
                            "can be given a start.",
                            block, assembly.supports[assembly.blocks[block].support].name),
                locations.of(index));
        }
        if (chosen)
        {
            const BlockStart& start = chosen->second;
            places[block] = locations.of(chosen->first.text);
            state.placements[block] = placementOf(start, assembly.blocks[block]);
            state.velocity.segment<3>(3 * free[block]) << start.velocity, start.angularVelocity;
        }
    }
    for (std::size_t i = 0; i < motion.blocks.size(); ++i)
    {
        const std::string& name = motion.blocks[i].first.text;
        questionRotation(motion.blocks[i].second, locations.of(name));
        if (!isMatched[i])
        {
            throw FatalIOError(fmt::format("There is no block {}: the assembly has blocks 0 to {}.", name,
                                           assembly.blocks.size() - 1),
                               locations.of(name));
        }
    }
    return {std::move(state), std::move(places)};
}

} // namespace drystone
