// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/FillFromAbove.h"

#include "assembly/BlockShape.h"
#include "assembly/Loads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace drystone
{

template<int Dim>
FillFromAbove<Dim>::FillFromAbove(const Assembly<Dim>& structure, std::optional<double> levelOfFill)
    : assembly(structure), level(levelOfFill), width(widthOfAJoint(structure))
{
    for (const Block<Dim>& block : assembly.blocks)
    {
        boxes.push_back(boundingBox(block));
        extend<Dim>(all, boxes.back().lower);
        extend<Dim>(all, boxes.back().upper);
    }
}

template<int Dim>
bool FillFromAbove<Dim>::reaches(const std::vector<SurfacePiece<Dim>>& pieces) const
{
    const Vector<Dim>& normal = pieces.front().normal;
    const Vector<Dim> outwards = (normal - normal.dot(up) * up).normalized();
    bool isKnown = false;
    for (const SurfacePiece<Dim>& piece : pieces)
    {
        for (const auto& [place, weight] : quadratureOf(piece))
        {
            const double opposite = weight > 0 ? firstBlockAlong(place, outwards) : 0;
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
bool FillFromAbove<Dim>::isOpenAbove(const Vector<Dim>& place, const Vector<Dim>& toOpposite) const
{
    constexpr std::array<double, 3> parts{0.25, 0.5, 0.75};
    return std::any_of(parts.begin(), parts.end(),
                       [&](double part)
                       {
                           const double cover = firstBlockAlong(place + part * toOpposite, up);
                           return std::isinf(cover) || (level && cover > *level - place.dot(up) + width);
                       });
}

template<int Dim>
double FillFromAbove<Dim>::firstBlockAlong(const Vector<Dim>& from, const Vector<Dim>& direction) const
{
    const Vector<Dim> end = from + (all.upper - all.lower).norm() * direction;
    const Box<Dim> way = enlarged<Dim>({from.cwiseMin(end), from.cwiseMax(end)}, width);
    double first = std::numeric_limits<double>::infinity();
    for (std::size_t block = 0; block < boxes.size(); ++block)
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
            if (places[i] >= 0 && distanceFrom(assembly.blocks[block], middle) == 0
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
