// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a user gives for an edit of a dictionary: the path, name and value of an entry, checked before they
/// stand in a file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// A path as Dictionary::findPath takes it: patterns without the quotes that they have in files.
std::string withoutQuotes(std::string_view path);

/// The names between the slashes of a path, as they are given: patterns with their quotes.
std::vector<std::string> givenNames(std::string_view path);
/// The same as Dictionary has them.
std::vector<std::string> keywordsOf(std::string_view path);

/// The value as it stands in the text. \param path of its entry, for messages \throws FatalIOError where it
/// is not one value and nothing more
std::string checkedValue(std::string_view value, std::string_view path);

/// The name of an entry that is added, as it is given. \throws FatalIOError where it is none
std::string checkedName(const std::string& name);

/// Whether a checked value is a sub-dictionary.
bool isDictionaryText(const std::string& value);

} // namespace drystone
