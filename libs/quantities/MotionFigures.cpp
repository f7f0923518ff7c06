// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Figures of single blocks and of all, taken from placements, velocities and the ledger of energy.
#include "quantities/MotionFigures.h"

#include "assembly/BlockShape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// The blocks that a figure is taken over: the one that is named, or all free ones.
template<int Dim>
std::vector<int> watchedBlocks(const Assembly<Dim>& assembly, std::optional<int> block,
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
template<int Dim, class Figure>
auto largestOver(std::vector<int> blocks, Figure figure)
{
    return [blocks = std::move(blocks), figure](const DynamicState<Dim>& start, const Motion<Dim>& now)
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

template<int Dim>
InstantFigure<Dim> farthestCorner(const Assembly<Dim>& assembly, const SourceLocation& location)
{
    // One a block: its corners as built, from its mass centre.
    std::vector<std::vector<Vector<Dim>>> arms;
    for (const Block<Dim>& block : assembly.blocks)
    {
        const Vector<Dim> centre = blockMass(block).centroid;
        arms.push_back(cornersOf(block));
        for (Vector<Dim>& corner : arms.back())
        {
            corner -= centre;
        }
    }
    InstantFigure<Dim> figure{"displacement", "m", "displacement of any corner", {}};
    figure.at =
        largestOver<Dim>(watchedBlocks(assembly, {}, location),
                         [arms](std::size_t block, const Placement<Dim>& start, const Placement<Dim>& now)
                         {
                             double farthest = 0;
                             for (const Vector<Dim>& arm : arms[block])
                             {
                                 const Vector<Dim> way = now.translation - start.translation
                                                         + swing(now.rotation, arm)
                                                         - swing(start.rotation, arm);
                                 farthest = std::max(farthest, way.norm());
                             }
                             return farthest;
                         });
    return figure;
}

template<int Dim>
InstantFigure<Dim> displacementOf(const Assembly<Dim>& assembly, std::optional<int> block,
                                  const SourceLocation& location)
{
    InstantFigure<Dim> figure{"displacement", "m", "displacement of " + nameOf(block), {}};
    figure.at = largestOver<Dim>(watchedBlocks(assembly, block, location),
                                 [](std::size_t, const Placement<Dim>& start, const Placement<Dim>& now)
                                 { return (now.translation - start.translation).norm(); });
    return figure;
}

template<int Dim>
Vector<Dim> unitDirection(const std::array<double, 3>& direction, const SourceLocation& location)
{
    const Vector<Dim> inSpace = Eigen::Map<const Vector<3>>(direction.data()).head<Dim>();
    if (!(inSpace.norm() > 0))
    {
        throw FatalIOError(
            fmt::format("The direction has no length in {}.", Dim == 2 ? "the plane" : "space"), location);
    }
    if (Dim == 2 && direction[2] != 0)
    {
        throw FatalIOError("The third component of direction must be 0: the structure lies in the x-y plane.",
                           location);
    }
    return inSpace.stableNormalized();
}

template<int Dim>
InstantFigure<Dim> displacementAlong(const Assembly<Dim>& assembly, int block, const Vector<Dim>& direction,
                                     const SourceLocation& location)
{
    const std::size_t index = freeBlock(assembly, block, location);
    const std::string along =
        Dim == 2 ? fmt::format("({:g} {:g})", direction[0], direction[1])
                 : fmt::format("({:g} {:g} {:g})", direction[0], direction[1], direction[Dim - 1]);
    return {"displacement", "m", fmt::format("displacement of block {} along {}", block, along),
            [index, direction](const DynamicState<Dim>& start, const Motion<Dim>& now) {
                return direction.dot(now.state.placements[index].translation
                                     - start.placements[index].translation);
            }};
}

template<int Dim>
InstantFigure<Dim> rotationOf(const Assembly<Dim>& assembly, std::optional<int> block,
                              const SourceLocation& location)
{
    InstantFigure<Dim> figure{"rotation", "rad", "rotation of " + nameOf(block), {}};
    figure.at = largestOver<Dim>(watchedBlocks(assembly, block, location),
                                 [](std::size_t, const Placement<Dim>& start, const Placement<Dim>& now)
                                 { return rowsOf(turnBetween(start.rotation, now.rotation)).norm(); });
    return figure;
}

template<int Dim>
InstantFigure<Dim> dropOf(const Assembly<Dim>& assembly, std::optional<int> block,
                          const SourceLocation& location)
{
    InstantFigure<Dim> figure{"drop", "m", "drop of " + nameOf(block), {}};
    figure.at = largestOver<Dim>(watchedBlocks(assembly, block, location),
                                 [](std::size_t, const Placement<Dim>& start, const Placement<Dim>& now)
                                 { return start.translation[Dim - 1] - now.translation[Dim - 1]; });
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

template<int Dim>
InstantFigure<Dim> energyOf(EnergyPart part)
{
    return {"energy", "J", fmt::format("energy ({})", nameOf(part)),
            [part](const DynamicState<Dim>&, const Motion<Dim>& now) { return partOf(now.energy, part); }};
}

template<int Dim>
std::size_t freeBlock(const Assembly<Dim>& assembly, int block, const SourceLocation& location)
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

template InstantFigure<2> farthestCorner(const Assembly<2>& assembly, const SourceLocation& location);
template InstantFigure<2> displacementOf(const Assembly<2>& assembly, std::optional<int> block,
                                         const SourceLocation& location);
template Vector<2> unitDirection<2>(const std::array<double, 3>& direction, const SourceLocation& location);
template InstantFigure<2> displacementAlong(const Assembly<2>& assembly, int block,
                                            const Vector<2>& direction, const SourceLocation& location);
template InstantFigure<2> rotationOf(const Assembly<2>& assembly, std::optional<int> block,
                                     const SourceLocation& location);
template InstantFigure<2> dropOf(const Assembly<2>& assembly, std::optional<int> block,
                                 const SourceLocation& location);
template InstantFigure<2> energyOf(EnergyPart part);
template std::size_t freeBlock(const Assembly<2>& assembly, int block, const SourceLocation& location);

template InstantFigure<3> farthestCorner(const Assembly<3>& assembly, const SourceLocation& location);
template InstantFigure<3> displacementOf(const Assembly<3>& assembly, std::optional<int> block,
                                         const SourceLocation& location);
template Vector<3> unitDirection<3>(const std::array<double, 3>& direction, const SourceLocation& location);
template InstantFigure<3> displacementAlong(const Assembly<3>& assembly, int block,
                                            const Vector<3>& direction, const SourceLocation& location);
template InstantFigure<3> rotationOf(const Assembly<3>& assembly, std::optional<int> block,
                                     const SourceLocation& location);
template InstantFigure<3> dropOf(const Assembly<3>& assembly, std::optional<int> block,
                                 const SourceLocation& location);
template InstantFigure<3> energyOf(EnergyPart part);
template std::size_t freeBlock(const Assembly<3>& assembly, int block, const SourceLocation& location);

} // namespace drystone
