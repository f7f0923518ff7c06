// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Part of every benchmark: its head names the processor and the dense kernel in addition to what Google
/// Benchmark says.
#include "Context.h"
#include "linear/DenseKernel.h"

#include <benchmark/benchmark.h>

#include <fstream>
#include <string>

namespace drystone
{
namespace
{

std::string processor()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
    {
        if (line.starts_with("model name"))
        {
            return line.substr(line.find(':') + 2);
        }
    }
    return "unknown";
}

const bool isNamed = []
{
    benchmark::AddCustomContext("processor", processor());
    benchmark::AddCustomContext("dense kernel", denseKernel().name);
    benchmark::AddCustomContext("threads", "1");
    return true;
}();

} // namespace

double peakMemory()
{
    std::ifstream status("/proc/self/status");
    std::string word;
    double kilobytes = 0;
    while (status >> word)
    {
        if (word == "VmHWM:")
        {
            status >> kilobytes;
        }
    }
    return kilobytes / 1e6;
}

} // namespace drystone
