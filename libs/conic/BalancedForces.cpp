// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The nearest forces that balance a load, in the metric of the barrier, and their repair.
#include "conic/BalancedForces.h"

#include "conic/InteriorPoint.h"
#include "conic/form/FormOperators.h"
#include "conic/form/FormSchur.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// s^2 of rays, P(s) of round cones, whose eigenvalues are those of s squared along its frame and their
/// product across it. \param least that eigenvalues of s count as
ConeWeights<double> barrierWeights(const ConeRanges& cones, const Eigen::VectorXd& s, double least)
{
    ConeWeights<double> weights;
    weights.rays = s.head(cones.rays).cwiseMax(least).cwiseAbs2();
    weights.rounds.resize(static_cast<std::size_t>(cones.rounds));
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const Eigen::Vector3d x = s.segment<3>(cones.at(round));
        const double radius = x.tail<2>().norm();
        const double larger = std::max(least, x[0] + radius);
        const double smaller = std::max(least, x[0] - radius);
        weights.rounds[static_cast<std::size_t>(round)] = {
            directionOf(x, radius), {larger * larger, smaller * smaller, larger * smaller}};
    }
    return weights;
}

} // namespace

template<int Rows, int Forces>
Eigen::VectorXd nearestForces(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& near,
                              double tolerance, SymbolicAnalysis& symbolic)
{
    constexpr int mostRefinements = 6; // each leaves a part of the last, given by the regularisation
    constexpr double relative = 1e-13; // bodies that nothing touches make S singular
    constexpr double least = 1e-3;     // of the mean
    Form<Rows> form = makeForm(program, symbolic);
    const ConeRanges cones = form.cones();
    const Eigen::VectorXd known = conesOf(program, form, near);
    SchurSystem<Rows>& system = schurSystem(form, symbolic);
    const double size = cones.degree() > 0 ? known.squaredNorm() / static_cast<double>(cones.degree()) : 1;
    const ConeWeights<double> weights = barrierWeights(cones, known, least * std::sqrt(size));
    assembleSchur(form, weights, relative * std::max(size, relative), relative, system);
    if (!system.factorise())
    {
        return {};
    }
    const double allowed = tolerance * std::max(1e-300, form.load.template lpNorm<Eigen::Infinity>());
    Eigen::VectorXd s = known;
    Eigen::VectorXd change(s.size());
    for (int refinement = 0; refinement <= mostRefinements; ++refinement)
    {
        Eigen::VectorXd missing = -form.load;
        addForces(form, s, missing);
        if (missing.lpNorm<Eigen::Infinity>() <= allowed)
        {
            return solutionOf(program, form, s, Eigen::VectorXd(Eigen::VectorXd::Zero(form.rows())), 0.0)
                .contactForce;
        }
        solveWithLimits(form, weights, system, missing);
        applyTransposed(form, missing, change);
        weights.apply(change);
        s -= change;
        if (!s.allFinite())
        {
            return {};
        }
    }
    return {};
}

template<int Rows, int Forces>
std::vector<std::size_t> pointsOutside(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& near,
                                       const Eigen::VectorXd& forces, double margin)
{
    std::vector<std::size_t> outside;
    for (std::size_t i = 0; i < program.contacts.size(); ++i)
    {
        const Eigen::Index row = Forces * static_cast<Eigen::Index>(i);
        const Eigen::Matrix<double, Forces, 1> left =
            forces.segment<Forces>(row) - margin * near.segment<Forces>(row);
        if (!(left.template tail<Forces - 1>().norm() <= program.friction[i] * left[0]))
        {
            outside.push_back(i);
        }
    }
    return outside;
}

template<int Rows, int Forces>
std::vector<char> withNeighbours(const ConeProgram<Rows, Forces>& program, std::vector<char> isMarked,
                                 int times)
{
    for (int ring = 0; ring < times; ++ring)
    {
        const std::vector<char> before = isMarked;
        for (const auto& contact : program.contacts)
        {
            if (contact.first >= 0 && contact.second >= 0
                && (before[static_cast<std::size_t>(contact.first)]
                    || before[static_cast<std::size_t>(contact.second)]))
            {
                isMarked[static_cast<std::size_t>(contact.first)] = true;
                isMarked[static_cast<std::size_t>(contact.second)] = true;
            }
        }
    }
    return isMarked;
}

