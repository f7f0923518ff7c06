// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "runControl/CaseLock.h"

#include "core/Error.h"

#include <cerrno>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace drystone
{
namespace
{

/// Who holds the lock, from the kernel's list: `1: FLOCK  ADVISORY  WRITE 1234 fd:01:5678 0 EOF`. Empty where
/// it does not say.
std::string holderOf(int descriptor)
{
    struct stat status = {};
    if (fstat(descriptor, &status) != 0)
    {
        return {};
    }
    const std::string inode = fmt::format(":{}", status.st_ino);
    std::ifstream locks("/proc/locks");
    for (std::string line; std::getline(locks, line);)
    {
        std::istringstream words(line);
        std::string number, kind, mode, access, place;
        long process = 0;
        words >> number >> kind >> mode >> access >> process >> place;
        if (words && kind == "FLOCK" && place.ends_with(inode) && process > 0)
        {
            return fmt::format(" (process {})", process);
        }
    }
    return {};
}

} // namespace

CaseLock::CaseLock(const std::filesystem::path& caseDirectory, const std::string& application)
    : descriptor(::open(caseDirectory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
{
    if (descriptor < 0 || flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK)
    {
        return;
    }
    const std::string holder = holderOf(descriptor);
    ::close(descriptor);
    throw FatalError(fmt::format("Another run is at work in the case {}{}: {} would mix its results with "
                                 "those.\n\nWait until it has ended, or run in a copy of the case.",
                                 std::filesystem::absolute(caseDirectory).lexically_normal().string(), holder,
                                 application));
}

CaseLock::~CaseLock()
{
    if (descriptor >= 0)
    {
        ::close(descriptor);
    }
}

} // namespace drystone
