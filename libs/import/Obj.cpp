// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Wavefront OBJ. ImportedFile.h says why the reader is our own.
#include "import/Solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace drystone
{

namespace
{

class ObjReader
{
public:
    explicit ObjReader(const ImportedFile& source) : file(source) {}

    Solids read()
    {
        LineReader lines(file.bytes);
        std::string_view line;
        std::string joined;
        while (lines.next(line))
        {
            number = lines.number();
            joined.clear();
            while (line.ends_with('\\')) // goes on in the next line
            {
                joined.append(line.substr(0, line.size() - 1));
                joined += ' ';
                if (!lines.next(line))
                {
                    line = {};
                }
            }
            if (!joined.empty())
            {
                joined.append(line);
                line = joined;
            }
            readLine(line);
        }
        closeSolid();
        if (loneVertices > 0)
        {
            refuse(file, number,
                   fmt::format("The file ends with {} vertices that no face follows: is it cut off? Write it "
                               "anew, or remove these lines.",
                               loneVertices));
        }
        if (solids.solids.empty())
        {
            refuse(file, 0,
                   "There is no face in this file: an OBJ file of solids has lines `v x y z` and `f 1 2 3`.");
        }
        solids.rounding = digits.unit();
        solids.division = hasObjects || hasGroups ? Division::asWritten : Division::byConnectivity;
        if (!hasMaterials)
        {
            for (Solid& solid : solids.solids)
            {
                solid.zones = {withoutNumber(solid.name)};
            }
        }
        return std::move(solids);
    }

private:
    void readLine(std::string_view line)
    {
        const std::string_view word = nextWord(line);
        if (word == "v")
        {
            readVertex(line);
            ++loneVertices;
        }
        else if (word == "f")
        {
            readFace(line);
            loneVertices = 0;
        }
        else if (word == "l" || word == "p")
        {
            loneVertices = 0;
        }
        else if (word == "o")
        {
            // Groups before the first object were objects of their own; those in objects are parts.
            closeSolid();
            hasObjects = true;
            name = trimmed(line);
            beginsAt = number;
        }
        else if (word == "g" && !hasObjects)
        {
            closeSolid();
            hasGroups = true;
            name = trimmed(line);
            beginsAt = number;
        }
        else if (word == "usemtl")
        {
            hasMaterials = true;
            material = trimmed(line);
        }
        // All else is of no account for solids: normals, texture, smoothing, lines, points, comments.
    }

    void readVertex(std::string_view line)
    {
        Vector<3> vertex;
        for (int axis = 0; axis < 3; ++axis)
        {
            const std::string_view word = nextWord(line);
            if (word.empty())
            {
                refuse(file, number, fmt::format("A vertex has 3 coordinates; this one has {}.", axis));
            }
            vertex[axis] = numberOf(file, number, word);
            digits.add(word);
        }
        vertices.push_back(vertex);
    }

    void readFace(std::string_view line)
    {
        if (current.faces.empty())
        {
            current.name = name;
            current.zones = {material};
            current.line = beginsAt > 0 ? beginsAt : number;
        }
        std::vector<int> face;
        for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line))
        {
            if (word.front() == '#')
            {
                break;
            }
            const int index = integerOf(file, number, word.substr(0, word.find('/')));
            const auto count = static_cast<long>(vertices.size());
            const long vertex = index > 0 ? index - 1L : count + index; // negative: counted from the last
            if (index == 0 || vertex < 0 || vertex >= count)
            {
                refuse(file, number,
                       fmt::format(
                           "The face has vertex {}, but {} vertices are given before it, numbered from 1.",
                           index, count));
            }
            const auto [place, isNew] =
                own.emplace(static_cast<int>(vertex), static_cast<int>(current.vertices.size()));
            if (isNew)
            {
                current.vertices.push_back(vertices[static_cast<std::size_t>(vertex)]);
            }
            face.push_back(place->second);
        }
        if (face.size() < 3)
        {
            refuse(file, number,
                   fmt::format("A face has at least 3 vertices; this one has {}.", face.size()));
        }
        current.faces.push_back(std::move(face));
    }

    void closeSolid()
    {
        if (!current.faces.empty())
        {
            orderAsInFile();
            solids.solids.push_back(std::move(current));
        }
        current = {};
        own.clear();
    }

    /// Vertices in the order of the file instead of that in which faces name them: what is written from
    /// blocks gives these blocks again, to the last index.
    void orderAsInFile()
    {
        std::vector<std::pair<int, int>> places(own.begin(), own.end());
        std::sort(places.begin(), places.end());
        std::vector<Vector<3>> ordered;
        std::vector<int> newIndex(places.size());
        for (const auto& [inFile, inSolid] : places)
        {
            newIndex[static_cast<std::size_t>(inSolid)] = static_cast<int>(ordered.size());
            ordered.push_back(current.vertices[static_cast<std::size_t>(inSolid)]);
        }
        current.vertices = std::move(ordered);
        for (std::vector<int>& face : current.faces)
        {
            for (int& vertex : face)
            {
                vertex = newIndex[static_cast<std::size_t>(vertex)];
            }
        }
    }

    const ImportedFile& file;
    int number = 0;   ///< of the line
    int beginsAt = 0; ///< line of the last `o` or `g`
    std::vector<Vector<3>> vertices;
    int loneVertices = 0; ///< since the last face, line or point
    Solid current;
    std::unordered_map<int, int> own; ///< index in `current` of a vertex of the file
    std::string name;
    std::string material;
    bool hasObjects = false;
    bool hasGroups = false;
    bool hasMaterials = false;
    DigitCount digits;
    Solids solids;
};

} // namespace

std::string withoutNumber(std::string_view name)
{
    const std::size_t last = name.find_last_not_of("0123456789");
    if (last == std::string_view::npos)
    {
        return {}; // a number alone is no name of several
    }
    if (last + 1 < name.size())
    {
        name = name.substr(0, last + 1);
        name = name.substr(0, name.find_last_not_of("._- ") + 1);
    }
    return std::string(name);
}

Solids readObj(const ImportedFile& file)
{
    return ObjReader(file).read();
}

} // namespace drystone
