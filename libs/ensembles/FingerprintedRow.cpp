// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Puts fingerprints to rows of studies and ensembles, and compares them.
#include "ensembles/FingerprintedRow.h"

#include "dictionary/Fingerprint.h"

#include <fmt/format.h>

#include <cstdlib>

namespace drystone
{

std::string withFingerprint(const std::string& row)
{
    return fmt::format("{} #{:016x}", row, fingerprint(row));
}

std::optional<std::string> withoutFingerprint(const std::string& row)
{
    const std::size_t at = row.find(" #");
    if (at == row.npos)
    {
        return row;
    }
    std::string text = row.substr(0, at);
    const std::string whole = row.substr(0, row.find_last_not_of(" \t\r") + 1); // spaces of an editor
    return whole == withFingerprint(text) ? std::optional(std::move(text)) : std::nullopt;
}

std::vector<double> numbersOf(const std::string& text)
{
    std::vector<double> numbers;
    const char* at = text.c_str();
    for (char* end = nullptr;; at = end)
    {
        const double value = std::strtod(at, &end);
        if (end == at)
        {
            const bool isRead =
                text.find_first_not_of(" \t", static_cast<std::size_t>(at - text.c_str())) == text.npos;
            return isRead ? numbers : std::vector<double>();
        }
        numbers.push_back(value);
    }
}

} // namespace drystone
