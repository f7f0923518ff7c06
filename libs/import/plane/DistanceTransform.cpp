// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Two passes of lower envelopes of parabolas: Felzenszwalb and Huttenlocher, Distance transforms of sampled
/// functions, Theory of Computing 8 (2012).
#include "import/plane/DistanceTransform.h"

#include <cstddef>

namespace drystone
{
namespace
{

constexpr double farAway = 1e15;

/// The transform of one row or column: of values f(j) the least (i - j)^2 + f(j) over all j, for each i. The
/// parabolas of some j form the lower envelope, each from a bound to the next. It keeps its memory from line
/// to line.
class LowerEnvelope
{
public:
    /// \param value reference to the i-th value of the line, which is changed
    template<class ValueAt>
    void transform(int size, const ValueAt& value)
    {
        line.resize(static_cast<std::size_t>(size));
        for (int i = 0; i < size; ++i)
        {
            line[static_cast<std::size_t>(i)] = value(i);
        }
        findParabolas(size);
        std::size_t k = 0;
        for (int i = 0; i < size; ++i)
        {
            while (k + 1 < places.size() && bounds[k + 1] < i)
            {
                ++k;
            }
            value(i) = double(i - places[k]) * (i - places[k]) + at(places[k]);
        }
    }

private:
    double at(int i) const { return line[static_cast<std::size_t>(i)]; }
    /// Where the parabolas of two places cross.
    double crossing(int i, int j) const
    {
        return ((at(i) + double(i) * i) - (at(j) + double(j) * j)) / (2.0 * i - 2.0 * j);
    }
    void findParabolas(int size)
    {
        places.assign(1, 0);
        bounds.assign(1, -farAway);
        for (int i = 1; i < size; ++i)
        {
            double place = crossing(i, places.back());
            while (place <= bounds.back() && places.size() > 1)
            {
                places.pop_back();
                bounds.pop_back();
                place = crossing(i, places.back());
            }
            if (place <= bounds.back())
            {
                places.back() = i;
                continue;
            }
            places.push_back(i);
            bounds.push_back(place);
        }
    }

    std::vector<double> line;
    std::vector<int> places;    ///< of the parabolas of the envelope
    std::vector<double> bounds; ///< from where on each is the lowest
};

} // namespace

Raster<double> squaredDistances(const Raster<std::uint8_t>& isMarked)
{
    Raster<double> squares = rasterOf(isMarked.width, isMarked.height, farAway);
    forEachPixel(squares,
                 [&](int x, int y)
                 {
                     if (isMarked.at(x, y) != 0)
                     {
                         squares.at(x, y) = 0;
                     }
                 });
    LowerEnvelope envelope;
    for (int x = 0; x < squares.width; ++x)
    {
        envelope.transform(squares.height, [&](int y) -> double& { return squares.at(x, y); });
    }
    for (int y = 0; y < squares.height; ++y)
    {
        envelope.transform(squares.width, [&](int x) -> double& { return squares.at(x, y); });
    }
    return squares;
}

} // namespace drystone
