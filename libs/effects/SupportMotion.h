// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Supports that move in a prescribed way: constant/supportMotion.
///
///     right { direction (0 -1 0); displacement ((0 0) (2 0.05)); }      // settles 50 mm in 2 s
///     table { direction (1 0 0); velocity ((0 0) (0.5 1) (1 0)); }      // speeds up and slows down
///     left  { centre (1 0 0); rotation ((0 0) (2 0.01)); }              // turns by 0.01 rad about (1 0)
///
/// In space a rotation has an `axis (0 0 1);`, too.
#pragma once

#include "contact/Equilibrium.h"
#include "dictionary/Options.h"
#include "effects/MassMatrix.h"
#include "geometry/Rotation.h"
#include "timeSeries/GroundAcceleration.h"

#include <filesystem>

namespace drystone
{

/// What one entry says: a table of displacements or velocities, or one of rotations or angular velocities, or
/// one of each. Between the points of a table it is linear; before the first and after the last the support
/// stands still.
template<int Dim>
struct SupportMotionSettings
{
    Vector<Dim> direction = Vector<Dim>::Zero();         ///< of any length but zero
    std::vector<std::pair<double, double>> displacement; ///< times [s] and places [m]
    std::vector<std::pair<double, double>> velocity;     ///< times [s] and velocities [m/s]
    Vector<Dim> centre = Vector<Dim>::Zero();        ///< of rotation, as built; it goes with the support [m]
    Turn<Dim> axis = unitTurn<Dim>();                ///< of rotation: in space any vector, in the plane 1
    std::vector<std::pair<double, double>> rotation; ///< times [s] and angles [rad]
    std::vector<std::pair<double, double>> angularVelocity; ///< times [s] and velocities [rad/s]
};
template<int Dim>
void declare(Options& options, SupportMotionSettings<Dim>& settings);

/// The whole file: an entry for each support that moves, under its name.
template<int Dim>
struct SupportMotionFile
{
    std::vector<std::pair<std::string, SupportMotionSettings<Dim>>> supports;
};
template<int Dim>
void declare(Options& options, SupportMotionFile<Dim>& file);

/// A support that moves relative to the ground. Histories have exact means; null: none.
template<int Dim>
struct SupportMotion
{
    int support = -1;                                               ///< index into Assembly::supports
    Vector<Dim> direction = Vector<Dim>::UnitX();                   ///< unit vector
    std::shared_ptr<const GroundAcceleration> velocity;             ///< of its centre [m/s]
    std::shared_ptr<const GroundAcceleration> angularVelocity = {}; ///< about its centre [rad/s]
    Vector<Dim> centre = Vector<Dim>::Zero();                       ///< as built [m]
    Turn<Dim> axis = unitTurn<Dim>(); ///< that it turns about: in space a unit vector, in the plane 1
};

/// How a block goes with its support over a time; all zero where the support stands still.
template<int Dim>
struct SupportStep
{
    Vector<Dim> translation = Vector<Dim>::Zero(); ///< of the support's centre [m]
    Turn<Dim> rotation = noTurn<Dim>();            ///< [rad]
    Vector<Dim> arm = Vector<Dim>::Zero(); ///< from that centre to the block's mass centre at the start [m]
};

/// The displacement (ux uy rz) of the block's mass centre after a share of the time: to the last digits.
template<int Dim>
BlockVector<Dim> displacementAfter(const SupportStep<Dim>& step, double share = 1);

/// The supports of a case that move; none where the file is absent.
/// \throws FatalIOError for what is wrong with the file, or a name that no support has
template<int Dim>
std::vector<SupportMotion<Dim>> readSupportMotions(const std::filesystem::path& caseDirectory,
                                                   const Assembly<Dim>& assembly);

/// How each block goes with its support between two instants; not at all for all others. Empty without
/// motions. \param centroids as built, in `blocks` \param placements at the first instant
template<int Dim>
std::vector<SupportStep<Dim>>
supportSteps(const std::vector<SupportMotion<Dim>>& motions, const Assembly<Dim>& assembly,
             const std::vector<BlockMass<Dim>>& blocks, const std::vector<Placement<Dim>>& placements,
             double from, double to);

/// Moves blocks by a share of the way that they go with their supports. \param steps see supportSteps
template<int Dim>
void moveWithSupports(std::vector<Placement<Dim>>& placements, const std::vector<SupportStep<Dim>>& steps,
                      double share = 1);

/// By how much points close and slide because supports move, two a point [m]; empty where none does.
template<int Dim>
Eigen::VectorXd closingBySupports(const std::vector<ContactPoint<Dim>>& points,
                                  const std::vector<ContactColumns<Dim>>& columns,
                                  const std::vector<SupportStep<Dim>>& supports);

/// The mean velocities (ux uy rz) of the mass centres of all blocks between two instants; of one at an
/// instant where they are the same [m/s, m/s, rad/s]. \return one a block, zero where no support moves it
template<int Dim>
std::vector<BlockVector<Dim>>
supportVelocities(const std::vector<SupportMotion<Dim>>& motions, const Assembly<Dim>& assembly,
                  const std::vector<BlockMass<Dim>>& blocks, const std::vector<Placement<Dim>>& placements,
                  double from, double to);

} // namespace drystone
