// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Edits of a dictionary's text that leave comments, layout, macros and directives as they are.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace drystone
{

/// The text of a file with one entry given another value, `2` or `{ a 1; }`. An entry that is not there is
/// added. Macros and directives are not carried out: an entry that comes from an included file counts as not
/// there, and what is added overrides it. \param file that the text is of, for messages \param path keywords
/// with slashes between, texture/unit, patterns in quotes or without \throws FatalIOError when the text or
/// the value is not right, when there is no dictionary to add to, or when the entry depends on a condition
std::string withEntrySet(const std::string& text, const std::filesystem::path& file, std::string_view path,
                         std::string_view value);

/// The text of a file without an entry, however often it is given; the same text when it is not there.
/// \throws FatalIOError as above
std::string withEntryRemoved(const std::string& text, const std::filesystem::path& file,
                             std::string_view path);

/// What to do with an entry of a file.
enum class EntryEdit
{
    set,   ///< give it a value; one that is not there is added
    add,   ///< one that is there stays as it is, with a warning
    remove ///< one that is not there is warned of
};

/// Edit a file, which is then written whole or not at all; of a symbolic link, the file that it leads to. An
/// entry that an included file has stays there: a value that is set is added to this one, and overrides it.
/// \param path as above; points may stand between keywords where no entry has a name with points
/// \param value ignored for EntryEdit::remove
/// \throws FatalError as above, and when the file cannot be written
void editFile(const std::filesystem::path& file, std::string_view path, EntryEdit edit,
              std::string_view value);

} // namespace drystone
