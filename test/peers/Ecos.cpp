// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// ECOS (Domahidi, Chu & Boyd 2013), run in R on a file of numbers.
#include "ForceProgram.h"
#include "Peers.h"
#include "Subprocess.h"

#include <fmt/format.h>

#include <fstream>
#include <limits>

namespace drystone
{
namespace
{

/// What solveWithEcos.R reads.
std::string problemText(const ForceProgram& form)
{
    std::string text =
        fmt::format("{} {} {} {} {}\n", form.unknowns, form.equations, form.rays, form.cones, form.coneSize);
    for (const std::vector<double>* list : {&form.cost, &form.load, &form.bounds})
    {
        text += fmt::format("{:.17g}\n", fmt::join(*list, "\n"));
    }
    for (const Triplets* matrix : {&form.equality, &form.limits})
    {
        text += fmt::format("{}\n", matrix->entries.size());
        for (const auto& [row, column, value] : matrix->entries)
        {
            text += fmt::format("{:.0f} {:.0f} {:.17g}\n", row + 1, column + 1, value);
        }
    }
    return text;
}

template<int Rows, int Forces>
std::optional<PeerAnswer> solve(const ConeProgram<Rows, Forces>& program, double tolerance)
{
    const std::optional<ForceProgram> form = forceProgram(program);
    if (!form)
    {
        return {};
    }
    const Scratch scratch;
    std::ofstream(scratch.folder / "problem") << problemText(*form);
    runProgram(fmt::format("timeout 300 Rscript '{}' '{}/problem' '{}/solution' {}",
                           DRYSTONE_PEERS "/solveWithEcos.R", scratch.folder.string(),
                           scratch.folder.string(), tolerance));
    PeerAnswer answer;
    double iterations = 0;
    std::vector<double> unknowns(static_cast<std::size_t>(form->unknowns), 0);
    std::vector<double> multipliers(static_cast<std::size_t>(form->equations), 0);
    std::ifstream stream(scratch.folder / "solution");
    stream >> answer.seconds >> iterations;
    for (std::vector<double>* list : {&unknowns, &multipliers})
    {
        for (double& entry : *list)
        {
            stream >> entry;
        }
    }
    if (!stream)
    {
        multipliers.assign(multipliers.size(), std::numeric_limits<double>::quiet_NaN());
    }
    answer.solution = solutionOf(program, *form, unknowns, multipliers);
    answer.solution.iterations = static_cast<int>(iterations);
    return answer;
}

} // namespace

std::optional<Peer> ecos()
{
    if (runProgram("Rscript -e 'library(ECOSolveR)'").status != 0)
    {
        return {};
    }
    return Peer{"ECOS", ContactLaw::associative, [](const AnyConeProgram& any, double tolerance) {
                    return std::visit([&](const auto& program) { return solve(program, tolerance); }, any);
                }};
}

} // namespace drystone
