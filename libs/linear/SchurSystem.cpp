// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// By fronts where a factorisation takes many multiplications; by blocks below that, and in DoubleDouble.
#include "linear/SchurSystem.h"

#include "core/Threads.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// Multiplications of a factorisation from which it is done by fronts. Measured on walls, one core; a
/// factorisation and a solve, by blocks, by fronts and by CHOLMOD 3 (simplicial first, then supernodal, on
/// OpenBLAS) [ms]:
///
///     blocks  multiplications   by blocks        by fronts       CHOLMOD
///        146       8e4          0.037 0.005      0.030 0.009     0.14 0.010
///        410       1.3e6        0.31  0.03       0.27  0.03      1.06 0.07
///      1,620       1.4e7        3.0   0.23       2.2   0.19      5.9  0.4
///      6,440       1.2e8        25    2.5        16    2.4       30   3.4
///     25,680       1e9          285   31         100   13        180  20
///    102,560       8e9          2,100 -          730   70        1,000 100
///
/// A solution takes six to ten solves with each factor.
constexpr double frontalOperations = 5e5;

} // namespace

template<int Rows, class Scalar>
SchurSystem<Rows, Scalar>::SchurSystem(int bodies, const std::vector<Coupling>& couplings)
    : bodyCount(bodies),
      pattern(makeBlockPattern(bodies, couplings)),
      values(pattern.row.size(), Block::Zero())
{
    FactorPattern factor = makeFactorPattern(pattern);
    operationCount = factor.operations(Rows);
    const double numbers = static_cast<double>(Rows * Rows * factor.factor.row.size());
    costOverSolve = operationCount / (2 * numbers);
    if (!std::is_same_v<Scalar, double> || operationCount < frontalOperations)
    {
        small.emplace(std::move(factor));
    }
    else
    {
        large.emplace(pattern, factor.factor);
    }
}

template<int Rows, class Scalar>
void SchurSystem<Rows, Scalar>::setZero()
{
    forParts(static_cast<long>(values.size()), [this](long begin, long end)
             { std::fill(values.begin() + begin, values.begin() + end, Block::Zero()); });
}

template<int Rows, class Scalar>
bool SchurSystem<Rows, Scalar>::factorise()
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        if (large)
        {
            return large->factorise(pattern, values.data());
        }
    }
    return small->factorise(pattern, values.data());
}

template<int Rows, class Scalar>
void SchurSystem<Rows, Scalar>::solve(Eigen::Ref<Vector> x)
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        if (large)
        {
            return large->solve(x);
        }
    }
    small->solve(x);
}

template<int Rows, class Scalar>
void SchurSystem<Rows, Scalar>::solve(Eigen::Ref<Vector> one, Eigen::Ref<Vector> other)
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        if (large)
        {
            return large->solve(one, other);
        }
    }
    small->solve(one, other);
}

template<int Rows, class Scalar>
void SchurSystem<Rows, Scalar>::solveRoughly(Eigen::Ref<Vector> x)
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        if (large)
        {
            return large->solveRoughly(x);
        }
    }
    small->solve(x);
}

template class SchurSystem<3>;
template class SchurSystem<6>;
template class SchurSystem<3, DoubleDouble>;
template class SchurSystem<6, DoubleDouble>;

} // namespace drystone
