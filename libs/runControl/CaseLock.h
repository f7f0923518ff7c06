// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One run at a time in a case: in this library because every application that writes into a case needs it.
#pragma once

#include <filesystem>
#include <string>

namespace drystone
{

/// The kernel's lock (flock) on the case directory itself, held as long as the object lives and released when
/// the process dies, however it does. It needs no file, so it works on disks that are read-only too; on file
/// systems without locks there is none and the run goes on.
class CaseLock
{
public:
    /// \param application that runs, for the message
    /// \param remedy      the end of the message
    /// \throws FatalError when another process holds the lock, a second later still, with its id where the
    /// system shows it
    CaseLock(const std::filesystem::path& caseDirectory, const std::string& application,
             const std::string& remedy);
    ~CaseLock();
    CaseLock(const CaseLock&) = delete;
    CaseLock& operator=(const CaseLock&) = delete;

private:
    int descriptor = -1;
};

} // namespace drystone
