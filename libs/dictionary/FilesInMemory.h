// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files whose text is taken from memory instead of from the disk: how an ensemble gives a case thousands of
/// variants without a file being written, and without one being read more than once.
#pragma once

#include "dictionary/Dictionary.h"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace drystone
{

/// As long as it lives, dictionaries that this thread reads with Expansion::all are read once and kept, and
/// those with a text here have this text, also where another file includes them. The files of a case must not
/// change meanwhile. One at a time in a thread.
class FilesInMemory
{
public:
    FilesInMemory();
    ~FilesInMemory();
    FilesInMemory(const FilesInMemory&) = delete;
    FilesInMemory& operator=(const FilesInMemory&) = delete;

    /// From now on the file says this.
    void set(const std::filesystem::path& file, std::string text);

    /// Whether another dictionary that is kept was read from it too.
    bool isIncluded(const std::filesystem::path& file) const;

    // For the reader of dictionaries.
    static FilesInMemory* current();                                    ///< nullptr where there is none
    const std::string* textOf(const std::filesystem::path& file) const; ///< nullptr: see the disk
    const Dictionary* find(const std::filesystem::path& file) const;    ///< nullptr: not read yet
    /// \param sources names of the files that it was read from, with those it includes
    void keep(const std::filesystem::path& file, const Dictionary& dictionary, std::set<std::string> sources);

private:
    struct Kept
    {
        Dictionary dictionary;
        std::set<std::string> sources;
    };
    std::map<std::string, std::string> texts;
    std::map<std::string, Kept> dictionaries;
};

/// As long as it lives, this thread reads what is on the disk, whatever is in memory.
class FilesOnDisk
{
public:
    FilesOnDisk();
    ~FilesOnDisk();
    FilesOnDisk(const FilesOnDisk&) = delete;
    FilesOnDisk& operator=(const FilesOnDisk&) = delete;

private:
    FilesInMemory* hidden;
};

/// Whether a file has a text in memory, so that it need not be on the disk, or was read from there before.
bool isInMemory(const std::filesystem::path& file);

} // namespace drystone
