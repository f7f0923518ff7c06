// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sets of things that belong together, such as blocks that touch, from the pairs that do; in core since
/// solvers of several libraries group their bodies so.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace drystone
{

/// Numbers from 0, each in a set of its own until sets are joined (Tarjan, 1975; paths are halved).
class DisjointSets
{
public:
    explicit DisjointSets(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0); }

    /// The least number of the set that one is in.
    int firstOf(int member)
    {
        while (above(member) != member)
        {
            above(member) = above(above(member));
            member = above(member);
        }
        return member;
    }

    void join(int one, int other)
    {
        const auto [least, next] = std::minmax({firstOf(one), firstOf(other)});
        above(next) = least;
    }

private:
    std::vector<int> parent; ///< one of the same set, not greater; itself for the first

    int& above(int member) { return parent[static_cast<std::size_t>(member)]; }
};

} // namespace drystone
