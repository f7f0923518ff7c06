// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A sound case in which one file is any text, named by the first character (see SoundCase). The readers of
/// each application may only reject it with a FatalError.
#include "SoundCase.h"

#include "dynamics/DynamicCase.h"
#include "dynamics/InitialMotion.h"
#include "runControl/Time.h"
#include "statics/LimitAnalysisCase.h"

#include <array>
#include <cstdint>

namespace
{

constexpr auto files = drystone::fuzz::joined(
    drystone::fuzz::blockOnGround, std::array<drystone::fuzz::CaseFile, 6>{
                                       {{"constant/groundMotion", ""},
                                        {"system/controlDict", "deltaT 0.01; endTime 1; writeInterval 1;\n"},
                                        {"system/schemes", ""},
                                        {"system/solution", ""},
                                        {"0/motion", ""},
                                        {"constant/supportMotion", ""}}});

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace drystone;
    static const fuzz::SoundCase sound(files);
    const auto changed = sound.replaceOne({reinterpret_cast<const char*>(data), size});
    if (!changed)
    {
        return 0;
    }
    fuzz::tryReading([&] { readLimitAnalysisCase<2>(sound.path()); });
    fuzz::tryReading([&] { readLimitAnalysisCase<3>(sound.path()); });
    fuzz::tryReading([&] { Time time(sound.path()); });
    fuzz::tryReading(
        [&]
        {
            const DynamicCase<2> scene = readDynamicCase<2>(sound.path());
            readInitialMotion(sound.path(), "0", scene.assembly);
        });
    sound.restore(files[*changed]);
    return 0;
}
