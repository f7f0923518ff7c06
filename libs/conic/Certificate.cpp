// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Each error over the size of what it is compared with; strengths enter the dual objective as lost work.
#include "conic/Certificate.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

/// The gap of a multiplier is relative to the multiplier itself, but for one so small that the live load is
/// below this share of the dead load: an alpha of exactly zero is an answer too. So is work on gaps, such as
/// the reaction of a support that sinks and need not carry anything, below this share of what the loads do
/// on the largest gap.
constexpr double smallMultiplier = 1e-3;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// value / scale, where 0 / 0 is 0 and NaN is infinite.
double relative(double value, double scale)
{
    if (!std::isfinite(value) || !std::isfinite(scale))
    {
        return infinite;
    }
    if (value == 0)
    {
        return 0;
    }
    return scale > 0 ? value / scale : infinite;
}

/// Largest amount by which a point's force leaves its set -T <= c_n <= N, |c_t| <= C + mu c_n.
template<int Rows, int Forces>
double coneViolation(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& contactForce)
{
    double result = 0;
    for (int point = 0; point < program.points(); ++point)
    {
        const auto force = contactForce.template segment<Forces>(Forces * point);
        const double shear = force.template tail<Forces - 1>().norm();
        const Strength strength = program.strengthOf(static_cast<std::size_t>(point));
        const double held = std::max(force[0], -strength.tension);
        const double excess = std::max({-strength.tension - force[0], force[0] - strength.crushing,
                                        shear - strength.cohesion - program.friction[point] * held});
        result = std::isnan(excess) ? infinite : std::max(result, excess);
    }
    return result;
}

/// Largest amount by which z leaves the dual cone mu |z_t| <= z_n, of points that crushing does not bound.
template<int Rows, int Forces>
double dualConeViolation(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& z)
{
    double result = 0;
    for (int point = 0; point < program.points(); ++point)
    {
        if (program.strengthOf(static_cast<std::size_t>(point)).isBounded())
        {
            continue;
        }
        const auto opening = z.template segment<Forces>(Forces * point);
        const double slip = opening.template tail<Forces - 1>().norm();
        const double mu = program.friction[point];
        if (mu * slip <= opening[0]) // in the cone; not where one is not a number
        {
            continue;
        }
        // The distance from the cone, for any friction coefficient: from its surface, or from its vertex
        // where that is nearest.
        const bool isNearSurface = slip + mu * opening[0] >= 0;
        const double excess =
            isNearSurface ? (mu * slip - opening[0]) / std::sqrt(1 + mu * mu) : opening.norm();
        result = std::isnan(excess) ? infinite : std::max(result, excess);
    }
    return result;
}

/// What strengths add to the dual objective, and the sum of its terms' sizes.
struct StrengthWork
{
    double least = 0; ///< sum of min z'c over the sets of the points, <= 0
    double size = 0;
};

template<int Rows, int Forces>
StrengthWork strengthWork(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& z)
{
    StrengthWork work;
    for (int point = 0; program.hasStrength() && point < program.points(); ++point)
    {
        const auto opening = z.template segment<Forces>(Forces * point);
        const double slip = opening.template tail<Forces - 1>().norm();
        const double excess = opening[0] - program.friction[point] * slip;
        const Strength strength = program.strengthOf(static_cast<std::size_t>(point));
        double lost = strength.cohesion * slip;
        if (excess >= 0)
        {
            lost += strength.tension * excess;
        }
        else if (strength.isBounded())
        {
            lost -= strength.crushing * excess;
        }
        work.least -= lost;
        work.size += lost;
    }
    return work;
}

/// How far the loads would carry free bodies: the measure of a displacement when nothing moves [m].
template<int Rows, int Forces>
double farthestFall(const ConeProgram<Rows, Forces>& program, double lever)
{
    double farthest = 0;
    for (int body = 0; body < program.bodies; ++body)
    {
        const auto& inertia = program.inertia[static_cast<std::size_t>(body)];
        const Eigen::Matrix<double, Rows, 1> load = program.load.template segment<Rows>(Rows * body);
        const Eigen::Matrix<double, Rows, 1> fall =
            inertia.isDiagonal(0) ? Eigen::Matrix<double, Rows, 1>(load.cwiseQuotient(inertia.diagonal()))
                                  : Eigen::Matrix<double, Rows, 1>(inertia.ldlt().solve(load));
        farthest = std::max(farthest, largestRow<Rows, Forces>(fall, lever));
    }
    return farthest;
}

