// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How blocks start: 0/motion.
///
///     0         { displacement (0.01 0); rotation 0.1; }      // block 0
///     1         { rotation 0.1; about (0.25 0); }             // tilted about a corner
///     "[3-5]"   { velocity (1 0); angularVelocity -0.2; }     // blocks 3, 4 and 5
#pragma once

#include "dictionary/Options.h"
#include "dynamics/DynamicState.h"

#include <array>
#include <filesystem>
#include <optional>

namespace drystone
{

/// What one entry gives to the blocks it names.
struct BlockStart
{
    Vector<2> displacement = Vector<2>::Zero();      ///< of the mass centre [m]
    double rotation = 0;                             ///< [rad], positive counter-clockwise
    std::optional<std::array<double, 2>> about = {}; ///< point of the block, as built, that it turns about
                                                     ///< before it is displaced [m]; absent: its mass centre
    Vector<2> velocity = Vector<2>::Zero();          ///< of the mass centre, relative to the ground [m/s]
    double angularVelocity = 0;                      ///< [rad/s]
};
void declare(Options& options, BlockStart& start);

/// The whole file. A block takes the entry with its index; without one, the last pattern that matches.
struct InitialMotion
{
    std::vector<std::pair<NamePattern, BlockStart>> blocks;
};
void declare(Options& options, InitialMotion& motion);

/// A state as it is read.
struct InitialState
{
    DynamicState state;
    std::vector<SourceLocation>
        places; ///< of the entry of each block, or of the file; empty where it is absent
};

/// The state at the time of `<case>/<time name>/motion`: as built and at rest where the file is absent.
/// \throws FatalIOError for what is wrong with the file, an index without a block, a pattern that no block
/// matches, a support that is given a motion
InitialState readInitialMotion(const std::filesystem::path& caseDirectory, const std::string& timeName,
                               const Assembly<2>& assembly);

} // namespace drystone
