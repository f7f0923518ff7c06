// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Supports that move in a prescribed way: constant/supportMotion.
///
///     right { direction (0 -1 0); displacement ((0 0) (2 0.05)); }      // settles 50 mm in 2 s
///     table { direction (1 0 0); velocity ((0 0) (0.5 1) (1 0)); }      // speeds up and slows down
///     left  { centre (1 0 0); rotation ((0 0) (2 0.01)); }              // turns by 0.01 rad about (1 0)
#pragma once

#include "contact/Equilibrium.h"
#include "dictionary/Options.h"
#include "timeSeries/GroundAcceleration.h"

#include <filesystem>

namespace drystone
{

/// What one entry says: a table of displacements or velocities, or one of rotations or angular velocities, or
/// one of each. Between the points of a table it is linear; before the first and after the last the support
/// stands still.
struct SupportMotionSettings
{
    Vector<2> direction{0, 0};                           ///< of any length but zero
    std::vector<std::pair<double, double>> displacement; ///< times [s] and places [m]
    std::vector<std::pair<double, double>> velocity;     ///< times [s] and velocities [m/s]
    Vector<2> centre{0, 0};                          ///< of rotation, as built; it goes with the support [m]
    std::vector<std::pair<double, double>> rotation; ///< times [s] and angles [rad]
    std::vector<std::pair<double, double>> angularVelocity; ///< times [s] and velocities [rad/s]
};
void declare(Options& options, SupportMotionSettings& settings);

/// The whole file: an entry for each support that moves, under its name.
struct SupportMotionFile
{
    std::vector<std::pair<std::string, SupportMotionSettings>> supports;
};
void declare(Options& options, SupportMotionFile& file);

/// A support that moves relative to the ground. Histories have exact means; null: none.
struct SupportMotion
{
    int support = -1;                                               ///< index into Assembly::supports
    Vector<2> direction{1, 0};                                      ///< unit vector
    std::shared_ptr<const GroundAcceleration> velocity;             ///< of its centre [m/s]
    std::shared_ptr<const GroundAcceleration> angularVelocity = {}; ///< about its centre [rad/s]
    Vector<2> centre{0, 0};                                         ///< as built [m]
};

/// How a block goes with its support over a time; all zero where the support stands still.
struct SupportStep
{
    Vector<2> translation = Vector<2>::Zero(); ///< of the support's centre [m]
    double rotation = 0;                       ///< [rad]
    Vector<2> arm = Vector<2>::Zero(); ///< from that centre to the block's mass centre at the start [m]
};

/// The displacement (ux uy rz) of the block's mass centre after a share of the time: to the last digits.
Vector<3> displacementAfter(const SupportStep& step, double share = 1);

/// The supports of a case that move; none where the file is absent.
/// \throws FatalIOError for what is wrong with the file, or a name that no support has
std::vector<SupportMotion> readSupportMotions(const std::filesystem::path& caseDirectory,
                                              const Assembly<2>& assembly);

/// How each block goes with its support between two instants; not at all for all others. Empty without
/// motions. \param centroids as built, in `blocks` \param placements at the first instant
std::vector<SupportStep> supportSteps(const std::vector<SupportMotion>& motions, const Assembly<2>& assembly,
                                      const std::vector<BlockMass<2>>& blocks,
                                      const std::vector<Placement<2>>& placements, double from, double to);

/// Moves blocks by a share of the way that they go with their supports. \param steps see supportSteps
void moveWithSupports(std::vector<Placement<2>>& placements, const std::vector<SupportStep>& steps,
                      double share = 1);

/// By how much points close and slide because supports move, two a point [m]; empty where none does.
Eigen::VectorXd closingBySupports(const std::vector<ContactPoint<2>>& points,
                                  const std::vector<ContactColumns<2>>& columns,
                                  const std::vector<SupportStep>& supports);

/// The mean velocities (ux uy rz) of the mass centres of all blocks between two instants; of one at an
/// instant where they are the same [m/s, m/s, rad/s]. \return one a block, zero where no support moves it
std::vector<Vector<3>> supportVelocities(const std::vector<SupportMotion>& motions,
                                         const Assembly<2>& assembly, const std::vector<BlockMass<2>>& blocks,
                                         const std::vector<Placement<2>>& placements, double from, double to);

} // namespace drystone
