// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One step of the theta method as a cone program: Portioli, Cascini & Landolfo 2017, eq. 1-9.
#pragma once

#include "conic/Certificate.h"
#include "conic/SolverChoice.h"
#include "contact/Equilibrium.h"
#include "dynamics/DynamicState.h"
#include "dynamics/StepWork.h"
#include "effects/Effect.h"
#include "effects/Friction.h"
#include "runControl/Schemes.h"

#include <functional>
#include <type_traits>

namespace drystone
{

struct SymbolicAnalysis;

/// Length of a step and weight of its end.
struct ThetaScheme
{
    double theta = 1;       ///< 1: backward Euler; 0.5: trapezoidal rule
    double timeStep = 0.01; ///< [s]
};

/// The program whose multipliers y are the displacements over the step. The motion is
///
///     M (v1 - v0) = dt (f - A c),    y = dt (theta v1 + (1 - theta) v0),
///
/// and without v1 it reads Mbar y + A c = f + Mbar v0 dt with Mbar = M/(theta dt^2).
/// \param mass M, where the blocks are at the start \param velocity v0
/// \param load f: mean over the step of all that acts on the blocks but the contacts [N and N m]
/// \param points contact points, with their gaps now \param columns theirs, with the lever arms of now
/// \param friction mu of each point
template<int Dim>
StepProgram<Dim> thetaStepProgram(const std::type_identity_t<MassMatrix<Dim>>& mass,
                                  const Eigen::VectorXd& velocity, const Eigen::VectorXd& load,
                                  const std::vector<ContactPoint<Dim>>& points,
                                  const std::vector<ContactColumns<Dim>>& columns,
                                  const std::vector<double>& friction, const ThetaScheme& scheme);

/// Puts Mbar = M/(theta dt^2) into a program. \return Mbar
template<int Dim>
MassMatrix<Dim> setInertia(StepProgram<Dim>& program, const std::type_identity_t<MassMatrix<Dim>>& mass,
                           const ThetaScheme& scheme);

/// What a program is of. An impact is a step without loads and with impulses for forces: it leaves no gaps
/// that later steps would have to repair.
enum class StepKind
{
    motion,
    impact
};

/// Whether points may overlap by a little under their forces.
enum class Overlaps
{
    none,   ///< rigid, and forces that any solver gives: impacts between steps that are not damped
    closed, ///< none at the end: forces are those of points that overlap, but these do not. Other impacts,
            ///< and theta below 1, where nothing takes away the energy of overlaps
    damped  ///< by the step itself, which theta 1 does
};

/// Structures of space with so many contact points are large: Newton's method does not reach Coulomb's law in
/// them, which alternating directions come near to. In smaller ones it mostly does, to the last digits.
inline constexpr std::size_t pointsOfLarge = 500;

/// How well a step is to be solved.
struct StepSettings
{
    StepKind kind = StepKind::motion;
    FlowRule flowRule = FlowRule::associative;
    Overlaps overlaps = Overlaps::none;
    double blockSize = 1;                             ///< mean, what lengths are compared with [m]
    double contactOverlap = Schemes().contactOverlap; ///< of points that follow the flow [blockSize]
    double partOfStep = 1;       ///< its length over that of the whole step that impacts have parted
    double contactTolerance = 0; ///< error allowed in the gaps at the end of the step [m]
    SolverChoice solver;
    /// Coulomb's law is looked for by the fixed point alone, without what goes on from a start that is near
    /// (Newton's method, the augmented Lagrangian), before half of the programs allowed are solved.
    bool isFixedPointOnly = false;
    /// Whether displacements are corrected to those that the forces give to the last digits (keepMomenta);
    /// false where the caller does.
    bool keepsMomenta = true;
    const StepWork* work = nullptr; ///< done so far, and the most allowed; not owned; null: no bound
};

/// Where a step may end, for a start.
struct StepGuess
{
    Eigen::VectorXd displacement; ///< dt v0, say, to linearise about at first; or empty
    Eigen::VectorXd contactForce; ///< of the last step, Dim a point; or empty
    InteriorStart interior;       ///< of the last step that had one; or empty
};

/// Corrects a program for what is not linear in it. Given the displacements of its solution, it puts the
/// contact columns where the momenta of the step want them and the gaps such that g - A'y, for this y, are
/// the gaps, and minus the slips, of the blocks where y takes them, turned by finite angles. \return the
/// largest error of the gaps that the program as it came had predicted, at points that carry a force or
/// overlap [m]
template<int Dim>
using Relinearisation = std::type_identity_t<std::function<double(
    const Eigen::VectorXd& displacement, const Eigen::VectorXd& contactForce, StepProgram<Dim>& program)>>;

/// Puts the columns of the contact points, in their order, into a program.
template<int Dim>
void setColumns(StepProgram<Dim>& program, const std::vector<ContactColumns<Dim>>& columns);

/// No contact force is larger than so many times all that there is to balance, which is what loads and
/// momenta are and what it takes to open gaps that are closed [N]: blocks that would need it are wedged.
/// \param blockSize mean [m]
template<int Dim>
double largestForce(const StepProgram<Dim>& program, double blockSize);

/// A solved step.
struct ThetaStep : SolverWork ///< no factorisation where the guess was the solution
{
    SolveStatus status = SolveStatus::notConverged; ///< `optimal` or not usable
    Eigen::VectorXd displacement;                   ///< y, rows of each free block [m, rad]
    Eigen::VectorXd contactForce; ///< c, (normal, shear) of each point, mean over the step [N]
    Eigen::VectorXd closing;      ///< A'y, likewise: by how much the points close and slide [m]
    InteriorStart interior;       ///< of the last program that had one, else the guess's
    Certificate certificate;      ///< of the last program solved
    Eigen::VectorXd load;         ///< of that program, rows of each free block; or empty: as given
    Eigen::VectorXd gap;          ///< likewise, (normal, tangent) of each point [m]
    double initialResidual =
        0;                ///< worst figure of the certificate of the guess "no motion, forces as before"
    double flowError = 0; ///< by how much mu |u_t| is missed, at the worst of the points that touch [m]
    double slip = 0;      ///< largest at points that carry a force, of a step that programs alone solve [m]
    int programs = 0;     ///< solved
    bool isStartLost = false; ///< one of the programs was not solved from the one before it, though near it
};

/// Solves the step.
///
/// A structure at rest costs one certificate: when "no motion, forces as before" meets the tolerance, it is
/// the solution. Otherwise programs are solved in turn until the linear prediction of the gaps is right to
/// `contactTolerance` and, with `nonAssociative`, until the fixed point of Acary & Cadoux (2013) is reached:
/// the program's flow opens a point by mu |u_t| as it slides by u_t; with its gap increased by just that the
/// point slides without opening, which is Coulomb's law. Its forces are followed from those of the guess, or
/// else of the first program (FollowedFlow.h), which ends nearly every step. Where they are not, after the
/// first program Newton's method (CoulombNewton.h) finds that fixed point, most often, and before it, in
/// steady motion, from the forces of the guess; else Anderson's acceleration goes on from there, until
/// mu |u_t| changes by less than ten times the tolerance of itself or 1e-12 of `blockSize`; from the fourth
/// program on 1% of what the step changes the motion by will do, from the fifteenth 15%. In large
/// structures of space whose forces are not followed programs begin with the openings of forces near the
/// least ones (AlternatingDirections.h), of which 10% will do from the first on. Of an impact 1% of the
/// velocities will do from the first, but no more than 30% of what it changes them by, as impacts of no more
/// than rounding would leave more than they find. Turns count by what they move a block of `blockSize` by.
/// `flowError` says what is left. Points that are apart and carry nothing do not count.
///
/// The displacements are those that the contact forces give the blocks, to the last digits (y = Mbar^-1 (fbar
/// - A c)), unless that would spoil the certificate: so no momentum is lost to the tolerance of the solver.
/// \param symbolic kept from step to step (conic/form/Form.h), or null; not owned
/// \return status `notConverged` after 60 programs or when the work is used up, or when the solver fails
template<int Dim>
ThetaStep solveThetaStep(StepProgram<Dim> program, const StepSettings& settings, const StepGuess& guess = {},
                         const Relinearisation<Dim>& relinearise = {}, SymbolicAnalysis* symbolic = nullptr);

/// Mbar^-1 rows: the displacements that forces give the blocks.
template<int Dim>
Eigen::VectorXd displacementUnder(const StepProgram<Dim>& program, Eigen::VectorXd rows);

/// With theta below 1 lever arms are those on the way to where the step takes the blocks. They are then right
/// to the tolerance of the gaps, and angular momentum with them: here both become exact, by displacements
/// that are less than that tolerance. \return false where a block of space turns too far in the step for
/// that: its turn is then not found
template<int Dim>
bool keepMomenta(ThetaStep& step, StepProgram<Dim>& program, const Relinearisation<Dim>& relinearise);

/// Moves the blocks by the displacements of a step and gives them v1 = (y/dt - (1 - theta) v0)/theta.
/// Rotations are finite. In space v1 so computed is in axes that have not turned in the step, those in which
/// y is: the angular velocities that the blocks have at its end are these, turned as they are.
/// \return v1 before it is turned, which energies are computed from
template<int Dim>
Eigen::VectorXd advance(DynamicState<Dim>& state, const std::vector<int>& free,
                        const Eigen::VectorXd& displacement, const ThetaScheme& scheme);

/// Energies of a step. With p = M (v1 - v0) and u = y/dt = (v0 + v1)/2 + (theta - 1/2)(v1 - v0):
/// kinetic change = (v0 + v1)'/2 p = u' p - (theta - 1/2) |v1 - v0|_M^2, and u' p = y' (f - A c).
/// \param velocityAfter as `advance` returns it
template<int Dim>
StepEnergy stepEnergy(const ThetaStep& step, const MassMatrix<Dim>& mass, const Eigen::VectorXd& load,
                      const Eigen::VectorXd& velocityBefore, const Eigen::VectorXd& velocityAfter,
                      const ThetaScheme& scheme);

} // namespace drystone
