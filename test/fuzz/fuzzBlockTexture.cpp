// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Any text, read as system/blockTextureDict: rejected with a FatalError, or a structure whose file reads
/// back.
#include "../MadeStructure.h"
#include "InputFile.h"

#include "assembly/AssemblyFile.h"
#include "texture/Texture.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace drystone;
    static const fuzz::Folder folder;
    fuzz::tryReading(
        [&]
        {
            const std::string_view text(reinterpret_cast<const char*>(data), size);
            const Dictionary dictionary = Dictionary::readString(text, "fuzz");
            const bool isEmpty = dimensionsOf(dictionary) == 3 ? madeStructure<3>(dictionary).blocks.empty()
                                                               : madeStructure<2>(dictionary).blocks.empty();
            if (isEmpty)
            {
                std::abort();
            }
        });
    return 0;
}
