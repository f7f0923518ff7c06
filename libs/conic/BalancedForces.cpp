// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The nearest forces that balance a load, in the metric of the barrier.
#include "conic/BalancedForces.h"

#include "conic/form/FormOperators.h"
#include "conic/form/FormSchur.h"

namespace drystone
{
namespace
{

/// s^2 of rays, P(s) of round cones, whose eigenvalues are those of s squared along its frame and their
/// product across it.
ConeWeights<double> barrierWeights(const ConeRanges& cones, const Eigen::VectorXd& s)
{
    ConeWeights<double> weights;
    weights.rays = s.head(cones.rays).cwiseAbs2();
    weights.rounds.resize(static_cast<std::size_t>(cones.rounds));
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const Eigen::Vector3d x = s.segment<3>(cones.at(round));
        const double radius = x.tail<2>().norm();
        const double larger = x[0] + radius;
        const double smaller = std::max(0.0, x[0] - radius);
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
    Form<Rows> form = makeForm(program, symbolic);
    const ConeRanges cones = form.cones();
    const Eigen::VectorXd known = conesOf(program, form, near);
    const ConeWeights<double> weights = barrierWeights(cones, known);
    SchurSystem<Rows>& system = schurSystem(form, symbolic);
    const double size = cones.degree() > 0 ? known.squaredNorm() / static_cast<double>(cones.degree()) : 1;
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

template Eigen::VectorXd nearestForces(const PlaneConeProgram&, const Eigen::VectorXd&, double,
                                       SymbolicAnalysis&);
template Eigen::VectorXd nearestForces(const SpaceConeProgram&, const Eigen::VectorXd&, double,
                                       SymbolicAnalysis&);

template std::vector<std::size_t> pointsOutside(const PlaneConeProgram&, const Eigen::VectorXd&,
                                                const Eigen::VectorXd&, double);
template std::vector<std::size_t> pointsOutside(const SpaceConeProgram&, const Eigen::VectorXd&,
                                                const Eigen::VectorXd&, double);

} // namespace drystone
