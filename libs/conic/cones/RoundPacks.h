// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Round cones of long vectors, as many at once as the processor reckons with: what SecondOrderCone.h says of
/// one cone is then done to four.
#pragma once

#include "conic/cones/SecondOrderCone.h"
#include "core/Threads.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>
#include <vector>

namespace drystone
{

template<class Scalar>
using VectorOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// What round cones of a vector of such numbers are reckoned with in: four at once where they are doubles.
template<class Scalar>
using Abreast = std::conditional_t<std::is_same_v<Scalar, double>, FourDoubles, Scalar>;
/// Likewise where the leading doubles do.
template<class Scalar>
using AbreastInDoubles = std::decay_t<decltype(leading(std::declval<Abreast<Scalar>>()))>;

/// Round cones that are reckoned with at once.
struct Pack
{
    std::size_t number;
    Eigen::Index round; ///< the first
    int count;
};

/// Carries out `function(pack)` for each, on several threads where there are many.
template<class Number, class Function>
void forPacks(Eigen::Index rounds, const Function& function)
{
    constexpr int most = countOf<Number>;
    forParts((rounds + most - 1) / most,
             [&](long begin, long end)
             {
                 for (long pack = begin; pack < end; ++pack)
                 {
                     function(Pack{static_cast<std::size_t>(pack), most * pack,
                                   static_cast<int>(std::min<Eigen::Index>(most, rounds - most * pack))});
                 }
             });
}

/// The numbers of a pack in x, which begin at `first`; e for cones that it is short of.
template<class Scalar>
ConeVector<Abreast<Scalar>> taken(const VectorOf<Scalar>& x, Eigen::Index first, int count)
{
    using Number = Abreast<Scalar>;
    const auto from = [](const Scalar* at) -> ConeVector<Number>
    {
        return {Gathered<Number>::from(at, 3), Gathered<Number>::from(at + 1, 3),
                Gathered<Number>::from(at + 2, 3)};
    };
    if (count == countOf<Number>)
    {
        return from(x.data() + first);
    }
    Eigen::Matrix<Scalar, 3, countOf<Number>> filled;
    filled.colwise() = ConeVector<Scalar>(Scalar(1), Scalar(0), Scalar(0));
    filled.leftCols(count).reshaped() = x.segment(first, 3 * count);
    return from(filled.data());
}

/// Likewise matrices; that of e for cones that the pack is short of.
template<class Scalar>
FramedMatrix<Abreast<Scalar>> taken(const std::vector<FramedMatrix<Scalar>>& all, const Pack& pack)
{
    using Number = Abreast<Scalar>;
    const auto from = [](const FramedMatrix<Scalar>* first) -> FramedMatrix<Number>
    {
        constexpr int apart = sizeof(FramedMatrix<Scalar>) / sizeof(Scalar);
        const auto number = [](const Scalar& ofFirst)
        { return Number(Gathered<Number>::from(&ofFirst, apart)); };
        return {
            {number(first->direction[0]), number(first->direction[1])},
            {number(first->eigenvalues[0]), number(first->eigenvalues[1]), number(first->eigenvalues[2])}};
    };
    const FramedMatrix<Scalar>* first = all.data() + pack.round;
    if (pack.count == countOf<Number>)
    {
        return from(first);
    }
    std::array<FramedMatrix<Scalar>, countOf<Number>> filled;
    std::copy_n(first, pack.count, filled.begin());
    return from(filled.data());
}

/// Writes the numbers of a pack into x, from `first` on; those of cones that it is short of nowhere.
template<class Scalar>
void put(const ConeVector<Abreast<Scalar>>& pack, Eigen::Index first, int count, VectorOf<Scalar>& x)
{
    Scalar* to = x.data() + first;
    for (int one = 0; one < countOf<Abreast<Scalar>> && one < count; ++one, to += 3)
    {
        to[0] = oneOf(pack[0], one);
        to[1] = oneOf(pack[1], one);
        to[2] = oneOf(pack[2], one);
    }
}

} // namespace drystone
