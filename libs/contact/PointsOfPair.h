// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lists of contact points are sorted by pairs of blocks: finds those of one pair.
#pragma once

#include "contact/ContactPoint.h"

#include <algorithm>
#include <utility>

namespace drystone
{

template<int Dim>
std::pair<int, int> pairOf(const ContactPoint<Dim>& point)
{
    return {point.block, point.neighbour};
}

/// The entries of a pair of blocks in a list that is sorted by pairs: the first one, and behind the last.
/// \param ofEntry the pair of an entry
template<typename Iterator, typename PairOfEntry>
std::pair<Iterator, Iterator> entriesOf(const std::pair<int, int>& pair, Iterator begin, Iterator end,
                                        const PairOfEntry& ofEntry)
{
    const auto isBefore = [&](const auto& entry) { return ofEntry(entry) < pair; };
    const auto isOther = [&](const auto& entry) { return ofEntry(entry) != pair; };
    const Iterator first = std::partition_point(begin, end, isBefore);
    return {first, std::find_if(first, end, isOther)}; // a pair has a handful of points
}

} // namespace drystone