/// The program whose sets are the directions in which those of `program` have no end: its cones, and nothing
/// where crushing bounds them.
template<int Rows, int Forces>
ConeProgram<Rows, Forces> recession(ConeProgram<Rows, Forces> program)
{
    for (Strength& strength : program.strength)
    {
        strength = {0, 0, strength.isBounded() ? 0 : infinite};
    }
    return program;
}

/// sum |a_i b_i|: what a product a'b is compared with.
double magnitude(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
    return a.cwiseProduct(b).lpNorm<1>();
}

/// What a solution leaves of the balance, and the largest load, with which it is compared.
struct Balance
{
    Eigen::VectorXd missing; ///< r + A c - f - alpha L, R b
    double largestLoad = 0;
};

/// \param inertial r; empty at rest
template<int Rows, int Forces>
Balance balanceOf(const ConeProgram<Rows, Forces>& program, const ConeSolution& solution,
                  const Eigen::VectorXd& inertial, double lever)
{
    Balance balance{applyEquilibrium(program, solution.contactForce),
                    largestRow<Rows, Forces>(program.load, 1 / lever)};
    if (inertial.size() > 0)
    {
        balance.missing += inertial;
    }
    balance.missing -= program.load;
    if (balance.largestLoad == 0) // bodies at rest and free of loads that something pushes
    {
        balance.largestLoad = largestRow<Rows, Forces>(inertial, 1 / lever);
    }
    if (program.hasMultiplier())
    {
        balance.missing -= solution.multiplier * program.liveLoad;
        balance.largestLoad =
            std::max(balance.largestLoad,
                     std::abs(solution.multiplier) * largestRow<Rows, Forces>(program.liveLoad, 1 / lever));
    }
    return balance;
}

/// The difference of the primal and the dual objective, summed term by term, and the largest of the terms,
/// with which it is compared.
struct ObjectiveDifference
{
    double value = 0;
    double largestTerm = 0;

    void add(double term, double size)
    {
        value += term;
        largestTerm = std::max(largestTerm, size);
    }
};

} // namespace

double Certificate::worst() const
{
    return std::max({primalResidual, dualResidual, dualityGap});
}

template<int Rows, int Forces>
Certificate certifyOptimal(const ConeProgram<Rows, Forces>& program, const ConeSolution& solution)
{
    const double lever = meanLeverArm(program);
    const Eigen::VectorXd& c = solution.contactForce;
    const Eigen::VectorXd& y = solution.displacement;
    const bool isAtRest = y.isZero(0);
    const Eigen::VectorXd inertial = isAtRest ? Eigen::VectorXd() : applyInertia(program, y);
    const Balance balance = balanceOf(program, solution, inertial, lever);
    Certificate certificate;

    // Objectives: primal 1/2 y'Mbar y + g'c + 1/2 c'C c - alpha, dual f'y - 1/2 y'Mbar y - 1/2 c'C c;
    // difference = y'Mbar y + (g + C c)'c - alpha - f'y.
    ObjectiveDifference difference;
    double displacementScale = largestRow<Rows, Forces>(y, lever);
    if (!isAtRest)
    {
        difference.add(inertial.dot(y) - program.load.dot(y),
                       std::max(magnitude(inertial, y), magnitude(program.load, y)));
    }
    if (program.hasMultiplier())
    {
        const double alpha = solution.multiplier;
        difference.add(-alpha, std::max(std::abs(alpha),
                                        smallMultiplier * largestRow<Rows, Forces>(program.load, 1 / lever)
                                            / largestRow<Rows, Forces>(program.liveLoad, 1 / lever)));
        certificate.dualResidual = relative(std::abs(program.liveLoad.dot(y) - 1), 1);
    }
    Eigen::VectorXd z = gapUnder(program, c);
    if (program.gap.size() > 0 || program.hasCompliance())
    {
        const double largestGap = z.size() > 0 ? z.cwiseAbs().maxCoeff() : 0;
        displacementScale = std::max(displacementScale, largestGap);
        difference.add(z.dot(c),
                       std::max(magnitude(z, c), smallMultiplier * balance.largestLoad * largestGap));
    }
    if (!isAtRest)
    {
        z -= applyTransposed(program, y);
    }
    const StrengthWork strength = strengthWork(program, z);
    difference.add(-strength.least, strength.size);

    const double openings = dualConeViolation(program, z);
    if (program.hasInertia() && (openings != 0 || difference.value != 0)) // what is zero needs no scale
    {
        displacementScale = std::max(displacementScale, farthestFall(program, lever));
        difference.add(0, balance.largestLoad * displacementScale);
    }
    certificate.primalResidual =
        std::max(relative(largestRow<Rows, Forces>(balance.missing, 1 / lever), balance.largestLoad),
                 relative(coneViolation(program, c), balance.largestLoad));
    certificate.dualResidual = std::max(certificate.dualResidual, relative(openings, displacementScale));
    certificate.dualityGap = relative(std::abs(difference.value), difference.largestTerm);
    return certificate;
}

