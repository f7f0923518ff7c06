// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The text of a record of ground motion, with what the readers of its formats have in common: lines, words,
/// numbers, units, and refusals that say where.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// A record's file, cut into lines.
struct RecordText
{
    std::filesystem::path file;
    std::string content;
    std::vector<std::string_view> lines; ///< views into `content`, without line ends

    /// \param line from 0 \throws FatalIOError always: what is wrong, and how to repair it
    [[noreturn]] void refuse(std::size_t line, const std::string& what, const std::string& repair) const;
};

/// \post all lines are views into text.content, so `text` must not be copied: fill it in place
/// \throws FatalIOError for what is no text, or empty
void load(const std::filesystem::path& file, RecordText& text);

std::string upper(std::string_view text);
std::string_view trimmedCell(std::string_view text);
std::vector<std::string_view> wordsBetween(std::string_view line, std::string_view separators);

/// The whole token as a number: plain, with a + sign, or with Fortran's D for the exponent.
std::optional<double> numberOf(std::string_view token);
/// A number that is finite, also times a factor. \throws FatalIOError that names it
double finiteNumber(const RecordText& text, std::size_t line, std::string_view token, double factor = 1);

/// The unit to read with, from what the user declares and what the file says at a line.
/// \throws FatalIOError where neither is a unit, or they contradict each other
std::string settledUnit(const RecordText& text, std::size_t line, const std::string& declared,
                        const std::string& found);

} // namespace drystone
