// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Tries for the lock until patience ends; /proc/locks shows by the inode which process has it.
#include "runControl/CaseLock.h"

#include "core/Error.h"

#include <cerrno>
#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <thread>

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

/// The processes of a run that was killed may live, and hold its lock, for an instant longer than the one
/// that was waited for.
constexpr auto patience = std::chrono::seconds(1);

/// \return whether it is held now, or there are no locks here
bool lockOrWait(int descriptor)
{
    const auto end = std::chrono::steady_clock::now() + patience;
    while (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    {
        if (std::chrono::steady_clock::now() > end)
        {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
}

} // namespace

CaseLock::CaseLock(const std::filesystem::path& caseDirectory, const std::string& application,
                   const std::string& remedy)
    : descriptor(::open(caseDirectory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
{
    if (descriptor < 0 || lockOrWait(descriptor))
    {
        return;
    }
    const std::string holder = holderOf(descriptor);
    ::close(descriptor);
    throw FatalError(fmt::format("Another run is at work in the case {}{}: {} would mix its results with "
                                 "those.\n\n{}",
                                 std::filesystem::absolute(caseDirectory).lexically_normal().string(), holder,
                                 application, remedy));
}

CaseLock::~CaseLock()
{
    if (descriptor >= 0)
    {
        ::close(descriptor);
    }
}

} // namespace drystone
