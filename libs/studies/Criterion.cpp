// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registry of criteria and their measures of a motion.
#include "studies/Criterion.h"

#include "contact/Facing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// The blocks that a criterion monitors: the one that is named, or all free ones.
std::vector<int> watchedBlocks(const Assembly<2>& assembly, std::optional<int> block,
                               const SourceLocation& location)
{
    const int count = static_cast<int>(assembly.blocks.size());
    if (block && *block >= count)
    {
        throw FatalIOError(
            fmt::format("There is no block {}: the assembly has blocks 0 to {}.", *block, count - 1),
            location);
    }
    std::vector<int> blocks;
    for (int index = 0; index < count; ++index)
    {
        if (assembly.blocks[static_cast<std::size_t>(index)].support < 0 && index == block.value_or(index))
        {
            blocks.push_back(index);
        }
    }
    if (blocks.empty())
    {
        throw FatalIOError(block ? fmt::format("Block {} is fixed and never moves: name a free one, or omit "
                                               "`block` to monitor all.",
                                               *block)
                                 : "The structure has no free block: nothing can move.",
                           location);
    }
    return blocks;
}

/// The largest value of a figure over some blocks; figure(block, placement at start, placement now).
template<class Figure>
auto largestOver(std::vector<int> blocks, Figure figure)
{
    return [blocks = std::move(blocks), figure](const DynamicState& start, const DynamicState& now)
    {
        double largest = 0;
        for (const int block : blocks)
        {
            const auto index = static_cast<std::size_t>(block);
            largest = std::max(largest, figure(index, start.placements[index], now.placements[index]));
        }
        return largest;
    };
}

std::string nameOf(std::optional<int> block)
{
    return block ? fmt::format("block {}", *block) : "any block";
}

void declareBlock(Options& options, std::optional<int>& block)
{
    options.optional("block", block, "index of the block to watch; absent: all").atLeast(0).example("0");
}

struct MotionSettings
{
    double displacement = 1e-6;
};

void declare(Options& options, MotionSettings& settings)
{
    options
        .optional("displacement", settings.displacement,
                  "of any corner of any block, from where the run began: beyond this it has moved")
        .unit("m")
        .above(0);
}

CriterionMaker makeMotion(const MotionSettings& settings, const Dictionary& dictionary)
{
    return [settings, location = dictionary.location()](const Assembly<2>& assembly)
    {
        std::vector<Polygon> outlines;
        std::vector<Vector<2>> centres;
        for (const Block<2>& block : assembly.blocks)
        {
            outlines.push_back(block.outline);
            centres.push_back(blockMass(block).centroid);
        }
        Criterion criterion{"displacement",
                            "m",
                            settings.displacement,
                            fmt::format("displacement of any corner above {:g} m", settings.displacement),
                            {}};
        criterion.measure = largestOver(
            watchedBlocks(assembly, {}, location),
            [outlines, centres](std::size_t block, const Placement<2>& start, const Placement<2>& now)
            {
                const Polygon before = placed(outlines[block], centres[block], start);
                const Polygon after = placed(outlines[block], centres[block], now);
                double farthest = 0;
                for (std::size_t corner = 0; corner < before.size(); ++corner)
                {
                    farthest = std::max(farthest, (after[corner] - before[corner]).norm());
                }
                return farthest;
            });
        return criterion;
    };
}

struct DisplacementSettings
{
    std::optional<int> block;
    double limit = 0;
};

void declare(Options& options, DisplacementSettings& settings)
{
    declareBlock(options, settings.block);
    options.required("limit", settings.limit, "of the displacement of the mass centre")
        .unit("m")
        .above(0)
        .example("0.05");
}

CriterionMaker makeDisplacement(const DisplacementSettings& settings, const Dictionary& dictionary)
{
    return [settings, location = dictionary.locationOf("block")](const Assembly<2>& assembly)
    {
        Criterion criterion{
            "displacement",
            "m",
            settings.limit,
            fmt::format("displacement of {} above {:g} m", nameOf(settings.block), settings.limit),
            {}};
        criterion.measure = largestOver(watchedBlocks(assembly, settings.block, location),
                                        [](std::size_t, const Placement<2>& start, const Placement<2>& now)
                                        { return (now.translation - start.translation).norm(); });
        return criterion;
    };
}

struct RotationSettings
{
    std::optional<int> block;
    double limit = 0;
};

void declare(Options& options, RotationSettings& settings)
{
    declareBlock(options, settings.block);
    options.required("limit", settings.limit, "of the rotation, either way")
        .unit("rad")
        .above(0)
        .example("0.2");
}

CriterionMaker makeRotation(const RotationSettings& settings, const Dictionary& dictionary)
{
    return [settings, location = dictionary.locationOf("block")](const Assembly<2>& assembly)
    {
        Criterion criterion{
            "rotation",
            "rad",
            settings.limit,
            fmt::format("rotation of {} above {:g} rad", nameOf(settings.block), settings.limit),
            {}};
        criterion.measure = largestOver(watchedBlocks(assembly, settings.block, location),
                                        [](std::size_t, const Placement<2>& start, const Placement<2>& now)
                                        { return std::abs(now.rotation - start.rotation); });
        return criterion;
    };
}

struct CollapseSettings
{
    std::optional<int> block;
    double drop = 0.5;
};

void declare(Options& options, CollapseSettings& settings)
{
    declareBlock(options, settings.block);
    options
        .optional("drop", settings.drop,
                  "how far the mass centre of a block sinks when it falls, in mean block sizes (the root of "
                  "the mean area)")
        .above(0);
}

CriterionMaker makeCollapse(const CollapseSettings& settings, const Dictionary& dictionary)
{
    return [settings, location = dictionary.locationOf("block")](const Assembly<2>& assembly)
    {
        const double blockSize = meanBlockSize(assembly);
        Criterion criterion{
            "drop",
            "m",
            settings.drop * blockSize,
            fmt::format("{} falls by more than {:g} m", nameOf(settings.block), settings.drop * blockSize),
            {}};
        criterion.measure = largestOver(watchedBlocks(assembly, settings.block, location),
                                        [](std::size_t, const Placement<2>& start, const Placement<2>& now)
                                        { return start.translation.y() - now.translation.y(); });
        return criterion;
    };
}

} // namespace

const Registry<CriterionMaker>& criterionTypes()
{
    static const Registry<CriterionMaker> registry{
        "criterion",
        {model<CriterionMaker, MotionSettings>("motion", "something moves at all", makeMotion),
         model<CriterionMaker, DisplacementSettings>("displacement", "a block is displaced by more than this",
                                                     makeDisplacement),
         model<CriterionMaker, RotationSettings>("rotation", "a block turns by more than this", makeRotation),
         model<CriterionMaker, CollapseSettings>("collapse", "a block falls", makeCollapse)}};
    return registry;
}

} // namespace drystone
