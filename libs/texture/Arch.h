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
    circular, ///< segmental below an angle of 180 degrees
    pointed,  ///< two arcs of circles whose centres lie on the springing line on either side of the axis
    elliptic  ///< half an ellipse
};

inline std::array<std::pair<std::string_view, ArchProfile>, 3> namesOf(ArchProfile)
{
    return {{{"circular", ArchProfile::circular},
             {"pointed", ArchProfile::pointed},
             {"elliptic", ArchProfile::elliptic}}};
}

struct Arch
{
    ArchProfile profile = ArchProfile::circular;
    double radius = 1;       ///< of the centreline; of an elliptic one half the span [m]
    double offset = 0;       ///< of a pointed one: of each centre from the axis, towards the other side [m]
    double rise = 0;         ///< of an elliptic one: of the crown over the springing line [m]
    double thickness = 0.15; ///< in the radial direction [m]
    int voussoirs = 27;
    double depth = 1;   ///< out of plane [m]
    double angle = 180; ///< subtended by a circular arch, from springing to springing [degrees]
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

/// Voussoirs from the left springing to the right one: quadrilaterals with straight edges, whose corners lie
/// at t/2 on either side of the centreline on joints that are perpendicular to it and turned by equal angles
/// from each to the next. Circular: about the origin, crown at (0, R); a semicircle springs from y = 0.
/// Pointed: springing at y = 0, equal angles from there to the crown, whose joint alone is vertical.
/// Elliptic: half axes R and rise, springing at y = 0. The two abutments come last; each has the springing
/// plane as its face, extended by t to either side so that a voussoir may slide on it. The arch is symmetric
/// bit by bit.
Assembly<2> makeAssembly(const Arch& arch, Abutments abutments = Abutments::own);

} // namespace drystone
