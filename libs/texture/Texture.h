// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// system/blockTextureDict: the available textures and supports, and the structure they make.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"
#include "dictionary/Registry.h"
#include "texture/BlockZones.h"
#include "texture/Supports.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// The result of a texture.
template<int Dim>
struct Texture
{
    Assembly<Dim> assembly; ///< with supports of its own if it has any: an arch's abutments
    double unit = 1;        ///< the length of one unit: that of a full block [m], or 1 m
    /// Of a texture whose blocks are in a file: reads it, relative to the case directory. Empty for others,
    /// whose assembly is complete.
    std::function<Assembly<Dim>(const std::filesystem::path& caseDirectory)> readBlocks = {};
};

/// The textures that `texture { type ...; }` chooses from.
template<int Dim>
const Registry<Texture<Dim>>& textureTypes();
template<>
const Registry<Texture<2>>& textureTypes();
template<>
const Registry<Texture<3>>& textureTypes();

/// system/blockTextureDict.
template<int Dim>
struct BlockTexture
{
    int dimensions = Dim;
    Texture<Dim> texture;
    std::vector<Named<ZoneMaker<Dim>>> zones;
    std::vector<Named<SupportMaker<Dim>>> supports;
    std::optional<double> jointTolerance; ///< absent: what the digits of the coordinates require [m]
};

template<int Dim>
void declare(Options& options, BlockTexture<Dim>& blockTexture);

/// What `dimensions` says, 2 where it is absent: which of the two structures to make. \throws FatalIOError
/// when it is neither 2 nor 3
int dimensionsOf(const Dictionary& dictionary);

/// The structure that a dictionary describes, including its supports. \param caseDirectory of the files that
/// it names \throws FatalIOError for any fault in it, an empty texture and other `dimensions` than Dim
/// included, before anything is made
template<int Dim>
Assembly<Dim> makeStructure(const Dictionary& dictionary, const std::filesystem::path& caseDirectory);

} // namespace drystone
