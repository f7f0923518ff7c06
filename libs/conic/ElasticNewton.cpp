// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/ElasticNewton.h"

#include "conic/Certificate.h"
#include "linear/SchurSystem.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drystone
{
namespace
{

/// The force of a point and how it changes with A'y.
struct PointLaw
{
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero(); ///< D
};

/// \param pressing A'y - g \param compliance diagonal of C
PointLaw lawOf(const Eigen::Vector2d& pressing, const Eigen::Vector2d& compliance, double mu)
{
    PointLaw law;
    const Eigen::Vector2d trial = pressing.cwiseQuotient(compliance);
    if (std::abs(trial[1]) <= mu * trial[0])
    {
        law.force = trial;
        law.stiffness = compliance.cwiseInverse().asDiagonal();
        return law;
    }
    const Eigen::Vector2d edge(1, std::copysign(mu, trial[1]));
    const double along = edge.dot(pressing); // d'C c* = d'(A'y - g)
    if (along > 0)
    {
        const double size = compliance.dot(edge.cwiseAbs2());
        law.force = along / size * edge;
        law.stiffness = edge * edge.transpose() / size;
    }
    return law;
}

/// phi and what Newton's method needs of it.
class ElasticStep
{
public:
    explicit ElasticStep(const PlaneConeProgram& program)
        : program_(program),
          gap_(gapUnder(program, Eigen::VectorXd::Zero(2 * program.points()))),
          couplings_(couplingsOf(program)),
          order_(eliminationOrder(program.bodies, couplings_)),
          place_(order_.size()),
          system_(program.bodies, ordered())
    {
    }

    double value(const Eigen::VectorXd& y)
    {
        const Eigen::VectorXd pressing = applyTransposed(program_, y) - gap_;
        force_.resize(pressing.size());
        laws_.resize(static_cast<std::size_t>(program_.points()));
        for (int point = 0; point < program_.points(); ++point)
        {
            PointLaw& law = laws_[static_cast<std::size_t>(point)];
            law = lawOf(pressing.segment<2>(2 * point), program_.compliance.segment<2>(2 * point),
                        program_.friction[static_cast<std::size_t>(point)]);
            force_.segment<2>(2 * point) = law.force;
        }
        return 0.5 * y.dot(applyInertia(program_, y)) - program_.load.dot(y) + force_.dot(pressing)
               - 0.5 * program_.compliance.dot(force_.cwiseAbs2());
    }

    /// At the y of the last `value`.
    Eigen::VectorXd slope(const Eigen::VectorXd& y) const
    {
        return applyInertia(program_, y) + applyEquilibrium(program_, force_) - program_.load;
    }

    const Eigen::VectorXd& force() const { return force_; }

    /// Newton's step from the y of the last `value`; empty when the system cannot be factorised.
    Eigen::VectorXd step(const Eigen::VectorXd& slope)
    {
        system_.setZero();
        for (int body = 0; body < program_.bodies; ++body)
        {
            system_.diagonal(place(body)) += program_.inertia[static_cast<std::size_t>(body)];
        }
        for (int point = 0; point < program_.points(); ++point)
        {
            const auto& columns = program_.contacts[static_cast<std::size_t>(point)];
            const Eigen::Matrix2d& D = laws_[static_cast<std::size_t>(point)].stiffness;
            if (columns.first >= 0)
            {
                system_.diagonal(place(columns.first)) += columns.onFirst * D * columns.onFirst.transpose();
            }
            if (columns.second >= 0)
            {
                system_.diagonal(place(columns.second)) +=
                    columns.onSecond * D * columns.onSecond.transpose();
            }
            if (columns.first >= 0 && columns.second >= 0)
            {
                const int first = place(columns.first);
                const int second = place(columns.second);
                // rows of the later one
                system_.coupling(system_.slot(first, second)) +=
                    first > second ? (columns.onFirst * D * columns.onSecond.transpose()).eval()
                                   : (columns.onSecond * D * columns.onFirst.transpose()).eval();
            }
        }
        if (!system_.factorise())
        {
            return {};
        }
        Eigen::VectorXd ordered(slope.size());
        for (int body = 0; body < program_.bodies; ++body)
        {
            ordered.segment<3>(3 * place(body)) = -slope.segment<3>(3 * body);
        }
        system_.solve(ordered);
        Eigen::VectorXd step(slope.size());
        for (int body = 0; body < program_.bodies; ++body)
        {
            step.segment<3>(3 * body) = ordered.segment<3>(3 * place(body));
        }
        return step;
    }

private:
    static std::vector<Coupling> couplingsOf(const PlaneConeProgram& program)
    {
        std::vector<Coupling> couplings;
        for (const auto& columns : program.contacts)
        {
            if (columns.first >= 0 && columns.second >= 0)
            {
                couplings.push_back(
                    {std::min(columns.first, columns.second), std::max(columns.first, columns.second)});
            }
        }
        std::sort(couplings.begin(), couplings.end());
        couplings.erase(std::unique(couplings.begin(), couplings.end()), couplings.end());
        return couplings;
    }

    int place(int body) const { return place_[static_cast<std::size_t>(body)]; }

    /// The couplings with bodies by their place in the order; fills in the places.
    std::vector<Coupling> ordered()
    {
        for (std::size_t position = 0; position < order_.size(); ++position)
        {
            place_[static_cast<std::size_t>(order_[position])] = static_cast<int>(position);
        }
        std::vector<Coupling> result;
        for (const Coupling& coupling : couplings_)
        {
            result.push_back({place(coupling[0]), place(coupling[1])});
        }
        return result;
    }

    const PlaneConeProgram& program_;
    Eigen::VectorXd gap_;
    std::vector<Coupling> couplings_;
    std::vector<int> order_;
    std::vector<int> place_;
    SchurSystem<3> system_;
    Eigen::VectorXd force_;
    std::vector<PointLaw> laws_;
};

} // namespace

ConeSolution solveElasticNewton(const PlaneConeProgram& program, const ConeSolution& start,
                                const ElasticNewtonSettings& settings)
{
    if (!program.hasInertia() || program.hasMultiplier() || program.hasStrength())
    {
        throw std::invalid_argument("solveElasticNewton needs inertia and cones, and no multiplier");
    }
    if (program.compliance.size() != 2 * program.points()
        || (program.points() > 0 && !(program.compliance.minCoeff() > 0)))
    {
        throw std::invalid_argument("solveElasticNewton needs points that all give way");
    }
    constexpr double armijo = 1e-4;
    constexpr double shortest = 1e-12;
    ConeSolution solution;
    Eigen::VectorXd& y = solution.displacement;
    y = start.displacement.size() == program.load.size() ? start.displacement
                                                         : Eigen::VectorXd::Zero(program.load.size());
    ElasticStep problem(program);
    double value = problem.value(y);
    for (int& iteration = solution.iterations;; ++iteration)
    {
        solution.contactForce = problem.force();
        if (certifyOptimal(program, solution).worst() <= settings.tolerance)
        {
            solution.status = SolveStatus::optimal;
            return solution;
        }
        if (iteration == settings.maximumIterations)
        {
            return solution;
        }
        const Eigen::VectorXd slope = problem.slope(y);
        const Eigen::VectorXd step = problem.step(slope);
        ++solution.factorisations;
        if (step.size() == 0 || !step.allFinite())
        {
            return solution;
        }
        const double descent = slope.dot(step);
        for (double length = 1;; length /= 2)
        {
            const Eigen::VectorXd next = y + length * step;
            const double there = problem.value(next);
            // In the last steps phi changes by less than its rounding: the slope tells then.
            const bool isLower = there <= value + armijo * length * descent
                                 || problem.slope(next).norm() <= 0.5 * slope.norm();
            if (isLower || length < shortest)
            {
                y = next;
                value = there;
                break;
            }
        }
    }
}

} // namespace drystone
