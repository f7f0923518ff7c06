// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One step of the theta method as a cone program: Portioli & Cascini 2017, eq. 1-9.
#pragma once

#include "assembly/ContactProperties.h"
#include "assembly/Equilibrium.h"
#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"
#include "dynamics/DynamicState.h"

namespace drystone
{

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
/// \param mass diagonal of M, 3 a free block \param velocity v0, likewise
/// \param load f: mean over the step of all that acts on the blocks but the contacts [N, N, N m]
/// \param points contact points, with their gaps now \param columns theirs, with the lever arms of now
/// \param friction mu of each point
PlaneConeProgram thetaStepProgram(const Eigen::VectorXd& mass, const Eigen::VectorXd& velocity,
                                  const Eigen::VectorXd& load, const std::vector<ContactPoint<2>>& points,
                                  const std::vector<ContactColumns<2>>& columns,
                                  const std::vector<double>& friction, const ThetaScheme& scheme);

/// A solved step.
struct ThetaStep
{
    SolveStatus status = SolveStatus::notConverged; ///< `optimal` or not usable
    Eigen::VectorXd displacement;                   ///< y, 3 a free block [m, m, rad]
    Eigen::VectorXd contactForce; ///< c, (normal, tangent) of each point, mean over the step [N]
    Certificate certificate;      ///< of the last program solved
    int iterations = 0;           ///< of all programs together
    int factorisations = 0;       ///< likewise
    int programs = 0;             ///< more than one with the flow rule nonAssociative
};

/// Solves the step. With `nonAssociative` by the fixed point of Acary & Cadoux (2013): the program's flow
/// opens a point by mu |u_t| as it slides by u_t; with its gap increased by just that the point slides
/// without opening, which is Coulomb's law. Solved again until mu |u_t| stands still to 1e-8 of itself or
/// 1e-12 of `blockSize`; `notConverged` after 100 programs. \param blockSize [m]
ThetaStep solveThetaStep(PlaneConeProgram program, FlowRule flowRule, double blockSize,
                         const InteriorPointSettings& settings);

/// Moves the blocks by the displacements of a step and gives them v1 = (y/dt - (1 - theta) v0)/theta.
/// Rotations are finite: angles of the plane add.
void advance(DynamicState& state, const std::vector<int>& free, const Eigen::VectorXd& displacement,
             const ThetaScheme& scheme);

/// Where the energy of one step goes [J]; kinetic energy changes by
/// loadWork - normalLoss - frictionLoss - algorithmicLoss.
struct StepEnergy
{
    double loadWork = 0;     ///< f' y
    double normalLoss = 0;   ///< of the normal forces: closing of gaps; negative where sliding opens a joint
    double frictionLoss = 0; ///< of the shear forces
    double algorithmicLoss = 0; ///< (theta - 1/2) |v1 - v0|_M^2, in which impacts on closed contacts are lost
};

/// Energies of a step. With p = M (v1 - v0) and u = y/dt = (v0 + v1)/2 + (theta - 1/2)(v1 - v0):
/// kinetic change = (v0 + v1)'/2 p = u' p - (theta - 1/2) |v1 - v0|_M^2, and u' p = y' (f - A c).
StepEnergy stepEnergy(const PlaneConeProgram& program, const ThetaStep& step, const Eigen::VectorXd& mass,
                      const Eigen::VectorXd& load, const Eigen::VectorXd& velocityBefore,
                      const Eigen::VectorXd& velocityAfter, const ThetaScheme& scheme);

} // namespace drystone
