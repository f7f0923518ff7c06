// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Figures of a structure in motion: displacements, rotations, energies, times of return. Written once, for
/// criteria, searches, ensembles and comparisons of accuracy.
#pragma once

#include "dynamics/Motion.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// A figure at one instant. Immutable, so that threads can share it.
template<int Dim>
struct InstantFigure
{
    std::string name;    ///< displacement, rotation, drop, energy
    std::string unit;    ///< m, rad, J
    std::string subject; ///< `displacement of block 3`
    /// \param start the state in which the run began
    std::function<double(const DynamicState<Dim>& start, const Motion<Dim>& now)> at;
};

/// Displacement of any corner of any free block, the farthest [m].
/// \param location for messages \throws FatalIOError when no block is free
template<int Dim>
InstantFigure<Dim> farthestCorner(const Assembly<Dim>& assembly, const SourceLocation& location);

/// Displacement of the mass centre of a block, or the largest of all free blocks [m].
/// \throws FatalIOError, as those below, for a block that does not exist, or is fixed
template<int Dim>
InstantFigure<Dim> displacementOf(const Assembly<Dim>& assembly, std::optional<int> block,
                                  const SourceLocation& location);

/// A direction of a dictionary in the space of an assembly, of length 1.
/// \throws FatalIOError for one without a length, or out of the plane
template<int Dim>
Vector<Dim> unitDirection(const std::array<double, 3>& direction, const SourceLocation& location);

/// Displacement of the mass centre of a block along a unit vector, with its sign [m].
template<int Dim>
InstantFigure<Dim> displacementAlong(const Assembly<Dim>& assembly, int block, const Vector<Dim>& direction,
                                     const SourceLocation& location);

/// Rotation without its sign of a block, or the largest of all free blocks [rad]; in space the angle of the
/// rotation that leads from the start to now, at most pi.
template<int Dim>
InstantFigure<Dim> rotationOf(const Assembly<Dim>& assembly, std::optional<int> block,
                              const SourceLocation& location);

/// By how much the mass centre of a block has sunk (along -y in the plane, -z in space), or the most of all
/// free blocks; 0 where it has risen [m].
template<int Dim>
InstantFigure<Dim> dropOf(const Assembly<Dim>& assembly, std::optional<int> block,
                          const SourceLocation& location);

/// Parts of the ledger of energy.
enum class EnergyPart
{
    kinetic,
    potential,
    mechanical, ///< kinetic and potential
    frictionLoss,
    dissipation ///< friction, impacts, damping and what the integration loses
};
std::array<std::pair<std::string_view, EnergyPart>, 5> namesOf(EnergyPart);
std::string_view nameOf(EnergyPart part);
double partOf(const EnergyLedger& energy, EnergyPart part);

/// Energy [J].
template<int Dim>
InstantFigure<Dim> energyOf(EnergyPart part);

/// The block that a figure refers to. \throws FatalIOError for one that does not exist, or is fixed
template<int Dim>
std::size_t freeBlock(const Assembly<Dim>& assembly, int block, const SourceLocation& location);

/// Detects when a block of the plane that rocks returns to upright. Between two steps the instant is
/// extrapolated from the state before, because impacts change the state after.
class ReturnWatch
{
public:
    /// \param watchedBlock index in Assembly::blocks \param rotationRow of its rotation among the velocities
    ReturnWatch(std::size_t watchedBlock, Eigen::Index rotationRow) : block(watchedBlock), row(rotationRow) {}

    /// \param timeStep that led to this state; 0 before the first [s]
    void observe(const Motion<2>& motion, double timeStep);
    const std::vector<double>& returns() const { return returnTimes; } ///< [s]

private:
    static constexpr double upright = 1e-9; ///< [rad]

    double timeToUpright(double timeStep) const;

    std::size_t block;
    Eigen::Index row;
    double side = 0; ///< on which the block leans; 0 while it is upright
    double time = 0;
    double rotation = 0;
    double velocity = 0;
    double acceleration = 0;
    std::vector<double> returnTimes;
};

} // namespace drystone
