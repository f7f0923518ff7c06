// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// GLPK, linked where it is installed.
#include "LinearProgram.h"

#if __has_include(<glpk.h>)
#include <glpk.h>

namespace drystone
{
namespace
{

std::optional<PeerAnswer> solve(const AnyConeProgram& any, double tolerance)
{
    const PlaneConeProgram* program = asLinear(any);
    if (!program)
    {
        return {};
    }
    const LinearProgram linear = linearProgram(*program);
    glp_term_out(GLP_OFF);
    glp_prob* problem = glp_create_prob();
    glp_set_obj_dir(problem, GLP_MIN);
    glp_add_rows(problem, linear.rows);
    for (int row = 0; row < linear.rows; ++row)
    {
        glp_set_row_bnds(problem, row + 1, GLP_FX, linear.right[static_cast<std::size_t>(row)], 0);
    }
    const int count = static_cast<int>(linear.columns.size());
    glp_add_cols(problem, count);
    for (int column = 0; column < count; ++column)
    {
        // Indices from 1: the first element of each array is not read.
        std::vector<int> rows{0};
        std::vector<double> values{0};
        for (const LinearProgram::Entry& entry : linear.columns[static_cast<std::size_t>(column)])
        {
            rows.push_back(entry.row + 1);
            values.push_back(entry.value);
        }
        glp_set_mat_col(problem, column + 1, static_cast<int>(rows.size()) - 1, rows.data(), values.data());
        const bool isMultiplier = linear.hasMultiplier && column + 1 == count;
        glp_set_col_bnds(problem, column + 1, isMultiplier ? GLP_FR : GLP_LO, 0, 0);
        glp_set_obj_coef(problem, column + 1, linear.costs[static_cast<std::size_t>(column)]);
    }
    glp_smcp settings;
    glp_init_smcp(&settings);
    settings.msg_lev = GLP_MSG_OFF;
    settings.tol_bnd = std::max(tolerance, 1e-9);
    settings.tol_dj = std::max(tolerance, 1e-9);
    settings.tm_lim = 60000;
    settings.it_lim = 10000 + 100 * (linear.rows + count); // it may cycle
    const double start = cpuSeconds();
    glp_scale_prob(problem, GLP_SF_AUTO);
    glp_adv_basis(problem, 0);
    glp_simplex(problem, &settings);
    PeerAnswer answer;
    answer.seconds = cpuSeconds() - start;
    std::vector<double> columns(static_cast<std::size_t>(count));
    std::vector<double> y(static_cast<std::size_t>(linear.rows));
    for (int column = 0; column < count; ++column)
    {
        columns[static_cast<std::size_t>(column)] = glp_get_col_prim(problem, column + 1);
    }
    for (int row = 0; row < linear.rows; ++row)
    {
        y[static_cast<std::size_t>(row)] = glp_get_row_dual(problem, row + 1);
    }
    answer.solution = solutionOf(*program, linear, columns, y);
    answer.solution.iterations = glp_get_it_cnt(problem);
    glp_delete_prob(problem);
    return answer;
}

} // namespace

std::optional<Peer> glpk()
{
    return Peer{"GLPK", ContactLaw::associative, solve};
}

} // namespace drystone
#else
std::optional<drystone::Peer> drystone::glpk()
{
    return {};
}
#endif
