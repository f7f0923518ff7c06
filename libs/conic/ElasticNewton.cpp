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
template<int Forces>
struct PointLaw
{
    Eigen::Matrix<double, Forces, 1> force = Eigen::Matrix<double, Forces, 1>::Zero();
    Eigen::Matrix<double, Forces, Forces> stiffness = Eigen::Matrix<double, Forces, Forces>::Zero(); ///< D
};

/// Outside the cone the nearest force lies on its edge d = (1, mu e), e the direction of shear, which is that
/// of the pressing since all directions of shear give way alike: c = a d, a = d'(A'y - g) / d'Cd. In space e
/// turns with the pressing p, which adds a mu (I - e e') / |p_t| to the stiffness. \param pressing A'y - g
/// \param compliance diagonal of C
template<int Forces>
PointLaw<Forces> lawOf(const Eigen::Matrix<double, Forces, 1>& pressing,
                       const Eigen::Matrix<double, Forces, 1>& compliance, double mu)
{
    constexpr int shears = Forces - 1;
    PointLaw<Forces> law;
    const Eigen::Matrix<double, Forces, 1> trial = pressing.cwiseQuotient(compliance);
    if (trial.template tail<shears>().norm() <= mu * trial[0])
    {
        law.force = trial;
        law.stiffness = compliance.cwiseInverse().asDiagonal();
        return law;
    }
    const Eigen::Matrix<double, shears, 1> shear = pressing.template tail<shears>();
    const double length = shear.norm();
    const Eigen::Matrix<double, shears, 1> direction =
        length > 0 ? Eigen::Matrix<double, shears, 1>(shear / length)
                   : Eigen::Matrix<double, shears, 1>(Eigen::Matrix<double, shears, 1>::Unit(0));
    Eigen::Matrix<double, Forces, 1> edge;
    edge << 1, mu * direction;
    const double along = edge.dot(pressing); // d'C c* = d'(A'y - g)
    if (along > 0)
    {
        const double size = compliance.dot(edge.cwiseAbs2());
        law.force = along / size * edge;
        law.stiffness = edge * edge.transpose() / size;
        if (shears > 1 && length > 0)
        {
            law.stiffness.template bottomRightCorner<shears, shears>() +=
                along / size * mu / length
                * (Eigen::Matrix<double, shears, shears>::Identity() - direction * direction.transpose());
        }
    }
    return law;
}

/// phi and what Newton's method needs of it.
template<int Rows, int Forces>
class ElasticStep
{
public:
    explicit ElasticStep(const ConeProgram<Rows, Forces>& ofProgram)
        : program(ofProgram),
          gap(gapUnder(ofProgram, Eigen::VectorXd::Zero(Forces * ofProgram.points()))),
          couplings(couplingsOf(ofProgram)),
          order(eliminationOrder(ofProgram.bodies, couplings)),
          places(order.size()),
          system(ofProgram.bodies, ordered())
    {
    }

    double value(const Eigen::VectorXd& y)
    {
        const Eigen::VectorXd pressing = applyTransposed(program, y) - gap;
        force.resize(pressing.size());
        laws.resize(static_cast<std::size_t>(program.points()));
        for (int point = 0; point < program.points(); ++point)
        {
            PointLaw<Forces>& law = laws[static_cast<std::size_t>(point)];
            law = lawOf<Forces>(pressing.segment<Forces>(Forces * point),
                                program.compliance.template segment<Forces>(Forces * point),
                                program.friction[static_cast<std::size_t>(point)]);
            force.segment<Forces>(Forces * point) = law.force;
        }
        return 0.5 * y.dot(applyInertia(program, y)) - program.load.dot(y) + force.dot(pressing)
               - 0.5 * program.compliance.dot(force.cwiseAbs2());
    }

    /// At the y of the last `value`.
    Eigen::VectorXd slope(const Eigen::VectorXd& y) const
    {
        return applyInertia(program, y) + applyEquilibrium(program, force) - program.load;
    }

    const Eigen::VectorXd& contactForce() const { return force; }

