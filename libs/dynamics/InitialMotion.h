// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How blocks start: 0/motion.
///
///     0         { displacement (0.01 0); rotation 0.1; }      // block 0
///     1         { rotation 0.1; about (0.25 0); }             // tilted about a corner
///     "[3-5]"   { velocity (1 0); angularVelocity -0.2; }     // blocks 3, 4 and 5
///
/// In space vectors have three components: rotation is a rotation vector, angularVelocity along its axis.
#pragma once

#include "dictionary/Options.h"
#include "dynamics/DynamicState.h"
#include "geometry/Rotation.h"

#include <array>
#include <filesystem>
#include <optional>

namespace drystone
{

/// What one entry gives to the blocks it names.
template<int Dim>
struct BlockStart
{
    Vector<Dim> displacement = Vector<Dim>::Zero(); ///< of the mass centre [m]
    Turn<Dim> rotation = noTurn<Dim>();             ///< [rad]
    std::optional<Vector<Dim>> about = {};          ///< point of the block, as built, that it turns about
                                                    ///< before it is displaced [m]; absent: its mass centre
    Vector<Dim> velocity = Vector<Dim>::Zero();     ///< of the mass centre, relative to the ground [m/s]
    Turn<Dim> angularVelocity = noTurn<Dim>();      ///< [rad/s]
};
template<int Dim>
void declare(Options& options, BlockStart<Dim>& start);

/// The whole file. A block takes the entry with its index; without one, the last pattern that matches.
template<int Dim>
struct InitialMotion
{
    std::vector<std::pair<NamePattern, BlockStart<Dim>>> blocks;
};
template<int Dim>
void declare(Options& options, InitialMotion<Dim>& motion);

/// A state as it is read.
template<int Dim>
struct InitialState
{
    DynamicState<Dim> state;
    std::vector<SourceLocation>
        places; ///< of the entry of each block, or of the file; empty where it is absent
};

/// The state at the time of `<case>/<time name>/motion`: as built and at rest where the file is absent.
/// \throws FatalIOError for what is wrong with the file, an index without a block, a pattern that no block
/// matches, a support that is given a motion
template<int Dim>
InitialState<Dim> readInitialMotion(const std::filesystem::path& caseDirectory, const std::string& timeName,
                                    const Assembly<Dim>& assembly);

} // namespace drystone
