// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Clp has a licence with which it cannot be linked to Drystone: it runs as a separate program, on an MPS
/// file.
#include "LinearProgram.h"
#include "Subprocess.h"

#include "core/WholeFile.h"

#include <fmt/format.h>

#include <fstream>

namespace drystone
{
namespace
{

std::string mpsText(const LinearProgram& linear)
{
    std::string text = "NAME drystone FREE\nROWS\n N COST\n";
    const auto out = std::back_inserter(text);
    for (int row = 0; row < linear.rows; ++row)
    {
        fmt::format_to(out, " E R{}\n", row);
    }
    text += "COLUMNS\n";
    for (std::size_t column = 0; column < linear.columns.size(); ++column)
    {
        if (linear.costs[column] != 0)
        {
            fmt::format_to(out, " C{} COST {}\n", column, linear.costs[column]);
        }
        for (const LinearProgram::Entry& entry : linear.columns[column])
        {
            fmt::format_to(out, " C{} R{} {}\n", column, entry.row, entry.value);
        }
    }
    text += "RHS\n";
    for (int row = 0; row < linear.rows; ++row)
    {
        if (linear.right[static_cast<std::size_t>(row)] != 0)
        {
            fmt::format_to(out, " RHS R{} {}\n", row, linear.right[static_cast<std::size_t>(row)]);
        }
    }
    if (linear.hasMultiplier)
    {
        fmt::format_to(out, "BOUNDS\n FR BND C{}\n", linear.columns.size() - 1);
    }
    text += "ENDATA\n";
    return text;
}

std::optional<PeerAnswer> solve(const AnyConeProgram& any, double tolerance)
{
    const PlaneConeProgram* program = asLinear(any);
    if (!program)
    {
        return {};
    }
    const LinearProgram linear = linearProgram(*program);
    const Scratch scratch;
    writeWholeFile(scratch.folder / "program.mps", mpsText(linear));
    const Finished finished = runProgram(fmt::format(
        "cd '{}' && clp program.mps -primalTolerance {} -dualTolerance {} -seconds 60 -dualsimplex "
        "-saveSolution solution",
        scratch.folder.string(), tolerance, tolerance));
    // Numbers of rows and columns, the objective, then values and multipliers of the rows, and of the
    // columns.
    int sizes[2] = {0, 0};
    double objective = 0;
    std::ifstream stream(scratch.folder / "solution", std::ios::binary);
    stream.read(reinterpret_cast<char*>(sizes), sizeof(sizes));
    stream.read(reinterpret_cast<char*>(&objective), sizeof(objective));
    std::vector<double> columns(linear.columns.size());
    std::vector<double> activities(static_cast<std::size_t>(linear.rows));
    std::vector<double> y(static_cast<std::size_t>(linear.rows));
    if (sizes[0] == linear.rows && sizes[1] == static_cast<int>(columns.size()))
    {
        for (std::vector<double>* vector : {&activities, &y, &columns})
        {
            stream.read(reinterpret_cast<char*>(vector->data()),
                        static_cast<std::streamsize>(vector->size() * sizeof(double)));
        }
    }
    PeerAnswer answer{solutionOf(*program, linear, columns, y), finished.seconds};
    return answer;
}

} // namespace

std::optional<Peer> clp()
{
    return isInstalled("clp") ? std::optional(Peer{"Clp", ContactLaw::associative, solve}) : std::nullopt;
}

} // namespace drystone