template<int Rows, int Forces>
Certificate certifyInfeasible(const ConeProgram<Rows, Forces>& program,
                              const Eigen::VectorXd& displacementRay)
{
    const double lever = meanLeverArm(program);
    const Eigen::VectorXd opening = -applyTransposed(program, displacementRay);
    const StrengthWork strength = strengthWork(program, opening);
    const double work = program.load.dot(displacementRay) + strength.least;
    // The share of the load's work that does not cancel: a ray is only as good as f'y is clearly positive,
    // also compared with what the same forces would do on what its openings miss the cone by. Those are known
    // to rounding at best, even where they come out as zero.
    const double size = std::max(magnitude(program.load, displacementRay),
                                 largestRow<Rows, Forces>(program.load, 1 / lever)
                                     * largestRow<Rows, Forces>(displacementRay, lever));
    const double share = relative(work, size + strength.size);
    Certificate certificate;
    if (!(share > 0) || !std::isfinite(share))
    {
        certificate.dualityGap = infinite;
        return certificate;
    }
    const double violation = std::max(std::numeric_limits<double>::epsilon(),
                                      relative(dualConeViolation<Rows, Forces>(program, opening),
                                               largestRow<Rows, Forces>(displacementRay, lever)));
    double liveWork = 0;
    if (program.hasMultiplier())
    {
        liveWork = relative(std::abs(program.liveLoad.dot(displacementRay)),
                            largestRow<Rows, Forces>(program.liveLoad, 1 / lever)
                                * largestRow<Rows, Forces>(displacementRay, lever));
    }
    certificate.dualResidual = std::max(violation, liveWork) / share;
    return certificate;
}

template<int Rows, int Forces>
Certificate certifyUnbounded(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& forceRay)
{
    const double lever = meanLeverArm(program);
    const double forceScale = largestRow<Rows, Forces>(program.liveLoad, 1 / lever);
    const Eigen::VectorXd imbalance = applyEquilibrium(program, forceRay) - program.liveLoad;
    Certificate certificate;
    certificate.primalResidual =
        std::max(relative(largestRow<Rows, Forces>(imbalance, 1 / lever), forceScale),
                 relative(coneViolation(recession(program), forceRay), forceScale));
    // Along the ray the objective gains 1 - g'c for each unit of the multiplier, and loses c'Cc/2 of its
    // square.
    const double gain = 1 - (program.gap.size() > 0 ? program.gap.dot(forceRay) : 0);
    if (!(gain > 0) || (program.hasCompliance() && !forceRay.isZero(0)))
    {
        certificate.dualityGap = infinite;
        return certificate;
    }
    certificate.primalResidual /= std::min(gain, 1.0);
    return certificate;
}

template<int Rows, int Forces>
Certificate certify(const ConeProgram<Rows, Forces>& program, const ConeSolution& solution)
{
    switch (solution.status)
    {
    case SolveStatus::infeasible:
        return certifyInfeasible(program, solution.displacement);
    case SolveStatus::unbounded:
        return certifyUnbounded(program, solution.contactForce);
    case SolveStatus::optimal:
    case SolveStatus::notConverged:
        break;
    }
    return certifyOptimal(program, solution);
}

template Certificate certifyOptimal(const PlaneConeProgram&, const ConeSolution&);
template Certificate certifyOptimal(const SpaceConeProgram&, const ConeSolution&);
template Certificate certifyInfeasible(const PlaneConeProgram&, const Eigen::VectorXd&);
template Certificate certifyInfeasible(const SpaceConeProgram&, const Eigen::VectorXd&);
template Certificate certifyUnbounded(const PlaneConeProgram&, const Eigen::VectorXd&);
template Certificate certifyUnbounded(const SpaceConeProgram&, const Eigen::VectorXd&);
template Certificate certify(const PlaneConeProgram&, const ConeSolution&);
template Certificate certify(const SpaceConeProgram&, const ConeSolution&);

} // namespace drystone
