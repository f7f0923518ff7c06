// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the input said when a result was computed from it, so that a result which is kept can be compared
/// with the input of now.
#pragma once

#include "dictionary/Dictionary.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// A fingerprint that grows: FNV-1a of 64 bits (Fowler, Noll, Vo; RFC 9923). It distinguishes what is
/// different by accident, not by intent.
class Fingerprint
{
public:
    void add(std::string_view bytes);
    void add(double value); ///< the number, -0 as 0
    std::uint64_t value() const { return hash; }

private:
    std::uint64_t hash = 0xcbf29ce484222325u;
};

std::uint64_t fingerprint(std::string_view bytes);

/// Of what a dictionary says: keys and values in their order with macros and includes carried out, numbers by
/// value; neither comments, layout nor the header FoamFile count.
/// \param leftOut keys of the dictionary that do not count either
std::uint64_t fingerprint(const Dictionary& dictionary, const std::vector<std::string>& leftOut = {});

/// Of a dictionary as it is written, for what changes entries before it is read: its tokens, duplicates and
/// all branches of conditions among them, with macros, includes and arithmetic not carried out. Neither
/// comments, layout nor the header FoamFile count. Of the bytes where the text is no dictionary.
std::uint64_t fingerprintOfTokens(const SourceFile& file);

/// The files that entries `file "..."` of a dictionary and of its sub-dictionaries name.
std::vector<std::string> filesNamedIn(const Dictionary& dictionary);

/// A file of the input and what it said.
struct InputFile
{
    std::string name;          ///< relative to the case directory, or absolute
    std::uint64_t content = 0; ///< its fingerprint; 0 where there is no such file
};

/// Dictionaries of a case, and the files that their entries `file "..."` name, byte by byte.
/// \param names relative to the case directory; one that is not there has content 0
/// \throws FatalIOError for what is wrong with a dictionary
std::vector<InputFile> inputFiles(const std::filesystem::path& caseDirectory,
                                  const std::vector<std::string>& names);

/// As files keep them: `1f2e3d4c5b6a7988 constant/g`, one a text.
std::vector<std::string> textsOf(const std::vector<InputFile>& files);
/// \return what of the texts is of that form
std::vector<InputFile> inputFilesIn(const std::vector<std::string>& texts);

/// The files that said something else before, sorted by name; each `constant/g has changed`, `.. is new` or
/// `.. is gone`. A file that one of the two does not name counts as one that is not there.
struct InputChange
{
    std::string file;
    std::string text;
};
std::vector<InputChange> changesOfInput(const std::vector<InputFile>& before,
                                        const std::vector<InputFile>& now);
/// `constant/g has changed, constant/groundMotion is new`.
std::string textOf(const std::vector<InputChange>& changes);

} // namespace drystone
