// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a structure at rest carries: forces that prove of all loads between some known ones that nothing
/// moves. In this library since it is made of the program of a step.
#pragma once

#include "effects/Effect.h"

#include <map>

namespace drystone
{

/// Forces in the cones that balance a load prove that a step from rest ends at rest: with y = 0 they are the
/// solution of its program, since z = g >= 0 and g'c = 0 where they act at closed points only, and y is
/// unique, as the inertia is definite. They satisfy Coulomb's law, too, where nothing slides. The cones are
/// convex: of forces c_i that balance loads f_i any mean balances the mean of the loads. So a few are enough
/// for a whole record, as long as the blocks stay where they are.
///
/// Loads are f0 + sum_k a_k L_k, f0 the dead load and L_k the directions in which effects load the structure.
/// Known are the forces c_0 of f0, well inside the cones, and those at which the structure is about to move,
/// found when a load first needs them: for each sign of each L_k the largest factor s_k, or 1e-4 less, which
/// is the multiplier of limit analysis (Portioli, Cascini & Landolfo 2017, eq. 10), and likewise for sums of
/// several s_k L_k. With b_k = |a_k|/s_k in falling order and S_i the first i of the directions in it,
///
///     sum_k a_k L_k = sum_i (b_i - b_i+1) (sum of s_k L_k over S_i),
///
/// in which each term is the share lambda_i = (b_i - b_i+1)/alpha_i of a load that is just carried
/// (Freudenthal's triangulation of an orthant, 1942). So c = c_0 + sum lambda_i (c_i - c_0) balances the
/// load, and is inside the cones by the share 1 - sum lambda_i of how far c_0 is. What is known of a load
/// does not depend on the loads before it, so that a run which is continued is the same as one that is not.
/// Which points are closed depends on the length of the step: a proof is of steps that agree in these.
template<int Dim>
struct RestProof
{
    /// A load that is just carried.
    struct Carried
    {
        double factor = 0; ///< alpha; 0: not known to carry any of it
        Eigen::VectorXd contactForce;
    };

    std::vector<Placement<Dim>> placements;      ///< where the blocks rest
    std::vector<ContactPoint<Dim>> points;       ///< of the program, with their gaps
    StepProgram<Dim> program;                    ///< of the last step that was looked at
    double timeStep = 0;                         ///< its own [s]
    Eigen::VectorXd deadLoad;                    ///< f0
    std::vector<char> isClosed;                  ///< of the points: those that forces act at
    std::vector<Eigen::VectorXd> directions;     ///< L_k, independent of each other
    double tolerance = 0;                        ///< of the solver
    Eigen::VectorXd forcesOfDeadLoad;            ///< c_0; empty: none are known
    std::map<std::vector<int>, Carried> carried; ///< by directions, from 1 on, negative for the opposite
    int programs = 0;                            ///< solved for it
    int factorisations = 0;
};

/// A proof that knows the forces of the dead load, if there are any. \param loads of which the directions are
/// taken, those that depend on others left out \param tolerance of every figure of a certificate
template<int Dim>
RestProof<Dim> proofOfRest(StepProgram<Dim> program, double timeStep, Eigen::VectorXd deadLoad,
                           const std::vector<Eigen::VectorXd>& loads, double tolerance);

/// Of points that give way: their forces follow from where the blocks are, so that those of the last step are
/// the only ones, and hold no other load than they did. The certificate of the step says which that is.
/// \param forces of the last step, Dim a point [N]
template<int Dim>
RestProof<Dim> proofOfElasticRest(StepProgram<Dim> program, double timeStep, Eigen::VectorXd forces);

/// Forces that balance a load, inside the cones by a share `margin` of how far those of the dead load are.
/// Solves programs where they are not known yet. \return F k, or empty where none are found
template<int Dim>
Eigen::VectorXd forcesAtRest(RestProof<Dim>& proof, const Eigen::VectorXd& load, double margin);

} // namespace drystone
