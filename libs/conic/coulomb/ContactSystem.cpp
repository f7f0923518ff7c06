// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Columns divided by the Cholesky root of each body's inertia; S summed for Cholesky's method or for LU.
#include "conic/coulomb/ContactSystem.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace drystone
{

template<int Rows, int Forces>
std::vector<SlidingLaw> slidingLaws(const ConeProgram<Rows, Forces>& program, Sliding sliding)
{
    std::vector<SlidingLaw> laws;
    for (std::size_t point = 0; point < program.friction.size(); ++point)
    {
        const Strength strength = program.strengthOf(point);
        laws.push_back({sliding, program.friction[point], strength.cohesion, strength.tension});
    }
    return laws;
}

template<int Rows, int Forces>
ContactSystem<Rows, Forces>::ContactSystem(const ConeProgram<Rows, Forces>& program, Sliding slidingLaw,
                                           SymbolicAnalysis& symbolic)
    : sliding(slidingLaw)
{
    for (const auto& inertia : program.inertia)
    {
        root.push_back(Block(inertia.llt().matrixL()));
    }
    setColumns(program);

    analyse(program, symbolic);
    position = placesIn(symbolic.order);
    const std::vector<Coupling> couplings = couplingsByPlace(symbolic.touching, position);
    if (sliding == Sliding::associative)
    {
        std::optional<SchurSystem<Rows>>& kept = symbolic.system<Rows>();
        symmetric = kept ? &*kept : &kept.emplace(program.bodies, couplings);
    }
    else
    {
        std::optional<BlockLu<Rows>>& kept = symbolic.unsymmetric<Rows>();
        unsymmetric = kept ? &*kept : &kept.emplace(makeBlockPattern(program.bodies, couplings));
        lower.resize(unsymmetric->pattern().row.size());
        upperTransposed.resize(unsymmetric->pattern().row.size());
    }
    for (const ConeColumns<Rows, Forces>& column : columns)
    {
        int at = -1;
        if (column.first >= 0 && column.second >= 0)
        {
            const int first = position[static_cast<std::size_t>(column.first)];
            const int second = position[static_cast<std::size_t>(column.second)];
            at = symmetric ? symmetric->slot(first, second) : unsymmetric->pattern().slot(first, second);
        }
        slot.push_back(at);
    }
}

template<int Rows, int Forces>
void ContactSystem<Rows, Forces>::setColumns(const ConeProgram<Rows, Forces>& program)
{
    columns = program.contacts;
    const auto scale = [this](int body, Eigen::Matrix<double, Rows, Forces>& part)
    {
        if (body >= 0)
        {
            root[static_cast<std::size_t>(body)].template triangularView<Eigen::Lower>().solveInPlace(part);
        }
    };
    for (ConeColumns<Rows, Forces>& column : columns)
    {
        scale(column.first, column.onFirst);
        scale(column.second, column.onSecond);
    }
}

template<int Rows, int Forces>
Eigen::VectorXd ContactSystem<Rows, Forces>::scaledRows(VectorXd rows) const
{
    for (std::size_t body = 0; body < root.size(); ++body)
    {
        auto part = rows.template segment<Rows>(Rows * static_cast<Eigen::Index>(body));
        root[body].template triangularView<Eigen::Lower>().solveInPlace(part);
    }
    return rows;
}

template<int Rows, int Forces>
Eigen::VectorXd ContactSystem<Rows, Forces>::displacementOf(VectorXd x) const
{
    for (std::size_t body = 0; body < root.size(); ++body)
    {
        auto part = x.template segment<Rows>(Rows * static_cast<Eigen::Index>(body));
        root[body].template triangularView<Eigen::Lower>().transpose().solveInPlace(part);
    }
    return x;
}

template<int Rows, int Forces>
void ContactSystem<Rows, Forces>::addForce(int point, const Eigen::Matrix<double, Forces, 1>& contactForce,
                                           VectorXd& rows) const
{
    drystone::addForce(columns[static_cast<std::size_t>(point)], contactForce, rows);
}

template<int Rows, int Forces>
Eigen::VectorXd ContactSystem<Rows, Forces>::forcesOnBodies(const VectorXd& contactForce) const
{
    VectorXd rows = VectorXd::Zero(Rows * static_cast<Eigen::Index>(root.size()));
    for (int point = 0; point < static_cast<int>(columns.size()); ++point)
    {
        addForce(point, contactForce.template segment<Forces>(Forces * point), rows);
    }
    return rows;
}

template<int Rows, int Forces>
double ContactSystem<Rows, Forces>::normalCompliance(int point) const
{
    const ConeColumns<Rows, Forces>& column = columns[static_cast<std::size_t>(point)];
    return (column.first >= 0 ? column.onFirst.col(0).squaredNorm() : 0)
           + (column.second >= 0 ? column.onSecond.col(0).squaredNorm() : 0);
}

template<int Rows, int Forces>
Eigen::Matrix<double, Forces, 1> ContactSystem<Rows, Forces>::closing(int point, const VectorXd& x) const
{
    return closingOf(columns[static_cast<std::size_t>(point)], x);
}

template<int Rows, int Forces>
Eigen::VectorXd ContactSystem<Rows, Forces>::closings(const VectorXd& x) const
{
    VectorXd result(Forces * static_cast<Eigen::Index>(columns.size()));
    for (int point = 0; point < static_cast<int>(columns.size()); ++point)
    {
        result.template segment<Forces>(Forces * point) = closing(point, x);
    }
    return result;
}

template<int Rows, int Forces>
typename ContactSystem<Rows, Forces>::Block& ContactSystem<Rows, Forces>::diagonal(int body)
{
    return symmetric ? symmetric->diagonal(placeOf(body))
                     : lower[static_cast<std::size_t>(
                         unsymmetric->pattern().columnStart[static_cast<std::size_t>(placeOf(body))])];
}

template<int Rows, int Forces>
void ContactSystem<Rows, Forces>::setToIdentity()
{
    if (symmetric)
    {
        symmetric->setZero();
    }
    std::fill(lower.begin(), lower.end(), Block::Zero());
    std::fill(upperTransposed.begin(), upperTransposed.end(), Block::Zero());
    for (int body = 0; body < static_cast<int>(root.size()); ++body)
    {
        diagonal(body).setIdentity();
    }
}

/// The blocks of both bodies of a point off the diagonal. \param first, second: A D of each
template<int Rows, int Forces>
void ContactSystem<Rows, Forces>::addCoupling(std::size_t point, const PieceForces& first,
                                              const PieceForces& second)
{
    const ConeColumns<Rows, Forces>& column = columns[point];
    const bool isFirstLater = placeOf(column.first) > placeOf(column.second);
    Block& below =
        symmetric ? symmetric->coupling(slot[point]) : lower[static_cast<std::size_t>(slot[point])];
    if (isFirstLater)
    {
        below += first * column.onSecond.transpose();
    }
    else
    {
        below += second * column.onFirst.transpose();
    }
    if (unsymmetric)
    {
        Block& above = upperTransposed[static_cast<std::size_t>(slot[point])];
        if (isFirstLater)
        {
            above += column.onFirst * second.transpose();
        }
        else
        {
            above += column.onSecond * first.transpose();
        }
    }
}

template<int Rows, int Forces>
bool ContactSystem<Rows, Forces>::factorise(const VectorXd& rho,
                                            const std::vector<PointForce<Forces>>& pieces)
{
    setToIdentity();
    for (std::size_t point = 0; point < columns.size(); ++point)
    {
        if (pieces[point].derivative.isZero(0))
        {
            continue;
        }
        const Eigen::Matrix<double, Forces, Forces> change =
            rho[static_cast<Eigen::Index>(point)] * pieces[point].derivative;
        const ConeColumns<Rows, Forces>& column = columns[point];
        const PieceForces first = column.onFirst * change;
        const PieceForces second = column.onSecond * change;
        if (column.first >= 0)
        {
            diagonal(column.first) += first * column.onFirst.transpose();
        }
        if (column.second >= 0)
        {
            diagonal(column.second) += second * column.onSecond.transpose();
        }
        if (column.first >= 0 && column.second >= 0)
        {
            addCoupling(point, first, second);
        }
    }
    return symmetric ? symmetric->factorise() : unsymmetric->factorise(lower, upperTransposed);
}

template<int Rows, int Forces>
Eigen::VectorXd ContactSystem<Rows, Forces>::solve(const VectorXd& rows)
{
    ordered.resize(rows.size());
    for (std::size_t body = 0; body < root.size(); ++body)
    {
        ordered.template segment<Rows>(Rows * position[body]) =
            rows.template segment<Rows>(Rows * static_cast<Eigen::Index>(body));
    }
    if (symmetric)
    {
        symmetric->solve(ordered);
    }
    else
    {
        unsymmetric->solve(ordered);
    }
    VectorXd result(rows.size());
    for (std::size_t body = 0; body < root.size(); ++body)
    {
        result.template segment<Rows>(Rows * static_cast<Eigen::Index>(body)) =
            ordered.template segment<Rows>(Rows * position[body]);
    }
    return result;
}

template std::vector<SlidingLaw> slidingLaws(const PlaneConeProgram& program, Sliding sliding);
template std::vector<SlidingLaw> slidingLaws(const SpaceConeProgram& program, Sliding sliding);
template class ContactSystem<3, 2>;
template class ContactSystem<6, 3>;

} // namespace drystone
