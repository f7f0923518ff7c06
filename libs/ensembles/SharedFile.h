// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files that several processes of an ensemble write to, each what is whole at once.
#pragma once

#include <filesystem>
#include <string_view>

#include <unistd.h>

namespace drystone
{

/// \throws FatalError with what the system says of the last call
[[noreturn]] void refuseToWrite(const std::filesystem::path& file);

/// Opens a file, made if it is not there. \param flags of open(2) \return a descriptor, which the caller
/// closes \throws FatalError when it cannot be opened
int openFile(const std::filesystem::path& file, int flags);

/// \param file named if it cannot be written \throws FatalError
void writeAll(int descriptor, std::string_view text, const std::filesystem::path& file);

/// Closes what it holds.
struct OpenFile
{
    int descriptor = -1;
    ~OpenFile() { ::close(descriptor); }
};

} // namespace drystone
