// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A small Cholesky factor of the active rays for each set of them; the certificate has the last word.
#include "conic/ActiveRays.h"

#include "conic/Certificate.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace drystone
{
namespace
{

/// Beyond these the form is as quick.
constexpr int mostBodies = 4;
constexpr int mostPoints = 32;

/// More rays than rows are never independent.
constexpr int mostActive = 3 * mostBodies;

constexpr int mostChanges = 6; // of the set

/// A ray of a start carries if its force is more than this part of the largest.
constexpr double carrying = 1e-12;

/// A ray of which less than this is left without the others depends on them: forces are not unique.
constexpr double dependent = 1e-10;

/// Overlaps of less than this part of the largest motion of a point are rounding.
constexpr double roundingOfOverlap = 1e-13;

/// Of a contact point.
struct Ray
{
    int point;
    Eigen::Vector2d direction; ///< normal force and shear of a unit of it
    double force = 0;          ///< s
    bool isActive = false;
};

template<int Rows>
using Short = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Rows, 1>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, mostActive, mostActive>;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 * mostBodies, mostActive>;

class ActiveRays
{
public:
    ActiveRays(const PlaneConeProgram& ofProgram, const Eigen::VectorXd& startForces)
        : program(ofProgram), rows(3 * ofProgram.bodies)
    {
        rays.reserve(2 * program.contacts.size());
        double largest = 0;
        for (int point = 0; point < program.points(); ++point)
        {
            const double mu = program.friction[static_cast<std::size_t>(point)];
            const double normal = startForces[2 * point];
            const double shear = startForces[2 * point + 1];
            if (mu > 0)
            {
                rays.push_back({point, {1, mu}, (normal + shear / mu) / 2});
                rays.push_back({point, {1, -mu}, (normal - shear / mu) / 2});
            }
            else
            {
                rays.push_back({point, {1, 0}, normal});
            }
            largest = std::max(largest, normal);
        }
        for (Ray& ray : rays)
        {
            ray.isActive = ray.force > carrying * largest;
            ray.force = ray.isActive ? ray.force : 0;
        }
    }

    /// For the set as it is. \return whether its rays are independent
    bool solve()
    {
        if (!collect())
        {
            return false;
        }
        Square system = columns.transpose().lazyProduct(moved);
        const Short<mostActive> diagonal = system.diagonal();
        const Eigen::LLT<Eigen::Ref<Square>> factor(system);
        if (factor.info() != Eigen::Success
            || (system.diagonal().array().square() < dependent * diagonal.array()).any())
        {
            return false;
        }
        for (int refinement = 0; refinement < 2; ++refinement)
        {
            Short<mostActive> change = columns.transpose().lazyProduct(displacement());
            for (std::size_t k = 0; k < active.size(); ++k)
            {
                change[static_cast<Eigen::Index>(k)] -= gapOf(*active[k]);
            }
            factor.solveInPlace(change);
            for (std::size_t k = 0; k < active.size(); ++k)
            {
                active[k]->force += change[static_cast<Eigen::Index>(k)];
            }
        }
        return true;
    }

    /// Puts the set right. \return whether it was
    bool settle()
    {
        const Short<3 * mostBodies> y = displacement();
        bool isRight = true;
        double largest = 0;
        openings.resize(rays.size());
        for (std::size_t k = 0; k < rays.size(); ++k)
        {
            const double closing = closingOf(rays[k], y);
            openings[k] = gapOf(rays[k]) - closing;
            largest = std::max(largest, std::abs(closing));
        }
        for (std::size_t k = 0; k < rays.size(); ++k)
        {
            Ray& ray = rays[k];
            const bool isActive = ray.isActive ? ray.force > 0 : openings[k] < -roundingOfOverlap * largest;
            isRight = isRight && isActive == ray.isActive;
            ray.isActive = isActive;
            ray.force = isActive ? ray.force : 0;
        }
        return isRight;
    }

    ConeSolution solution() const
    {
        ConeSolution solution;
        solution.contactForce = Eigen::VectorXd::Zero(2 * program.points());
        for (const Ray& ray : rays)
        {
            solution.contactForce.segment<2>(2 * ray.point) += ray.force * ray.direction;
        }
        solution.displacement = displacement();
        return solution;
    }

private:
    double gapOf(const Ray& ray) const
    {
        return program.gap.size() > 0 ? ray.direction.dot(program.gap.segment<2>(2 * ray.point)) : 0;
    }

    const ConeColumns<3, 2>& contactOf(const Ray& ray) const
    {
        return program.contacts[static_cast<std::size_t>(ray.point)];
    }

    template<class Rows>
    double closingOf(const Ray& ray, const Rows& y) const
    {
        const auto& contact = contactOf(ray);
        double closing = 0;
        if (contact.first >= 0)
        {
            closing += (contact.onFirst * ray.direction).dot(y.template segment<3>(3 * contact.first));
        }
        if (contact.second >= 0)
        {
            closing += (contact.onSecond * ray.direction).dot(y.template segment<3>(3 * contact.second));
        }
        return closing;
    }

    /// Adds B s of one ray.
    template<class Rows>
    void add(const Ray& ray, double force, Rows&& sum) const
    {
        const auto& contact = contactOf(ray);
        if (contact.first >= 0)
        {
            sum.template segment<3>(3 * contact.first) += contact.onFirst * (force * ray.direction);
        }
        if (contact.second >= 0)
        {
            sum.template segment<3>(3 * contact.second) += contact.onSecond * (force * ray.direction);
        }
    }

    /// Mbar^-1 of rows.
    template<class Rows>
    void accelerate(Rows&& sum) const
    {
        for (int body = 0; body < program.bodies; ++body)
        {
            const auto& inertia = program.inertia[static_cast<std::size_t>(body)];
            const Eigen::Vector3d own = sum.template segment<3>(3 * body);
            sum.template segment<3>(3 * body) = inertia.isDiagonal(0)
                                                    ? Eigen::Vector3d(own.cwiseQuotient(inertia.diagonal()))
                                                    : Eigen::Vector3d(inertia.ldlt().solve(own));
        }
    }

    /// The columns of the active rays. \return whether these are not too many to be independent
    bool collect()
    {
        active.clear();
        for (Ray& ray : rays)
        {
            if (ray.isActive)
            {
                active.push_back(&ray);
            }
        }
        if (active.size() > static_cast<std::size_t>(rows))
        {
            return false;
        }
        columns.setZero(rows, static_cast<Eigen::Index>(active.size()));
        for (std::size_t k = 0; k < active.size(); ++k)
        {
            add(*active[k], 1, columns.col(static_cast<Eigen::Index>(k)));
        }
        moved = columns;
        for (Eigen::Index k = 0; k < moved.cols(); ++k)
        {
            accelerate(moved.col(k));
        }
        return true;
    }

    /// y = Mbar^-1 (f - B s).
    Short<3 * mostBodies> displacement() const
    {
        Short<3 * mostBodies> y = program.load;
        for (const Ray& ray : rays)
        {
            if (ray.isActive)
            {
                add(ray, -ray.force, y);
            }
        }
        accelerate(y);
        return y;
    }

    const PlaneConeProgram& program;
    int rows;
    std::vector<Ray> rays;
    std::vector<Ray*> active;
    std::vector<double> openings;
    Columns columns; ///< B of the active rays
    Columns moved;   ///< Mbar^-1 B
};

} // namespace

bool areFew(const PlaneConeProgram& program)
{
    return program.bodies <= mostBodies && program.points() <= mostPoints;
}

std::optional<ConeSolution> solveByActiveRays(const PlaneConeProgram& program, const ConeSolution& start,
                                              double tolerance)
{
    if (!areFew(program))
    {
        return std::nullopt;
    }
    ActiveRays rays(program, start.contactForce);
    for (int change = 0; change <= mostChanges; ++change)
    {
        if (!rays.solve())
        {
            return std::nullopt;
        }
        if (rays.settle())
        {
            ConeSolution solution = rays.solution();
            solution.iterations = change + 1;
            solution.factorisations = change + 1;
            if (certifyOptimal(program, solution).worst() > tolerance)
            {
                return std::nullopt;
            }
            solution.status = SolveStatus::optimal;
            return solution;
        }
    }
    return std::nullopt;
}

} // namespace drystone
