// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The best force of a point at the tip, inside or on the surface; in space there by guarded Newton steps.
#include "conic/GaussSeidel.h"

#include "conic/Certificate.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace drystone
{
namespace
{

/// Sweeps between certificates, as a share of the sweeps done: a certificate costs as much as some sweeps.
constexpr double sweepsBetweenCertificates = 0.2;

template<int Forces>
using Force = Eigen::Matrix<double, Forces, 1>;

/// Force on the ray along `direction` that is best, 0 when pulling would be.
template<int Forces>
double leastOnRay(const Eigen::Matrix<double, Forces, Forces>& W, const Force<Forces>& b,
                  const Force<Forces>& direction)
{
    return std::max(0.0, -b.dot(direction) / direction.dot(W * direction));
}

/// The best forces inside the cone or at its tip. \return whether they are the best of all, so that the
/// surface need not be searched
template<int Forces>
bool leastOffSurface(const Eigen::Matrix<double, Forces, Forces>& W, const Force<Forces>& b, double mu,
                     Force<Forces>& force)
{
    // At the tip the point opens as much as its slip requires: b in the dual cone.
    if (mu * b.template tail<Forces - 1>().norm() <= b[0])
    {
        force.setZero();
        return true;
    }
    force = -W.ldlt().solve(b);
    return force[0] >= 0 && force.template tail<Forces - 1>().norm() <= mu * force[0];
}

/// What one contact point needs.
template<int Rows, int Forces>
struct LocalProblem
{
    Eigen::Matrix<double, Rows, Forces> firstMoves; ///< Mbar^-1 A of the first body
    Eigen::Matrix<double, Rows, Forces> secondMoves;
    Eigen::Matrix<double, Forces, Forces> W;    ///< with the compliance of the point
    Eigen::Matrix<double, Forces, Forces> ownW; ///< without
};

template<int Rows, int Forces>
std::vector<LocalProblem<Rows, Forces>> makeLocalProblems(const ConeProgram<Rows, Forces>& program)
{
    std::vector<LocalProblem<Rows, Forces>> problems(program.contacts.size());
    std::vector<Eigen::LDLT<Eigen::Matrix<double, Rows, Rows>>> inertia;
    for (const auto& block : program.inertia)
    {
        inertia.emplace_back(block);
    }
    for (std::size_t point = 0; point < problems.size(); ++point)
    {
        const auto& columns = program.contacts[point];
        auto& problem = problems[point];
        problem.W.setZero();
        if (columns.first >= 0)
        {
            problem.firstMoves = inertia[columns.first].solve(columns.onFirst);
            problem.W += columns.onFirst.transpose() * problem.firstMoves;
        }
        if (columns.second >= 0)
        {
            problem.secondMoves = inertia[columns.second].solve(columns.onSecond);
            problem.W += columns.onSecond.transpose() * problem.secondMoves;
        }
        problem.ownW = problem.W;
        if (program.hasCompliance())
        {
            problem.W +=
                program.compliance.template segment<Forces>(Forces * static_cast<int>(point)).asDiagonal();
        }
    }
    return problems;
}

/// y = Mbar^-1 (f - A c).
template<int Rows, int Forces>
Eigen::VectorXd displacementUnder(const ConeProgram<Rows, Forces>& program,
                                  const Eigen::VectorXd& contactForce)
{
    Eigen::VectorXd rows = program.load - applyEquilibrium(program, contactForce);
    for (int body = 0; body < program.bodies; ++body)
    {
        auto row = rows.template segment<Rows>(Rows * body);
        row = program.inertia[body].ldlt().solve(row).eval();
    }
    return rows;
}

/// The best force of a point within what it can carry.
template<int Rows, int Forces>
Force<Forces> leastAt(const ConeProgram<Rows, Forces>& program, int point,
                      const Eigen::Matrix<double, Forces, Forces>& W, const Force<Forces>& b)
{
    if constexpr (Forces == 2)
    {
        if (program.hasStrength())
        {
            return leastInSet(W, b, program.friction[point], program.strength[point]);
        }
    }
    return leastInCone(W, b, program.friction[point]);
}

/// Nearest forces that the points can carry.
template<int Rows, int Forces>
Eigen::VectorXd insideSets(const ConeProgram<Rows, Forces>& program, Eigen::VectorXd contactForce)
{
    using Matrix = Eigen::Matrix<double, Forces, Forces>;
    for (int point = 0; point < program.points(); ++point)
    {
        auto force = contactForce.template segment<Forces>(Forces * point);
        const Force<Forces> away = -force;
        force = leastAt(program, point, Matrix(Matrix::Identity()), away);
    }
    return contactForce;
}

} // namespace

Eigen::Vector2d leastInCone(const Eigen::Matrix2d& W, const Eigen::Vector2d& b, double mu)
{
    Eigen::Vector2d force;
    if (leastOffSurface<2>(W, b, mu, force))
    {
        return force;
    }
    const Eigen::Vector2d up(1, mu);
    const Eigen::Vector2d down(1, -mu);
    const double onUp = leastOnRay<2>(W, b, up);
    const double onDown = leastOnRay<2>(W, b, down);
    // The least on a ray d is b'd n / 2.
    return onUp * b.dot(up) <= onDown * b.dot(down) ? onUp * up : onDown * down;
}

Eigen::Vector2d leastInSet(const Eigen::Matrix2d& W, const Eigen::Vector2d& b, double mu,
                           const Strength& strength)
{
    const auto value = [&](const Eigen::Vector2d& c) { return c.dot(0.5 * W * c + b); };
    const Eigen::Vector2d inside = -W.ldlt().solve(b);
    if (inside[0] >= -strength.tension && inside[0] <= strength.crushing
        && std::abs(inside[1]) <= strength.cohesion + mu * inside[0])
    {
        return inside;
    }
    // Its edges: from the corner at the greatest tension, or at the most pressure, to the other one.
    const double alone = std::max(0.0, strength.cohesion - mu * strength.tension);
    const double length = strength.crushing + strength.tension;
    Eigen::Vector2d best(-strength.tension, alone);
    double least = value(best);
    const auto tryEdge = [&](const Eigen::Vector2d& corner, const Eigen::Vector2d& direction, double most)
    {
        const double along = -direction.dot(b + W * corner) / direction.dot(W * direction);
        const Eigen::Vector2d c = corner + std::clamp(along, 0.0, most) * direction;
        if (value(c) < least)
        {
            best = c;
            least = value(c);
        }
    };
    tryEdge({-strength.tension, alone}, {1, mu}, length);
    tryEdge({-strength.tension, -alone}, {1, -mu}, length);
    tryEdge({-strength.tension, -alone}, {0, 1}, 2 * alone);
    if (strength.isBounded())
    {
        const double shear = alone + mu * length;
        tryEdge({strength.crushing, -shear}, {0, 1}, 2 * shear);
    }
    return best;
}

/// On the surface, along d = (1, mu cos p, mu sin p), the least is -(b'd)^2 / (2 d'W d) where b'd < 0: the
/// angle p that makes h = b'd / sqrt(d'W d) least is sought among a dozen, then by Newton's method.
Eigen::Vector3d leastInCone(const Eigen::Matrix3d& W, const Eigen::Vector3d& b, double mu)
{
    Eigen::Vector3d force;
    if (leastOffSurface<3>(W, b, mu, force))
    {
        return force;
    }
    if (mu == 0)
    {
        return {leastOnRay<3>(W, b, Eigen::Vector3d::UnitX()), 0, 0};
    }
    const auto along = [mu](double angle)
    { return Eigen::Vector3d(1, mu * std::cos(angle), mu * std::sin(angle)); };
    constexpr int directions = 12;
    constexpr double spacing = 2 * std::numbers::pi / directions;
    double angle = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int direction = 0; direction < directions; ++direction)
    {
        const Eigen::Vector3d d = along(direction * spacing);
        const double value = b.dot(d) / std::sqrt(d.dot(W * d));
        if (value < least)
        {
            least = value;
            angle = direction * spacing;
        }
    }
    // h' = 0: with n = b'd and q = d'W d, h' q^(3/2) = n' q - n q'/2 =: e, which changes its sign between the
    // neighbours of the best direction.
    double low = angle - spacing;
    double high = angle + spacing;
    for (int iteration = 0; iteration < 50; ++iteration)
    {
        const Eigen::Vector3d d = along(angle);
        const Eigen::Vector3d d1(0, -d[2], d[1]);
        const Eigen::Vector3d d2(0, -d[1], -d[2]);
        const Eigen::Vector3d Wd = W * d;
        const double n = b.dot(d);
        const double q = d.dot(Wd);
        const double e = b.dot(d1) * q - n * d1.dot(Wd);
        const double slope = b.dot(d2) * q + b.dot(d1) * d1.dot(Wd) - n * (d2.dot(Wd) + d1.dot(W * d1));
        (e > 0 ? high : low) = angle;
        double next = angle - e / slope;
        if (!(slope > 0) || !(next > low && next < high))
        {
            next = 0.5 * (low + high);
        }
        const double change = std::abs(next - angle);
        angle = next;
        if (change < 1e-15)
        {
            break;
        }
    }
    const Eigen::Vector3d d = along(angle);
    return leastOnRay<3>(W, b, d) * d;
}

