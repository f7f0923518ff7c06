// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of polyhedra.
#include "assembly/Polyhedra.h"

#include "geometry/space/PolyhedronFault.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

namespace
{

/// A list of lists, each with the place where it stands.
template<class Value>
std::vector<SourceLocation> readPlaced(const Entry& entry, std::vector<Value>& values)
{
    entry.markUsed();
    std::vector<SourceLocation> places;
    TokenCursor cursor(entry);
    const TokenCursor::ListStart start = cursor.openList();
    while (!cursor.isNext(')'))
    {
        places.push_back(entry.locationOf(cursor.peek()));
        Value value{};
        read(cursor, value);
        values.push_back(std::move(value));
    }
    cursor.closeList(start, values.size());
    cursor.expectEnd();
    return places;
}

Polyhedron readPolyhedron(const Dictionary& dictionary, std::size_t block)
{
    Polyhedron shape;
    readPlaced(dictionary.lookup("vertices"), shape.vertices);
    const std::vector<SourceLocation> places = readPlaced(dictionary.lookup("faces"), shape.faces);
    for (const Entry& entry : dictionary.entries())
    {
        if (!entry.isUsed())
        {
            throw FatalIOError(unknownWordMessage("key", entry.keyword(), {"vertices", "faces"}),
                               entry.location());
        }
    }
    if (const std::optional<PolyhedronFault> fault = findFault(shape))
    {
        throw FatalIOError(
            fmt::format(
                "Block {} is not a solid: {}.\n\nGive each face by the indices of its vertices (the first "
                "is 0) in their order round it, counter-clockwise seen from outside.",
                block, fault->text),
            fault->face >= 0
                ? places[static_cast<std::size_t>(fault->face)]
                : dictionary.locationOf(fault->face == PolyhedronFault::vertices ? "vertices" : "faces"));
    }
    return shape;
}

} // namespace

void read(TokenCursor& cursor, Polyhedra& polyhedra)
{
    polyhedra = {};
    const TokenCursor::ListStart start = cursor.openList();
    while (!cursor.isNext(')'))
    {
        polyhedra.places.push_back(cursor.entry().locationOf(cursor.peek()));
        Dictionary dictionary;
        read(cursor, dictionary);
        polyhedra.shapes.push_back(readPolyhedron(dictionary, polyhedra.shapes.size()));
    }
    cursor.closeList(start, polyhedra.shapes.size());
}

} // namespace drystone