namespace
{

/// Whether each body is at one of the points.
template<int Rows, int Forces>
std::vector<char> bodiesAt(const ConeProgram<Rows, Forces>& program, const std::vector<std::size_t>& points)
{
    std::vector<char> isAt(static_cast<std::size_t>(program.bodies), false);
    for (const std::size_t point : points)
    {
        for (const int body : {program.contacts[point].first, program.contacts[point].second})
        {
            if (body >= 0)
            {
                isAt[static_cast<std::size_t>(body)] = true;
            }
        }
    }
    return isAt;
}

/// The balance of some of the bodies.
template<int Rows, int Forces>
struct PartOfBalance
{
    ConeProgram<Rows, Forces> program; ///< its load that of the whole with the forces of other bodies
    std::vector<std::size_t> points;   ///< of it, in the whole
};

template<int Rows, int Forces>
PartOfBalance<Rows, Forces> partOfBalance(const ConeProgram<Rows, Forces>& whole,
                                          const Eigen::VectorXd& forces, const std::vector<char>& isPart)
{
    PartOfBalance<Rows, Forces> part;
    std::vector<int> own(isPart.size(), -1); // number in the part
    for (std::size_t body = 0; body < own.size(); ++body)
    {
        own[body] = isPart[body] ? part.program.bodies++ : -1;
    }
    Eigen::VectorXd& load = part.program.load;
    load.resize(Rows * part.program.bodies);
    for (std::size_t body = 0; body < own.size(); ++body)
    {
        if (isPart[body])
        {
            load.segment<Rows>(Rows * own[body]) =
                whole.load.template segment<Rows>(Rows * static_cast<Eigen::Index>(body));
        }
    }
    const auto numberOf = [&own](int body) { return body < 0 ? -1 : own[static_cast<std::size_t>(body)]; };
    for (std::size_t point = 0; point < whole.contacts.size(); ++point)
    {
        ConeColumns<Rows, Forces> columns = whole.contacts[point];
        const bool isKnown =
            (columns.first >= 0 && numberOf(columns.first) < 0)
            || (columns.second >= 0 && numberOf(columns.second) < 0); // another body is at it
        columns.first = numberOf(columns.first);
        columns.second = numberOf(columns.second);
        if (columns.first < 0 && columns.second < 0)
        {
            continue;
        }
        if (!isKnown)
        {
            part.program.contacts.push_back(columns);
            part.program.friction.push_back(whole.friction[point]);
            part.points.push_back(point);
            continue;
        }
        const auto force = forces.segment<Forces>(Forces * static_cast<Eigen::Index>(point));
        if (columns.first >= 0)
        {
            load.segment<Rows>(Rows * columns.first) -= columns.onFirst * force;
        }
        if (columns.second >= 0)
        {
            load.segment<Rows>(Rows * columns.second) -= columns.onSecond * force;
        }
    }
    return part;
}

} // namespace

template<int Rows, int Forces>
Eigen::VectorXd repairedForces(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& forces,
                               const std::vector<std::size_t>& outside, double tolerance, int& factorisations)
{
    constexpr double largestPart = 0.6; // of the bodies: larger ones cost what a program of all does
    InteriorPointSettings settings;
    settings.tolerance = tolerance;
    settings.arithmetic = Arithmetic::standard;
    int last = 0; // bodies of the part before
    for (int neighbours = 3;; neighbours *= 3)
    {
        const std::vector<char> isPart = withNeighbours(program, bodiesAt(program, outside), neighbours);
        const PartOfBalance<Rows, Forces> part = partOfBalance(program, forces, isPart);
        if (part.program.bodies == last || part.program.bodies > largestPart * program.bodies)
        {
            return {};
        }
        last = part.program.bodies;
        const ConeSolution solution = solveInteriorPoint(part.program, settings);
        factorisations += solution.factorisations;
        if (solution.status == SolveStatus::optimal)
        {
            Eigen::VectorXd repaired = forces;
            for (std::size_t i = 0; i < part.points.size(); ++i)
            {
                repaired.segment<Forces>(Forces * static_cast<Eigen::Index>(part.points[i])) =
                    solution.contactForce.segment<Forces>(Forces * static_cast<Eigen::Index>(i));
            }
            return repaired;
        }
    }
}

template Eigen::VectorXd nearestForces(const PlaneConeProgram&, const Eigen::VectorXd&, double,
                                       SymbolicAnalysis&);
template Eigen::VectorXd nearestForces(const SpaceConeProgram&, const Eigen::VectorXd&, double,
                                       SymbolicAnalysis&);

template std::vector<std::size_t> pointsOutside(const PlaneConeProgram&, const Eigen::VectorXd&,
                                                const Eigen::VectorXd&, double);
template std::vector<std::size_t> pointsOutside(const SpaceConeProgram&, const Eigen::VectorXd&,
                                                const Eigen::VectorXd&, double);

template std::vector<char> withNeighbours(const PlaneConeProgram&, std::vector<char>, int);
template std::vector<char> withNeighbours(const SpaceConeProgram&, std::vector<char>, int);

template Eigen::VectorXd repairedForces(const PlaneConeProgram&, const Eigen::VectorXd&,
                                        const std::vector<std::size_t>&, double, int&);
template Eigen::VectorXd repairedForces(const SpaceConeProgram&, const Eigen::VectorXd&,
                                        const std::vector<std::size_t>&, double, int&);

} // namespace drystone
