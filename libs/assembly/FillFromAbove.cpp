// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rays from places on a face, level to the block opposite and upwards, show whether blocks are in the way.
#include "assembly/FillFromAbove.h"

#include "assembly/BlockShape.h"
#include "assembly/Loads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace drystone
{
namespace
{

/// Some places of a piece, none on its border, where blocks often end.
std::vector<Vector<2>> placesInside(const SurfacePiece<2>& piece)
{
    constexpr int count = 10;
    std::vector<Vector<2>> places;
    for (int i = 0; i < count; ++i)
    {
        places.emplace_back(piece.corners[0]
                            + (i + 0.5) / count * Vector<2>(piece.corners[1] - piece.corners[0]));
    }
    return places;
}

std::vector<Vector<3>> placesInside(const SurfacePiece<3>& piece)
{
    constexpr int count = 5;
    const auto& [a, b, c] = piece.corners;
    std::vector<Vector<3>> places;
    for (int i = 0; i < count; ++i)
    {
        for (int j = 0; i + j < count; ++j)
        {
            places.emplace_back(a + (i + 1.0 / 3) / count * (b - a) + (j + 1.0 / 3) / count * (c - a));
        }
    }
    return places;
}

} // namespace

template<int Dim>
FillFromAbove<Dim>::FillFromAbove(const Assembly<Dim>& structure, std::optional<double> levelOfFill)
    : assembly(structure), level(levelOfFill), width(widthOfAJoint(structure))
{
    for (const Block<Dim>& block : assembly.blocks)
    {
        boxes.push_back(boundingBox(block));
        extend<Dim>(all, boxes.back());
    }
    every.resize(boxes.size());
    std::iota(every.begin(), every.end(), std::size_t{0});
}

template<int Dim>
bool FillFromAbove<Dim>::reaches(const std::vector<SurfacePiece<Dim>>& pieces) const
{
    const Vector<Dim>& normal = pieces.front().normal;
    const Vector<Dim> outwards = (normal - normal.dot(up) * up).normalized();
    bool isKnown = false;
    for (const SurfacePiece<Dim>& piece : pieces)
    {
        if (piece.weight <= 0)
        {
            continue;
        }
        for (const Vector<Dim>& place : placesInside(piece))
        {
            const double opposite = firstBlockAlong(every, place, outwards);
            if (opposite > width && (std::isinf(opposite) || isOpenAbove(place, opposite * outwards)))
            {
                return true;
            }
            isKnown = isKnown || opposite > width; // else another block lies there
        }
    }
    return !isKnown;
}

template<int Dim>
bool FillFromAbove<Dim>::isSheltered(const std::vector<SurfacePiece<Dim>>& pieces) const
{
    Box<Dim> above;
    for (const SurfacePiece<Dim>& piece : pieces)
    {
        for (const Vector<Dim>& corner : piece.corners)
        {
            extend<Dim>(above, corner);
        }
    }
    above.upper[Dim - 1] = all.upper[Dim - 1];
    std::vector<std::size_t> near;
    for (std::size_t block = 0; block < boxes.size(); ++block)
    {
        if (meet<Dim>(above, boxes[block]))
        {
            near.push_back(block);
        }
    }
    const auto isBelowABlock = [&](const Vector<Dim>& place)
    {
        const double cover = firstBlockAlong(near, place, up);
        return cover > width && std::isfinite(cover)
               && (!level || std::abs(*level - place.dot(up) - cover) > width); // else it stands on the fill
    };
    return std::any_of(pieces.begin(), pieces.end(),
                       [&](const SurfacePiece<Dim>& piece)
                       {
                           const auto places = placesInside(piece);
                           return piece.weight > 0
                                  && std::any_of(places.begin(), places.end(), isBelowABlock);
                       });
}

template<int Dim>
bool FillFromAbove<Dim>::isOpenAbove(const Vector<Dim>& place, const Vector<Dim>& toOpposite) const
{
    constexpr std::array<double, 3> parts{0.25, 0.5, 0.75};
    return std::any_of(parts.begin(), parts.end(),
                       [&](double part)
                       { return std::isinf(firstBlockAlong(every, place + part * toOpposite, up)); });
}

template<int Dim>
double FillFromAbove<Dim>::firstBlockAlong(const std::vector<std::size_t>& among, const Vector<Dim>& from,
                                           const Vector<Dim>& direction) const
{
    const Vector<Dim> end = from + (all.upper - all.lower).norm() * direction;
    const Box<Dim> way = enlarged<Dim>(boxAround<Dim>(from, end), width);
    double first = std::numeric_limits<double>::infinity();
    for (const std::size_t block : among)
    {
        if (!meet<Dim>(way, boxes[block]))
        {
            continue;
        }
        std::vector<double> places = placesToCut(assembly.blocks[block], from, direction);
        places.push_back(0);
        std::sort(places.begin(), places.end());
        for (std::size_t i = 0; i + 1 < places.size() && places[i] < first; ++i)
        {
            const Vector<Dim> middle = from + (places[i] + places[i + 1]) / 2 * direction;
            // A ray within a joint is in neither of its blocks, and nothing comes through it.
            if (places[i] >= 0 && distanceFrom(assembly.blocks[block], middle) <= width
                && places[i + 1] - places[i] > width)
            {
                first = places[i];
            }
        }
    }
    return first;
}

template class FillFromAbove<2>;
template class FillFromAbove<3>;

} // namespace drystone
