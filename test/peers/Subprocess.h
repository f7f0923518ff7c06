// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Programs run as separate processes of a test.
#pragma once

#include <filesystem>
#include <string>

namespace drystone
{

/// A folder of its own, gone when this goes.
struct Scratch
{
    std::filesystem::path folder;
    Scratch();
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
};

/// How a command ended.
struct Finished
{
    int status = 0;
    double seconds = 0; ///< CPU time of the command and what it started, start-up and reading included
};

/// Runs a command of the shell, its output dropped.
Finished runProgram(const std::string& command);

/// Whether there is such a program in PATH.
bool isInstalled(const std::string& program);

} // namespace drystone
