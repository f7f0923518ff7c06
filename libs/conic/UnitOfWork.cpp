// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Times the Schur system for weights of one, caches filled, as often as the clock requires.
#include "conic/UnitOfWork.h"

#include "conic/form/FormSchur.h"
#include "core/Log.h"

#include <algorithm>
#include <limits>

namespace drystone
{

template<int Rows, int Forces>
double unitOfWork(const ConeProgram<Rows, Forces>& program)
{
    SymbolicAnalysis symbolic;
    Form<Rows> form = makeForm(program, symbolic);
    SchurSystem<Rows>& system = schurSystem(form, symbolic);
    const ConeWeights<double> d{Eigen::VectorXd::Ones(form.cones().rays),
                                std::vector<FramedMatrix<double>>(form.rounds.size())};
    Eigen::VectorXd x;
    const auto timeOf = [&](int count)
    {
        const double start = cpuTime();
        for (int i = 0; i < count; ++i)
        {
            x = Eigen::VectorXd::Ones(Rows * form.bodies);
            assembleSchur(form, d, 1e-9, 0, system);
            system.factorise();
            system.solve(x);
        }
        return (cpuTime() - start) / count;
    };
    timeOf(1); // fills caches
    // The clock itself takes some tenths of a microsecond: a block's matrix is done in less.
    const int count = std::clamp(static_cast<int>(1e-4 / std::max(timeOf(1), 1e-9)), 1, 1000);
    double least = std::numeric_limits<double>::max();
    for (int repetition = 0; repetition < 10; ++repetition)
    {
        least = std::min(least, timeOf(count));
    }
    return least;
}

template double unitOfWork(const PlaneConeProgram&);
template double unitOfWork(const SpaceConeProgram&);

} // namespace drystone
