// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What wide fronts of a factor take from each other: the one dense operation whose speed decides the time of
/// a large factorisation. In this library because FrontalCholesky is its only user.
#pragma once

#include <vector>

namespace drystone
{

/// Of C = C - A B' or C = -A B', where the rows of B are the first rows of A: a symmetric update of the
/// columns that stand first. All matrices are stored by columns, `stride` from one to the next. Each number
/// of C comes out the same whichever others are computed with it, so that several threads may share the rows.
struct DenseUpdate
{
    enum class Target
    {
        subtract, ///< C -= A B'
        set       ///< C = -A B'
    };
    Target target = Target::subtract;
    int rows = 0;     ///< of A and C
    int columns = 0;  ///< of C, rows of B; at most `rows`
    int firstRow = 0; ///< of C that is computed
    int depth = 0;    ///< columns of A and B
    const double* a = nullptr;
    long aStride = 0;
    double* c = nullptr; ///< only on and below the diagonal is read and written
    long cStride = 0;
};

/// One text (DenseKernelText.h) compiled for several processors. A kernel adds in an order of its own, the
/// same whatever the machine and the number of threads: figures agree to the last bit between runs with the
/// same kernel, and to rounding between kernels.
struct DenseKernel
{
    const char* name;                                      ///< avx512, avx2 or baseline
    void (*update)(const DenseUpdate& task, double* work); ///< \param work numbers as said below
};

/// Numbers of work that any kernel needs for any task, from an address that is a multiple of 64 bytes on.
inline constexpr long denseKernelWork = 600'000;

/// The first of them. \param numbers that hold them, which get their size here when there are none
double* alignedWork(std::vector<double>& numbers);

/// The kernels that this processor can run, the quickest first. At least the baseline is among them.
const std::vector<DenseKernel>& availableDenseKernels();

/// The one in use: the quickest that is available, or the one that the environment variable DRYSTONE_KERNEL
/// names. \throws FatalError where that names none that this processor can run
const DenseKernel& denseKernel();

} // namespace drystone
