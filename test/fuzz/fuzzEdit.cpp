// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Any text edited as caseDictionary does: refused with a FatalError, or an entry that was set reads back,
/// and one that was removed is gone.
#include "core/Dictionary.h"
#include "core/DictionaryEdit.h"

#include "InputFile.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace drystone;
    const std::string text(reinterpret_cast<const char*>(data), size);
    for (const std::string path : {"deltaT", "texture/unit", "a/b/c"})
    {
        fuzz::tryReading(
            [&]
            {
                const std::string set = withEntrySet(text, "fuzz", path, "42");
                const Dictionary edited = Dictionary::readString(set, "fuzz", Expansion::none);
                const Entry* entry = edited.findPath(path);
                if (entry == nullptr || entry->as<int>() != 42)
                {
                    std::abort();
                }
            });
        fuzz::tryReading([&] { withEntryRemoved(text, "fuzz", path); });
    }
    return 0;
}
