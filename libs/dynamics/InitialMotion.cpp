// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads 0/motion, and questions patterns and rotations that are probably mistakes.
#include "dynamics/InitialMotion.h"

#include "dictionary/DictionaryPattern.h"
#include "dictionary/EntryLocations.h"
#include "dynamics/StartCheck.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

template<int Dim>
void declare(Options& options, BlockStart<Dim>& start)
{
    options.optional("displacement", start.displacement, "of the mass centre, from as built").unit("m");
    constexpr auto sense = Dim == 2 ? "positive counter-clockwise" : "vector along the axis, right hand";
    options.optional("rotation", start.rotation, sense).unit("rad");
    options
        .optional("about", start.about,
                  "point that it turns about, as built, before it is displaced; absent: its mass centre")
        .unit("m")
        .example(Dim == 2 ? "(0.25 0)" : "(0.25 0 0)");
    options.check(
        "about",
        [&start]
        {
            const bool isMissing = start.about && rowsOf(start.rotation).isZero(0);
            return !isMissing ? ""
                   : Dim == 2
                       ? "There is a point to turn about, but no rotation. Add for instance `rotation 0.1;`."
                       : "There is a point to turn about, but no rotation. Add for instance "
                         "`rotation (0 0.1 0);`.";
        });
    options.optional("velocity", start.velocity, "of the mass centre, relative to the ground").unit("m/s");
    options.optional("angularVelocity", start.angularVelocity, sense).unit("rad/s");
}

namespace
{

/// Where a start places a block.
template<int Dim>
Placement<Dim> placementOf(const BlockStart<Dim>& start, const Block<Dim>& block)
{
    Placement<Dim> placement{start.displacement, start.rotation};
    if (start.about)
    {
        const Vector<Dim> arm = blockMass(block).centroid - *start.about;
        placement.translation += turned(start.rotation, arm) - arm;
    }
    return placement;
}

/// One of several blocks was mistyped: the others have a start, and it has none.
void questionAlternative(const std::string& pattern, std::size_t blocks, const SourceLocation& place)
{
    std::vector<std::string> names;
    for (std::size_t block = 0; pattern.find('|') != std::string::npos && block < blocks; ++block)
    {
        names.push_back(std::to_string(block));
    }
    const std::string mistyped = names.empty() ? std::string() : alternativeWithoutName(pattern, names);
    if (!mistyped.empty())
    {
        printWarningOnce(
            fmt::format("In the pattern {}: there is no block {}, the assembly has blocks 0 to {}.", pattern,
                        mistyped, blocks - 1),
            place);
    }
}

template<int Dim>
using NamedStart = std::pair<NamePattern, BlockStart<Dim>>;

/// Which entries match a block, and which of them a free one.
struct MatchedEntries
{
    std::vector<char> any;
    std::vector<char> ofFree;
};

/// The entry that gives a block its start: the one with its index, else the last pattern; null: none. A
/// pattern that holds supports as well, ".*" say, gives them nothing. \param free index of the block, or -1
template<int Dim>
const NamedStart<Dim>* startOf(const std::string& block, int free, const InitialMotion<Dim>& motion,
                               MatchedEntries& matched)
{
    const NamedStart<Dim>* chosen = nullptr;
    for (std::size_t i = 0; i < motion.blocks.size(); ++i)
    {
        const NamePattern& name = motion.blocks[i].first;
        if (!name.matches(block))
        {
            continue;
        }
        matched.any[i] = true;
        matched.ofFree[i] = matched.ofFree[i] || free >= 0;
        const bool isExact = name.text == block;
        if (isExact || (free >= 0 && !(chosen && chosen->first.text == block)))
        {
            chosen = &motion.blocks[i];
        }
    }
    return chosen;
}

/// \throws FatalIOError for an entry of no block, or of fixed ones only
template<int Dim>
void checkEntries(const InitialMotion<Dim>& motion, const MatchedEntries& matched, std::size_t blocks,
                  const EntryLocations& locations)
{
    for (std::size_t i = 0; i < motion.blocks.size(); ++i)
    {
        const std::string& name = motion.blocks[i].first.text;
        questionRotation(motion.blocks[i].second, locations.of(name));
        if (!matched.any[i])
        {
            throw FatalIOError(
                fmt::format("There is no block {}: the assembly has blocks 0 to {}.", name, blocks - 1),
                locations.of(name));
        }
        if (!matched.ofFree[i])
        {
            throw FatalIOError(
                fmt::format("All blocks that the pattern {} matches are fixed. Only free blocks "
                            "can be given a start.",
                            name),
                locations.of(name));
        }
        questionAlternative(name, blocks, locations.of(name));
    }
}

} // namespace

template<int Dim>
void declare(Options& options, InitialMotion<Dim>& motion)
{
    options.each(motion.blocks, "of the block with this index, or of the blocks that the pattern matches");
}

template<int Dim>
InitialState<Dim> readInitialMotion(const std::filesystem::path& caseDirectory, const std::string& timeName,
                                    const Assembly<Dim>& assembly)
{
    DynamicState<Dim> state = stateAtRest(assembly);
    const Dictionary dictionary = Dictionary::readFileIfPresent(caseDirectory / timeName / "motion");
    const auto motion = readOptions<InitialMotion<Dim>>(dictionary);
    const std::vector<int> free = freeIndices(assembly);
    const EntryLocations locations(dictionary);
    std::vector<SourceLocation> places(dictionary.empty() ? 0 : free.size(), dictionary.location());
    MatchedEntries matched{std::vector<char>(motion.blocks.size(), false),
                           std::vector<char>(motion.blocks.size(), false)};
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        const std::string index = std::to_string(block);
        const NamedStart<Dim>* chosen = startOf(index, free[block], motion, matched);
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
            const BlockStart<Dim>& start = chosen->second;
            places[block] = locations.of(chosen->first.text);
            state.placements[block] = placementOf(start, assembly.blocks[block]);
            state.velocity.template segment<freedomCount<Dim>>(freedomCount<Dim> * free[block])
                << start.velocity,
                rowsOf(start.angularVelocity);
        }
    }
    checkEntries(motion, matched, free.size(), locations);
    return {std::move(state), std::move(places)};
}

template void declare(Options& options, BlockStart<2>& start);
template void declare(Options& options, InitialMotion<2>& motion);
template InitialState<2> readInitialMotion(const std::filesystem::path& caseDirectory,
                                           const std::string& timeName, const Assembly<2>& assembly);
template void declare(Options& options, BlockStart<3>& start);
template void declare(Options& options, InitialMotion<3>& motion);
template InitialState<3> readInitialMotion(const std::filesystem::path& caseDirectory,
                                           const std::string& timeName, const Assembly<3>& assembly);

} // namespace drystone
