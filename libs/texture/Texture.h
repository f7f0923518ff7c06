// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// system/blockTextureDict: the textures and supports to choose from, and the structure they make.
#pragma once

#include "assembly/Assembly.h"
#include "core/Options.h"
#include "core/Registry.h"
#include "texture/Supports.h"

#include <string>
#include <vector>

namespace drystone
{

/// What a texture makes.
struct Texture
{
    Assembly<2> assembly; ///< with supports of its own if it has any: an arch's abutments
    double unit = 1;      ///< what lengths in units refer to: that of a full block [m], or 1 m
};

/// The textures that `texture { type ...; }` chooses from.
const Registry<Texture>& textureTypes();

/// system/blockTextureDict.
struct BlockTexture
{
    int dimensions = 2;
    Texture texture;
    std::vector<Named<SupportMaker>> supports;
};

void declare(Options& options, BlockTexture& blockTexture);

/// The structure that a dictionary describes, supports and all. \throws FatalIOError for whatever is wrong in
/// it, an empty texture included, before anything is made
Assembly<2> makeStructure(const Dictionary& dictionary);

} // namespace drystone
