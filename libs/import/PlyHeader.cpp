// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The lines of a PLY header.
#include "import/PlyHeader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace drystone
{

namespace
{

std::optional<PlyType> typeOf(std::string_view word)
{
    using Name = std::pair<std::string_view, PlyType>;
    static constexpr std::array<Name, 16> names{{{"char", PlyType::int8},
                                                 {"int8", PlyType::int8},
                                                 {"uchar", PlyType::uint8},
                                                 {"uint8", PlyType::uint8},
                                                 {"short", PlyType::int16},
                                                 {"int16", PlyType::int16},
                                                 {"ushort", PlyType::uint16},
                                                 {"uint16", PlyType::uint16},
                                                 {"int", PlyType::int32},
                                                 {"int32", PlyType::int32},
                                                 {"uint", PlyType::uint32},
                                                 {"uint32", PlyType::uint32},
                                                 {"float", PlyType::float32},
                                                 {"float32", PlyType::float32},
                                                 {"double", PlyType::float64},
                                                 {"float64", PlyType::float64}}};
    const auto found =
        std::find_if(names.begin(), names.end(), [&](const Name& name) { return name.first == word; });
    return found == names.end() ? std::nullopt : std::optional(found->second);
}

PlyFormat formatOf(const ImportedFile& file, int number, std::string_view name)
{
    if (name == "ascii")
    {
        return PlyFormat::ascii;
    }
    if (name != "binary_little_endian" && name != "binary_big_endian")
    {
        refuse(file, number,
               fmt::format("Unknown format {}: it is ascii, binary_little_endian or binary_big_endian.",
                           shown(name)));
    }
    return name == "binary_little_endian" ? PlyFormat::little : PlyFormat::big;
}

/// \param line without its first word
PlyElement elementOf(const ImportedFile& file, int number, std::string_view line)
{
    PlyElement element{std::string(nextWord(line)), 0, {}};
    const int count = integerOf(file, number, nextWord(line));
    if (count < 0)
    {
        refuse(file, number, fmt::format("There cannot be {} elements.", count));
    }
    element.count = static_cast<std::size_t>(count);
    return element;
}

/// \param line without its first word
PlyProperty propertyOf(const ImportedFile& file, int number, std::string_view line)
{
    PlyProperty property;
    std::string_view type = nextWord(line);
    const bool isList = type == "list";
    std::string_view countType;
    if (isList)
    {
        countType = nextWord(line);
        property.count = typeOf(countType);
        type = nextWord(line);
    }
    const std::optional<PlyType> known = typeOf(type);
    if (!known || (isList && !property.count))
    {
        refuse(file, number,
               fmt::format("Unknown type {}: it is char, uchar, short, ushort, int, uint, float, double or "
                           "a list.",
                           shown(known ? countType : type)));
    }
    property.type = *known;
    property.name = nextWord(line);
    return property;
}

/// The first byte after a line, whose end LineReader has passed.
std::size_t endOf(std::string_view line, const ImportedFile& file)
{
    auto end = static_cast<std::size_t>(line.data() + line.size() - file.bytes.data());
    for (const char ending : {'\r', '\n'})
    {
        end += end < file.bytes.size() && file.bytes[end] == ending ? 1 : 0;
    }
    return end;
}

} // namespace

PlyHeader readPlyHeader(const ImportedFile& file)
{
    PlyHeader header;
    LineReader lines(file.bytes);
    std::string_view line;
    bool hasFormat = false;
    lines.next(line);
    if (trimmed(line) != "ply")
    {
        refuse(file, 1, "A PLY file begins with the line `ply`: this one does not.");
    }
    while (lines.next(line))
    {
        const int number = lines.number();
        const std::string_view word = nextWord(line);
        if (word == "format")
        {
            header.format = formatOf(file, number, nextWord(line));
            hasFormat = true;
        }
        else if (word == "element")
        {
            header.elements.push_back(elementOf(file, number, line));
        }
        else if (word == "property")
        {
            if (header.elements.empty())
            {
                refuse(file, number, "This property belongs to no element.");
            }
            header.elements.back().properties.push_back(propertyOf(file, number, line));
        }
        else if (word == "end_header")
        {
            if (!hasFormat)
            {
                refuse(file, number, "The header has no line `format`.");
            }
            header.end = endOf(line, file);
            header.lines = number;
            return header;
        }
        else if (word != "comment" && word != "obj_info" && !word.empty())
        {
            refuse(file, number, fmt::format("Unknown word {} in the header.", shown(word)));
        }
    }
    refuse(file, lines.number(), "The header has no line `end_header`: get a complete copy of the file.");
}

} // namespace drystone
