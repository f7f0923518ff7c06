// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The formats of exportBlocks in one list: in the folder of its main, since they read more of a case than
/// the library `import`, which has their writers.
#pragma once

#include "import/export/Unwritten.h"
#include "import/export/Writers.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// What is to be written.
template<int Dim>
struct BlockExport
{
    const std::filesystem::path& caseDirectory;
    const Assembly<Dim>& assembly;
    std::string time = {}; ///< of the time directory where the blocks are; empty: as built
    std::vector<Placement<Dim>> placements = {}; ///< one a block, or none: as built
    std::vector<ExportedSolid> solids = {};      ///< the blocks there
    std::vector<SolidFrame> frames = {};         ///< of an animation, or none
    WrittenNumbers numbers = {};
};

template<int Dim>
struct ExportFormat
{
    std::string_view name;   ///< what -format says
    std::string_view ending; ///< of its files
    /// The file; says what a case has and the format can not have. \throws FatalIOError for faults of the
    /// case
    std::string (*text)(const BlockExport<Dim>& blocks);
    WrittenProperties written = {};        ///< of blocks as built
    bool takesDecimals = false;            ///< of -decimals
    bool takesFrames = false;              ///< of -animation
    bool hasDensities = false;             ///< solids with their densities
    std::string_view ofConcaveBlocks = ""; ///< what becomes of them; empty: they are blocks as others
};

template<int Dim>
const std::vector<ExportFormat<Dim>>& exportFormats();

} // namespace drystone