namespace
{

/// \throws std::invalid_argument where a program is none that relaxation solves
template<int Rows, int Forces>
void requireCones(const ConeProgram<Rows, Forces>& program)
{
    if (!program.hasInertia() || program.hasMultiplier())
    {
        throw std::invalid_argument("solveGaussSeidel needs inertia and no multiplier");
    }
    if (Forces == 3 && program.hasStrength())
    {
        throw std::invalid_argument("solveGaussSeidel needs cones in space: no strengths");
    }
}

/// Gives a point the force that is best as long as all others keep theirs, and the two bodies that it touches
/// their displacements by it. \param c forces of all points \param y displacements of all bodies
template<int Rows, int Forces, typename Problem>
void relax(const ConeProgram<Rows, Forces>& program, const Problem& problem, int point, Eigen::VectorXd& c,
           Eigen::VectorXd& y)
{
    const auto& columns = program.contacts[point];
    if (columns.first < 0 && columns.second < 0)
    {
        return; // nothing there can move
    }
    Force<Forces> z = -closingOf(columns, y);
    if (program.gap.size() > 0)
    {
        z += program.gap.template segment<Forces>(Forces * point);
    }
    auto force = c.template segment<Forces>(Forces * point);
    const Force<Forces> b = z - problem.ownW * force;
    const Force<Forces> best = leastAt(program, point, problem.W, b);
    const Force<Forces> change = best - force;
    force = best;
    if (columns.first >= 0)
    {
        y.template segment<Rows>(Rows * columns.first) -= problem.firstMoves * change;
    }
    if (columns.second >= 0)
    {
        y.template segment<Rows>(Rows * columns.second) -= problem.secondMoves * change;
    }
}

} // namespace

