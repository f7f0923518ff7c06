// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files that are written whole or not at all, and read whole; and where the files are that an installation
/// shares.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace drystone
{

/// Writes a file through a temporary in its folder that then takes its name, so that a reader, or a run that
/// is killed, meets the old content or the new one and never half of it. Folders missing on the way are made.
/// A file that is replaced keeps its mode and, where this user can give it, its owner; other names of it
/// (hard links) keep the old content. \throws FatalError naming the file and the system's reason (no
/// permission, write-protected, disk full,
/// ...); the old file then stands.
void writeWholeFile(const std::filesystem::path& file, std::string_view content);

/// The same without the temporary, into a folder that nobody looks at before it takes its name.
void writeFile(const std::filesystem::path& file, std::string_view content);

/// Removes from a folder what programs that were killed have left there of files, and of folders, that were
/// to take their name when they were whole: `<name>.<process>.tmp` and `.purged` of processes that are gone.
void removeLeftovers(const std::filesystem::path& folder);

/// The bytes of a file; none where it cannot be read, which the caller has to distinguish from an empty one
/// where that matters.
std::string contentOfFile(const std::filesystem::path& file);

/// `share/drystone` next to the `bin` of the running application, of a build or of an installation; empty
/// where there is no such folder.
std::filesystem::path sharedFolder();

/// Finds out whether files can be written into a folder, which need not exist yet, without touching anything:
/// for a run to find out before it computes.
///
/// \throws FatalError naming the folder, and the system's reason, when they cannot
void requireWritable(const std::filesystem::path& folder);

} // namespace drystone
