// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A cone program in the form that solvers work on: a product of standard cones in two ranges, dimensionless,
/// in elimination order. One text for the plane (3 rows a body) and space (6): which cone a contact point has
/// is its own property.
#pragma once

#include "conic/ConeProgram.h"
#include "conic/cones/ConeProduct.h"
#include "linear/BlockLu.h"
#include "linear/DoubleDouble.h"
#include "linear/SchurSystem.h"

#include <array>
#include <optional>
#include <tuple>

namespace drystone
{

/// Every contact force is written c = c0 + R s with s in a product K of rays (s >= 0) and round cones
/// (s0 >= |(s1 s2)|), so that the cone program becomes
///
///     minimise    1/2 y' M y + g' s - w alpha    subject to  M y + B s = f + alpha L,   s in K,
///     multipliers z = g - B' y in K,  L' y = w,
///
/// with B = A R. The columns of R are
/// - in the plane the edges of the friction cone |t| <= mu n, (1, mu) and (1, -mu) over sqrt(1 + mu2): rays;
/// - in space T = diag(1, mu, mu) / sqrt(1 + mu2): one round cone;
/// - without friction the normal alone: a ray. One with a large friction has a ray along its normal as well,
///   which its cone contains anyhow but which keeps the system well-conditioned.
///
/// A point with a Strength has the set -T <= c_n <= N, |c_t| <= C + mu c_n. Tension shifts its origin c0 to
/// c_n = -T; there cohesion leaves a shear |t| <= tau = C - mu T, so that the set is the sum of the cone and
/// of a piece of the shear axis, or of a disc in the plane of shear: no vertex lies far away however small mu
/// is. The piece is a ray limited to 2 tau that starts from -tau; the disc is a round cone (p0, t) whose p0,
/// which exerts no force, is limited to tau. Crushing limits the normal force of the others. A limit e s_i <=
/// u, or e (s_i + s_j) <= u, becomes the row e s_i + w = u with a slack w >= 0, which is a ray of its own.
/// Rows of limits follow those of the bodies in y. They are eliminated from the Schur system by hand, so that
/// its pattern is that of the bodies.
///
/// s and z hold the rays of points, the slacks, then the round cones, three numbers each. Everything is
/// scaled: rows of moments by a mean lever arm, loads by their largest entry, displacements so that inertia
/// is of order one; see `Scaling`.
template<int Rows>
struct Form
{
    static constexpr int forces = Rows == 3 ? 2 : 3; ///< components of a force
    static constexpr int moments = Rows - forces;
    static constexpr int columnSize = forces + 2 * moments;
    using Inertia = Eigen::Matrix<double, Rows, Rows>;
    using Force = Eigen::Matrix<double, forces, 1>;

    /// A column of B: its force on the first body, which is the opposite of that on the second, its moment on
    /// the first and its moment on the second.
    using Column = Eigen::Matrix<double, columnSize, 1>;
    using RoundColumns = Eigen::Matrix<double, columnSize, 3>; ///< of a round cone

    /// Cones between the same two bodies, which stand together.
    struct Group
    {
        int first; ///< body in elimination order, or `bodies`, the fixed ground, when nothing else is touched
        int second; ///< later than `first` in elimination order, or `bodies`
        int begin;  ///< of its rays
        int end;
        int slot; ///< of the pair's block in the Schur system, or -1 when `second` is fixed
        int beginRound;
        int endRound;
    };

    /// Groups that one task adds up, in large forms. What it adds to a body that an earlier share touches,
    /// too, it lends that body until all are done.
    struct Share
    {
        int begin;
        int end;
    };

    /// The sum of one ray, or of two of the same point, times `component` is at most `bound`; or the first
    /// component of a round cone is.
    struct Limit
    {
        int group;
        int ray;          ///< unless it is of a round cone
        int rays;         ///< 1 or 2; 0 for a round cone
        int round;        ///< or -1
        double component; ///< of each ray along the force that is limited
        double bound;     ///< in the units of the cone program
        double factor;    ///< e: the component over the scale of the row
    };

    /// How these numbers relate to those of the cone program: with ~ for scaled, moment = lever * moment~,
    /// force = force~ * load, y = y~ * displacement (rotations also / lever), L = L~ * liveLoad,
    /// alpha = alpha~ * load / liveLoad.
    struct Scaling
    {
        double lever = 1;
        double load = 1;
        double liveLoad = 1;
        double displacement = 1;
    };

    int bodies = 0;
    std::vector<int> position; ///< of each body in elimination order
    std::vector<Group> groups;
    std::vector<Share> shares;              ///< none where the groups are few
    std::vector<std::array<int, 2>> places; ///< where each group adds: its body, or bodies + 1 and the place
                                            ///< in `lent`; none without shares
    std::vector<int> lent;                  ///< bodies that shares add to elsewhere, share by share
    std::vector<Column> rays;               ///< of points
    std::vector<RoundColumns, Eigen::aligned_allocator<RoundColumns>> rounds;
    std::vector<Limit> limits;
    Eigen::VectorXd
        load; ///< f, Rows (bodies + 1) + limits: the last body is the fixed ground, its rows are zero
    Eigen::VectorXd liveLoad; ///< L, likewise, or empty
    double liveWork = 1;      ///< w of L'y = w: about the number of loaded rows, so that y is of order one
    std::vector<Inertia> inertia;
    Eigen::VectorXd gap; ///< g, as s

