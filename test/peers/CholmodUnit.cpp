// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Measures F with CHOLMOD, on one thread.
#include "CholmodUnit.h"

#include "conic/form/FormSchur.h"
#include "core/Log.h"

#include <cholmod.h>
#include <dlfcn.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace drystone
{
namespace
{

/// What CHOLMOD needs, on one thread.
class Cholmod
{
public:
    Cholmod(const BlockPattern& pattern) : size(3 * static_cast<std::size_t>(pattern.columns()))
    {
        if (void* threads = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
        {
            reinterpret_cast<void (*)(int)>(threads)(1);
        }
        if (void* levels = dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"))
        {
            reinterpret_cast<void (*)(int)>(levels)(0);
        }
        cholmod_start(&common);
        constexpr int bodiesForDissection = 3000;
        common.nmethods = 1;
        common.method[0].ordering = pattern.columns() < bodiesForDissection ? CHOLMOD_AMD : CHOLMOD_METIS;
        common.supernodal = CHOLMOD_AUTO;
        const std::size_t blocks = pattern.row.size() - pattern.columns();
        matrix = cholmod_allocate_sparse(size, size, 9 * blocks + 2 * size, 1, 1, -1, CHOLMOD_REAL, &common);
        right = cholmod_ones(size, 1, CHOLMOD_REAL, &common);
    }
    ~Cholmod()
    {
        cholmod_free_sparse(&matrix, &common);
        cholmod_free_factor(&factor, &common);
        for (cholmod_dense** vector : {&right, &solution, &work[0], &work[1]})
        {
            cholmod_free_dense(vector, &common);
        }
        cholmod_finish(&common);
    }
    Cholmod(const Cholmod&) = delete;
    Cholmod& operator=(const Cholmod&) = delete;

    /// The lower triangle of S, column by column.
    void setMatrix(const BlockPattern& pattern, SchurSystem<3>& system)
    {
        auto* start = static_cast<int*>(matrix->p);
        auto* row = static_cast<int*>(matrix->i);
        auto* value = static_cast<double*>(matrix->x);
        int position = 0;
        for (int body = 0; body < pattern.columns(); ++body)
        {
            const int first = pattern.columnStart[body];
            for (int column = 0; column < 3; ++column)
            {
                start[3 * body + column] = position;
                for (int entry = first; entry < pattern.columnStart[body + 1]; ++entry)
                {
                    const Eigen::Matrix3d& block =
                        entry == first ? system.diagonal(body) : system.coupling(entry);
                    for (int line = entry == first ? column : 0; line < 3; ++line)
                    {
                        row[position] = 3 * pattern.row[entry] + line;
                        value[position++] = block(line, column);
                    }
                }
            }
        }
        start[size] = position;
    }

    void factorise()
    {
        if (!factor)
        {
            factor = cholmod_analyze(matrix, &common);
        }
        cholmod_factorize(matrix, factor, &common);
    }

    void solve()
    {
        cholmod_solve2(CHOLMOD_A, factor, right, nullptr, &solution, nullptr, &work[0], &work[1], &common);
        if (common.status != CHOLMOD_OK)
        {
            throw std::runtime_error("CHOLMOD has not solved a Schur system");
        }
    }

private:
    std::size_t size;
    cholmod_common common;
    cholmod_sparse* matrix = nullptr;
    cholmod_factor* factor = nullptr;
    cholmod_dense* right = nullptr;
    cholmod_dense* solution = nullptr;
    cholmod_dense* work[2] = {nullptr, nullptr};
};

} // namespace

double cholmodUnitOfWork(const PlaneConeProgram& program)
{
    SymbolicAnalysis symbolic;
    Form<3> form = makeForm(program, symbolic);
    SchurSystem<3>& system = schurSystem(form, symbolic);
    const BlockPattern pattern = makeBlockPattern(form.bodies, form.couplings);
    const ConeWeights<double> d{Eigen::VectorXd::Ones(form.cones().rays), {}};
    Cholmod cholmod(pattern);
    double least = std::numeric_limits<double>::max();
    for (int repetition = 0; repetition < 11; ++repetition)
    {
        const double start = cpuTime();
        assembleSchur(form, d, 1e-9, 0, system);
        cholmod.setMatrix(pattern, system);
        cholmod.factorise();
        cholmod.solve();
        least = std::min(least, cpuTime() - start); // the first one analyses too
    }
    return least;
}

} // namespace drystone
