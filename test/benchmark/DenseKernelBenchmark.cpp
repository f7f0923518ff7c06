// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The dense kernels that this processor can run, and dsyrk of the BLAS that is installed (OpenBLAS chooses
/// its kernel by itself, or as OPENBLAS_CORETYPE says), on the shapes of wide fronts: GFlop/s on one core.
///
///     OPENBLAS_NUM_THREADS=1 build/test/DenseKernelBenchmark
#include "linear/DenseKernel.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

extern "C"
{
    /// The lower triangle of C = factor A A' + keep C, stored by columns.
    void dsyrk_(const char* triangle, const char* transpose, const int* rows, const int* depth,
                const double* factor, const double* a, const int* aStride, const double* keep, double* c,
                const int* cStride);
}

namespace drystone
{
namespace
{

template<class Update>
void measure(benchmark::State& state, const Update& update)
{
    const int rows = static_cast<int>(state.range(0));
    const int depth = static_cast<int>(state.range(1));
    const auto size = static_cast<std::size_t>(rows);
    const std::vector<double> a(size * static_cast<std::size_t>(depth), 0.5);
    std::vector<double> c(size * size);
    for (auto _ : state)
    {
        update(rows, depth, a.data(), c.data());
        benchmark::ClobberMemory();
    }
    state.counters["GFlop/s"] =
        benchmark::Counter(1e-9 * rows * rows * depth, benchmark::Counter::kIsIterationInvariantRate);
}

void own(benchmark::State& state, const DenseKernel& kernel)
{
    std::vector<double> work;
    double* const begin = alignedWork(work);
    measure(state,
            [&](int rows, int depth, const double* a, double* c) {
                kernel.update({DenseUpdate::Target::set, rows, rows, depth, a, rows, c, rows}, begin);
            });
}

void blas(benchmark::State& state)
{
    measure(state,
            [](int rows, int depth, const double* a, double* c)
            {
                const double subtract = -1;
                const double keep = 0;
                dsyrk_("L", "N", &rows, &depth, &subtract, a, &rows, &keep, c, &rows);
            });
}

/// One benchmark a kernel.
bool registerAll()
{
    const auto withShapes = [](benchmark::internal::Benchmark* made)
    {
        made->ArgNames({"rows", "depth"});
        for (const auto& [rows, depth] :
             {std::pair(60, 15), std::pair(300, 60), std::pair(600, 300), std::pair(3000, 1000)})
        {
            made->Args({rows, depth});
        }
    };
    for (const DenseKernel& kernel : availableDenseKernels())
    {
        withShapes(benchmark::RegisterBenchmark(kernel.name, own, kernel));
    }
    withShapes(benchmark::RegisterBenchmark("BLAS", blas));
    return true;
}

const bool isRegistered = registerAll();

} // namespace
} // namespace drystone
