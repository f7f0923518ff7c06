// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The choice among the kernels.
#include "linear/DenseKernel.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace drystone
{

// Each in a file of its own, compiled for its processors: DenseKernelAvx512.cpp and so on.
void updateWithAvx512(const DenseUpdate& task, double* work);
void updateWithAvx2(const DenseUpdate& task, double* work);
void updateWithBaseline(const DenseUpdate& task, double* work);

namespace
{

std::vector<DenseKernel> findKernels()
{
    std::vector<DenseKernel> kernels;
#if defined(__x86_64__)
    __builtin_cpu_init();
    // All of the level that the file is compiled for: the compiler may use any of it.
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw")
        && __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq")
        && __builtin_cpu_supports("avx512vl"))
    {
        kernels.push_back({"avx512", updateWithAvx512});
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi")
        && __builtin_cpu_supports("bmi2"))
    {
        kernels.push_back({"avx2", updateWithAvx2});
    }
#endif
    kernels.push_back({"baseline", updateWithBaseline});
    return kernels;
}

const DenseKernel& chooseKernel()
{
    const std::vector<DenseKernel>& kernels = availableDenseKernels();
    const char* wanted = std::getenv("DRYSTONE_KERNEL");
    if (!wanted || *wanted == 0)
    {
        return kernels.front();
    }
    std::string names;
    for (const DenseKernel& kernel : kernels)
    {
        if (std::string_view(kernel.name) == wanted)
        {
            return kernel;
        }
        names += std::string(names.empty() ? "" : ", ") + kernel.name;
    }
    throw FatalError(
        fmt::format("The environment variable DRYSTONE_KERNEL is `{}`: this processor can run {}. "
                    "Unset it for the quickest of them.",
                    wanted, names));
}

} // namespace

double* alignedWork(std::vector<double>& numbers)
{
    constexpr std::size_t alignment = 64 / sizeof(double);
    if (numbers.empty())
    {
        numbers.resize(denseKernelWork + alignment);
    }
    const auto address = reinterpret_cast<std::uintptr_t>(numbers.data()) / sizeof(double);
    return numbers.data() + (alignment - address % alignment) % alignment;
}

const std::vector<DenseKernel>& availableDenseKernels()
{
    static const std::vector<DenseKernel> kernels = findKernels();
    return kernels;
}

const DenseKernel& denseKernel()
{
    static const DenseKernel& kernel = chooseKernel();
    return kernel;
}

} // namespace drystone
