// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// STL. Own reader: that of VTK crashes on damaged files.
#include "core/LowerCase.h"
#include "import/ByteReader.h"
#include "import/Solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

constexpr std::size_t lengthOfHeader = 80;
constexpr std::size_t triangle = 50; ///< bytes: normal, three vertices, two bytes of attributes

/// Some programs write the words in capitals.
bool isWord(std::string_view word, std::string_view expected)
{
    return word.size() == expected.size() && lowerCase(word) == expected;
}

/// Many binary files begin with `solid`, too: the count of triangles decides.
bool isBinary(const ImportedFile& file)
{
    if (file.bytes.size() < lengthOfHeader + 4)
    {
        return false;
    }
    const auto count = ByteReader(file, lengthOfHeader, std::endian::little).take<std::uint32_t>();
    if (file.bytes.size() == lengthOfHeader + 4 + triangle * static_cast<std::size_t>(count))
    {
        return true;
    }
    const std::string_view start(file.bytes.data(), std::min<std::size_t>(file.bytes.size(), 1000));
    return !isWord(trimmed(start).substr(0, 5), "solid") || start.find('\0') != std::string_view::npos;
}

Solids readBinary(const ImportedFile& file)
{
    ByteReader bytes(file, lengthOfHeader, std::endian::little);
    const auto count = bytes.take<std::uint32_t>();
    if (bytes.remaining() < triangle * static_cast<std::size_t>(count))
    {
        refuse(
            file, 0,
            fmt::format("The file says that it has {} triangles, which take {} bytes, but it has {}: get a "
                        "complete copy of it.",
                        count, lengthOfHeader + 4 + triangle * static_cast<std::size_t>(count),
                        file.bytes.size()));
    }
    if (bytes.remaining() >= triangle * (static_cast<std::size_t>(count) + 1))
    {
        refuse(
            file, 0,
            fmt::format("The file says that it has {} triangles, but it has bytes for {}: write it anew, one "
                        "solid after the other in one count.",
                        count, bytes.remaining() / triangle));
    }
    Solids solids;
    Solid solid;
    double largest = 0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        bytes.skip(12); // the normal follows from the order of the vertices
        std::vector<int> face;
        for (int corner = 0; corner < 3; ++corner)
        {
            Vector<3> vertex;
            for (int axis = 0; axis < 3; ++axis)
            {
                vertex[axis] = bytes.take<float>();
            }
            if (!vertex.allFinite())
            {
                refuse(file, 0, fmt::format("Triangle {} has a vertex that is not finite.", i));
            }
            largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
            face.push_back(static_cast<int>(solid.vertices.size()));
            solid.vertices.push_back(vertex);
        }
        bytes.skip(2);
        solid.faces.push_back(std::move(face));
    }
    solids.rounding = std::ldexp(largest, -23);
    solids.solids.push_back(std::move(solid));
    return solids;
}

class AsciiStl
{
public:
    explicit AsciiStl(const ImportedFile& source) : file(source), lines(file.bytes) {}

    Solids read()
    {
        for (std::string_view word = next(); !word.empty(); word = next())
        {
            if (!isWord(word, "solid"))
            {
                fail("solid", word);
            }
            Solid solid;
            solid.name = trimmed(rest);
            solid.zones = {withoutNumber(solid.name)};
            solid.line = lines.number();
            rest = {};
            while (isWord(word = next(), "facet"))
            {
                rest = {}; // the normal follows from the order of the vertices
                expect("outer");
                expect("loop");
                std::vector<int> face;
                for (int corner = 0; corner < 3; ++corner)
                {
                    expect("vertex");
                    Vector<3> vertex;
                    for (int axis = 0; axis < 3; ++axis)
                    {
                        const std::string_view coordinate = next();
                        vertex[axis] = numberOf(file, lines.number(), coordinate);
                        digits.add(coordinate);
                    }
                    face.push_back(static_cast<int>(solid.vertices.size()));
                    solid.vertices.push_back(vertex);
                }
                expect("endloop");
                expect("endfacet");
                solid.faces.push_back(std::move(face));
            }
            if (!isWord(word, "endsolid"))
            {
                fail("endsolid", word);
            }
            rest = {};
            if (!solid.faces.empty())
            {
                solids.solids.push_back(std::move(solid));
            }
        }
        solids.rounding = digits.unit();
        return std::move(solids);
    }

private:
    /// Empty at the end of the file.
    std::string_view next()
    {
        std::string_view word = nextWord(rest);
        while (word.empty() && lines.next(rest))
        {
            word = nextWord(rest);
        }
        return word;
    }
    void expect(std::string_view what)
    {
        if (const std::string_view word = next(); !isWord(word, what))
        {
            fail(what, word);
        }
    }
    [[noreturn]] void fail(std::string_view what, std::string_view found) const
    {
        refuse(file, lines.number(),
               found.empty()
                   ? fmt::format("The file ends where `{}` is expected: get a complete copy of it.", what)
                   : fmt::format("`{}` is expected, but `{}` found.", what, shown(found)));
    }

    const ImportedFile& file;
    LineReader lines;
    std::string_view rest;
    DigitCount digits;
    Solids solids;
};

} // namespace

Solids readStl(const ImportedFile& file)
{
    Solids solids = isBinary(file) ? readBinary(file) : AsciiStl(file).read();
    solids.division = Division::byConnectivity;
    if (solids.solids.empty() || solids.solids.front().faces.empty())
    {
        refuse(file, 0, "There is no triangle in this file.");
    }
    return solids;
}

} // namespace drystone
