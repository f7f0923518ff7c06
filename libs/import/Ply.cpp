// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The data of Stanford PLY. Own reader: that of VTK crashes on damaged files.
#include "import/ByteReader.h"
#include "import/PlyHeader.h"
#include "import/Solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// What a value says: that of a normal or a colour nothing of how coordinates are rounded.
enum class Meaning
{
    coordinate, ///< of a vertex
    other
};

/// A source of values: words of a text, or numbers in bytes.
class Words
{
public:
    Words(const ImportedFile& source, const PlyHeader& header)
        : file(source), lines(std::string_view(source.bytes).substr(header.end)), before(header.lines)
    {
    }
    double take(PlyType type, Meaning meaning)
    {
        const std::string_view word = next();
        const double value = numberOf(file, line(), word);
        if (meaning == Meaning::coordinate && (type == PlyType::float32 || type == PlyType::float64))
        {
            digits.add(word);
        }
        return value;
    }
    /// \throws FatalIOError when there are more
    void requireEnd()
    {
        std::string_view word = nextWord(rest);
        while (word.empty() && lines.next(rest))
        {
            word = nextWord(rest);
        }
        if (!word.empty())
        {
            refuse(
                file, line(),
                fmt::format("{} stands behind the last element that the header counts: correct its counts, "
                            "or write the file anew.",
                            shown(word)));
        }
    }
    int line() const { return before + lines.number(); }
    double rounding(double) const { return digits.unit(); }

private:
    std::string_view next()
    {
        std::string_view word = nextWord(rest);
        while (word.empty())
        {
            if (!lines.next(rest))
            {
                refuse(file, line(), "The file ends in the middle of its data: get a complete copy of it.");
            }
            word = nextWord(rest);
        }
        return word;
    }

    const ImportedFile& file;
    LineReader lines;
    std::string_view rest;
    int before;
    DigitCount digits;
};

class Bytes
{
public:
    Bytes(const ImportedFile& source, const PlyHeader& header)
        : file(source),
          bytes(source, header.end, header.format == PlyFormat::big ? std::endian::big : std::endian::little)
    {
    }
    double take(PlyType type, Meaning meaning)
    {
        switch (type)
        {
        case PlyType::int8:
            return bytes.take<std::int8_t>();
        case PlyType::uint8:
            return bytes.take<std::uint8_t>();
        case PlyType::int16:
            return bytes.take<std::int16_t>();
        case PlyType::uint16:
            return bytes.take<std::uint16_t>();
        case PlyType::int32:
            return bytes.take<std::int32_t>();
        case PlyType::uint32:
            return bytes.take<std::uint32_t>();
        case PlyType::float32:
            isSingle = isSingle || meaning == Meaning::coordinate;
            return finite(bytes.take<float>());
        default:
            return finite(bytes.take<double>());
        }
    }
    /// \throws FatalIOError when there are more; ends of lines and zeros are none
    void requireEnd()
    {
        const std::string_view rest = std::string_view(file.bytes).substr(bytes.place());
        if (const std::size_t next = rest.find_first_not_of(std::string_view("\r\n \0", 4));
            next != std::string_view::npos)
        {
            refuse(file, 0,
                   fmt::format("{} bytes stand behind the last element that the header counts: correct its "
                               "counts, or write the file anew.",
                               rest.size()));
        }
    }
    int line() const { return 0; }
    double rounding(double largest) const { return isSingle ? std::ldexp(largest, -23) : 0; }

private:
    double finite(double value) const
    {
        if (!std::isfinite(value))
        {
            refuse(file, 0, fmt::format("The number before byte {} is not finite.", bytes.place()));
        }
        return value;
    }

    const ImportedFile& file;
    ByteReader bytes;
    bool isSingle = false;
};

int axisOf(const PlyProperty& property)
{
    return !property.count && property.name.size() == 1
               ? static_cast<int>(std::string_view("xyz").find(property.name))
               : -1;
}

