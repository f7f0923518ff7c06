// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The weight of a fill on the faces of blocks, and its earth pressure.
#pragma once

#include "assembly/LoadedFaces.h"
#include "assembly/Tractions.h"

namespace drystone
{

/// `type backfill;`
template<int Dim>
struct BackfillSettings : LoadedFaces<Dim>
{
    double unitWeight = 0;         ///< [N/m3]
    std::optional<double> level;   ///< y, in space z, of its surface [m]; absent: above all faces
    double surcharge = 0;          ///< on its surface [Pa]
    double lateralCoefficient = 0; ///< horizontal over vertical pressure, on faces that it reaches
};

template<int Dim>
void declare(Options& options, BackfillSettings<Dim>& settings);

/// What a backfill presses with. At a depth t below its level the vertical pressure is p = unitWeight t +
/// surcharge; a face with the outward normal n, horizontal part h, bears
///     -p (max(n_up, 0) e_up + lateralCoefficient h),
/// its weight on the horizontal projection, of faces that look up, and earth pressure on the vertical one,
/// also of faces that lean over the fill. The earth pressure is left out on faces that the fill would have to
/// rise to: level with them another block stands opposite, and all between is covered, as under an arch or in
/// an opening. The weight is not: on a face above which another block stands, apart from it, it is that of
/// all above the face, and the log says so.
template<int Dim>
Tractions<Dim> backfillTractions(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                                 const BackfillSettings<Dim>& settings);

} // namespace drystone
