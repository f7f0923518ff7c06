// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// K is changed point by point, factorised anew in the columns that depend on it, at times summed afresh.
#include "conic/coulomb/CollapseSystem.h"

#include "linear/SchurSystem.h"

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// On the diagonal of K, where stiffnesses are of order one: K of a mechanism is singular.
constexpr double diagonalTerm = 1e-13;

/// The matrix is summed up anew after so many changes for each point, so that rounding does not add up.
constexpr int changesToSum = 1;

} // namespace

template<int Rows, int Forces>
CollapseSystem<Rows, Forces>::CollapseSystem(const ConeProgram<Rows, Forces>& program)
    : lever(meanLeverArm(program)), bodyCount(program.bodies), pointColumns(program.contacts)
{
    load = scaledRows(program.load);
    liveLoad = scaledRows(program.liveLoad);
    live = liveLoad.lpNorm<Eigen::Infinity>();
    force = load.lpNorm<Eigen::Infinity>();
    force = force > 0 ? force : live;
    load /= force;
    liveLoad /= live;

    std::vector<Coupling> couplings;
    for (ConeColumns<Rows, Forces>& column : pointColumns)
    {
        column.onFirst.template bottomRows<Rows - Forces>() /= lever;
        column.onSecond.template bottomRows<Rows - Forces>() /= lever;
        if (column.first >= 0 && column.second >= 0)
        {
            couplings.push_back({column.first, column.second});
        }
    }
    positions = placesIn(eliminationOrder(bodyCount, couplings));
    patternOfK = makeBlockPattern(bodyCount, couplingsByPlace(couplings, positions));
    for (const ConeColumns<Rows, Forces>& column : pointColumns)
    {
        slots.push_back(column.first >= 0 && column.second >= 0
                            ? patternOfK.slot(positions[column.first], positions[column.second])
                            : -1);
    }
    derivatives.assign(pointColumns.size(), Derivative::Zero());
    lowerOfK.resize(patternOfK.row.size());
    upperOfK.resize(patternOfK.row.size());
    factorOfK.emplace(patternOfK);
    changeCount = changesToSum * static_cast<int>(pointColumns.size()) + 1;
}

template<int Rows, int Forces>
VectorXd CollapseSystem<Rows, Forces>::scaledRows(VectorXd rows) const
{
    for (Eigen::Index body = 0; body < rows.size() / Rows; ++body)
    {
        rows.template segment<Rows - Forces>(Rows * body + Forces) /= lever;
    }
    return rows;
}

template<int Rows, int Forces>
VectorXd CollapseSystem<Rows, Forces>::columnsTimes(const VectorXd& forces) const
{
    VectorXd rows = VectorXd::Zero(load.size());
    Eigen::Index row = 0;
    for (const ConeColumns<Rows, Forces>& column : pointColumns)
    {
        addForce<Rows, Forces>(column, forces.template segment<Forces>(row), rows);
        row += Forces;
    }
    return rows;
}

template<int Rows, int Forces>
VectorXd CollapseSystem<Rows, Forces>::columnsTransposedTimes(const VectorXd& displacement) const
{
    VectorXd closing(Forces * static_cast<Eigen::Index>(pointColumns.size()));
    Eigen::Index row = 0;
    for (const ConeColumns<Rows, Forces>& column : pointColumns)
    {
        Eigen::Matrix<double, Forces, 1> point = Eigen::Matrix<double, Forces, 1>::Zero();
        for (int component = 0; component < Forces; ++component)
        {
            double sum = 0;
            if (column.first >= 0)
            {
                const double* body = displacement.data() + Rows * column.first;
                for (int i = 0; i < Rows; ++i)
                {
                    sum += column.onFirst(i, component) * body[i];
                }
            }
            if (column.second >= 0)
            {
                const double* body = displacement.data() + Rows * column.second;
                for (int i = 0; i < Rows; ++i)
                {
                    sum += column.onSecond(i, component) * body[i];
                }
            }
            point[component] = sum;
        }
        closing.template segment<Forces>(row) = point;
        row += Forces;
    }
    return closing;
}

template<int Rows, int Forces>
VectorXd CollapseSystem<Rows, Forces>::forcesOf(VectorXd closing) const
{
    Eigen::Index row = 0;
    for (const Derivative& derivative : derivatives)
    {
        closing.template segment<Forces>(row) = (derivative * closing.template segment<Forces>(row)).eval();
        row += Forces;
    }
    return closing;
}

