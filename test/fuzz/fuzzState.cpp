// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Any bytes, read as the state of a run: rejected with a FatalError, or written in either format and read
/// back as the same.
#include "InputFile.h"

#include "io/TimeDirectory.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace drystone;
    static const fuzz::Folder folder;
    const auto file = folder.path / "state";
    fuzz::write(file, std::string_view(reinterpret_cast<const char*>(data), size));
    bool isRead = false;
    State state;
    fuzz::tryReading(
        [&]
        {
            state = readState(file);
            isRead = true;
        });
    if (isRead)
    {
        for (const WriteFormat format : {WriteFormat::ascii, WriteFormat::binary})
        {
            fuzz::tryReading( // a value that is not finite is not written
                [&]
                {
                    const std::string text = stateText(state, format);
                    fuzz::write(file, text);
                    const State again = readState(file);
                    if (again.scalars != state.scalars || again.arrays != state.arrays
                        || again.texts != state.texts)
                    {
                        std::abort();
                    }
                });
        }
    }
    return 0;
}
