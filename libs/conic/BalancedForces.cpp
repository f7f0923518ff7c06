// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The nearest forces that balance a load, in the metric of the barrier, and their repair.
#include "conic/BalancedForces.h"

#include "conic/InteriorPoint.h"
#include "conic/ProgramPart.h"
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

/// Assembles and factorises B D B' with D at known forces. \return whether that is possible
template<int Rows>
bool factorise(const Form<Rows>& form, const Eigen::VectorXd& known, ConeWeights<double>& weights,
               SchurSystem<Rows>& system)
{
    constexpr double relative = 1e-13; // bodies that nothing touches make S singular
    constexpr double least = 1e-3;     // of the mean
    const ConeRanges cones = form.cones();
    const double size = cones.degree() > 0 ? known.squaredNorm() / static_cast<double>(cones.degree()) : 1;
    weights = barrierWeights(cones, known, least * std::sqrt(size));
    assembleSchur(form, weights, relative * std::max(size, relative), relative, system);
    return system.factorise();
}

/// Changes forces by the least until they balance a load. \param load as that of the form \param s is changed
/// \return whether they do, to the tolerance
template<int Rows>
bool balance(const Form<Rows>& form, const ConeWeights<double>& weights, SchurSystem<Rows>& system,
             const Eigen::VectorXd& load, double tolerance, Eigen::VectorXd& s)
{
    constexpr int mostRefinements = 6; // each leaves a part of the last, given by the regularisation
    const double allowed = tolerance * std::max(1e-300, load.lpNorm<Eigen::Infinity>());
    Eigen::VectorXd change(s.size());
    for (int refinement = 0; refinement <= mostRefinements; ++refinement)
    {
        Eigen::VectorXd missing = -load;
        addForces(form, s, missing);
        if (missing.lpNorm<Eigen::Infinity>() <= allowed)
        {
            return true;
        }
        solveWithLimits(form, weights, system, missing);
        applyTransposed(form, missing, change);
        weights.apply(change);
        s -= change;
        if (!s.allFinite())
        {
            return false;
        }
    }
    return false;
}

/// In the units of the program.
template<int Rows, int Forces>
Eigen::VectorXd forcesOf(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                         const Eigen::VectorXd& s)
{
    return solutionOf(program, form, s, Eigen::VectorXd(Eigen::VectorXd::Zero(form.rows())), 0.0)
        .contactForce;
}

} // namespace

template<int Rows, int Forces>
Eigen::VectorXd nearestForces(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& near,
                              double tolerance, SymbolicAnalysis& symbolic)
{
    Form<Rows> form = makeForm(program, symbolic);
    SchurSystem<Rows>& system = schurSystem(form, symbolic);
    Eigen::VectorXd s = conesOf(program, form, near);
    ConeWeights<double> weights;
    return factorise(form, s, weights, system) && balance(form, weights, system, form.load, tolerance, s)
               ? forcesOf(program, form, s)
               : Eigen::VectorXd();
}

template<int Rows, int Forces>
ForceChanges<Rows, Forces>::ForceChanges(ConeProgram<Rows, Forces> ofStructure, const Eigen::VectorXd& near)
    : program(std::move(ofStructure))
{
    program.liveLoad.resize(0);
    program.inertia.clear();
    program.strength.clear();
    program.gap.resize(0);
    form = makeForm(program, symbolic);
    isFactorised = factorise(form, conesOf(program, form, near), weights, schurSystem(form, symbolic));
}

template<int Rows, int Forces>
Eigen::VectorXd ForceChanges<Rows, Forces>::under(const Eigen::VectorXd& load, double tolerance)
{
    Eigen::VectorXd s = Eigen::VectorXd::Zero(form.cones().size());
    return isFactorised
                   && balance(form, weights, schurSystem(form, symbolic), loadOf(form, load), tolerance, s)
               ? forcesOf(program, form, s)
               : Eigen::VectorXd();
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

/// The balance of some of the bodies under the forces of the others, by friction alone.
template<int Rows, int Forces>
ProgramPart<Rows, Forces> partOfBalance(const ConeProgram<Rows, Forces>& whole, const Eigen::VectorXd& forces,
                                        const std::vector<char>& isPart)
{
    ProgramPart<Rows, Forces> part = partUnderForces(whole, forces, isPart);
    part.program.inertia.clear();
    part.program.strength.clear();
    part.program.gap.resize(0);
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
        const ProgramPart<Rows, Forces> part = partOfBalance(program, forces, isPart);
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
            putInto<Forces>(part.points, solution.contactForce, repaired);
            return repaired;
        }
    }
}

template Eigen::VectorXd nearestForces(const PlaneConeProgram&, const Eigen::VectorXd&, double,
                                       SymbolicAnalysis&);
template Eigen::VectorXd nearestForces(const SpaceConeProgram&, const Eigen::VectorXd&, double,
                                       SymbolicAnalysis&);

template class ForceChanges<3, 2>;
template class ForceChanges<6, 3>;

template std::vector<std::size_t> pointsOutside(const PlaneConeProgram&, const Eigen::VectorXd&,
                                                const Eigen::VectorXd&, double);
template std::vector<std::size_t> pointsOutside(const SpaceConeProgram&, const Eigen::VectorXd&,
                                                const Eigen::VectorXd&, double);

template Eigen::VectorXd repairedForces(const PlaneConeProgram&, const Eigen::VectorXd&,
                                        const std::vector<std::size_t>&, double, int&);
template Eigen::VectorXd repairedForces(const SpaceConeProgram&, const Eigen::VectorXd&,
                                        const std::vector<std::size_t>&, double, int&);

} // namespace drystone
