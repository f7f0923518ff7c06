// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A sound case in which one file is any text: the first character, a digit, says which. Reading the case for
/// each application may only be refused with a FatalError.
#include "InputFile.h"

#include "core/Time.h"
#include "dynamics/DynamicCase.h"
#include "dynamics/InitialMotion.h"
#include "statics/LimitAnalysisCase.h"

#include <array>
#include <cstdint>

namespace
{

using namespace drystone;

struct CaseFile
{
    std::string_view name;
    std::string_view text; ///< of the sound case; empty: absent
};

constexpr std::array<CaseFile, 10> files{
    {{"constant/assembly/blocks",
      "dimensions 2; thickness 1; supports { ground { type blocks; blocks (0); } }\n"
      "outlines ( ((-2 -1) (2 -1) (2 0) (-2 0)) ((0 0) (1 0) (1 1) (0 1)) );\n"},
     {"constant/g", "value (0 -9.81 0);\n"},
     {"constant/materialProperties", "density 2000;\n"},
     {"constant/contactProperties", "friction { type Coulomb; mu 0.6; flowRule associative; }\n"},
     {"constant/loads", "dead { type gravity; }\nlive { type inertial; direction (1 0 0); }\n"},
     {"constant/groundMotion", ""},
     {"system/controlDict", "deltaT 0.01; endTime 1; writeInterval 1;\n"},
     {"system/schemes", ""},
     {"system/solution", ""},
     {"0/motion", ""}}};

void writeSound(const std::filesystem::path& folder, const CaseFile& file)
{
    if (file.text.empty())
    {
        std::filesystem::remove(folder / file.name);
    }
    else
    {
        fuzz::write(folder / file.name, file.text);
    }
}

/// A folder with the sound case in it.
class SoundCase
{
public:
    SoundCase()
    {
        for (const CaseFile& file : files)
        {
            writeSound(folder_.path, file);
        }
    }
    const std::filesystem::path& path() const { return folder_.path; }

private:
    fuzz::Folder folder_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const SoundCase sound;
    if (size == 0 || data[0] < '0' || data[0] > '9')
    {
        return 0;
    }
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const CaseFile& changed = files[static_cast<std::size_t>(data[0] - '0')];
    fuzz::write(sound.path() / changed.name, text.substr(1));
    fuzz::tryReading([&] { readLimitAnalysisCase(sound.path()); });
    fuzz::tryReading([&] { Time time(sound.path()); });
    fuzz::tryReading(
        [&]
        {
            const DynamicCase scene = readDynamicCase(sound.path());
            readInitialMotion(sound.path(), "0", scene.assembly);
        });
    writeSound(sound.path(), changed);
    return 0;
}
