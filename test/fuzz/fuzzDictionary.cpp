// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Any text, read as a dictionary: it may only be rejected with a FatalError, and its printed form reads back
/// as the same.
#include "dictionary/Dictionary.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace
{

using namespace drystone;

template<class Value>
void tryReading(const Entry& entry)
{
    try
    {
        entry.as<Value>();
    }
    catch (const FatalError&)
    {
    }
}

void visit(const Dictionary& dictionary)
{
    for (const Entry& entry : dictionary.entries())
    {
        if (dictionary.find(entry.keyword()) == nullptr)
        {
            std::abort();
        }
        if (entry.isDictionary())
        {
            visit(entry.dictionary());
            continue;
        }
        tryReading<double>(entry);
        tryReading<int>(entry);
        tryReading<bool>(entry);
        tryReading<std::string>(entry);
        tryReading<std::array<double, 2>>(entry);
        tryReading<std::vector<std::vector<std::array<double, 2>>>>(entry);
        tryReading<std::vector<std::pair<double, double>>>(entry);
        tryReading<std::vector<Dictionary>>(entry);
    }
    dictionary.find("someKeyword");
    dictionary.findPath("some/key/word");
}

void readWith(std::string_view text, Expansion expansion)
{
    Dictionary dictionary;
    try
    {
        dictionary = Dictionary::readString(text, "fuzz", expansion);
    }
    catch (const FatalError&)
    {
        return;
    }
    visit(dictionary);
    if (expansion == Expansion::none)
    {
        return;
    }
    const std::string printed = toText(dictionary);
    try
    {
        const std::string again = toText(Dictionary::readString(printed, "printed", Expansion::all));
        if (again == printed)
        {
            return;
        }
        std::fprintf(stderr, "printed:\n%s\nprinted again:\n%s\n", printed.c_str(), again.c_str());
    }
    catch (const FatalError& error)
    {
        std::fprintf(stderr, "printed:\n%s\n%s\n", printed.c_str(), error.report().c_str());
    }
    std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    readWith(text, Expansion::all);
    readWith(text, Expansion::none);
    return 0;
}