    Scaling scaling;
    std::vector<int> firstRay;     ///< first ray of each contact point, and one past the last
    std::vector<int> firstRound;   ///< likewise
    std::vector<Force> directions; ///< normal force and shear of a unit of each ray
    std::vector<Eigen::Vector3d>
        roundScales;                 ///< diagonal of T of each round cone; 0 where it exerts no force
    std::vector<Coupling> couplings; ///< pairs of bodies in elimination order, for the Schur system

    /// Rays, slacks included, and round cones.
    ConeRanges cones() const
    {
        return {static_cast<Eigen::Index>(rays.size() + limits.size()),
                static_cast<Eigen::Index>(rounds.size())};
    }
    Eigen::Index slack(std::size_t limit) const { return static_cast<Eigen::Index>(rays.size() + limit); }
    Eigen::Index entry(const Limit& limit) const ///< of s, the first that is limited
    {
        return limit.round < 0 ? limit.ray : cones().at(limit.round);
    }
    static Eigen::Index entries(const Limit& limit) { return limit.round < 0 ? limit.rays : 1; }
    Eigen::Index row(std::size_t limit) const ///< of y
    {
        return Rows * (bodies + 1) + static_cast<Eigen::Index>(limit);
    }
    Eigen::Index rows() const { return row(limits.size()); }
    bool hasMultiplier() const { return liveLoad.size() > 0; }
    bool hasInertia() const { return !inertia.empty(); }
};

/// The cone program that a form of so many rows is made of.
template<int Rows>
using ProgramOf = ConeProgram<Rows, Form<Rows>::forces>;

/// The symbolic part of a Schur system, which depends on nothing but which bodies touch. Kept from program to
/// program it is made anew only when that changes, and the results are the same to the last bit as without
/// it. Empty at first; not for two threads at once.
struct SymbolicAnalysis
{
    int bodies = 0;
    std::vector<Coupling> touching; ///< pairs of bodies as the program numbers them, in its order
    std::vector<int> order;         ///< of elimination
    std::tuple<std::optional<SchurSystem<3>>, std::optional<SchurSystem<6>>> systems;
    std::tuple<std::optional<BlockLu<3>>, std::optional<BlockLu<6>>> unsymmetricSystems;

    template<int Rows>
    std::optional<SchurSystem<Rows>>& system()
    {
        return std::get<std::optional<SchurSystem<Rows>>>(systems);
    }
    template<int Rows>
    std::optional<BlockLu<Rows>>& unsymmetric()
    {
        return std::get<std::optional<BlockLu<Rows>>>(unsymmetricSystems);
    }
    template<int Rows>
    const std::optional<SchurSystem<Rows>>& system() const
    {
        return std::get<std::optional<SchurSystem<Rows>>>(systems);
    }
};

/// Brings the pairs of bodies that touch and the order of elimination up to date; where they change the
/// systems are forgotten.
template<int Rows, int Forces>
void analyse(const ConeProgram<Rows, Forces>& program, SymbolicAnalysis& symbolic);

/// Structure and numbers of the form of a program. \param symbolic brought up to date but for its system
/// \param multiplier that is expected, where it is large: forces are scaled by what it makes of the live load
/// \throws std::invalid_argument when the forces of a contact on its two bodies are not opposite
template<int Rows, int Forces>
Form<Rows> makeForm(const ConeProgram<Rows, Forces>& program, SymbolicAnalysis& symbolic,
                    double multiplier = 0);

/// The Schur system with the pattern of a form, its numbers those of who used it last; gives each group the
/// place of its block. \param symbolic that makeForm was called with
template<int Rows>
SchurSystem<Rows>& schurSystem(Form<Rows>& form, SymbolicAnalysis& symbolic);

/// Forces s that make up contact forces, slacks left at zero; forces outside their sets are put inside, or on
/// their surface. \param contactForce F k \return as the cones
template<int Rows, int Forces>
Eigen::VectorXd conesOf(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                        const Eigen::VectorXd& contactForce);

/// Openings of the cones for those of the points, z = R'u, slacks zero. \param opening u, F k, or empty for
/// zero
template<int Rows>
Eigen::VectorXd conesOfOpening(const Form<Rows>& form, const Eigen::VectorXd& opening);

/// The opposite of conesOfOpening for a program without strength; a point without friction opens along its
/// normal. \return F k
template<int Rows>
Eigen::VectorXd openingOf(const Form<Rows>& form, const Eigen::VectorXd& z);

/// Another load than that of the program, in the units and the order of its form. \param load R b
/// \return as Form::load
template<int Rows>
Eigen::VectorXd loadOf(const Form<Rows>& form, const Eigen::VectorXd& load);

/// Displacements in the units and the order of a form. \param displacement R b \return y, ground at rest
template<int Rows>
Eigen::VectorXd rowsOf(const Form<Rows>& form, const Eigen::VectorXd& displacement);

/// Solution in the program's own units and numbering; the forces of a point's cones are added up before they
/// are rounded.
template<int Rows, int Forces, class Scalar>
ConeSolution solutionOf(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                        const VectorOf<Scalar>& s, const VectorOf<Scalar>& y, const Scalar& multiplier);

} // namespace drystone
