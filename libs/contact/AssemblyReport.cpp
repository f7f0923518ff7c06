// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Statistics first, then a line a check with the faults below it, the verdict last.
#include "contact/AssemblyReport.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

template<int Dim>
std::string placeText(const Vector<Dim>& place)
{
    constexpr double ofMap = 1e3; // [m]
    const int digits = place.template lpNorm<Eigen::Infinity>() < ofMap ? 6 : 10;
    return fmt::format("({:.{}g})", fmt::join(place.data(), place.data() + Dim, " "), digits);
}

template<int Dim>
int failedChecks(const AssemblyReport<Dim>& report)
{
    return static_cast<int>(std::count_if(report.checks.begin(), report.checks.end(),
                                          [](const CheckResult& check) { return check.failures > 0; }));
}

template<int Dim>
std::string printedReport(const Assembly<Dim>& assembly, const AssemblyReport<Dim>& report)
{
    const AssemblyStatistics<Dim>& statistics = report.statistics;
    std::string text = "Assembly stats\n";
    const auto line = [&text](std::string_view name, const auto& value)
    { text += fmt::format("    {:<18}{}\n", fmt::format("{}:", name), value); };
    line("blocks", statistics.blocks);
    line("free blocks", statistics.freeBlocks);
    line("concave blocks", statistics.concaveBlocks);
    line("vertices", statistics.vertices);
    line("joints", statistics.joints);
    line("contact points", statistics.contactPoints);
    line("supports", statistics.supports);
    for (std::size_t i = 0; i < assembly.supports.size(); ++i)
    {
        const auto fixed =
            std::count_if(assembly.blocks.begin(), assembly.blocks.end(),
                          [&](const Block<Dim>& block) { return block.support == static_cast<int>(i); });
        text += fmt::format("        {} ({}), {} blocks\n", assembly.supports[i].name,
                            assembly.supports[i].type, fixed);
    }
    text += fmt::format("\nChecking geometry...\n    Bounding box of the free blocks {} {} m\n",
                        placeText<Dim>(statistics.lower), placeText<Dim>(statistics.upper));
    for (const CheckResult& check : report.checks)
    {
        text += check.failures == 0 ? fmt::format("    {} OK.\n", check.message)
                                    : fmt::format(" ***{}, {} failed.\n", check.message, check.name);
        for (const std::string& fault : check.faults)
        {
            text += fmt::format("      - {}\n", fault);
        }
        if (check.failures > static_cast<int>(check.faults.size()))
        {
            text +=
                fmt::format("      - and {} more\n", check.failures - static_cast<int>(check.faults.size()));
        }
    }
    const int failed = failedChecks(report);
    text += failed == 0 ? "\nAssembly OK." : fmt::format("\nFailed {} checks.", failed);
    return text;
}

template std::string placeText<2>(const Vector<2>& place);
template std::string placeText<3>(const Vector<3>& place);
template int failedChecks(const AssemblyReport<2>& report);
template int failedChecks(const AssemblyReport<3>& report);
template std::string printedReport(const Assembly<2>& assembly, const AssemblyReport<2>& report);
template std::string printedReport(const Assembly<3>& assembly, const AssemblyReport<3>& report);

} // namespace drystone
