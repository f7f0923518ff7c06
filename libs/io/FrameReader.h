// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads back what Frames.h wrote: where the blocks are in each frame of an animation. It is meant for files
/// that Drystone wrote and not for those of others.
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// Displacement of each block in one frame; NaN of a block that the frame does not show, since it was
/// deleted.
struct BlockFrame
{
    double time = 0; ///< [s], of a mechanism its part from 0 to 1
    Eigen::Matrix3Xd
        displacement;          ///< of the mass centres, a column for each block; of the plane with z = 0 [m]
    Eigen::Matrix3Xd rotation; ///< rotation vectors; of the plane about z [rad]
};

/// Frames of `<folder>/<name>.vtp.series`, at most `most` of them, first and last included, evenly chosen.
/// \param blocks of the assembly that they show \throws FatalError for a file that cannot be read or shows
/// other blocks
std::vector<BlockFrame> readBlockFrames(const std::filesystem::path& folder, const std::string& name,
                                        std::size_t blocks, std::size_t most);

} // namespace drystone
