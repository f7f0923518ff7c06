// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/UnitOfWork.h"

#include "conic/RayOperators.h"
#include "core/Log.h"

#include <algorithm>
#include <limits>

namespace drystone
{

double unitOfWork(const PlaneConeProgram& program)
{
    SymbolicAnalysis symbolic;
    RayForm form = makeRayForm(program, symbolic);
    SchurSystem<3>& system = schurSystem(form, symbolic);
    const Eigen::VectorXd d = Eigen::VectorXd::Ones(form.program.rayCount());
    Eigen::VectorXd x;
    const auto timeOf = [&](int count)
    {
        const double start = cpuTime();
        for (int i = 0; i < count; ++i)
        {
            x = Eigen::VectorXd::Ones(3 * form.program.bodies);
            assembleSchur(form.program, d, 1e-9, 0, system);
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

} // namespace drystone
