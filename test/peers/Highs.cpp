// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// HiGHS (Huangfu & Hall 2018) through its library, by either of its methods. Debian 12 has no package of it:
/// CMAKE_PREFIX_PATH says where it is installed.
#include "LinearProgram.h"

#if __has_include(<interfaces/highs_c_api.h>)
#include <interfaces/highs_c_api.h>

#include <array>

namespace drystone
{
namespace
{

/// The linear program by columns, as the library takes it.
struct ByColumns
{
    std::vector<HighsInt> start{0};
    std::vector<HighsInt> row;
    std::vector<double> value;
    std::vector<double> lower;
    std::vector<double> upper;
};

ByColumns byColumns(const LinearProgram& linear, double infinite)
{
    ByColumns matrix;
    for (const std::vector<LinearProgram::Entry>& column : linear.columns)
    {
        for (const LinearProgram::Entry& entry : column)
        {
            matrix.row.push_back(entry.row);
            matrix.value.push_back(entry.value);
        }
        matrix.start.push_back(static_cast<HighsInt>(matrix.row.size()));
    }
    matrix.lower.assign(linear.columns.size(), 0);
    matrix.upper.assign(linear.columns.size(), infinite);
    if (linear.hasMultiplier)
    {
        matrix.lower.back() = -infinite;
    }
    return matrix;
}

std::optional<PeerAnswer> solve(const AnyConeProgram& any, double tolerance, const char* method)
{
    const PlaneConeProgram* program = asLinear(any);
    if (!program)
    {
        return {};
    }
    const LinearProgram linear = linearProgram(*program);
    void* highs = Highs_create();
    Highs_setBoolOptionValue(highs, "output_flag", 0);
    Highs_setStringOptionValue(highs, "solver", method);
    Highs_setIntOptionValue(highs, "threads", 1);
    Highs_setDoubleOptionValue(highs, "time_limit", 60);
    for (const char* option :
         {"primal_feasibility_tolerance", "dual_feasibility_tolerance", "ipm_optimality_tolerance"})
    {
        Highs_setDoubleOptionValue(highs, option, tolerance);
    }
    const ByColumns matrix = byColumns(linear, Highs_getInfinity(highs));
    const auto columns = static_cast<HighsInt>(linear.columns.size());
    PeerAnswer answer;
    const double start = cpuSeconds();
    Highs_passLp(highs, columns, linear.rows, static_cast<HighsInt>(matrix.row.size()),
                 kHighsMatrixFormatColwise, kHighsObjSenseMinimize, 0, linear.costs.data(),
                 matrix.lower.data(), matrix.upper.data(), linear.right.data(), linear.right.data(),
                 matrix.start.data(), matrix.row.data(), matrix.value.data());
    Highs_run(highs);
    answer.seconds = cpuSeconds() - start;
    std::vector<double> x(linear.columns.size());
    std::vector<double> reduced(x.size());
    std::vector<double> rows(static_cast<std::size_t>(linear.rows));
    std::vector<double> y(rows.size());
    Highs_getSolution(highs, x.data(), reduced.data(), rows.data(), y.data());
    answer.solution = solutionOf(*program, linear, x, y);
    for (const char* count : {"simplex_iteration_count", "ipm_iteration_count"})
    {
        HighsInt iterations = 0;
        Highs_getIntInfoValue(highs, count, &iterations);
        answer.solution.iterations += std::max<HighsInt>(0, iterations);
    }
    Highs_destroy(highs);
    return answer;
}

std::optional<Peer> by(const std::string& name, const char* method)
{
    return Peer{name, ContactLaw::associative, [method](const AnyConeProgram& program, double tolerance) {
                    return solve(program, tolerance, method);
                }};
}

} // namespace

std::optional<Peer> highsSimplex()
{
    return by("HiGHS simplex", "simplex");
}

std::optional<Peer> highsInteriorPoint()
{
    return by("HiGHS interior point", "ipx");
}

} // namespace drystone
#else
namespace drystone
{

std::optional<Peer> highsSimplex()
{
    return {};
}

std::optional<Peer> highsInteriorPoint()
{
    return {};
}

} // namespace drystone
#endif
