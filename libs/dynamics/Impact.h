// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What happens in an instant when blocks meet: the impact law of the steps, apart from when it acts.
#pragma once

#include "dynamics/ThetaStep.h"

#include <vector>

namespace drystone
{

/// Blocks that meet. Nothing is owned.
template<int Dim>
struct ImpactProblem
{
    const MassMatrix<Dim>& mass;             ///< M where the blocks are
    const Eigen::VectorXd& velocity;         ///< v- before the impact, likewise [m/s and rad/s]
    const StepProgram<Dim>& program;         ///< of the step: contact columns where the blocks meet, friction
    const std::vector<std::size_t>& meeting; ///< points of it that take part
    const Eigen::VectorXd& closingBySupports; ///< over the step, Dim a point of the program [m]; or empty
    double restitution = 0;                   ///< e, 0 to 1
    double slowestRebound = 0;                ///< points that would part slower do not part at all [m/s]
    double timeStep = 1;                      ///< of the step [s]; scales the program only
    double timeOfBonds = 0;                   ///< in which bonds may carry their strength as an impulse [s]
    /// Of all points of the program in the step, where the search for impulses begins [N]; null: from none.
    const Eigen::VectorXd* stepForce = nullptr;
};

/// What an impact changes.
struct Impact : SolverWork
{
    bool isSolved = false;
    Eigen::VectorXd velocity;  ///< v+
    Eigen::VectorXd impulse;   ///< P at the points that meet, (normal, tangent) [N s]
    double energyLoss = 0;     ///< kinetic energy before and work of supports, less the energy after [J]
    double workOfSupports = 0; ///< by the impulses on blocks that move with a support [J]
    /// The least part of the restitution that blocks part with: below 1 where all of it would create energy.
    double restitutionShare = 1;
    int programs = 0; ///< solved
};

/// Newton's impact law as Moreau (1988) wrote it for many points at once, bounded by energy. With u = A'v the
/// closing velocities,
///
///     M (v+ - v-) = -A P,     0 <= P_n  complementary to  -(u_n+ + k e max(u_n-, 0)) >= 0,
///     |P_t| <= mu P_n, against u_t+ (Coulomb's law without dilatancy, whatever the flow rule of the steps).
///
/// With k = 1 this is Newton's law, which together with friction may create energy: a corner that strikes the
/// ground obliquely sticks there, and returning all of the normal velocity takes more than what the
/// compression stored (Kane 1984; Brach 1989). The condition for coefficients that never do so
/// (Leine & van de Wouw 2008, section 5.4; Glocker 2013) depends on mu and on the masses. Therefore k, one
/// number for all points of blocks that meet each other (supports do not connect), is 1 where that creates no
/// energy and else the largest from 0 on with
///
///     1/2 v+' M v+  <=  1/2 v-' M v-  + work of the moving supports.
///
/// For k = 0 that holds: u+'P >= 0 and so the loss is u+'P + 1/2 |v+ - v-|_M^2. Where k is below 1 it is
/// found by false position, and the last step is taken along the segment between two solutions, one that
/// creates energy and one that does not. The set of impulses with |P_t| <= mu P_n and that of velocities
/// without penetration are convex, so both stay satisfied, and the energy along the segment is a parabola
/// whose root is exact to rounding, however accurately the programs are solved.
///
/// Bonds that take part hold their points together without rebound, by impulses up to their strength times
/// the length of the whole step, as in steps of theta 1, which are an impact and a step in one: an instant
/// would break them however strong they are.
///
/// Friction: with the associative law of a step a joint opens by mu |u_t| dt, which the next step takes into
/// account as a gap and which vanishes with dt; in an impact it would throw the blocks apart at mu |u_t|,
/// however short the step: other physics.
template<int Dim>
Impact impactOf(const ImpactProblem<Dim>& problem, const StepSettings& settings);

/// Whether a bond holds a point of a program.
template<int Dim>
bool isBonded(const StepProgram<Dim>& program, std::size_t point);

/// By how much the points of a program close per time, Dim a point [m/s]: A'v and what the supports do.
/// \param closingBySupports over the step [m]; or empty
template<int Dim>
Eigen::VectorXd closingVelocity(const StepProgram<Dim>& program, const Eigen::VectorXd& velocity,
                                const Eigen::VectorXd& closingBySupports, double timeStep);

} // namespace drystone
