// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Tries starts in turn: near, kept from the last step, from nothing; one alone in extended numbers.
#include "conic/interiorPoint/SolveOnce.h"

#include "conic/Certificate.h"
#include "conic/interiorPoint/Loop.h"

namespace drystone
{
namespace
{

/// A start whose certificate's worst figure is at most this is worth a try. From farther away what the last
/// step passed on its way is the better start.
constexpr double nearEnough = 0.01;

/// Multiplications of a factorisation, each some 40 of double precision: half a second.
constexpr double affordableOperations = 2e7;
/// Blocks that enter each other have hundreds of points each, and no digits would help them.
constexpr int affordablePointsPerBody = 40;
/// Iterations in extended numbers that more than these have not been seen to end.
constexpr int mostExtendedIterations = 100;

template<int Rows, int Forces>
InteriorStart interiorStart(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                            const Iterate<double>& iterate, const Eigen::VectorXd& end)
{
    const Eigen::VectorXd fromEnd = iterate.y - end;
    ConeSolution inside = solutionOf(program, form, iterate.s, fromEnd, 0.0);
    return {std::move(inside.contactForce), openingOf(form, iterate.z), std::move(inside.displacement)};
}

template<int Rows, int Forces>
Iterate<double> interiorIterate(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                                const InteriorStart& start)
{
    return {conesOf(program, form, start.contactForce), conesOfOpening(form, start.opening),
            rowsOf(form, start.displacement), 0};
}

template<int Rows, int Forces, class Scalar>
ConeSolution solutionOfLoop(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                            const InteriorPointLoop<Rows, Scalar>& loop)
{
    const Iterate<Scalar>& at = loop.iterate();
    ConeSolution solution = solutionOf(program, form, at.s, at.y, at.alpha);
    solution.iterations = loop.iterations();
    solution.factorisations = loop.factorisations();
    solution.solves = loop.solves();
    solution.status = loop.ending() == Ending::converged ? SolveStatus::optimal
                      : loop.ending() == Ending::grows   ? SolveStatus::unbounded
                                                         : SolveStatus::notConverged;
    return solution;
}

template<int Rows, int Forces>
ConeSolution attemptExtended(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                             InteriorPointSettings settings, Sought sought)
{
    settings.maximumIterations = std::min(mostExtendedIterations, settings.maximumIterations);
    SchurSystem<Rows, DoubleDouble> system(program.bodies, form.couplings);
    InteriorPointLoop<Rows, DoubleDouble> loop(form, system, settings, sought);
    loop.run(program.hasInertia() ? Start::unit : Start::leastSquares, narrow);
    return solutionOfLoop(program, form, loop);
}

} // namespace

template<int Rows, int Forces>
bool mayBeExtended(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                   const SymbolicAnalysis& symbolic)
{
    const auto& system = symbolic.system<Rows>();
    return settings.arithmetic == Arithmetic::adaptive && system
           && system->operations() <= affordableOperations
           && program.points() <= affordablePointsPerBody * program.bodies;
}

template<int Rows, int Forces>
ConeSolution solveOnce(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                       const Aim& aim, SymbolicAnalysis& symbolic, const ConeSolution* near)
{
    Form<Rows> form = makeForm(program, symbolic, aim.multiplier);
    if (aim.sought == Sought::fall || aim.sought == Sought::carried)
    {
        form.liveWork = 0;
    }
    SchurSystem<Rows>& system = schurSystem(form, symbolic);
    if (aim.numbers == Numbers::extended)
    {
        return attemptExtended(program, form, settings, aim.sought);
    }
    InteriorPointLoop<Rows> loop(form, system, settings, aim.sought);
    bool converged = false;
    if (near)
    {
        const double error = certifyOptimal(program, *near).worst();
        const Eigen::VectorXd displacement = rowsOf(form, near->displacement);
        if (error <= nearEnough)
        {
            converged = loop.runNear(conesOf(program, form, near->contactForce), displacement, error);
        }
        if (!converged && near->interior.contactForce.size() == Forces * program.points())
        {
            converged = loop.runInside(interiorIterate(program, form, near->interior), displacement);
        }
    }
    // The least forces of a time step say little, as they leave inertia out: unit forces come first there.
    const auto isWorthAnother = [&]
    {
        return loop.ending() != Ending::falls && loop.ending() != Ending::grows
               && !(loop.ending() == Ending::stalled && mayBeExtended(program, settings, symbolic));
    };
    converged =
        converged
        || (program.hasInertia()
                ? loop.run(Start::unit, wide) || loop.run(Start::leastSquares, narrow)
                : loop.run(Start::leastSquares, wide) || (isWorthAnother() && loop.run(Start::unit, narrow)));
    ConeSolution solution = solutionOfLoop(program, form, loop);
    const Eigen::VectorXd& end = loop.iterate().y;
    if (loop.forcesOfLoadAlone().size() > 0)
    {
        solution.forceOfLoadAlone =
            solutionOf(program, form, loop.forcesOfLoadAlone(), end, 0.0).contactForce;
    }
    if (converged && !program.hasStrength() && loop.interior().s.size() > 0)
    {
        solution.interior = interiorStart(program, form, loop.interior(), end);
    }
    return solution;
}

template bool mayBeExtended(const PlaneConeProgram&, const InteriorPointSettings&, const SymbolicAnalysis&);
template bool mayBeExtended(const SpaceConeProgram&, const InteriorPointSettings&, const SymbolicAnalysis&);
template ConeSolution solveOnce(const PlaneConeProgram&, const InteriorPointSettings&, const Aim&,
                                SymbolicAnalysis&, const ConeSolution*);
template ConeSolution solveOnce(const SpaceConeProgram&, const InteriorPointSettings&, const Aim&,
                                SymbolicAnalysis&, const ConeSolution*);

} // namespace drystone
