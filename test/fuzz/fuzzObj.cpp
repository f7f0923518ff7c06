// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Any bytes, read as Wavefront OBJ: rejected with a FatalError, or sound blocks.
#include "ImportedBlocks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace drystone;
    fuzz::readSolids(readObj, data, size);
    return 0;
}
