// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The list of hard cases that tests and the table of test/benchmark share.
#pragma once

#include "Towers.h"

#include <fmt/format.h>

#include <string>

namespace drystone
{

/// A tower, and the share of its weight that pushes it while it makes one step from rest.
struct HardCase
{
    std::string name;
    std::string varied; ///< what is varied: massRatio friction blocks points
    double value = 0;   ///< of what is varied
    double alpha = 0;
    Tower tower;
};

/// Each of a family standing (at 0.8 of its multiplier) and moving (at 1.1 of it, and at least 0.05).
inline std::vector<HardCase> hardCases()
{
    std::vector<HardCase> cases;
    const auto add = [&cases](const std::string& varied, double value, Tower tower)
    {
        tower.push = {0.8, 0.6};
        const double alpha = towerMultiplier(tower, 3);
        cases.push_back({fmt::format("{}={:g} standing", varied, value), varied, value, 0.8 * alpha, tower});
        cases.push_back({fmt::format("{}={:g} moving", varied, value), varied, value,
                         std::max(0.05, 1.1 * alpha), tower});
    };
    for (const double ratio : {1.0, 1e2, 1e4, 1e6, 1e8})
    {
        add("massRatio", ratio, evenTower(5, ratio));
    }
    for (const double mu : {0.0, 1e-12, 0.65, 3.0})
    {
        add("friction", mu, evenTower(2, 1, mu));
    }
    for (const int blocks : {5, 20, 50, 200})
    {
        add("blocks", blocks, evenTower(blocks));
    }
    for (const int points : {2, 10, 76, 300})
    {
        add("pointsPerSide", points, evenTower(3, 1, 0.65, points));
    }
    return cases;
}

} // namespace drystone
