// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Loads on the faces of blocks: pressure, as of wind, and the weight of a backfill.
#pragma once

#include "assembly/Backfill.h"
#include "assembly/Loads.h"

namespace drystone
{

/// `type pressure;`
template<int Dim>
struct PressureSettings : LoadedFaces<Dim>
{
    double value = 0;                            ///< [Pa], positive presses, negative pulls
    Vector<Dim> normal = Vector<Dim>::Zero();    ///< of the faces, outwards; of any length but 0
    double within = 45;                          ///< of it and the normal of a face that is loaded [degree]
    Vector<Dim> direction = Vector<Dim>::Zero(); ///< of the force, of any length; 0: against each face
};

template<int Dim>
void declare(Options& options, PressureSettings<Dim>& settings);

/// The load of a pressure on faces. \param exposed see exposedSurface
template<int Dim>
Load pressureLoad(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                  const PressureSettings<Dim>& settings);

/// The load of a backfill, see backfillTractions.
template<int Dim>
Load backfillLoad(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                  const BackfillSettings<Dim>& settings);

/// The types `pressure` and `backfill` of constant/loads.
template<int Dim>
std::vector<Model<LoadMaker<Dim>>> surfaceLoadTypes();

} // namespace drystone