    /// Newton's step from the y of the last `value`; empty when the system cannot be factorised.
    Eigen::VectorXd step(const Eigen::VectorXd& slope)
    {
        system.setZero();
        for (int body = 0; body < program.bodies; ++body)
        {
            system.diagonal(place(body)) += program.inertia[static_cast<std::size_t>(body)];
        }
        for (int point = 0; point < program.points(); ++point)
        {
            const auto& columns = program.contacts[static_cast<std::size_t>(point)];
            const Eigen::Matrix<double, Forces, Forces>& D = laws[static_cast<std::size_t>(point)].stiffness;
            if (columns.first >= 0)
            {
                system.diagonal(place(columns.first)) += columns.onFirst * D * columns.onFirst.transpose();
            }
            if (columns.second >= 0)
            {
                system.diagonal(place(columns.second)) += columns.onSecond * D * columns.onSecond.transpose();
            }
            if (columns.first >= 0 && columns.second >= 0)
            {
                const int first = place(columns.first);
                const int second = place(columns.second);
                // rows of the later one
                system.coupling(system.slot(first, second)) +=
                    first > second ? (columns.onFirst * D * columns.onSecond.transpose()).eval()
                                   : (columns.onSecond * D * columns.onFirst.transpose()).eval();
            }
        }
        if (!system.factorise())
        {
            return {};
        }
        Eigen::VectorXd ordered(slope.size());
        for (int body = 0; body < program.bodies; ++body)
        {
            ordered.segment<Rows>(Rows * place(body)) = -slope.segment<Rows>(Rows * body);
        }
        system.solve(ordered);
        Eigen::VectorXd step(slope.size());
        for (int body = 0; body < program.bodies; ++body)
        {
            step.segment<Rows>(Rows * body) = ordered.segment<Rows>(Rows * place(body));
        }
        return step;
    }

private:
    static std::vector<Coupling> couplingsOf(const ConeProgram<Rows, Forces>& ofProgram)
    {
        std::vector<Coupling> pairs;
        for (const auto& columns : ofProgram.contacts)
        {
            if (columns.first >= 0 && columns.second >= 0)
            {
                pairs.push_back(
                    {std::min(columns.first, columns.second), std::max(columns.first, columns.second)});
            }
        }
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        return pairs;
    }

    int place(int body) const { return places[static_cast<std::size_t>(body)]; }

    /// The couplings with bodies by their place in the order; fills in the places.
    std::vector<Coupling> ordered()
    {
        for (std::size_t position = 0; position < order.size(); ++position)
        {
            places[static_cast<std::size_t>(order[position])] = static_cast<int>(position);
        }
        std::vector<Coupling> result;
        for (const Coupling& coupling : couplings)
        {
            result.push_back({place(coupling[0]), place(coupling[1])});
        }
        return result;
    }

    const ConeProgram<Rows, Forces>& program;
    Eigen::VectorXd gap;
    std::vector<Coupling> couplings;
    std::vector<int> order;
    std::vector<int> places;
    SchurSystem<Rows> system;
    Eigen::VectorXd force;
    std::vector<PointLaw<Forces>> laws;
};

} // namespace

template<int Rows, int Forces>
ConeSolution solveElasticNewton(const ConeProgram<Rows, Forces>& program, const ConeSolution& start,
                                const ElasticNewtonSettings& settings)
{
    if (!program.hasInertia() || program.hasMultiplier() || program.hasStrength())
    {
        throw std::invalid_argument("solveElasticNewton needs inertia and cones, and no multiplier");
    }
    if (program.compliance.size() != Forces * program.points()
        || (program.points() > 0 && !(program.compliance.minCoeff() > 0)))
    {
        throw std::invalid_argument("solveElasticNewton needs points that all give way");
    }
    for (Eigen::Index row = 2; Forces == 3 && row < program.compliance.size(); row += 3)
    {
        if (program.compliance[row] != program.compliance[row - 1])
        {
            throw std::invalid_argument("solveElasticNewton needs points that give way alike in all shears");
        }
    }
    constexpr double armijo = 1e-4;
    constexpr double shortest = 1e-12;
    ConeSolution solution;
    Eigen::VectorXd& y = solution.displacement;
    y = start.displacement.size() == program.load.size() ? start.displacement
                                                         : Eigen::VectorXd::Zero(program.load.size());
    ElasticStep<Rows, Forces> problem(program);
    double value = problem.value(y);
    for (int& iteration = solution.iterations;; ++iteration)
    {
        solution.contactForce = problem.contactForce();
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

template ConeSolution solveElasticNewton(const PlaneConeProgram&, const ConeSolution&,
                                         const ElasticNewtonSettings&);
template ConeSolution solveElasticNewton(const SpaceConeProgram&, const ConeSolution&,
                                         const ElasticNewtonSettings&);

} // namespace drystone
