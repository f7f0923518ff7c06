// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs a program and measures its CPU time.
#include "Subprocess.h"

#include <sys/resource.h>

#include <cstdlib>
#include <stdexcept>

namespace drystone
{
namespace
{

double secondsOfChildren()
{
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time)
    { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

} // namespace

Scratch::Scratch()
{
    std::string name = (std::filesystem::temp_directory_path() / "drystonePeer.XXXXXX").string();
    if (!mkdtemp(name.data()))
    {
        throw std::runtime_error("no folder can be made in " + name);
    }
    folder = name;
}

Scratch::~Scratch()
{
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
}

Finished runProgram(const std::string& command)
{
    const double before = secondsOfChildren();
    const int status = std::system(("( " + command + " ) >/dev/null 2>&1").c_str());
    return {status, secondsOfChildren() - before};
}

bool isInstalled(const std::string& program)
{
    return runProgram("command -v " + program).status == 0;
}

} // namespace drystone
