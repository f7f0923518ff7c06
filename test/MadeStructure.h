// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Structures of dictionaries that name no files, in the plane unless stated. Header only: targets that
/// include it link texture.
#pragma once

#include "texture/Texture.h"

namespace drystone
{

template<int Dim = 2>
Assembly<Dim> madeStructure(const Dictionary& dictionary)
{
    return makeStructure<Dim>(dictionary, ".");
}

} // namespace drystone
