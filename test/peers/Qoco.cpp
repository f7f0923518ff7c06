// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// QOCO (Chari & Acikmese 2025) through its library. Debian has no package of it: CMAKE_PREFIX_PATH says
/// where it is installed.
#include "ForceProgram.h"
#include "Peers.h"

#if __has_include(<qoco/qoco.h>)
#include <qoco/qoco.h>

#include <Eigen/SparseCore>

#include <cstdlib>

namespace drystone
{
namespace
{

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

Sparse sparseOf(const Triplets& triplets, std::size_t rows, int columns)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [row, column, value] : triplets.entries)
    {
        entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
    }
    Sparse matrix(static_cast<Eigen::Index>(rows), columns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    matrix.makeCompressed();
    return matrix;
}

QOCOCscMatrix viewOf(Sparse& matrix)
{
    QOCOCscMatrix view;
    qoco_set_csc(&view, static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()),
                 static_cast<int>(matrix.nonZeros()), matrix.valuePtr(), matrix.outerIndexPtr(),
                 matrix.innerIndexPtr());
    return view;
}

template<int Rows, int Forces>
std::optional<PeerAnswer> solve(const ConeProgram<Rows, Forces>& program, double tolerance)
{
    std::optional<ForceProgram> form = forceProgram(program);
    if (!form)
    {
        return {};
    }
    Sparse equality = sparseOf(form->equality, form->load.size(), form->unknowns);
    Sparse limits = sparseOf(form->limits, form->bounds.size(), form->unknowns);
    QOCOCscMatrix equalityView = viewOf(equality);
    QOCOCscMatrix limitsView = viewOf(limits);
    std::vector<int> sizes(static_cast<std::size_t>(form->cones), form->coneSize);
    QOCOSettings settings;
    set_default_settings(&settings);
    settings.abstol = tolerance;
    settings.reltol = tolerance;

    PeerAnswer answer;
    // Its cleanup frees the solver, too.
    auto* solver = static_cast<QOCOSolver*>(std::calloc(1, sizeof(QOCOSolver)));
    const double start = cpuSeconds();
    const bool isSetUp =
        qoco_setup(solver, form->unknowns, static_cast<int>(form->bounds.size()), form->equations, nullptr,
                   form->cost.data(), &equalityView, form->load.data(), &limitsView, form->bounds.data(),
                   form->rays, form->cones, sizes.data(), &settings)
        == QOCO_NO_ERROR;
    if (!isSetUp)
    {
        return {};
    }
    qoco_solve(solver);
    answer.seconds = cpuSeconds() - start;
    const QOCOSolution& found = *solver->sol;
    answer.solution =
        solutionOf(program, *form, {found.x, found.x + form->unknowns}, {found.y, found.y + form->equations});
    answer.solution.iterations = found.iters;
    qoco_cleanup(solver);
    return answer;
}

} // namespace

std::optional<Peer> qoco()
{
    return Peer{"QOCO", ContactLaw::associative, [](const AnyConeProgram& any, double tolerance) {
                    return std::visit([&](const auto& program) { return solve(program, tolerance); }, any);
                }};
}

} // namespace drystone
#else
namespace drystone
{

std::optional<Peer> qoco()
{
    return {};
}

} // namespace drystone
#endif
