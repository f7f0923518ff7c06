// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Measures of a motion.
#include "quantities/MotionFigures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// The blocks that a figure is taken over: the one that is named, or all free ones.
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

/// The largest value of a figure over some blocks, at least 0; figure(block, placement at start, now).
template<class Figure>
auto largestOver(std::vector<int> blocks, Figure figure)
{
    return [blocks = std::move(blocks), figure](const DynamicState<2>& start, const Motion<2>& now)
    {
        double largest = 0;
        for (const int block : blocks)
        {
            const auto index = static_cast<std::size_t>(block);
            largest = std::max(largest, figure(index, start.placements[index], now.state.placements[index]));
        }
        return largest;
    };
}

std::string nameOf(std::optional<int> block)
{
    return block ? fmt::format("block {}", *block) : "any block";
}

} // namespace

InstantFigure farthestCorner(const Assembly<2>& assembly, const SourceLocation& location)
{
    std::vector<Polygon> outlines;
    std::vector<Vector<2>> centres;
    for (const Block<2>& block : assembly.blocks)
    {
        outlines.push_back(block.outline);
        centres.push_back(blockMass(block).centroid);
    }
    InstantFigure figure{"displacement", "m", "displacement of any corner", {}};
    figure.at =
        largestOver(watchedBlocks(assembly, {}, location),
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
    return figure;
}

InstantFigure displacementOf(const Assembly<2>& assembly, std::optional<int> block,
                             const SourceLocation& location)
{
    InstantFigure figure{"displacement", "m", "displacement of " + nameOf(block), {}};
    figure.at = largestOver(watchedBlocks(assembly, block, location),
                            [](std::size_t, const Placement<2>& start, const Placement<2>& now)
                            { return (now.translation - start.translation).norm(); });
    return figure;
}

InstantFigure displacementAlong(const Assembly<2>& assembly, int block, const Vector<2>& direction,
                                const SourceLocation& location)
{
    const std::size_t index = freeBlock(assembly, block, location);
    return {"displacement", "m",
            fmt::format("displacement of block {} along ({:g} {:g})", block, direction.x(), direction.y()),
            [index, direction](const DynamicState<2>& start, const Motion<2>& now) {
                return direction.dot(now.state.placements[index].translation
                                     - start.placements[index].translation);
            }};
}

InstantFigure rotationOf(const Assembly<2>& assembly, std::optional<int> block,
                         const SourceLocation& location)
{
    InstantFigure figure{"rotation", "rad", "rotation of " + nameOf(block), {}};
    figure.at = largestOver(watchedBlocks(assembly, block, location),
                            [](std::size_t, const Placement<2>& start, const Placement<2>& now)
                            { return std::abs(now.rotation - start.rotation); });
    return figure;
}

InstantFigure dropOf(const Assembly<2>& assembly, std::optional<int> block, const SourceLocation& location)
{
    InstantFigure figure{"drop", "m", "drop of " + nameOf(block), {}};
    figure.at = largestOver(watchedBlocks(assembly, block, location),
                            [](std::size_t, const Placement<2>& start, const Placement<2>& now)
                            { return start.translation.y() - now.translation.y(); });
    return figure;
}

std::array<std::pair<std::string_view, EnergyPart>, 5> namesOf(EnergyPart)
{
    return {{{"kinetic", EnergyPart::kinetic},
             {"potential", EnergyPart::potential},
             {"mechanical", EnergyPart::mechanical},
             {"frictionLoss", EnergyPart::frictionLoss},
             {"dissipation", EnergyPart::dissipation}}};
}

std::string_view nameOf(EnergyPart part)
{
    for (const auto& [name, named] : namesOf(part))
    {
        if (named == part)
        {
            return name;
        }
    }
    return {};
}

double partOf(const EnergyLedger& energy, EnergyPart part)
{
    switch (part)
    {
    case EnergyPart::kinetic:
        return energy.kinetic;
    case EnergyPart::potential:
        return energy.potential;
    case EnergyPart::mechanical:
        return energy.kinetic + energy.potential;
    case EnergyPart::frictionLoss:
        return energy.frictionLoss;
    case EnergyPart::dissipation:
        break;
    }
    return energy.frictionLoss + energy.impactLoss + energy.algorithmicLoss + energy.dampingLoss;
}

InstantFigure energyOf(EnergyPart part)
{
    return {"energy", "J", fmt::format("energy ({})", nameOf(part)),
            [part](const DynamicState<2>&, const Motion<2>& now) { return partOf(now.energy, part); }};
}

std::size_t freeBlock(const Assembly<2>& assembly, int block, const SourceLocation& location)
{
    const int count = static_cast<int>(assembly.blocks.size());
    if (block >= count)
    {
        throw FatalIOError(
            fmt::format("There is no block {}: the assembly has blocks 0 to {}.", block, count - 1),
            location);
    }
    const auto index = static_cast<std::size_t>(block);
    if (assembly.blocks[index].support >= 0)
    {
        throw FatalIOError(fmt::format("Block {} is fixed and never moves: name a free one.", block),
                           location);
    }
    return index;
}

void ReturnWatch::observe(const Motion<2>& motion, double timeStep)
{
    const double rotationNow = motion.state.placements[block].rotation;
    const double velocityNow = motion.state.velocity[row];
    if (side != 0 && side * rotationNow <= upright)
    {
        returnTimes.push_back(time + timeToUpright(timeStep));
        side = 0;
    }
    if (side == 0 && std::abs(rotationNow) > upright)
    {
        side = std::copysign(1.0, rotationNow);
        timeStep = 0; // the change of velocity by an impact is no acceleration
    }
    acceleration = timeStep > 0 ? (velocityNow - velocity) / timeStep : 0;
    time = motion.state.time;
    rotation = rotationNow;
    velocity = velocityNow;
}

/// The root of r + w t + a t^2/2 = 0 within the step.
double ReturnWatch::timeToUpright(double timeStep) const
{
    const double closing = -side * velocity;
    const double turn = side * rotation;
    const double root = std::sqrt(std::max(closing * closing + 2 * -side * acceleration * turn, 0.0));
    const double untilUpright = closing + root > 0 ? 2 * turn / (closing + root) : timeStep;
    return std::clamp(untilUpright, 0.0, timeStep);
}

} // namespace drystone
