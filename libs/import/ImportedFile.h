// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A file that another program made, in memory, with what all readers of such files need: lines, words,
/// numbers, bytes, and refusals that say where.
///
/// Why OBJ and DXF are not read by the libraries that Debian 12 has for them:
/// - tinyobjloader 2.0.0rc10 does not read what was written: of the 2,400,000 coordinates of 100,000 bricks,
///   in 17 digits, its build for doubles returns 616,000 that differ from strtod's in the last bits, and
///   neighbours no longer share corners. `v 1 o 0` and `v 5` are vertices (0 for what is missing), without a
///   message, and a face of a vertex that does not exist is a warning without consequence.
/// - dxflib 3.26.4 reserves what a polyline announces: `90` with 2147483647 ends the process
/// (std::bad_alloc).
///   A file of which the second half is missing is read without a message, and so is the coordinate 0.o00000.
///
/// Neither names a line, which every refusal here does. The tests Obj.FaultsAreNamedWithTheirLine,
/// ObjText.ComesBackToTheLastBit and Dxf.HostileFilesEndInAMessage have these cases.
#pragma once

#include "core/Error.h"
#include "core/ShownWord.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

struct ImportedFile
{
    std::string name;  ///< as messages have it
    std::string bytes; ///< all of them
};

/// That a corner of a block may have [m].
inline constexpr double farthestCoordinate = 1e6;

/// \throws FatalIOError when there is no such file, it is no ordinary file (a pipe may never end), is empty,
/// or larger than 2 GB
ImportedFile readSource(const std::filesystem::path& file);

/// \throws FatalIOError always. \param line from 1; 0 where no line is to blame
[[noreturn]] void refuse(const ImportedFile& file, int line, const std::string& fault);

/// The lines of a text one after the other; LF, CR LF or CR end a line.
class LineReader
{
public:
    explicit LineReader(std::string_view text) : rest(text) {}
    /// \return whether there was another line; `line` then views it, without its end
    bool next(std::string_view& line);
    int number() const { return count; } ///< of the line that was read last, from 1

private:
    std::string_view rest;
    int count = 0;
};

std::string_view trimmed(std::string_view text);

/// Cuts the next word, between blanks, off the front of a line; empty at its end.
std::string_view nextWord(std::string_view& line);

/// The whole word as a finite number. \throws FatalIOError when it is none
double numberOf(const ImportedFile& file, int line, std::string_view word);

/// The whole word as an integer. \throws FatalIOError when it is none, or not within the range of int
int integerOf(const ImportedFile& file, int line, std::string_view word);

/// To how many digits the coordinates of a file are written, from each of their texts.
class DigitCount
{
public:
    void add(std::string_view number);
    /// The unit of the last digit, in units of the file; 0 where the coordinates seem to have all their
    /// digits. Coordinates that all have the same number of decimals, from 1 to 12 (`%.3f`), are taken to be
    /// rounded; so are those with 6 to 9 significant digits at most (`%g`, single precision), at the largest
    /// of them.
    double unit() const;

private:
    std::size_t numbers = 0;
    std::size_t withAsManyDecimals = 0; ///< as the first
    int decimalsOfFirst = -1;
    int significant = 0; ///< most of any
    double largest = 0;
};

} // namespace drystone
