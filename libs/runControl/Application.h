// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How every application starts and ends:
///
///     int main(int argc, char* argv[])
///     {
///         ApplicationDescription description;
///         description.name = "blockTexture";
///         description.summary = "Generates the blocks of a structure.";
///         description.kind = ApplicationKind::preProcessor;
///         return runApplication(argc, argv, description, [](const CommandLine& commandLine) { ... return 0;
///         });
///     }
#pragma once

#include "runControl/CommandLine.h"

#include <string>
#include <string_view>

namespace drystone
{

/// A time step frees its arrays and the next allocates the same again. Given back to the system they are
/// fetched anew page by page, which takes long, so that the C library is instructed to keep them. jemalloc,
/// which applications have where it is installed, keeps them by itself.
void keepFreedMemory();

/// Name, version and, where git knew it when the build was configured, commit: `Drystone 0.1.0 at
/// 25beebf30d2e`.
std::string versionText();

/// The main of every application: reads the command line, answers `-help`, prints the banner, runs `program`
/// in a case directory that exists, and turns what it throws into the message on standard error and the exit
/// status. \return the exit status
int runApplication(int argc, const char* const* argv, const ApplicationDescription& description,
                   const std::function<int(const CommandLine&)>& program);

/// Ends the log of an application whose runs can be interrupted: `End`, or after a signal that it was
/// stopped. \param continuation what a new start does, a sentence: `Started again, it continues.`
void printStopOrEnd(std::string_view continuation);

} // namespace drystone
