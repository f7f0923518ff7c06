// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// system/blockTextureDict: the available textures and supports, and the structure they make.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"
#include "dictionary/Registry.h"
#include "texture/Supports.h"

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// The result of a texture.
struct Texture
{
    Assembly<2> assembly; ///< with supports of its own if it has any: an arch's abutments
    double unit = 1;      ///< the length of one unit: that of a full block [m], or 1 m
};

/// The textures that `texture { type ...; }` chooses from.
const Registry<Texture>& textureTypes();

/// system/blockTextureDict.
struct BlockTexture
{
    int dimensions = 2;
    Texture texture;
    std::vector<Named<SupportMaker>> supports;
    std::optional<double> jointTolerance; ///< absent: what the digits of the coordinates ask for [m]
};

void declare(Options& options, BlockTexture& blockTexture);

/// The structure that a dictionary describes, including its supports. \throws FatalIOError for any fault in
/// it, an empty texture included, before anything is made
Assembly<2> makeStructure(const Dictionary& dictionary);

} // namespace drystone
