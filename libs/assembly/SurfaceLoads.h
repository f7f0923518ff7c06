// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Loads on the faces of blocks: pressure, as of wind, and the weight of a backfill.
#pragma once

#include "assembly/BlockSurface.h"
#include "assembly/Loads.h"

namespace drystone
{

/// Where a load acts on faces: on those of free blocks that no other block touches.
template<int Dim>
struct LoadedFaces
{
    std::vector<int> blocks;        ///< by index; empty: all
    std::vector<NamePattern> zones; ///< of the assembly; empty: all blocks
    std::vector<Vector<Dim>> box;   ///< lower and upper corner; empty: anywhere [m]
};

template<int Dim>
void declare(Options& options, LoadedFaces<Dim>& faces);

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

/// What of the faces is loaded: their surface less the parts on which other blocks lie.
/// \param covered see coveredSurface (contact/CoveredSurface.h)
template<int Dim>
std::vector<SurfacePiece<Dim>> exposedSurface(const Assembly<Dim>& assembly,
                                              const std::vector<SurfacePiece<Dim>>& covered,
                                              const LoadedFaces<Dim>& faces);

/// The load of a pressure on faces, rows as LoadVectors. \param exposed see exposedSurface
template<int Dim>
Eigen::VectorXd pressureLoad(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                             const PressureSettings<Dim>& settings);

/// The load of a backfill. At a depth t below its level the vertical pressure is p = unitWeight t +
/// surcharge; a face with the outward normal n, horizontal part h, bears
///     -p (max(n_up, 0) e_up + lateralCoefficient h),
/// its weight on the horizontal projection, of faces that look up, and earth pressure on the vertical one,
/// also of faces that lean over the fill. The earth pressure is left out on faces that the fill would have to
/// rise to: level with them another block stands opposite, and all between is covered, as under an arch or in
/// an opening. The weight is not: on a face above which another block stands, apart from it, it is that of
/// all above the face, and the log says so.
template<int Dim>
Eigen::VectorXd backfillLoad(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                             const BackfillSettings<Dim>& settings);

/// The types `pressure` and `backfill` of constant/loads.
template<int Dim>
std::vector<Model<LoadMaker<Dim>>> surfaceLoadTypes();

} // namespace drystone
