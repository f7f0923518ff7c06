// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces point by point, the nearest in the measure of C; steps are halved by Armijo's rule.
#include "conic/ElasticNewton.h"

#include "conic/Certificate.h"
#include "conic/coulomb/ContactSystem.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drystone
{
namespace
{

/// Outside the cone the nearest force lies on its edge d = (1, mu e), e the direction of shear, which is that
/// of the pressing since all directions of shear give way alike: c = a d, a = d'(A'y - g) / d'Cd. In space e
/// turns with the pressing p, which adds a mu (I - e e') / |p_t| to the derivative, which is by A'y.
/// \param pressing A'y - g \param compliance diagonal of C
template<int Forces>
PointForce<Forces> forceUnder(const Eigen::Matrix<double, Forces, 1>& pressing,
                              const Eigen::Matrix<double, Forces, 1>& compliance, double mu)
{
    constexpr int shears = Forces - 1;
    PointForce<Forces> law;
    const Eigen::Matrix<double, Forces, 1> trial = pressing.cwiseQuotient(compliance);
    if (trial.template tail<shears>().norm() <= mu * trial[0])
    {
        law.force = trial;
        law.derivative = compliance.cwiseInverse().asDiagonal();
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
        law.derivative = edge * edge.transpose() / size;
        if (shears > 1 && length > 0)
        {
            law.derivative.template bottomRightCorner<shears, shears>() +=
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
    ElasticStep(const ConeProgram<Rows, Forces>& ofProgram, SymbolicAnalysis& symbolic)
        : program(ofProgram),
          gap(gapOf(ofProgram)),
          system(ofProgram, Sliding::associative, symbolic),
          stiffnessFactor(Eigen::VectorXd::Ones(ofProgram.points())),
          laws(static_cast<std::size_t>(ofProgram.points()))
    {
    }

    double value(const Eigen::VectorXd& y)
    {
        const Eigen::VectorXd pressing = applyTransposed(program, y) - gap;
        force.resize(pressing.size());
        for (int point = 0; point < program.points(); ++point)
        {
            PointForce<Forces>& law = laws[static_cast<std::size_t>(point)];
            law = forceUnder<Forces>(pressing.segment<Forces>(Forces * point),
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
        if (!system.factorise(stiffnessFactor, laws))
        {
            return {};
        }
        return system.displacementOf(system.solve(system.scaledRows(-slope)));
    }

    /// Goes along a step as far as phi falls enough (Armijo's rule). \param y where it begins, and then ends
    /// \param phi the value there \param first slope where it begins
    void descend(Eigen::VectorXd& y, double& phi, const Eigen::VectorXd& first, const Eigen::VectorXd& step)
    {
        const Eigen::VectorXd from = y;
        const double before = phi;
        const double descent = first.dot(step);
        for (double length = 1;; length /= 2)
        {
            y = from + length * step;
            phi = value(y);
            // In the last steps phi changes by less than its rounding: the slope decides then.
            const bool isLower =
                phi <= before + armijo * length * descent || slope(y).norm() <= 0.5 * first.norm();
            if (isLower || length < shortest)
            {
                return;
            }
        }
    }

private:
    static constexpr double armijo = 1e-4; ///< share of the descent that the slope promises
    static constexpr double shortest = 1e-12;

    const ConeProgram<Rows, Forces>& program;
    Eigen::VectorXd gap;
    ContactSystem<Rows, Forces> system;
    Eigen::VectorXd stiffnessFactor; ///< 1: the laws' derivatives are by A'y itself
    Eigen::VectorXd force;
    std::vector<PointForce<Forces>> laws;
};

/// \throws std::invalid_argument where a program is none of points that give way alone
template<int Rows, int Forces>
void requireElastic(const ConeProgram<Rows, Forces>& program)
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
}

} // namespace

template<int Rows, int Forces>
ConeSolution solveElasticNewton(const ConeProgram<Rows, Forces>& program, const ConeSolution& start,
                                const ElasticNewtonSettings& settings, SymbolicAnalysis* kept)
{
    requireElastic(program);
    ConeSolution solution;
    Eigen::VectorXd& y = solution.displacement;
    y = start.displacement.size() == program.load.size() ? start.displacement
                                                         : Eigen::VectorXd::Zero(program.load.size());
    SymbolicAnalysis own;
    ElasticStep<Rows, Forces> problem(program, kept ? *kept : own);
    double phi = problem.value(y);
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
        problem.descend(y, phi, slope, step);
    }
}

template ConeSolution solveElasticNewton(const PlaneConeProgram&, const ConeSolution&,
                                         const ElasticNewtonSettings&, SymbolicAnalysis*);
template ConeSolution solveElasticNewton(const SpaceConeProgram&, const ConeSolution&,
                                         const ElasticNewtonSettings&, SymbolicAnalysis*);

} // namespace drystone
