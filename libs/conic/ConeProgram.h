// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The one convex cone program behind limit analysis and time steps.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace drystone
{

/// The columns of the equilibrium matrix A that belong to one contact point. They touch the rows of at most
/// two bodies, whose forces are opposite. Rows: forces, then moments; columns: normal force, then shear.
template<int Rows, int Forces>
struct ConeColumns
{
    int first = -1;  ///< body whose rows `onFirst` fills, or -1 when that body is fixed
    int second = -1; ///< likewise for `onSecond`
    Eigen::Matrix<double, Rows, Forces> onFirst = Eigen::Matrix<double, Rows, Forces>::Zero();
    Eigen::Matrix<double, Rows, Forces> onSecond = Eigen::Matrix<double, Rows, Forces>::Zero();
};

/// By how much displacements close a point in the direction of one component of its force: an entry of A'y.
/// Such entries are stored one by one and, where time counts, used so: loaded as a vector just after that,
/// they are waited for.
/// \param component 0: the normal force, then shear
template<int Rows, int Forces>
double closingAlong(const ConeColumns<Rows, Forces>& columns, int component,
                    const Eigen::VectorXd& displacement)
{
    double closing = 0;
    if (columns.first >= 0)
    {
        closing +=
            columns.onFirst.col(component).dot(displacement.template segment<Rows>(Rows * columns.first));
    }
    if (columns.second >= 0)
    {
        closing +=
            columns.onSecond.col(component).dot(displacement.template segment<Rows>(Rows * columns.second));
    }
    return closing;
}

/// By how much displacements close a point, and make it slide: its entries of A'y.
template<int Rows, int Forces>
Eigen::Matrix<double, Forces, 1> closingOf(const ConeColumns<Rows, Forces>& columns,
                                           const Eigen::VectorXd& displacement)
{
    Eigen::Matrix<double, Forces, 1> closing;
    for (int component = 0; component < Forces; ++component)
    {
        closing[component] = closingAlong(columns, component, displacement);
    }
    return closing;
}

/// Adds to the rows of the bodies what a force at a point is to them: its part of A c.
template<int Rows, int Forces>
void addForce(const ConeColumns<Rows, Forces>& columns, const Eigen::Matrix<double, Forces, 1>& force,
              Eigen::VectorXd& rows)
{
    if (columns.first >= 0)
    {
        rows.template segment<Rows>(Rows * columns.first) += columns.onFirst.lazyProduct(force);
    }
    if (columns.second >= 0)
    {
        rows.template segment<Rows>(Rows * columns.second) += columns.onSecond.lazyProduct(force);
    }
}

/// Whether the forces on the two bodies are opposite, to rounding; where one of them is fixed they are.
template<int Rows, int Forces>
bool hasOppositeForces(const ConeColumns<Rows, Forces>& columns)
{
    constexpr double rounding = 1e-9;
    const auto onFirst = columns.onFirst.template topRows<Forces>(); // as many rows of force as components
    const auto onSecond = columns.onSecond.template topRows<Forces>();
    return columns.first < 0 || columns.second < 0
           || (onFirst + onSecond).template lpNorm<Eigen::Infinity>()
                  <= rounding * onFirst.template lpNorm<Eigen::Infinity>();
}

/// What reshapes the cone of a point to -tension <= c_n <= crushing, |c_t| <= cohesion + mu c_n. None of it
/// leaves the cone.
struct Strength
{
    double cohesion = 0;                                       ///< at least mu tension
    double tension = 0;                                        ///< >= 0
    double crushing = std::numeric_limits<double>::infinity(); ///< > 0; infinite: no limit

    /// Whether it holds what would part or slip: not crushing, which takes away only.
    bool isBond() const { return cohesion > 0 || tension > 0; }
    bool isBounded() const { return crushing < std::numeric_limits<double>::infinity(); }
};

/// The problem data. With b bodies, k contact points, R = Rows and F = Forces:
///
///     minimise    1/2 r' Mbar^-1 r + g' c + 1/2 c' C c - alpha
///     subject to  r + A c = f + alpha L,    |c_t| <= mu c_n at every point
///
/// over the contact forces c (F k), the inertial forces r (R b) and the multiplier alpha. Its multipliers y
/// (R b) are the displacements of the bodies, and r = Mbar y:
///
///     maximise    f' y - 1/2 y' Mbar y - 1/2 c' C c
///     subject to  z = g + C c - A' y,    mu |z_t| <= z_n at every point,    L' y = 1
///
/// - limit analysis (Portioli, Cascini & Landolfo 2017, eq. 10): `inertia` empty, so that r = 0; f dead and L
/// live load; y is the
///   collapse mechanism, scaled so that the live load does unit work on it;
/// - time step (eq. 9): `liveLoad` empty, so that there is no alpha; y are the displacements over the step.
///
/// Where points have a `strength`, their sets K are no cones any more and z need not lie in a dual cone: the
/// dual objective gains the least of z'c over c in K (Certificate.h).
///
/// Nothing here knows of units: the solvers scale rows, loads and displacements themselves.
template<int Rows, int Forces>
struct ConeProgram
{
    using Inertia = Eigen::Matrix<double, Rows, Rows>;

    int bodies = 0;
    std::vector<ConeColumns<Rows, Forces>>
        contacts;                   ///< A, by contact point; points of one pair of bodies together
    std::vector<double> friction;   ///< mu of each contact point, >= 0
    std::vector<Strength> strength; ///< of each contact point, or empty: cones
    Eigen::VectorXd load;           ///< f, R b
    Eigen::VectorXd liveLoad;       ///< L, R b, or empty: no multiplier
    std::vector<Inertia> inertia;   ///< Mbar, one symmetric block a body, or empty: r = 0
    Eigen::VectorXd gap;            ///< g, F k (normal, tangential ...), or empty: zero
    Eigen::VectorXd compliance;     ///< diagonal of C, F k, >= 0, or empty: rigid points

    int points() const { return static_cast<int>(contacts.size()); }
    bool hasMultiplier() const { return liveLoad.size() > 0; }
    bool hasInertia() const { return !inertia.empty(); }
    bool hasCompliance() const { return compliance.size() > 0; }
    bool hasStrength() const { return !strength.empty(); }
    /// Of a point of a program without strengths: none.
    Strength strengthOf(std::size_t point) const { return hasStrength() ? strength[point] : Strength{}; }
    bool hasCrushing() const
    {
        return std::any_of(strength.begin(), strength.end(),
                           [](const Strength& ofPoint) { return ofPoint.isBounded(); });
    }
};

using PlaneConeProgram = ConeProgram<3, 2>;
using SpaceConeProgram = ConeProgram<6, 3>;

/// How a solve ended.
enum class SolveStatus
{
    optimal,     ///< the certificate meets the tolerance
    infeasible,  ///< no forces balance the load for any alpha: `displacement` is a ray that proves it
    unbounded,   ///< alpha grows without limit: `contactForce` is a ray that proves it
    notConverged ///< neither within the iterations allowed
};

/// A point well inside the cones that a solver passed on its way to a solution: where a program much like it,
/// such as that of the next time step, may be begun. At points that carry nothing, since they are new, both
/// are zero.
struct InteriorStart
{
    Eigen::VectorXd contactForce; ///< F k, inside the friction cones
    Eigen::VectorXd opening;      ///< F k, about g - A'y, inside the cones that are dual to them
    Eigen::VectorXd displacement; ///< R b, from that of the solution

    bool isEmpty() const { return displacement.size() == 0; }
};

/// What an answer took, all programs together.
struct SolverWork
{
    int iterations = 0;
    int factorisations = 0; ///< of Schur matrices
    int solves = 0;         ///< with those factors, forwards and back; counted by solveInteriorPoint only
};

/// Adds what a part of the work took.
void addWork(SolverWork& whole, const SolverWork& part);

/// What a solver returns. For `infeasible` the displacement y is a ray: -A' y in the dual cone, L' y = 0, f'
/// y > 0. For `unbounded` the contact force c is a ray: A c = L, c in the cone.
struct ConeSolution : SolverWork
{
    SolveStatus status = SolveStatus::notConverged;
    double multiplier = 0;        ///< alpha
    Eigen::VectorXd contactForce; ///< c, F k
    Eigen::VectorXd displacement; ///< y, R b
    /// Forces that carry f alone (alpha = 0), where a solver has come by some on its way; else empty.
    Eigen::VectorXd forceOfLoadAlone;
    InteriorStart interior;   ///< of a program with inertia, where a solver passed one; else empty
    bool isStartLost = false; ///< the start was nearly the solution, and this was not found from it
};

/// A c: generalised forces that contact forces balance. \param contactForce F k \return R b
template<int Rows, int Forces>
Eigen::VectorXd applyEquilibrium(const ConeProgram<Rows, Forces>& program,
                                 const Eigen::VectorXd& contactForce);

/// A' y: how much displacements close each point. \param displacement R b \return F k (normal, tangential
/// ...)
template<int Rows, int Forces>
Eigen::VectorXd applyTransposed(const ConeProgram<Rows, Forces>& program,
                                const Eigen::VectorXd& displacement);

/// g: zero where the program has no gaps. \return F k
template<int Rows, int Forces>
Eigen::VectorXd gapOf(const ConeProgram<Rows, Forces>& program);

/// g - A' y: how far the points of rigid blocks are apart after displacements. \param displacement R b
/// \return F k
template<int Rows, int Forces>
Eigen::VectorXd gapAfter(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& displacement);

/// g + C c: how far the points are apart with what their forces press them together. \return F k
template<int Rows, int Forces>
Eigen::VectorXd gapUnder(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& contactForce);

/// Mbar y. \return R b; zero when the program has no inertia
template<int Rows, int Forces>
Eigen::VectorXd applyInertia(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& displacement);

/// The primal objective 1/2 y' Mbar y + g' c + 1/2 c' C c - alpha of a solution; in limit analysis without
/// gaps -alpha.
template<int Rows, int Forces>
double objective(const ConeProgram<Rows, Forces>& program, const ConeSolution& solution);

/// Mean lever arm of the contact points: root mean square of the moment rows of A over that of its force
/// rows. 1 when there are no points. Makes moments comparable with forces.
template<int Rows, int Forces>
double meanLeverArm(const ConeProgram<Rows, Forces>& program);

/// The largest |entry| of rows of bodies, moments or rotations times a factor: 1 / lever arm makes moments
/// comparable with forces, the lever arm rotations with displacements. Infinite where an entry is not a
/// number. \param rows R b
template<int Rows, int Forces>
double largestRow(const Eigen::Ref<const Eigen::VectorXd>& rows, double momentFactor)
{
    double largest = 0;
    for (Eigen::Index body = 0; body < rows.size(); body += Rows)
    {
        for (int row = 0; row < Rows; ++row)
        {
            const double value = std::abs(rows[body + row]) * (row < Forces ? 1 : momentFactor);
            if (std::isnan(value))
            {
                return std::numeric_limits<double>::infinity();
            }
            largest = std::max(largest, value);
        }
    }
    return largest;
}

/// The program with inertia of order one in every row, its masses 1 and radii of gyration the mean lever arm:
/// how the bodies would start to move (Gauss's principle of least constraint). It always has a solution.
template<int Rows, int Forces>
ConeProgram<Rows, Forces> withUnitInertia(ConeProgram<Rows, Forces> program);

/// optimal, infeasible, unbounded or notConverged
std::string_view nameOf(SolveStatus status);

} // namespace drystone
