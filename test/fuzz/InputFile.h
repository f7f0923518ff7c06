// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Inputs of fuzz targets as files, for readers that read files.
#pragma once

#include "core/Error.h"

#include <filesystem>
#include <fstream>
#include <string_view>
#include <unistd.h>

namespace drystone::fuzz
{

/// A folder of this process, gone at its end.
class Folder
{
public:
    /// In memory, where there is such a place.
    Folder()
        : path((std::filesystem::is_directory("/dev/shm") ? std::filesystem::path("/dev/shm")
                                                          : std::filesystem::temp_directory_path())
               / ("drystoneFuzz." + std::to_string(::getpid())))
    {
        std::filesystem::create_directories(path);
    }
    ~Folder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const std::filesystem::path path;
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

/// Reads, which may be refused with a FatalError only.
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
