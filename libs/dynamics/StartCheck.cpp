// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Checks of 0/motion, and of edited states, against the blocks.
#include "dynamics/StartCheck.h"

#include "assembly/BlockShape.h"
#include "contact/AlmostJoints.h"
#include "contact/MovingContacts.h"
#include "contact/Penetration.h"
#include "core/Degrees.h"
#include "core/Log.h"
#include "geometry/WholeMetres.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace drystone
{
namespace
{

template<int Dim>
bool isDisplaced(const Placement<Dim>& placement)
{
    return !rowsOf(placement.rotation).isZero(0) || !placement.translation.isZero(0);
}

} // namespace

template<int Dim>
void refuseStartOverlaps(const Assembly<Dim>& assembly, const std::vector<Placement<Dim>>& placements,
                         const std::vector<SourceLocation>& places, JointStiffness joints)
{
    if (places.empty())
    {
        return;
    }
    const double asBuilt = penetration(assembly, std::vector<Placement<Dim>>(assembly.blocks.size())).depth;
    const Penetration deepest = penetration(assembly, placements);
    if (deepest.depth <= asBuilt + CheckLimits{}.jointTolerance * meanBlockSize(assembly))
    {
        return;
    }
    const int displaced = isDisplaced(placements[deepest.block]) ? deepest.block : deepest.neighbour;
    const int other = displaced == deepest.block ? deepest.neighbour : deepest.block;
    if (joints == JointStiffness::elastic && deepest.depth <= mayEnterElastic * meanBlockSize(assembly))
    {
        printWarning(
            fmt::format(
                "At the start {} is {:.3g} m deep in {}: elastic joints are pressed together by that. "
                "What is deeper than their forces hold at rest springs apart.",
                blockName(assembly, displaced), deepest.depth, blockName(assembly, other)),
            places[static_cast<std::size_t>(displaced)]);
        return;
    }
    throw FatalIOError(
        fmt::format(
            "At the start {} is {:.3g} m deep in {}. Blocks may touch, but not share space: correct "
            "displacement and rotation. A block that starts tilted about one of its corners has no "
            "displacement but, besides its rotation, `about ({});`, the place of that corner as built.",
            blockName(assembly, displaced), deepest.depth, blockName(assembly, other),
            Dim == 2 ? "x y" : "x y z"),
        places[static_cast<std::size_t>(displaced)]);
}

template<int Dim>
void refuseEditedPlaces(const DynamicCase<Dim>& scene, const std::vector<Placement<Dim>>& placements,
                        const SourceLocation& place)
{
    const Assembly<Dim>& assembly = scene.assembly;
    const EffectTraits traits = traitsOf(scene.effects);
    for (std::size_t block = 0; block < placements.size(); ++block)
    {
        if (assembly.blocks[block].support >= 0 && !traits.movesSupports && isDisplaced(placements[block]))
        {
            throw FatalIOError(
                fmt::format("In this state {} is not where it was built, though constant/supportMotion moves "
                            "no support.\n\nCorrect its translation and rotation, which are 0.",
                            blockName(assembly, static_cast<int>(block))),
                place);
        }
    }
    // The geometry is the one as built, or blocks that left the box lie where they did, whatever is there.
    const std::vector<std::string>& simulated = scene.effectNames.simulated;
    if (scene.schemes.smallDisplacements
        || std::find(simulated.begin(), simulated.end(), "deletion") != simulated.end())
    {
        return;
    }
    const double asBuilt = penetration(assembly, std::vector<Placement<Dim>>(assembly.blocks.size())).depth;
    const double share = traits.isCompliant ? mayEnterElastic : MovingContactOptions{}.mayEnter;
    const Penetration deepest = penetration(assembly, placements);
    if (deepest.depth > asBuilt + share * meanBlockSize(assembly))
    {
        throw FatalIOError(
            fmt::format("In this state {} is {:.3g} m deep in {}. Blocks may touch, but not share "
                        "space.\n\nCorrect translation and rotation, or remove the time "
                        "directory to start from an earlier one.",
                        blockName(assembly, deepest.block), deepest.depth,
                        blockName(assembly, deepest.neighbour)),
            place);
    }
}

template<int Dim>
void questionRotation(const BlockStart<Dim>& start, const SourceLocation& place)
{
    double angle = 0;
    if constexpr (Dim == 2)
    {
        angle = start.rotation;
    }
    else
    {
        angle = start.rotation.norm();
    }
    if (std::abs(angle) > std::numbers::pi / 2)
    {
        printWarning(
            doubtAboutDegrees(angle, Dim == 2 ? "rotation " : "rotation (0 0 ", Dim == 2 ? ";" : ");"),
            place);
    }
}

template<int Dim>
void questionSpeeds(const Assembly<Dim>& assembly, const InitialState<Dim>& start,
                    const TimeControls& controls)
{
    if (start.places.empty())
    {
        return;
    }
    const double deltaT = controls.deltaT;
    const double size = meanBlockSize(assembly);
    const std::vector<int> free = freeIndices(assembly);
    std::string fastest;
    double worst = 1; // radians or block sizes
    SourceLocation place;
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] < 0)
        {
            continue;
        }
        const auto velocity =
            start.state.velocity.template segment<freedomCount<Dim>>(freedomCount<Dim> * free[block]);
        const double way = velocity.template head<Dim>().norm() * deltaT;
        const double turn = velocity.template tail<freedomCount<Dim> - Dim>().norm() * deltaT;
        if (std::max(turn, way / size) > worst)
        {
            worst = std::max(turn, way / size);
            fastest = turn > way / size
                          ? fmt::format("turns by {:.3g} rad", turn)
                          : fmt::format("moves by {:.3g} m, {:.3g} mean block sizes,", way, way / size);
            fastest = fmt::format("Block {} {}", block, fastest);
            place = start.places[block];
        }
    }
    if (worst > mostInAStep)
    {
        throw FatalIOError(fmt::format("{} in a step of deltaT {:g} s: nothing of its motion could be "
                                       "computed. Give a velocity that a block can have.",
                                       fastest, deltaT),
                           place);
    }
    if (!fastest.empty() && !controls.adjustTimeStep)
    {
        printWarning(
            fmt::format("{} in a step of deltaT {:g} s: what it meets within a step is not seen. Usual "
                        "is a small part of a radian and of a block: give a deltaT of at most {:.1g} s, or "
                        "`adjustTimeStep yes;`.",
                        fastest, deltaT, 0.1 * deltaT / worst),
            place);
    }
}

