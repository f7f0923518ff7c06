// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Supports that move in a prescribed way: constant/supportMotion.
///
///     right { direction (0 -1 0); displacement ((0 0) (2 0.05)); }      // settles 50 mm in 2 s
///     table { direction (1 0 0); velocity ((0 0) (0.5 1) (1 0)); }      // speeds up and slows down
///     left  { centre (1 0 0); rotation ((0 0) (2 0.01)); }              // turns by 0.01 rad about (1 0)
///
/// In space a rotation has an `axis (0 0 1);`, too.
#pragma once

#include "effects/EffectType.h"
#include "geometry/Rotation.h"
#include "timeSeries/GroundAcceleration.h"

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

/// The supports that constant/supportMotion moves.
/// \throws FatalIOError for what is wrong with the file, or a name that no support has
template<int Dim>
std::vector<SupportMotion<Dim>> readSupportMotions(const Dictionary& dictionary,
                                                   const Assembly<Dim>& assembly);

/// Supports take the blocks that they hold along; contact forces work on them.
template<int Dim>
class MovingSupports final : public Effect<Dim>
{
public:
    explicit MovingSupports(std::vector<SupportMotion<Dim>> ofSupports) : motions(std::move(ofSupports)) {}
    /// Idle at rest: what moves no support in a step does nothing in it (SupportStep.h).
    EffectTraits traits() const override { return {.movesSupports = true, .isIdleAtRest = true}; }
    StepBounds stepBounds(double time) const override;
    std::vector<SupportStep<Dim>> supportSteps(const Structure<Dim>& structure,
                                               const std::vector<Placement<Dim>>& placements, double from,
                                               double to) const override;
    std::vector<BlockVector<Dim>> supportVelocities(const Structure<Dim>& structure,
                                                    const std::vector<Placement<Dim>>& placements,
                                                    double from, double to) const override;

private:
    std::vector<SupportMotion<Dim>> motions;
};

/// Its entry of the list.
template<int Dim>
EffectType<Dim> supportMotionType();

} // namespace drystone
