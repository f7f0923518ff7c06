// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Supports that move in a prescribed way: constant/supportMotion.
///
///     right { direction (0 -1 0); displacement ((0 0) (2 0.05)); }      // settles 50 mm in 2 s
///     table { direction (1 0 0); velocity ((0 0) (0.5 1) (1 0)); }      // speeds up and slows down
#pragma once

#include "core/Options.h"
#include "dynamics/DynamicState.h"
#include "dynamics/GroundAcceleration.h"

#include <filesystem>

namespace drystone
{

/// What one entry says: a table of one of the two. Between its points it is linear; before the first and
/// after the last the support stands still.
struct SupportMotionSettings
{
    Vector<2> direction{1, 0};                           ///< of any length but zero
    std::vector<std::pair<double, double>> displacement; ///< times [s] and places [m]
    std::vector<std::pair<double, double>> velocity;     ///< times [s] and velocities [m/s]
};
void declare(Options& options, SupportMotionSettings& settings);

/// The whole file: an entry for each support that moves, under its name.
struct SupportMotionFile
{
    std::vector<std::pair<std::string, SupportMotionSettings>> supports;
};
void declare(Options& options, SupportMotionFile& file);

/// A support that moves without turning, relative to the ground.
struct SupportMotion
{
    int support = -1;                                   ///< index into Assembly::supports
    Vector<2> direction{1, 0};                          ///< unit vector
    std::shared_ptr<const GroundAcceleration> velocity; ///< the history of its velocity [m/s]: exact means
};

/// The supports of a case that move; none where the file is absent.
/// \throws FatalIOError for what is wrong with the file, or a name that no support has
std::vector<SupportMotion> readSupportMotions(const std::filesystem::path& caseDirectory,
                                              const Assembly<2>& assembly);

/// How each block is displaced between two instants because its support moves [m]; zero for all others. Empty
/// without motions.
std::vector<Vector<2>> supportDisplacements(const std::vector<SupportMotion>& motions,
                                            const Assembly<2>& assembly, double from, double to);

} // namespace drystone
