// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the fuzz targets of imported files have in common: the bytes as a file, and blocks that must be
/// sound.
#pragma once

#include "InputFile.h"

#include "import/Drawing.h"
#include "import/SolidBlocks.h"

#include <cstdint>
#include <cstdlib>

namespace drystone::fuzz
{

inline ImportedFile imported(const std::uint8_t* data, std::size_t size)
{
    return {"fuzz", std::string(reinterpret_cast<const char*>(data), size)};
}

template<int Dim>
void requireSound(const Assembly<Dim>& assembly)
{
    if (assembly.blocks.empty())
    {
        std::abort();
    }
    for (const BlockMass<Dim>& mass : blockMasses(assembly))
    {
        if (!(mass.volume > 0) || !mass.centroid.allFinite())
        {
            std::abort();
        }
    }
}

/// Rejected with a FatalError, or made into blocks.
template<class Read>
void readSolids(const Read& read, const std::uint8_t* data, std::size_t size)
{
    tryReading(
        [&]
        {
            const ImportedFile file = imported(data, size);
            const Solids solids = read(file);
            tryReading([&] { requireSound(solidBlocks(solids, {}, file)); });
            SolidSettings settings;
            settings.tolerance = 0.01;
            settings.interfaces = Interfaces::contacts;
            tryReading([&] { requireSound(solidBlocks(solids, settings, file)); });
        });
}

template<class Read>
void readDrawing(const Read& read, const std::uint8_t* data, std::size_t size)
{
    tryReading(
        [&]
        {
            const ImportedFile file = imported(data, size);
            requireSound(drawnBlocks(read(file), {}, file));
        });
}

} // namespace drystone::fuzz
