// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The generator of the samples of ensembles.
#include "ensembles/Philox.h"

#include <numeric>
#include <utility>

namespace drystone
{

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key)
{
    constexpr std::uint64_t multiplier0 = 0xD2511F53u;
    constexpr std::uint64_t multiplier1 = 0xCD9E8D57u;
    constexpr std::uint32_t weyl0 = 0x9E3779B9u; // golden ratio
    constexpr std::uint32_t weyl1 = 0xBB67AE85u; // sqrt(3) - 1
    for (int round = 0; round < 10; ++round)
    {
        const std::uint64_t product0 = multiplier0 * counter[0];
        const std::uint64_t product1 = multiplier1 * counter[2];
        counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0],
                   static_cast<std::uint32_t>(product1),
                   static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1],
                   static_cast<std::uint32_t>(product0)};
        key[0] += weyl0;
        key[1] += weyl1;
    }
    return counter;
}

std::uint64_t randomBits(std::uint64_t seed, Stream stream, std::uint32_t variable, std::uint64_t sample)
{
    const auto high = [](std::uint64_t bits) { return static_cast<std::uint32_t>(bits >> 32); };
    const auto low = [](std::uint64_t bits) { return static_cast<std::uint32_t>(bits); };
    const auto bits = philox({low(sample), high(sample), variable, static_cast<std::uint32_t>(stream)},
                             {low(seed), high(seed)});
    return (std::uint64_t{bits[1]} << 32) | bits[0];
}

double uniform(std::uint64_t bits)
{
    return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

std::vector<std::uint32_t> permutation(std::uint64_t seed, std::uint32_t variable, std::uint32_t count)
{
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    for (std::uint32_t last = count; last > 1; --last)
    {
        // 32 bits times the count: for a million strata the probabilities are equal to 1 in 4000.
        const std::uint64_t bits = randomBits(seed, Stream::permutation, variable, last);
        const auto chosen = static_cast<std::uint32_t>(((bits >> 32) * last) >> 32);
        std::swap(order[last - 1], order[chosen]);
    }
    return order;
}

} // namespace drystone
