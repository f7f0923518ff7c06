// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A sound case, one file of which a fuzz target replaces: inputs begin with a character that says which.
#pragma once

#include "InputFile.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace drystone::fuzz
{

struct CaseFile
{
    std::string_view name;
    std::string_view text; ///< of the sound case; empty: absent
};

/// A block on the ground under its weight and a horizontal load.
inline constexpr std::array<CaseFile, 5> blockOnGround{
    {{"constant/assembly/blocks",
      "dimensions 2; thickness 1; supports { ground { type blocks; blocks (0); } }\n"
      "outlines ( ((-2 -1) (2 -1) (2 0) (-2 0)) ((0 0) (1 0) (1 1) (0 1)) );\n"},
     {"constant/g", "value (0 -9.81 0);\n"},
     {"constant/materialProperties", "density 2000;\n"},
     {"constant/contactProperties", "friction { type Coulomb; mu 0.6; flowRule associative; }\n"},
     {"constant/loads", "dead { type gravity; }\nlive { type inertial; direction (1 0 0); }\n"}}};

/// Some files followed by others.
template<std::size_t Some, std::size_t Others>
constexpr std::array<CaseFile, Some + Others> joined(const std::array<CaseFile, Some>& some,
                                                     const std::array<CaseFile, Others>& others)
{
    std::array<CaseFile, Some + Others> files{};
    std::copy(others.begin(), others.end(), std::copy(some.begin(), some.end(), files.begin()));
    return files;
}

/// The files of a sound case, in a folder of this process.
class SoundCase
{
public:
    /// \param caseFiles stays with the caller
    explicit SoundCase(std::span<const CaseFile> caseFiles) : files(caseFiles)
    {
        for (const CaseFile& file : files)
        {
            restore(file);
        }
    }

    const std::filesystem::path& path() const { return folder.path; }

    /// Writes the rest of an input to the file that its first character names: `0` to `9` the first ten
    /// files, `a` the eleventh, and so on.
    /// \return the number of that file; nothing, and nothing is written, when the character names none
    std::optional<std::size_t> replaceOne(std::string_view input) const
    {
        constexpr std::string_view characters = "0123456789abcdefghijklmnopqrstuvwxyz";
        const std::size_t number = input.empty() ? characters.npos : characters.find(input.front());
        if (number >= files.size())
        {
            return {};
        }
        write(path() / files[number].name, input.substr(1));
        return number;
    }

    void restore(const CaseFile& file) const
    {
        if (file.text.empty())
        {
            std::filesystem::remove(path() / file.name);
        }
        else
        {
            write(path() / file.name, file.text);
        }
    }

private:
    std::span<const CaseFile> files;
    Folder folder;
};

} // namespace drystone::fuzz
