// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A cone program of space in the form that solvers work on: standard second-order cones, dimensionless, in
/// elimination order. What RayProgram.h is in the plane.
#pragma once

#include "conic/ConeProgram.h"
#include "conic/SecondOrderCone.h"
#include "linear/SchurSystem.h"

namespace drystone
{

/// The friction cone |t| <= mu n is the image of the second-order cone K = {s0 >= |(s1 s2)|}: c = T s with
/// T = diag(1, mu, mu) / sqrt(1 + mu2). K is its own dual, and the program becomes
///
///     minimise    1/2 y' M y + g' s - w alpha    subject to  M y + B s = f + alpha L,   s in K,
///     multipliers z = g - B' y in K,  L' y = w,
///
/// with B = A T. Without friction the last two columns of a point vanish, and with them s1 and s2: no case
/// of its own. Rows of moments are scaled by a mean lever arm, loads by their largest entry, displacements so
/// that inertia is of order one (with ~ for scaled: moment = lever moment~, force = load force~, y =
/// displacement y~ and rotations also / lever, L = liveLoad L~, alpha = alpha~ load / liveLoad).
struct SpaceForm
{
    using Rows = Eigen::Matrix<double, 6, 1>;
    using Inertia = Eigen::Matrix<double, 6, 6>;

    /// The part of B that belongs to one contact point.
    struct Point
    {
        int first; ///< body in elimination order; `bodies` stands for fixed ground, whose rows are never read
        int second; ///< later than `first` in elimination order
        int slot;   ///< of the pair's block in the Schur system, or -1 when `second` is fixed
        Eigen::Matrix<double, 6, 3> onFirst;
        Eigen::Matrix<double, 6, 3> onSecond;
    };
    struct Scaling
    {
        double lever = 1;
        double load = 1;
        double liveLoad = 1;
        double displacement = 1;
    };

    int bodies = 0;
    std::vector<int> position; ///< of each body in elimination order
    std::vector<Point> points; ///< in the order of the program
    Eigen::VectorXd load;      ///< f, 6 (bodies + 1): the last body is the fixed ground, its rows are zero
    Eigen::VectorXd liveLoad;  ///< L, likewise, or empty
    double liveWork = 1;       ///< w of L'y = w: about the number of loaded rows, so that y is of order one
    std::vector<Inertia> inertia;
    Eigen::VectorXd gap; ///< g = T' (gap), 3 a point
    Scaling scaling;
    std::vector<Coupling> couplings; ///< pairs of bodies in elimination order, for the Schur system

    int pointCount() const { return static_cast<int>(points.size()); }
    bool hasMultiplier() const { return liveLoad.size() > 0; }
    bool hasInertia() const { return !inertia.empty(); }
};

SpaceForm makeSpaceForm(const SpaceConeProgram& program);

/// A Schur system with the pattern of the form; tells each point where its block is.
SchurSystem<6> makeSchurSystem(SpaceForm& form);

/// out = B' y. \param y 6 (bodies + 1), ground zero \param out 3 a point
void applyTransposed(const SpaceForm& form, const Eigen::VectorXd& y, Eigen::VectorXd& out);

/// out += B s. \param out 6 (bodies + 1), ground set to zero
void addForces(const SpaceForm& form, const Eigen::VectorXd& s, Eigen::VectorXd& out);

/// out += M y, nothing without inertia.
void addInertia(const SpaceForm& form, const Eigen::VectorXd& y, Eigen::VectorXd& out);

/// Puts S = M + delta I + B D B' into the system, its diagonal entries raised by the share `relative`.
/// \param d D, one block a point
void assembleSchur(const SpaceForm& form, const std::vector<FramedMatrix>& d, double delta, double relative,
                   SchurSystem<6>& system);

/// s of contact forces, scaled: T^-1 c. What no friction can carry is left out.
Eigen::VectorXd toCones(const SpaceConeProgram& program, const SpaceForm& form,
                        const Eigen::VectorXd& contactForce);

/// Solution in the program's own units and numbering.
ConeSolution fromCones(const SpaceConeProgram& program, const SpaceForm& form, const Eigen::VectorXd& s,
                       const Eigen::VectorXd& y, double multiplier);

} // namespace drystone