template<int Rows, int Forces>
ConeSolution solveGaussSeidel(const ConeProgram<Rows, Forces>& program, const ConeSolution& start,
                              const GaussSeidelSettings& settings)
{
    requireCones(program);
    const auto problems = makeLocalProblems(program);
    const int points = program.points();
    ConeSolution solution;
    Eigen::VectorXd& c = solution.contactForce;
    Eigen::VectorXd& y = solution.displacement;
    c = start.contactForce.size() == Forces * points ? insideSets(program, start.contactForce)
                                                     : Eigen::VectorXd::Zero(Forces * points);
    y = displacementUnder(program, c);

    int nextCertificate = 0;
    for (int& sweep = solution.iterations;; ++sweep)
    {
        if (sweep >= nextCertificate || sweep == settings.maximumIterations)
        {
            y = displacementUnder(program, c); // without the rounding of the sweeps
            if (certifyOptimal(program, solution).worst() <= settings.tolerance)
            {
                solution.status = SolveStatus::optimal;
                return solution;
            }
            nextCertificate = sweep + 1 + static_cast<int>(sweepsBetweenCertificates * sweep);
        }
        if (sweep == settings.maximumIterations)
        {
            return solution;
        }
        for (int step = 0; step < points; ++step)
        {
            const int point = sweep % 2 == 0 ? step : points - 1 - step;
            relax(program, problems[point], point, c, y);
        }
    }
}

template ConeSolution solveGaussSeidel(const PlaneConeProgram&, const ConeSolution&,
                                       const GaussSeidelSettings&);
template ConeSolution solveGaussSeidel(const SpaceConeProgram&, const ConeSolution&,
                                       const GaussSeidelSettings&);

} // namespace drystone
