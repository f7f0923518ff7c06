// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Inputs of fuzz targets as files, for readers that read files.
#pragma once

#include "core/Error.h"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <unistd.h>

namespace drystone::fuzz
{

/// A folder of this process, removed at its end.
class Folder
{
public:
    Folder() : path(make()) {}
    ~Folder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const std::filesystem::path path;

private:
    /// In memory, where there is such a place. Named by the target, not by the process: libFuzzer takes words
    /// for its inputs from what is compared, and a seed is to give the same ones each time.
    static std::filesystem::path make()
    {
        const std::filesystem::path room = std::filesystem::is_directory("/dev/shm")
                                               ? std::filesystem::path("/dev/shm")
                                               : std::filesystem::temp_directory_path();
        const std::string name = std::string("drystoneFuzz.") + program_invocation_short_name + ".";
        // Another process of the same target has locked its folder; what one left that was killed is taken
        // over.
        for (int number = 0;; ++number)
        {
            const std::filesystem::path folder = room / (name + std::to_string(number));
            std::filesystem::create_directory(folder);
            const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
            if (opened >= 0 && ::flock(opened, LOCK_EX | LOCK_NB) == 0)
            {
                for (const auto& left : std::filesystem::directory_iterator(folder))
                {
                    std::filesystem::remove_all(left);
                }
                return folder; // locked as long as the process lives
            }
            ::close(opened);
        }
    }
};

inline void write(const std::filesystem::path& file, std::string_view text)
{
    std::ofstream stream(file, std::ios::binary);
    if (!stream)
    {
        std::filesystem::create_directories(file.parent_path());
        stream.open(file, std::ios::binary);
    }
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
}

/// Reads an input, which may only be rejected with a FatalError.
template<class Read>
void tryReading(const Read& read)
{
    try
    {
        read();
    }
    catch (const FatalError&)
    {
    }
}

} // namespace drystone::fuzz
