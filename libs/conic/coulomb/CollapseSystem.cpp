// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/coulomb/CollapseSystem.h"

#include "linear/SchurSystem.h"

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// On the diagonal of K, where stiffnesses are of order one: K of a mechanism is singular.
constexpr double regularisation = 1e-13;

/// The matrix is summed up anew after so many changes for each point, so that rounding does not add up.
constexpr int changesToSum = 1;

} // namespace

template<int Rows, int Forces>
CollapseSystem<Rows, Forces>::CollapseSystem(const ConeProgram<Rows, Forces>& program)
    : lever(meanLeverArm(program)), bodies_(program.bodies), columns_(program.contacts)
{
    load = scaledRows(program.load);
    liveLoad = scaledRows(program.liveLoad);
    live = liveLoad.lpNorm<Eigen::Infinity>();
    force = load.lpNorm<Eigen::Infinity>();
    force = force > 0 ? force : live;
    load /= force;
    liveLoad /= live;

    std::vector<Coupling> couplings;
    for (ConeColumns<Rows, Forces>& column : columns_)
    {
        column.onFirst.template bottomRows<Rows - Forces>() /= lever;
        column.onSecond.template bottomRows<Rows - Forces>() /= lever;
        if (column.first >= 0 && column.second >= 0)
        {
            couplings.push_back({column.first, column.second});
        }
    }
    const std::vector<int> order = eliminationOrder(bodies_, couplings);
    position_.resize(order.size());
    for (int place = 0; place < bodies_; ++place)
    {
        position_[order[place]] = place;
    }
    for (Coupling& pair : couplings)
    {
        pair = {position_[pair[0]], position_[pair[1]]};
    }
    pattern_ = makeBlockPattern(bodies_, couplings);
    for (const ConeColumns<Rows, Forces>& column : columns_)
    {
        slot_.push_back(column.first >= 0 && column.second >= 0
                            ? pattern_.slot(position_[column.first], position_[column.second])
                            : -1);
    }
    derivative_.assign(columns_.size(), Derivative::Zero());
    lower_.resize(pattern_.row.size());
    upperTransposed_.resize(pattern_.row.size());
    factor_.emplace(pattern_);
    changes_ = changesToSum * static_cast<int>(columns_.size()) + 1;
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
    for (const ConeColumns<Rows, Forces>& column : columns_)
    {
        const Eigen::Matrix<double, Forces, 1> point = forces.template segment<Forces>(row);
        if (column.first >= 0)
        {
            rows.template segment<Rows>(Rows * column.first) += column.onFirst.lazyProduct(point);
        }
        if (column.second >= 0)
        {
            rows.template segment<Rows>(Rows * column.second) += column.onSecond.lazyProduct(point);
        }
        row += Forces;
    }
    return rows;
}

template<int Rows, int Forces>
VectorXd CollapseSystem<Rows, Forces>::columnsTransposedTimes(const VectorXd& displacement) const
{
    VectorXd closing(Forces * static_cast<Eigen::Index>(columns_.size()));
    Eigen::Index row = 0;
    for (const ConeColumns<Rows, Forces>& column : columns_)
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
    for (const Derivative& derivative : derivative_)
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
    const ConeColumns<Rows, Forces>& column = columns_[static_cast<std::size_t>(point)];
    const auto diagonal = [&](int body)
    { return static_cast<std::size_t>(pattern_.columnStart[position_[body]]); };
    const Eigen::Matrix<double, Rows, Forces> first = column.onFirst.lazyProduct(derivative);
    const Eigen::Matrix<double, Rows, Forces> second = column.onSecond.lazyProduct(derivative);
    if (column.first >= 0)
    {
        lower_[diagonal(column.first)].noalias() += first.lazyProduct(column.onFirst.transpose());
    }
    if (column.second >= 0)
    {
        lower_[diagonal(column.second)].noalias() += second.lazyProduct(column.onSecond.transpose());
    }
    if (slot_[static_cast<std::size_t>(point)] >= 0)
    {
        const auto slot = static_cast<std::size_t>(slot_[static_cast<std::size_t>(point)]);
        if (position_[column.first] > position_[column.second])
        {
            lower_[slot].noalias() += first.lazyProduct(column.onSecond.transpose());
            upperTransposed_[slot].noalias() += column.onFirst.lazyProduct(second.transpose());
        }
        else
        {
            lower_[slot].noalias() += second.lazyProduct(column.onFirst.transpose());
            upperTransposed_[slot].noalias() += column.onSecond.lazyProduct(first.transpose());
        }
    }
}

template<int Rows, int Forces>
void CollapseSystem<Rows, Forces>::change(int point, const Derivative& derivative)
{
    Derivative& old = derivative_[static_cast<std::size_t>(point)];
    if (++changes_ <= changesToSum * static_cast<int>(columns_.size()))
    {
        add(point, derivative - old);
        const ConeColumns<Rows, Forces>& column = columns_[static_cast<std::size_t>(point)];
        for (const int body : {column.first, column.second})
        {
            if (body >= 0)
            {
                changed_.push_back(position_[body]);
            }
        }
    }
    old = derivative;
}

template<int Rows, int Forces>
bool CollapseSystem<Rows, Forces>::factorise()
{
    ++factorisations;
    const bool isSummedUp = changes_ <= changesToSum * static_cast<int>(columns_.size());
    if (!isSummedUp)
    {
        std::fill(lower_.begin(), lower_.end(), Body::Zero());
        std::fill(upperTransposed_.begin(), upperTransposed_.end(), Body::Zero());
        for (int body = 0; body < bodies_; ++body)
        {
            lower_[static_cast<std::size_t>(pattern_.columnStart[body])] = regularisation * Body::Identity();
        }
        for (std::size_t point = 0; point < derivative_.size(); ++point)
        {
            if (!derivative_[point].isZero(0))
            {
                add(static_cast<int>(point), derivative_[point]);
            }
        }
        changes_ = 0;
    }
    isFactorised_ = isSummedUp && isFactorised_ ? factor_->refactorise(lower_, upperTransposed_, changed_)
                                                : factor_->factorise(lower_, upperTransposed_);
    changed_.clear();
    return isFactorised_;
}

template<int Rows, int Forces>
VectorXd CollapseSystem<Rows, Forces>::solve(const VectorXd& rows)
{
    ++solves;
    ordered_.resize(rows.size());
    for (int body = 0; body < bodies_; ++body)
    {
        ordered_.template segment<Rows>(Rows * position_[body]) = rows.template segment<Rows>(Rows * body);
    }
    factor_->solve(ordered_);
    VectorXd result(rows.size());
    for (int body = 0; body < bodies_; ++body)
    {
        result.template segment<Rows>(Rows * body) = ordered_.template segment<Rows>(Rows * position_[body]);
    }
    return result;
}

template class CollapseSystem<3, 2>;
template class CollapseSystem<6, 3>;

} // namespace drystone
