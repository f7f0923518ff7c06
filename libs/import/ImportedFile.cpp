// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of files and of the words in them.
#include "import/ImportedFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

constexpr std::uintmax_t largestFile = std::uintmax_t{1} << 31U;
constexpr std::string_view blanks = " \t\f\v\r";

} // namespace

ImportedFile readSource(const fs::path& file)
{
    ImportedFile source{file.lexically_normal().string(), {}};
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status))
    {
        refuse(source, 0, "There is no such file. Check the name: it is relative to the case directory.");
    }
    if (!fs::is_regular_file(status))
    {
        refuse(source, 0, "This is not an ordinary file: name one.");
    }
    const std::uintmax_t size = fs::file_size(file, error);
    if (error)
    {
        refuse(source, 0, fmt::format("Cannot find out the size of the file: {}.", error.message()));
    }
    if (size > largestFile)
    {
        refuse(source, 0,
               fmt::format("The file has {} bytes: at most {} are read. Divide it.", size, largestFile));
    }
    std::ifstream stream(file, std::ios::binary);
    source.bytes.resize(static_cast<std::size_t>(size));
    if (!stream.read(source.bytes.data(), static_cast<std::streamsize>(size)))
    {
        refuse(source, 0, "Cannot read the file. Check the right to read it.");
    }
    if (size == 0)
    {
        refuse(source, 0, "The file is empty: get a complete copy of it.");
    }
    return source;
}

void refuse(const ImportedFile& file, int line, const std::string& fault)
{
    throw FatalIOError(fault, {file.name, "", line});
}

bool LineReader::next(std::string_view& line)
{
    if (rest.empty())
    {
        return false;
    }
    const std::size_t end = rest.find_first_of("\r\n");
    line = rest.substr(0, end);
    if (end == std::string_view::npos)
    {
        rest = {};
    }
    else
    {
        const bool isTwo = rest[end] == '\r' && end + 1 < rest.size() && rest[end + 1] == '\n';
        rest.remove_prefix(end + (isTwo ? 2 : 1));
    }
    ++count;
    return true;
}

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view nextWord(std::string_view& line)
{
    const std::size_t first = line.find_first_not_of(blanks);
    if (first == std::string_view::npos)
    {
        line = {};
        return {};
    }
    line.remove_prefix(first);
    const std::string_view word = line.substr(0, line.find_first_of(blanks));
    line.remove_prefix(word.size());
    return word;
}

double numberOf(const ImportedFile& file, int line, std::string_view word)
{
    const std::string_view plain = word.substr(word.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, code] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    const bool isTiny = code == std::errc::result_out_of_range
                        && std::abs(std::strtod(std::string(plain).c_str(), nullptr)) < 1; // it shows which
    if (plain.empty() || end != plain.data() + plain.size() || (code != std::errc() && !isTiny))
    {
        refuse(file, line,
               fmt::format("'{}' is no number, or one that is too large.{}", shown(word),
                           word.find(',') == std::string_view::npos
                               ? ""
                               : " Export the file with decimal points, not commas."));
    }
    if (!std::isfinite(value))
    {
        refuse(file, line, fmt::format("'{}' is not a finite number.", shown(word)));
    }
    return isTiny ? 0 : value;
}

int integerOf(const ImportedFile& file, int line, std::string_view word)
{
    const std::string_view plain = word.substr(word.starts_with('+') ? 1 : 0);
    int value = 0;
    const auto [end, code] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    if (plain.empty() || end != plain.data() + plain.size() || code != std::errc())
    {
        refuse(file, line, fmt::format("'{}' is no integer, or one that is too large.", shown(word)));
    }
    return value;
}

void DigitCount::add(std::string_view number)
{
    ++numbers;
    const std::size_t exponentAt = number.find_first_of("eE");
    const std::string_view mantissa = number.substr(0, exponentAt);
    const std::size_t point = mantissa.find('.');
    const bool hasExponent = exponentAt != std::string_view::npos;
    const int decimals =
        point == std::string_view::npos || hasExponent ? -1 : static_cast<int>(mantissa.size() - point - 1);
    if (numbers == 1)
    {
        decimalsOfFirst = decimals;
    }
    withAsManyDecimals += decimals == decimalsOfFirst ? 1 : 0;
    int digits = 0;
    bool isLeading = true;
    for (const char c : mantissa)
    {
        if (c >= '0' && c <= '9')
        {
            isLeading = isLeading && c == '0';
            digits += isLeading ? 0 : 1;
        }
    }
    significant = std::max(significant, digits);
    double value = 0;
    const std::string_view plain = number.substr(number.starts_with('+') ? 1 : 0);
    std::from_chars(plain.data(), plain.data() + plain.size(), value);
    largest = std::max(largest, std::abs(value));
}

double DigitCount::unit() const
{
    constexpr int mostDecimals = 12;
    constexpr int fewestDigits = 6;
    constexpr int mostDigits = 9;
    if (numbers == withAsManyDecimals && decimalsOfFirst >= 1 && decimalsOfFirst <= mostDecimals)
    {
        return std::pow(10.0, -decimalsOfFirst);
    }
    if (significant >= fewestDigits && significant <= mostDigits && largest > 0)
    {
        return std::pow(10.0, std::floor(std::log10(largest)) + 1 - significant);
    }
    return 0;
}

} // namespace drystone
