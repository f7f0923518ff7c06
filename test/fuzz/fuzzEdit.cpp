// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Any text, edited as by caseDictionary: rejected with a FatalError, or an entry that was set reads back,
/// and one that was removed is absent.
#include "dictionary/Dictionary.h"
#include "dictionary/DictionaryEdit.h"

#include "InputFile.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace
{

/// Whether a path exists by its own names, not by patterns that match them.
bool isThere(const drystone::Dictionary& dictionary, std::string_view path)
{
    const std::size_t slash = path.find('/');
    const drystone::Entry* entry = dictionary.findExact(path.substr(0, slash));
    return entry != nullptr
           && (slash == std::string_view::npos
               || (entry->isDictionary() && isThere(entry->dictionary(), path.substr(slash + 1))));
}

} // namespace

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
                if (entry == nullptr || entry->isDictionary() || entry->valueText() != "42")
                {
                    std::abort();
                }
            });
        fuzz::tryReading(
            [&]
            {
                const std::string without = withEntryRemoved(text, "fuzz", path);
                if (isThere(Dictionary::readString(without, "fuzz", Expansion::none), path))
                {
                    std::abort();
                }
            });
    }
    return 0;
}
