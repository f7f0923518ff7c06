// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Counting the digits of coordinates.
#include "assembly/WrittenDigits.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace drystone
{

namespace
{

/// A computed coordinate mostly has 15 to 17.
constexpr int allDigits = 15;

/// A number of digits that fewer than this share of the coordinates reach is taken for a few corners of
/// another origin.
constexpr double leastShare = 0.1;

/// Of rounded coordinates one in ten ends in 0, which is not written. Where less than this share has the same
/// number of digits, corners were placed so on purpose: the wedge (0 0) (1 0.001), say.
constexpr double leastAgreement = 2.0 / 3;

/// A normal with a smaller part along an axis is perpendicular to it: rounding turns faces by less.
constexpr double leastPart = 1e-3;

struct WrittenNumber
{
    int significant = 0; ///< digits
    int decimals = 0;    ///< digits behind the point
    int exponent = 0;    ///< of ten
};

WrittenNumber writtenNumber(double value)
{
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), std::abs(value), std::chars_format::scientific)
            .ptr;
    const std::string_view all(text.data(), static_cast<std::size_t>(end - text.data()));
    const std::size_t mark = all.find('e');
    WrittenNumber number;
    number.significant = static_cast<int>(mark) - (all.find('.') < mark ? 1 : 0);
    const std::string_view exponent = all.substr(mark + 2);
    std::from_chars(exponent.data(), exponent.data() + exponent.size(), number.exponent);
    number.exponent *= all[mark + 1] == '-' ? -1 : 1;
    number.decimals = std::max(0, number.significant - 1 - number.exponent);
    return number;
}

/// The most digits that at least leastShare of the numbers have.
int mostCommonDigits(const std::vector<WrittenNumber>& numbers, int WrittenNumber::*digits)
{
    std::vector<int> counts;
    for (const WrittenNumber& number : numbers)
    {
        counts.push_back(number.*digits);
    }
    const auto place =
        counts.begin() + static_cast<std::ptrdiff_t>(leastShare * static_cast<double>(counts.size()));
    std::nth_element(counts.begin(), place, counts.end(), std::greater<>());
    return *place;
}

/// Calls `visit(coordinate)` for those that place an edge across itself: all, unless it is parallel to an
/// axis.
template<class Visit>
void visitCoordinates(const Block<2>& block, const Visit& visit)
{
    for (std::size_t i = 0; i < block.outline.size(); ++i)
    {
        const Vector<2>& from = block.outline[i];
        const Vector<2>& to = block.outline[(i + 1) % block.outline.size()];
        if (from.x() != to.x() && from.y() != to.y())
        {
            visit(from.x());
            visit(from.y());
            visit(to.x());
            visit(to.y());
        }
    }
}

/// The same of faces: along the axes that the normal has a part of, unless the face is parallel to two.
template<class Visit>
void visitCoordinates(const Block<3>& block, const Visit& visit)
{
    for (const std::vector<int>& face : block.shape.faces)
    {
        const Vector<3> normal = areaVector(block.shape, face).normalized();
        const auto isAlong = [&](int axis) { return std::abs(normal[axis]) > leastPart; };
        if (isAlong(0) + isAlong(1) + isAlong(2) < 2)
        {
            continue;
        }
        for (const int corner : face)
        {
            for (int axis = 0; axis < 3; ++axis)
            {
                if (isAlong(axis))
                {
                    visit(block.shape.vertices[static_cast<std::size_t>(corner)][axis]);
                }
            }
        }
    }
}

} // namespace

template<int Dim>
double writtenRounding(const Assembly<Dim>& assembly)
{
    std::vector<WrittenNumber> numbers;
    std::size_t count = 0;
    const auto add = [&](double coordinate)
    {
        ++count;
        if (coordinate == 0 || !std::isfinite(coordinate))
        {
            return;
        }
        const WrittenNumber number = writtenNumber(coordinate);
        if (number.significant < allDigits)
        {
            numbers.push_back(number);
        }
    };
    for (const Block<Dim>& block : assembly.blocks)
    {
        visitCoordinates(block, add);
    }
    if (numbers.empty() || static_cast<double>(numbers.size()) < leastAgreement * static_cast<double>(count))
    {
        return 0;
    }
    const int decimals = mostCommonDigits(numbers, &WrittenNumber::decimals);
    const int significant = mostCommonDigits(numbers, &WrittenNumber::significant);
    const auto share = [&](const auto& agrees)
    {
        return static_cast<double>(std::count_if(numbers.begin(), numbers.end(), agrees))
               / static_cast<double>(count);
    };
    const double withDecimals =
        share([&](const WrittenNumber& number) { return number.decimals == decimals; });
    const double withSignificant =
        share([&](const WrittenNumber& number) { return number.significant == significant; });
    if (std::max(withDecimals, withSignificant) < leastAgreement)
    {
        return 0;
    }
    if (withDecimals >= withSignificant)
    {
        return std::pow(10.0, -decimals);
    }
    int largest = -400;
    for (const WrittenNumber& number : numbers)
    {
        if (number.significant >= significant - 1) // 1.23450 lost its last digit, 1000 says nothing
        {
            largest = std::max(largest, number.exponent);
        }
    }
    return std::pow(10.0, largest + 1 - significant);
}

template double writtenRounding(const Assembly<2>& assembly);
template double writtenRounding(const Assembly<3>& assembly);

} // namespace drystone
