// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// By fronts where a factorisation takes many multiplications; by blocks below that, and in DoubleDouble.
#include "linear/SchurSystem.h"

#include "core/Threads.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// Multiplications of a factorisation from which it is done by fronts: with six to ten solves for each factor
/// the time of both is about the same there.
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
