// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Compares names letter by letter, and number by number where both have one.
#include "report/SortedFiles.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// Whether a name comes before another one, numbers by their value: motion_3 before motion_3.5.
bool isBefore(std::string_view one, std::string_view other)
{
    const auto numberIn = [](std::string_view& text)
    {
        double value = 0;
        const auto end =
            std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        return value;
    };
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    while (!one.empty() && !other.empty())
    {
        if (isDigit(one.front()) && isDigit(other.front()))
        {
            const double first = numberIn(one);
            const double second = numberIn(other);
            if (first != second)
            {
                return first < second;
            }
            continue;
        }
        if (one.front() != other.front())
        {
            return one.front() < other.front();
        }
        one.remove_prefix(1);
        other.remove_prefix(1);
    }
    return one.empty() && !other.empty();
}

} // namespace

std::vector<fs::path> filesWithEnding(const fs::path& folder, const std::string& ending)
{
    std::vector<fs::path> files;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, none))
    {
        if (entry.is_regular_file(none) && entry.path().extension() == ending)
        {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end(),
              [](const fs::path& one, const fs::path& other)
              {
                  // Without the ending, whose full stop may follow a number.
                  const auto name = [](fs::path file) { return file.replace_extension().string(); };
                  return isBefore(name(one), name(other));
              });
    return files;
}

} // namespace drystone
