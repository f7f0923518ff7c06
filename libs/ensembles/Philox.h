// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers that are a function of their place: the numbers of sample i need none of those before, so
/// that any number of processes, in any order, has the same ones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace drystone
{

/// Philox4x32-10 (Salmon, Moraes, Dror and Shaw 2011, Parallel random numbers: as easy as 1, 2, 3): 128 bits
/// of counter are mixed by ten rounds with 64 bits of key.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// What a number is drawn for; different streams of one seed are independent.
enum class Stream : std::uint32_t
{
    sample = 0,      ///< a variable of a sample
    second = 1,      ///< that of the second point of sensitivity
    permutation = 2, ///< the strata of a Latin hypercube
    shift = 3,       ///< the digital shift of a Sobol' sequence
    seed = 4,        ///< variables that are seeds
    bootstrap = 5
};

/// 64 random bits of variable k of sample i.
std::uint64_t randomBits(std::uint64_t seed, Stream stream, std::uint32_t variable, std::uint64_t sample);

/// Uniform on (0, 1), never 0 or 1: the middle of one of 2^52 equal parts.
double uniform(std::uint64_t bits);
inline double uniform(std::uint64_t seed, Stream stream, std::uint32_t variable, std::uint64_t sample)
{
    return uniform(randomBits(seed, stream, variable, sample));
}

/// A random order of 0 .. count - 1 (Fisher and Yates).
std::vector<std::uint32_t> permutation(std::uint64_t seed, std::uint32_t variable, std::uint32_t count);

} // namespace drystone