/// Adds to the matrix what a point contributes with so much stiffness.
template<int Rows, int Forces>
void CollapseSystem<Rows, Forces>::add(int point, const Derivative& derivative)
{
    const ConeColumns<Rows, Forces>& column = pointColumns[static_cast<std::size_t>(point)];
    const auto diagonal = [&](int body)
    { return static_cast<std::size_t>(patternOfK.columnStart[positions[body]]); };
    const Eigen::Matrix<double, Rows, Forces> first = column.onFirst.lazyProduct(derivative);
    const Eigen::Matrix<double, Rows, Forces> second = column.onSecond.lazyProduct(derivative);
    if (column.first >= 0)
    {
        lowerOfK[diagonal(column.first)].noalias() += first.lazyProduct(column.onFirst.transpose());
    }
    if (column.second >= 0)
    {
        lowerOfK[diagonal(column.second)].noalias() += second.lazyProduct(column.onSecond.transpose());
    }
    if (slots[static_cast<std::size_t>(point)] >= 0)
    {
        const auto slot = static_cast<std::size_t>(slots[static_cast<std::size_t>(point)]);
        if (positions[column.first] > positions[column.second])
        {
            lowerOfK[slot].noalias() += first.lazyProduct(column.onSecond.transpose());
            upperOfK[slot].noalias() += column.onFirst.lazyProduct(second.transpose());
        }
        else
        {
            lowerOfK[slot].noalias() += second.lazyProduct(column.onFirst.transpose());
            upperOfK[slot].noalias() += column.onSecond.lazyProduct(first.transpose());
        }
    }
}

template<int Rows, int Forces>
void CollapseSystem<Rows, Forces>::change(int point, const Derivative& derivative)
{
    Derivative& old = derivatives[static_cast<std::size_t>(point)];
    if (++changeCount <= changesToSum * static_cast<int>(pointColumns.size()))
    {
        add(point, derivative - old);
        const ConeColumns<Rows, Forces>& column = pointColumns[static_cast<std::size_t>(point)];
        for (const int body : {column.first, column.second})
        {
            if (body >= 0)
            {
                changedColumns.push_back(positions[body]);
            }
        }
    }
    old = derivative;
}

template<int Rows, int Forces>
bool CollapseSystem<Rows, Forces>::factorise()
{
    ++factorisations;
    const bool isSummedUp = changeCount <= changesToSum * static_cast<int>(pointColumns.size());
    if (!isSummedUp)
    {
        std::fill(lowerOfK.begin(), lowerOfK.end(), Body::Zero());
        std::fill(upperOfK.begin(), upperOfK.end(), Body::Zero());
        for (int body = 0; body < bodyCount; ++body)
        {
            lowerOfK[static_cast<std::size_t>(patternOfK.columnStart[body])] =
                diagonalTerm * Body::Identity();
        }
        for (std::size_t point = 0; point < derivatives.size(); ++point)
        {
            if (!derivatives[point].isZero(0))
            {
                add(static_cast<int>(point), derivatives[point]);
            }
        }
        changeCount = 0;
    }
    isUpToDate = isSummedUp && isUpToDate ? factorOfK->refactorise(lowerOfK, upperOfK, changedColumns)
                                          : factorOfK->factorise(lowerOfK, upperOfK);
    changedColumns.clear();
    return isUpToDate;
}

template<int Rows, int Forces>
VectorXd CollapseSystem<Rows, Forces>::solve(const VectorXd& rows)
{
    ++solves;
    orderedRows.resize(rows.size());
    for (int body = 0; body < bodyCount; ++body)
    {
        orderedRows.template segment<Rows>(Rows * positions[body]) = rows.template segment<Rows>(Rows * body);
    }
    factorOfK->solve(orderedRows);
    VectorXd result(rows.size());
    for (int body = 0; body < bodyCount; ++body)
    {
        result.template segment<Rows>(Rows * body) =
            orderedRows.template segment<Rows>(Rows * positions[body]);
    }
    return result;
}

template class CollapseSystem<3, 2>;
template class CollapseSystem<6, 3>;

} // namespace drystone
