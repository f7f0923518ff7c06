// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `arch`: voussoirs with radial joints between two abutments.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <array>
#include <string_view>
#include <utility>

namespace drystone
{

enum class ArchProfile
{
    circular
};

inline std::array<std::pair<std::string_view, ArchProfile>, 1> namesOf(ArchProfile)
{
    return {{{"circular", ArchProfile::circular}}};
}

struct Arch
{
    ArchProfile profile = ArchProfile::circular;
    double radius = 1;       ///< of the centreline [m]
    double thickness = 0.15; ///< in the radial direction [m]
    int voussoirs = 27;
    double depth = 1;   ///< out of plane [m]
    double angle = 180; ///< subtended by the arch, from springing to springing [degrees]
};

void declare(Options& options, Arch& arch);

/// All keys but `depth`, for vaults that have an arch as their section.
void declareSection(Options& options, Arch& arch);

/// Whether the arch has abutments of its own.
enum class Abutments
{
    own, ///< two fixed blocks as supports `left` and `right`
    none
};

/// Voussoirs from the left springing to the right one: trapezoids with straight edges, whose corners lie on
/// the circles of radius R - t/2 and R + t/2 about the origin, joints along radii. The crown is at (0, R): a
/// semicircle springs from y = 0. The two abutments come last; each has the springing plane as its face,
/// extended by t to either side so that a voussoir may slide on it. The arch is symmetric bit by bit.
Assembly<2> makeAssembly(const Arch& arch, Abutments abutments = Abutments::own);

} // namespace drystone
