// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether blocks can start where 0/motion or an edited state puts them, and where they were built.
#pragma once

#include "assembly/Assembly.h"
#include "dynamics/DynamicCase.h"
#include "dynamics/InitialMotion.h"
#include "runControl/TimeControls.h"

namespace drystone
{

/// Radians or block sizes in a step that are no motion but a mistake in writing.
inline constexpr double mostInAStep = 1e9;

enum class JointStiffness
{
    rigid,
    elastic
};

/// Refuses a start inside another block: motion has no answer to it, and would part the blocks or let them
/// fall through each other. Blocks may be 1e-6 of the mean block size in each other, and as deep as they were
/// built. Elastic joints press out of each other what is deeper, from their settlement under loads, say: up
/// to a quarter of a block that is warned of. \param places of InitialState; nothing is checked where there
/// are none \throws FatalIOError with both blocks and the depth, at the line of the block that is displaced
template<int Dim>
void refuseStartOverlaps(const Assembly<Dim>& assembly, const std::vector<Placement<Dim>>& placements,
                         const std::vector<SourceLocation>& places, JointStiffness joints);

/// Refuses the places of a state that was edited where a run leaves no blocks: deeper in each other than
/// motion allows, or fixed ones that nothing moves away from where they were built.
/// \param place of the state \throws FatalIOError with the blocks
template<int Dim>
void refuseEditedPlaces(const DynamicCase<Dim>& scene, const std::vector<Placement<Dim>>& placements,
                        const SourceLocation& place);

/// Warns of a rotation beyond a quarter of a turn, which looks like degrees.
template<int Dim>
void questionRotation(const BlockStart<Dim>& start, const SourceLocation& place);

/// Warns of the block that turns by more than a radian, or moves by more than a mean block size, in a step
/// of deltaT: whatever it meets in between is not seen. With adjustTimeStep the first step is chosen shorter.
/// \throws FatalIOError where it is so far that nothing can be computed, as of a velocity of 1e200 m/s
template<int Dim>
void questionSpeeds(const Assembly<Dim>& assembly, const InitialState<Dim>& start,
                    const TimeControls& controls);

/// Warns of a block next to one so heavy that what it weighs is in the tolerance of the solver: it hovers.
template<int Dim>
void questionMasses(const DynamicCase<Dim>& scene);

/// Warns of coordinates so large that gaps between blocks are rounding: of maps, say.
template<int Dim>
void questionDigits(const DynamicCase<Dim>& scene);

} // namespace drystone
