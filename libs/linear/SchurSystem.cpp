// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "linear/SchurSystem.h"

#include <cholmod.h>

#include <algorithm>
#include <numeric>

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

/// Bodies from which the order is by nested dissection instead of minimum degree. Measured likewise: 3.7
/// against 4.3 ms at 1,620 blocks and 37 against 39 ms at 6,440 are within the noise of F, the whole solution
/// at 6,440 takes 3.3 s with minimum degree and 2.9 s with dissection.
constexpr int dissectionBodies = 3000;

/// A CHOLMOD workspace that cleans up after itself.
struct Workspace
{
    cholmod_common common;
    Workspace()
    {
        cholmod_start(&common);
        common.print = 0; // a matrix that is not positive definite is an answer here, not a message
        common.error_handler = nullptr;
    }
    ~Workspace() { cholmod_finish(&common); }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;
};

} // namespace

std::vector<int> eliminationOrder(int bodies, const std::vector<Coupling>& couplings)
{
    std::vector<int> order(bodies);
    std::iota(order.begin(), order.end(), 0);
    if (bodies < 2)
    {
        return order;
    }
    Workspace workspace;
    cholmod_common& common = workspace.common;
    // Upper triangle of the graph of bodies, one entry a pair.
    std::vector<Coupling> pairs;
    pairs.reserve(couplings.size() + bodies);
    for (const Coupling& pair : couplings)
    {
        pairs.push_back({std::max(pair[0], pair[1]), std::min(pair[0], pair[1])});
    }
    for (int body = 0; body < bodies; ++body)
    {
        pairs.push_back({body, body});
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    cholmod_sparse* graph =
        cholmod_allocate_sparse(bodies, bodies, pairs.size(), 1, 1, 1, CHOLMOD_PATTERN, &common);
    auto* start = static_cast<int*>(graph->p);
    auto* row = static_cast<int*>(graph->i);
    std::fill(start, start + bodies + 1, 0);
    for (std::size_t entry = 0; entry < pairs.size(); ++entry)
    {
        row[entry] = pairs[entry][1];
        ++start[pairs[entry][0] + 1];
    }
    std::partial_sum(start, start + bodies + 1, start);

    common.nmethods = 1;
    common.method[0].ordering = bodies < dissectionBodies ? CHOLMOD_AMD : CHOLMOD_METIS;
    common.postorder = 1;
    common.supernodal = CHOLMOD_SIMPLICIAL;
    cholmod_factor* factor = cholmod_analyze(graph, &common);
    if (factor)
    {
        const auto* permutation = static_cast<const int*>(factor->Perm);
        std::copy(permutation, permutation + bodies, order.begin());
    }
    cholmod_free_factor(&factor, &common);
    cholmod_free_sparse(&graph, &common);
    return order;
}

template<int Rows, class Scalar>
SchurSystem<Rows, Scalar>::SchurSystem(int bodies, const std::vector<Coupling>& couplings)
    : bodies_(bodies),
      pattern_(makeBlockPattern(bodies, couplings)),
      values_(pattern_.row.size(), Block::Zero())
{
    FactorPattern factor = makeFactorPattern(pattern_);
    operations_ = factor.operations(Rows);
    const double numbers = static_cast<double>(Rows * Rows * factor.factor.row.size());
    factorisationOverSolve_ = operations_ / (2 * numbers);
    if (!std::is_same_v<Scalar, double> || operations_ < frontalOperations)
    {
        small_.emplace(std::move(factor));
    }
    else
    {
        large_.emplace(pattern_, factor.factor);
    }
}

template<int Rows, class Scalar>
void SchurSystem<Rows, Scalar>::setZero()
{
    for (Block& block : values_)
    {
        block.setZero();
    }
}

template<int Rows, class Scalar>
bool SchurSystem<Rows, Scalar>::factorise()
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        if (large_)
        {
            return large_->factorise(pattern_, values_.data());
        }
    }
    return small_->factorise(pattern_, values_.data());
}

template<int Rows, class Scalar>
void SchurSystem<Rows, Scalar>::solve(Eigen::Ref<Vector> x)
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        if (large_)
        {
            return large_->solve(x);
        }
    }
    small_->solve(x);
}

template<int Rows, class Scalar>
void SchurSystem<Rows, Scalar>::solve(Eigen::Ref<Vector> one, Eigen::Ref<Vector> other)
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        if (large_)
        {
            return large_->solve(one, other);
        }
    }
    small_->solve(one, other);
}

template<int Rows, class Scalar>
void SchurSystem<Rows, Scalar>::solveRoughly(Eigen::Ref<Vector> x)
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        if (large_)
        {
            return large_->solveRoughly(x);
        }
    }
    small_->solve(x);
}

template class SchurSystem<3>;
template class SchurSystem<6>;
template class SchurSystem<3, DoubleDouble>;
template class SchurSystem<6, DoubleDouble>;

} // namespace drystone
