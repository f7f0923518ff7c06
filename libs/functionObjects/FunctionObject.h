// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Function objects: the tables and pictures that `functions` of controlDict requests in addition to the
/// animation.
#pragma once

#include "contact/ContactState.h"
#include "dynamics/StepObservation.h"
#include "functionObjects/ColumnFile.h"
#include "runControl/PictureFormats.h"

#include <memory>
#include <optional>

namespace drystone
{

/// Writes tables or pictures of the steps it is given. Nothing is on disk before the first call of `write`.
template<int Dim>
class FunctionObject
{
public:
    virtual ~FunctionObject() = default;

    /// Adds the rows of this step.
    /// \throws FatalError when a table cannot be written
    virtual void write(const StepObservation<Dim>& step) = 0;
};

/// Where and how a function object writes.
struct FunctionOutput
{
    std::filesystem::path folder; ///< postProcessing/<function>/<startTime>
    int precision = 12;           ///< significant digits
    std::filesystem::path caseDirectory = {};
    PictureFormats pictureFormats{PictureFormat::svg};
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

/// Displacement of the mass centre and rotation of selected blocks, relative to the structure as built and to
/// the moving ground, and their velocities; one table per block, block<i>.dat: `Time[s] ux[m] uy[m] rz[rad]
/// vx[m/s] vy[m/s] wz[rad/s]`.
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
    std::vector<ColumnFile> tables; ///< one per block
};

/// Whether contactForces also lists each contact point.
enum class ContactPointTable
{
    none,
    all
};

/// The forces at the contact points. Forces are means over the step; impacts, plastic ones and those with
/// restitution, contribute their impulse divided by the length of the step. The sum of reactions times steps
/// is therefore the change of momentum that gravity and all other loads do not cause, and during impacts the
/// largest forces grow as steps become shorter. Their directions are those of the joints at the end of the
/// step: where a support turns by w in it they are turned by w, with theta 1/2 by half of it.
///
/// contactForces.dat: `Time[s] points[-] open[-] sticking[-] sliding[-] largestNormalForce[N]
/// largestShearForce[N]`, and for each support its reaction, which is the force on the structure and its
/// moment about the origin, positive counter-clockwise: `ground.x[N] ground.y[N] ground.moment[Nm]`.
///
/// points.dat, when requested, has a row for each point and time: `Time[s] block[-] neighbour[-] x[m] y[m]
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
    void openTables(const StepObservation<Dim>& step);
    void writePoint(const StepObservation<Dim>& step, std::size_t index, ContactState state);

    FunctionOutput output;
    ContactPointTable listing;
    std::optional<ColumnFile> table;
    std::optional<ColumnFile> points;
};

/// Convergence of the solver, in residuals.dat: `Time[s] timeStep[s] initialResidual[-] primalResidual[-]
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

/// Elapsed time that the stages of the steps have taken since the run began, in stageTimes.dat: `Time[s]
/// findContacts[s] assemble[s] contribute[s] solve[s] collide[s] review[s] move[s] account[s]`. A state does
/// not keep these: for one that was read there is a warning, and no table.
template<int Dim>
class StageTimesFunction final : public FunctionObject<Dim>
{
public:
    explicit StageTimesFunction(FunctionOutput functionOutput) : output(std::move(functionOutput)) {}
    void write(const StepObservation<Dim>& step) override;

private:
    FunctionOutput output;
    std::optional<ColumnFile> table;
    bool isWarned = false;
};

} // namespace drystone
