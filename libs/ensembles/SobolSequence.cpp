// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Direction numbers by the recurrence of primitive polynomials, combined by XOR where the index has a bit.
#include "ensembles/SobolSequence.h"

#include <array>
#include <cstddef>

namespace drystone
{
namespace
{

/// Primitive polynomials and first direction numbers (Joe and Kuo, new-joe-kuo-6, dimensions 2 to 21).
struct SobolDimension
{
    int degree;
    std::uint32_t polynomial; ///< inner coefficients
    std::array<std::uint32_t, 7> first;
};
constexpr std::array<SobolDimension, sobolDimensions - 1> sobolTable{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
}};

using DirectionNumbers = std::array<std::uint32_t, 32>;

std::array<DirectionNumbers, sobolDimensions> makeDirections()
{
    std::array<DirectionNumbers, sobolDimensions> all{};
    for (int bit = 0; bit < 32; ++bit)
    {
        all[0][static_cast<std::size_t>(bit)] = 1u << (31 - bit);
    }
    for (std::size_t dimension = 1; dimension < sobolDimensions; ++dimension)
    {
        const SobolDimension& made = sobolTable[dimension - 1];
        const auto degree = static_cast<std::size_t>(made.degree);
        DirectionNumbers& numbers = all[dimension];
        for (std::size_t bit = 0; bit < 32; ++bit)
        {
            if (bit < degree)
            {
                numbers[bit] = made.first[bit] << (31 - bit);
                continue;
            }
            numbers[bit] = numbers[bit - degree] ^ (numbers[bit - degree] >> made.degree);
            for (std::size_t k = 1; k < degree; ++k)
            {
                if ((made.polynomial >> (degree - 1 - k)) & 1u)
                {
                    numbers[bit] ^= numbers[bit - k];
                }
            }
        }
    }
    return all;
}

} // namespace

std::uint32_t sobolBits(std::uint32_t index, int dimension)
{
    static const auto directions = makeDirections();
    std::uint32_t bits = 0;
    for (std::size_t bit = 0; index != 0; ++bit, index >>= 1)
    {
        if (index & 1u)
        {
            bits ^= directions[static_cast<std::size_t>(dimension)][bit];
        }
    }
    return bits;
}

} // namespace drystone
