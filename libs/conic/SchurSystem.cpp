// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/SchurSystem.h"

#include "conic/BlockCholesky.h"

#include <cholmod.h>
#include <dlfcn.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace drystone
{
namespace
{

/// Multiplications of a factorisation from which CHOLMOD's supernodal code is used. Measured on square walls,
/// one core, our own block factor against CHOLMOD's: 1.4e7 multiplications (40 units) 3.3 and 5.3 ms, 1.2e8
/// (80 units) 32 and 32 ms, 4e8 (120 units) 108 and 92 ms, 1e9 (160 units) 285 and 229 ms, 8e9 (320
/// units) 2.1 and 1.1 s. Solves take the same time with both, but two right sides at once are quicker with
/// our own.
constexpr double supernodalOperations = 7e8;

/// Bodies from which the order is by nested dissection instead of minimum degree. Measured likewise: 3.7
/// against 4.3 ms at 1,620 blocks and 37 against 39 ms at 6,440 are within the noise of F, the whole solution
/// at 6,440 takes 3.3 s with minimum degree and 2.9 s with dissection.
constexpr int dissectionBodies = 3000;

/// CHOLMOD 3 asks OpenMP for four threads whatever the machine, and on one with two cores, or a busy one,
/// spends most of its time in their barriers (N = 160: 48 s of 190 in the kernel); OpenBLAS does likewise
/// with the small blocks of these factors. So both work on the thread they are called from: runs in parallel
/// are the callers' affair, and results do not depend on the number of threads. The libraries are asked by
/// name, since neither need be the one that CHOLMOD has been linked with.
void useOneThread()
{
    static const bool done = []
    {
        if (void* levels = dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"))
        {
            reinterpret_cast<void (*)(int)>(levels)(0);
        }
        if (void* threads = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
        {
            reinterpret_cast<void (*)(int)>(threads)(1);
        }
        return true;
    }();
    static_cast<void>(done);
}

/// A CHOLMOD workspace that cleans up after itself.
struct Workspace
{
    cholmod_common common;
    Workspace()
    {
        useOneThread();
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

template<int Rows>
struct SchurSystem<Rows>::Factor
{
    std::optional<BlockCholesky<Rows>> blocks;

    // The supernodal factor, when that is the faster one.
    std::optional<Workspace> workspace;
    cholmod_sparse* matrix = nullptr;
    cholmod_factor* factor = nullptr;
    cholmod_dense* solution = nullptr;
    cholmod_dense* work[2] = {nullptr, nullptr};

    ~Factor()
    {
        if (workspace)
        {
            cholmod_free_sparse(&matrix, &workspace->common);
            cholmod_free_factor(&factor, &workspace->common);
            cholmod_free_dense(&solution, &workspace->common);
            cholmod_free_dense(&work[0], &workspace->common);
            cholmod_free_dense(&work[1], &workspace->common);
        }
    }
};

template<int Rows>
SchurSystem<Rows>::SchurSystem(int bodies, const std::vector<Coupling>& couplings)
    : bodies_(bodies), pattern_(makeBlockPattern(bodies, couplings)), factor_(std::make_unique<Factor>())
{
    values_.assign(pattern_.row.size(), Block::Zero());

    BlockCholesky<Rows> symbolic(pattern_);
    operations_ = symbolic.operations();
    if (operations_ < supernodalOperations)
    {
        symbolic.allocate();
        factor_->blocks.emplace(std::move(symbolic));
        return;
    }

    // Scalar lower triangle of the same matrix for CHOLMOD, already in elimination order.
    cholmod_common& common = factor_->workspace.emplace().common;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    const std::size_t size = static_cast<std::size_t>(Rows) * bodies;
    const std::size_t entries = Rows * Rows * (pattern_.row.size() - bodies)
                                + static_cast<std::size_t>(Rows * (Rows + 1) / 2) * bodies;
    factor_->matrix = cholmod_allocate_sparse(size, size, entries, 1, 1, -1, CHOLMOD_REAL, &common);
    auto* start = static_cast<int*>(factor_->matrix->p);
    auto* scalarRow = static_cast<int*>(factor_->matrix->i);
    int position = 0;
    for (int body = 0; body < bodies; ++body)
    {
        for (int column = 0; column < Rows; ++column)
        {
            start[Rows * body + column] = position;
            for (int entry = pattern_.columnStart[body]; entry < pattern_.columnStart[body + 1]; ++entry)
            {
                for (int line = entry == pattern_.columnStart[body] ? column : 0; line < Rows; ++line)
                {
                    scalarRow[position++] = Rows * pattern_.row[entry] + line;
                }
            }
        }
    }
    start[size] = position;
    factor_->factor = cholmod_analyze(factor_->matrix, &common);
    if (!factor_->factor)
    {
        throw std::bad_alloc();
    }
}

template<int Rows>
SchurSystem<Rows>::~SchurSystem() = default;
template<int Rows>
SchurSystem<Rows>::SchurSystem(SchurSystem&&) noexcept = default;
template<int Rows>
SchurSystem<Rows>& SchurSystem<Rows>::operator=(SchurSystem&&) noexcept = default;

template<int Rows>
bool SchurSystem<Rows>::supernodal() const
{
    return !factor_->blocks.has_value();
}

template<int Rows>
void SchurSystem<Rows>::setZero()
{
    for (Block& block : values_)
    {
        block.setZero();
    }
}

template<int Rows>
bool SchurSystem<Rows>::factorise()
{
    if (factor_->blocks)
    {
        return factor_->blocks->factorise(pattern_, values_.data());
    }
    cholmod_common& common = factor_->workspace->common;
    auto* value = static_cast<double*>(factor_->matrix->x);
    std::size_t position = 0;
    for (int body = 0; body < bodies_; ++body)
    {
        for (int column = 0; column < Rows; ++column)
        {
            for (int entry = pattern_.columnStart[body]; entry < pattern_.columnStart[body + 1]; ++entry)
            {
                for (int line = entry == pattern_.columnStart[body] ? column : 0; line < Rows; ++line)
                {
                    value[position++] = values_[entry](line, column);
                }
            }
        }
    }
    cholmod_factorize(factor_->matrix, factor_->factor, &common);
    if (common.status == CHOLMOD_OUT_OF_MEMORY)
    {
        throw std::bad_alloc();
    }
    return common.status == CHOLMOD_OK && factor_->factor->minor == factor_->factor->n;
}

template<int Rows>
void SchurSystem<Rows>::solve(Eigen::Ref<Eigen::VectorXd> x)
{
    if (factor_->blocks)
    {
        factor_->blocks->solve(x);
        return;
    }
    cholmod_common& common = factor_->workspace->common;
    cholmod_dense right;
    right.nrow = static_cast<std::size_t>(x.size());
    right.ncol = 1;
    right.nzmax = right.nrow;
    right.d = right.nrow;
    right.x = x.data();
    right.z = nullptr;
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor_->factor, &right, nullptr, &factor_->solution, nullptr,
                   &factor_->work[0], &factor_->work[1], &common);
    const auto* value = static_cast<const double*>(factor_->solution->x);
    std::copy(value, value + x.size(), x.data());
}

template<int Rows>
void SchurSystem<Rows>::solve(Eigen::Ref<Eigen::VectorXd> one, Eigen::Ref<Eigen::VectorXd> other)
{
    if (factor_->blocks)
    {
        factor_->blocks->solve(one, other);
        return;
    }
    solve(one);
    solve(other);
}

template class SchurSystem<3>;
template class SchurSystem<6>;

} // namespace drystone
