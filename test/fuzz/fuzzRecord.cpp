// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Any text, read as a record of ground motion: rejected with a FatalError, or finite and in order.
#include "InputFile.h"

#include "timeSeries/Record.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace
{

using namespace drystone;

void check(const Record& record)
{
    if (record.times.empty() || record.times.size() != record.accelerations.size())
    {
        std::abort();
    }
    for (std::size_t i = 0; i < record.times.size(); ++i)
    {
        if (!std::isfinite(record.times[i]) || !std::isfinite(record.accelerations[i])
            || (i > 0 && !(record.times[i] > record.times[i - 1])))
        {
            std::abort();
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::Folder folder;
    const auto file = folder.path / "record";
    fuzz::write(file, std::string_view(reinterpret_cast<const char*>(data), size));
    fuzz::tryReading([&] { check(readPeerRecord(file)); });
    fuzz::tryReading([&] { check(readPeerRecord(file, "g")); });
    fuzz::tryReading([&] { check(readCsvRecord(file, {})); });
    fuzz::tryReading([&] { check(readCsvRecord(file, {.timeStep = 0.01, .unit = "m/s2"})); });
    fuzz::tryReading([&] { check(readCsvRecord(file, {0, std::string("acceleration"), 0, "g"})); });
    return 0;
}
