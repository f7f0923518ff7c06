// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Merges a child into its parent, on a stack, by widths and shares of zeros as CHOLMOD does.
#include "linear/Supernodes.h"

#include <algorithm>
#include <array>

namespace drystone
{
namespace
{

/// Columns of L that a front may have are chosen as in CHOLMOD (Chen, Davis, Hager & Rajamanickam 2008): a
/// child is taken into its parent's front while that is narrow enough for the share of zeros it brings.
struct Amalgamation
{
    int columns;
    double zeros; ///< share of L
};
constexpr std::array<Amalgamation, 4> amalgamations{{{8, 1}, {24, 0.8}, {64, 0.2}, {1 << 30, 0.1}}};

} // namespace

std::vector<Supernode> supernodes(const BlockPattern& factor, int rowsOfBlock)
{
    const std::vector<int>& start = factor.columnStart;
    std::vector<Supernode> found;
    for (int body = 0; body < factor.columns(); ++body)
    {
        found.push_back({body, body + 1, start[body + 1] - start[body]});
        while (found.size() > 1)
        {
            // The parent of the supernode before is this one if the first row below its columns says so.
            const Supernode& child = found[found.size() - 2];
            const Supernode& parent = found.back();
            const int last = child.lastBody - 1;
            if (start[last + 1] - start[last] < 2 || factor.row[start[last] + 1] >= parent.lastBody)
            {
                break;
            }
            const double width = child.lastBody - child.firstBody;
            const double together = width + parent.lastBody - parent.firstBody;
            const double bodies = width + parent.bodies;
            const double zeros = child.zeros + parent.zeros + width * (bodies - child.bodies);
            const double share = zeros / (together * (together + 1) / 2 + together * (bodies - together));
            const bool pays = std::any_of(amalgamations.begin(), amalgamations.end(),
                                          [&](const Amalgamation& amalgamation) {
                                              return rowsOfBlock * together <= amalgamation.columns
                                                     && share <= amalgamation.zeros;
                                          });
            if (!pays)
            {
                break;
            }
            const Supernode merged{child.firstBody, parent.lastBody, static_cast<int>(bodies), zeros};
            found.pop_back();
            found.back() = merged;
        }
    }
    return found;
}

} // namespace drystone
