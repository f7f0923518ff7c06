// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Function objects: what a user asks to be written beside the animation, in the `functions` of controlDict.
#pragma once

#include "dynamics/StepObservation.h"
#include "functionObjects/ColumnFile.h"

#include <memory>
#include <optional>

namespace drystone
{

/// Writes tables about the steps it is shown. Nothing is on the disk before the first call of `write`.
template<int Dim>
class FunctionObject
{
public:
    virtual ~FunctionObject() = default;

    /// Add what belongs to this step.
    /// \throws FatalError when a table cannot be written
    virtual void write(const StepObservation<Dim>& step) = 0;
};

/// Where and how a function object writes.
struct FunctionOutput
{
    std::filesystem::path folder; ///< postProcessing/<function>/<startTime>
    int precision = 12;           ///< significant digits
};

/// The energy ledger, in energy.dat:
/// `Time[s] kinetic[J] potential[J] externalWork[J] frictionLoss[J] impactLoss[J] algorithmicLoss[J]
/// imbalance[J] elastic[J] dampingLoss[J]`.
template<int Dim>
class EnergyFunction final : public FunctionObject<Dim>
{
public:
    explicit EnergyFunction(FunctionOutput functionOutput) : output(std::move(functionOutput)) {}
    void write(const StepObservation<Dim>& step) override;

private:
    FunctionOutput output;
    std::optional<ColumnFile> table;
};

/// Displacement of the mass centre and rotation of some blocks, relative to as built and to the moving
/// ground, and their velocities; one table a block, block<i>.dat: `Time[s] ux[m] uy[m] rz[rad] vx[m/s]
/// vy[m/s] wz[rad/s]`.
template<int Dim>
class BlockMotionFunction final : public FunctionObject<Dim>
{
public:
    /// \param blockIndices into Assembly::blocks; all must exist
    BlockMotionFunction(FunctionOutput functionOutput, std::vector<int> blockIndices)
        : output(std::move(functionOutput)), blocks(std::move(blockIndices))
    {
    }
    void write(const StepObservation<Dim>& step) override;

private:
    FunctionOutput output;
    std::vector<int> blocks;
    std::vector<ColumnFile> tables; ///< one a block
};

/// Whether contactForces lists each contact point.
enum class ContactPointTable
{
    none,
    all
};

/// What the contact points carry. Forces are means over the step; what impacts change at an instant, plastic
/// ones and those with restitution, is in them as impulse over the length of the step. So reactions times
/// steps add up to what gravity and all other loads do not explain of the momentum, and while blocks hit each
/// other the largest forces grow as steps get shorter.
///
/// contactForces.dat: `Time[s] points[-] open[-] sticking[-] sliding[-] largestNormalForce[N]
/// largestShearForce[N]`, and for each support its reaction, which is the force on the structure and its
/// moment about the origin, positive counter-clockwise: `ground.x[N] ground.y[N] ground.moment[Nm]`.
///
/// points.dat, when asked for, has a row for each point and time: `Time[s] block[-] neighbour[-] x[m] y[m]
/// gap[m] normalForce[N] shearForce[N] state[-]` (0 open, 1 sticking, 2 sliding).
template<int Dim>
class ContactForcesFunction final : public FunctionObject<Dim>
{
public:
    ContactForcesFunction(FunctionOutput functionOutput, ContactPointTable pointTable)
        : output(std::move(functionOutput)), listing(pointTable)
    {
    }
    void write(const StepObservation<Dim>& step) override;

private:
    FunctionOutput output;
    ContactPointTable listing;
    std::optional<ColumnFile> table;
    std::optional<ColumnFile> points;
};

/// How the solver did, in residuals.dat: `Time[s] timeStep[s] initialResidual[-] primalResidual[-]
/// dualResidual[-] gap[-] iterations[-] factorisations[-] programs[-] retries[-] flowError[m]`.
template<int Dim>
class ResidualsFunction final : public FunctionObject<Dim>
{
public:
    explicit ResidualsFunction(FunctionOutput functionOutput) : output(std::move(functionOutput)) {}
    void write(const StepObservation<Dim>& step) override;

private:
    FunctionOutput output;
    std::optional<ColumnFile> table;
};

} // namespace drystone
