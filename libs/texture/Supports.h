// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What holds a structure: fixed ground blocks under it, or some of its own blocks fixed.
#pragma once

#include "assembly/Assembly.h"

#include <limits>
#include <string>
#include <vector>

namespace drystone
{

/// Fixed ground whose top is y = 0, in blocks side by side from the left end of the structure to its right
/// end.
struct Ground
{
    double segment =
        std::numeric_limits<double>::infinity(); ///< length of one ground block [m]; infinity: a single one
    double depth =
        0; ///< of the ground blocks [m]; 0: a tenth of the larger of the structure's width and height
    double margin =
        -1; ///< by how far the ground goes on past each end [m]; negative: three times the larger of the
            ///< structure's width and height, so that what slides or falls has a ground to land on
};

/// Adds the ground's blocks behind those of the structure, and the support itself.
void addGround(Assembly<2>& assembly, const std::string& name, const Ground& ground);

} // namespace drystone