template void questionSpeeds(const Assembly<2>& assembly, const InitialState<2>& start,
                             const TimeControls& controls);
template void questionSpeeds(const Assembly<3>& assembly, const InitialState<3>& start,
                             const TimeControls& controls);
template<int Dim>
void questionDigits(const DynamicCase<Dim>& scene)
{
    constexpr double noticeable =
        1e-3; // of the error allowed in gaps: a wall has moved by 2e-5 m of 4 cm otherwise
    const Box<Dim> whole = boundingBox(scene.assembly);
    const double largest = std::max(whole.lower.template lpNorm<Eigen::Infinity>(),
                                    whole.upper.template lpNorm<Eigen::Infinity>());
    const double next = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
    const double allowed = scene.schemes.contactTolerance * scene.blockSize;
    if (scene.mass.size() == 0)
    {
        printWarning("All blocks are fixed, and nothing moves: state supports of some of them only in "
                     "system/blockTextureDict, and run blockTexture again.");
    }
    else if (next > noticeable * allowed)
    {
        printWarning(fmt::format(
            "Coordinates of up to {:.3g} m have neighbours {:.1e} m apart, {:.2g} of "
            "the error that contactTolerance "
            "allows in gaps ({:.1e} m): steps may find no solution, or another. Take a "
            "constant off all coordinates of "
            "the structure, as off those of a map, so that it is near 0: for an imported "
            "file `offset {};` in the texture of system/blockTextureDict does.",
            largest, next, next / allowed, allowed, inWholeMetres<Dim>(-(whole.lower + whole.upper) / 2)));
    }
}

template<int Dim>
void questionMasses(const DynamicCase<Dim>& scene)
{
    // Of the lightest block. Tilted by 0.2 rad, it rocks as alone to 1e-5 with 3e-4 of it, and with 1e-2
    // stays where it is.
    constexpr double noticeable = 1e-3;
    constexpr double usual = 1e4; // ratios of masses up to here are no matter, however loose the tolerance
    constexpr double closest = 1e-12;
    int lightest = -1;
    int heaviest = -1;
    const auto massOf = [&scene](int block)
    { return scene.mass[freedomCount<Dim> * scene.free[static_cast<std::size_t>(block)]]; };
    for (std::size_t i = 0; i < scene.free.size(); ++i)
    {
        if (scene.free[i] < 0)
        {
            continue;
        }
        const int block = static_cast<int>(i);
        lightest = lightest < 0 || massOf(block) < massOf(lightest) ? block : lightest;
        heaviest = heaviest < 0 || massOf(block) > massOf(heaviest) ? block : heaviest;
    }
    if (lightest < 0)
    {
        return;
    }
    const double ratio = massOf(heaviest) / massOf(lightest);
    const double tolerance = scene.solution.tolerance;
    if (ratio > usual && ratio * tolerance > noticeable)
    {
        printWarning(fmt::format(
            "Block {} has a mass of {:.3g} kg, block {} is {:.2g} times as heavy: the tolerance of the "
            "solver, {:g} of the forces, is {:.2g} of what the light one weighs, so that it may hover. "
            "Make supports of the heavy blocks{}.",
            lightest, massOf(lightest), heaviest, ratio, tolerance, ratio * tolerance,
            noticeable / ratio >= closest ? fmt::format(
                ", or set `tolerance {:.1g};` for contactDynamics in system/solution", noticeable / ratio)
                                          : ""));
    }
}

template void questionMasses(const DynamicCase<2>& scene);
template void questionMasses(const DynamicCase<3>& scene);
template void questionDigits(const DynamicCase<2>& scene);
template void questionDigits(const DynamicCase<3>& scene);
template void refuseStartOverlaps(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                                  const std::vector<SourceLocation>& places, JointStiffness joints);
template void refuseStartOverlaps(const Assembly<3>& assembly, const std::vector<Placement<3>>& placements,
                                  const std::vector<SourceLocation>& places, JointStiffness joints);
template void refuseEditedPlaces(const DynamicCase<2>& scene, const std::vector<Placement<2>>& placements,
                                 const SourceLocation& place);
template void refuseEditedPlaces(const DynamicCase<3>& scene, const std::vector<Placement<3>>& placements,
                                 const SourceLocation& place);
template void questionRotation(const BlockStart<2>& start, const SourceLocation& place);
template void questionRotation(const BlockStart<3>& start, const SourceLocation& place);

} // namespace drystone
