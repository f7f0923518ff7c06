// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Any text, read as a cone program: rejected with a FatalError, or written and read back as the same text.
#include "InputFile.h"

#include "conic/ProgramFile.h"

#include <cstdint>
#include <cstdlib>

namespace
{

using namespace drystone;

std::string textOf(const AnyConeProgram& program)
{
    return std::visit([](const auto& some) { return programText(some); }, program);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::Folder folder;
    const auto file = folder.path / "coneProgram";
    fuzz::write(file, std::string_view(reinterpret_cast<const char*>(data), size));
    std::string text;
    fuzz::tryReading([&] { text = textOf(readProgram(file)); });
    if (!text.empty())
    {
        fuzz::write(file, text);
        if (textOf(readProgram(file)) != text)
        {
            std::abort();
        }
    }
    return 0;
}
