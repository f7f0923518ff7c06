// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `import`: the blocks of a file that another program made.
#pragma once

#include "dictionary/Options.h"
#include "import/Drawing.h"
#include "import/SolidBlocks.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace drystone
{

enum class ImportFormat
{
    automatic, ///< by the ending of the file's name
    obj,
    ply,
    stl,
    compasJson,
    dxf,
    svg
};

inline std::array<std::pair<std::string_view, ImportFormat>, 7> namesOf(ImportFormat)
{
    return {{{"auto", ImportFormat::automatic},
             {"obj", ImportFormat::obj},
             {"ply", ImportFormat::ply},
             {"stl", ImportFormat::stl},
             {"compasJson", ImportFormat::compasJson},
             {"dxf", ImportFormat::dxf},
             {"svg", ImportFormat::svg}}};
}

template<int Dim>
struct Import;

template<>
struct Import<2>
{
    std::string file; ///< relative to the case directory
    ImportFormat format = ImportFormat::automatic;
    DrawingSettings drawing;
    ChordSettings chords;
};

template<>
struct Import<3>
{
    std::string file; ///< relative to the case directory
    ImportFormat format = ImportFormat::automatic;
    SolidSettings solid;
};

void declare(Options& options, Import<2>& settings);
void declare(Options& options, Import<3>& settings);

/// The blocks, all free, with zones. \throws FatalIOError at `place`, that of the entry `file`, when there is
/// no such file, or its format is not known or of the other dimension, and in the file for what is wrong with
/// it
Assembly<2> makeAssembly(const Import<2>& settings, const std::filesystem::path& caseDirectory,
                         const SourceLocation& place);
Assembly<3> makeAssembly(const Import<3>& settings, const std::filesystem::path& caseDirectory,
                         const SourceLocation& place);

} // namespace drystone