bool isOfVertices(const PlyElement& element, const PlyProperty& property)
{
    return element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// The values of a list, or nothing where it is not one of vertices. \param number of its element
template<class Source>
std::vector<int> readList(Source& source, const ImportedFile& file, const PlyElement& element,
                          const PlyProperty& property, std::size_t number)
{
    const bool isFace = isOfVertices(element, property);
    const double count = source.take(*property.count, Meaning::other);
    if (!(count >= 0) || count != std::floor(count) || (isFace && count < 3))
    {
        refuse(file, source.line(),
               fmt::format("{} {} has a list of {} values.", shown(element.name), number, count));
    }
    std::vector<int> face;
    for (double k = 0; k < count; ++k)
    {
        const double index = source.take(property.type, Meaning::other);
        if (!isFace)
        {
            continue;
        }
        if (!(index >= 0 && index < 2147483647.0) || index != std::floor(index))
        {
            refuse(file, source.line(), fmt::format("Face {} has the vertex {}.", number, index));
        }
        face.push_back(static_cast<int>(index));
    }
    return face;
}

void refuseUnknownVertices(const Solid& solid, const ImportedFile& file)
{
    for (std::size_t i = 0; i < solid.faces.size(); ++i)
    {
        for (const int vertex : solid.faces[i])
        {
            if (static_cast<std::size_t>(vertex) >= solid.vertices.size())
            {
                refuse(file, 0,
                       fmt::format("Face {} has vertex {}, but there are {} vertices, numbered from 0.", i,
                                   vertex, solid.vertices.size()));
            }
        }
    }
}

template<class Source>
Solids readData(const ImportedFile& file, const PlyHeader& header)
{
    Source source(file, header);
    Solid solid;
    double largest = 0;
    // Counts of the header are not believed: what is there is appended until the file ends.
    for (const PlyElement& element : header.elements)
    {
        if (element.properties.empty() && element.count > 0)
        {
            continue; // takes no bytes, however many there are
        }
        for (std::size_t i = 0; i < element.count; ++i)
        {
            Vector<3> vertex = Vector<3>::Zero();
            for (const PlyProperty& property : element.properties)
            {
                if (property.count)
                {
                    std::vector<int> face = readList(source, file, element, property, i);
                    if (isOfVertices(element, property))
                    {
                        solid.faces.push_back(std::move(face));
                    }
                    continue;
                }
                const int axis = element.name == "vertex" ? axisOf(property) : -1;
                const double value =
                    source.take(property.type, axis >= 0 ? Meaning::coordinate : Meaning::other);
                if (axis >= 0)
                {
                    vertex[axis] = value;
                    largest = std::max(largest, std::abs(value));
                }
            }
            if (element.name == "vertex")
            {
                solid.vertices.push_back(vertex);
            }
        }
    }
    source.requireEnd();
    refuseUnknownVertices(solid, file);
    if (solid.faces.empty())
    {
        refuse(file, 0, "Faces have no list vertex_indices or vertex_index.");
    }
    Solids solids;
    solids.rounding = source.rounding(largest);
    solids.division = Division::byConnectivity;
    solids.solids.push_back(std::move(solid));
    return solids;
}

} // namespace

Solids readPly(const ImportedFile& file)
{
    const PlyHeader header = readPlyHeader(file);
    const auto hasElement = [&](std::string_view name)
    {
        return std::any_of(header.elements.begin(), header.elements.end(),
                           [&](const PlyElement& element)
                           { return element.name == name && element.count > 0; });
    };
    if (!hasElement("vertex") || !hasElement("face"))
    {
        refuse(file, 0, "The file has no elements `vertex` and `face`: it is no surface of solids.");
    }
    for (const PlyElement& element : header.elements)
    {
        for (std::size_t axis = 0; element.name == "vertex" && axis < 3; ++axis)
        {
            if (std::none_of(element.properties.begin(), element.properties.end(),
                             [&](const PlyProperty& property)
                             { return axisOf(property) == static_cast<int>(axis); }))
            {
                refuse(file, 0, fmt::format("Vertices have no property {}.", "xyz"[axis]));
            }
        }
    }
    return header.format == PlyFormat::ascii ? readData<Words>(file, header) : readData<Bytes>(file, header);
}

} // namespace drystone
