// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Raises pivots until the factor exists; refines steps only where complementarity is small.
#include "conic/interiorPoint/Newton.h"

#include "conic/form/FormOperators.h"
#include "conic/form/FormSchur.h"
#include "core/Threads.h"

namespace drystone
{
namespace
{

/// Complementarity above which a Newton step needs no refinement: D is even there and the factor exact, and
/// what little it leaves shows in the residuals of the next iterate.
constexpr double firmComplementarity = 1e-7;
constexpr int mostRefinements = 3;

/// Complementarity above which a corrector needs no more than single precision: what little it spoils the
/// next predictor repairs.
constexpr double roughComplementarity = 1e-4;

/// Complementarity below which cancellation often makes a pivot negative.
constexpr double cancellingComplementarity = 1e-6;

constexpr int passesOfRepair = 6;

/// Multiplications of a factorisation over those of a solve from which forces of the load alone are looked
/// for longer.
constexpr double factorisationOverRest = 10;

} // namespace

template<int Rows, class Scalar>
void NewtonSystem<Rows, Scalar>::begin(double coneCompliance)
{
    compliance = coneCompliance;
    rounding = 0;
    repairs = 0;
}

template<int Rows, class Scalar>
bool NewtonSystem<Rows, Scalar>::factorise()
{
    const Regularisation& by = regularisation<Scalar>;
    const double force = std::max(1.0, largestOf(state.at.s));
    if (!scaling.update(state.cones, state.at.s, state.at.z, compliance / (force * force)))
    {
        return false;
    }
    // Cancellation may make a pivot negative: then each is raised by what rounding may have taken from it.
    if (state.mu < cancellingComplementarity)
    {
        rounding = std::max(rounding, by.leastRounding);
    }
    for (; rounding <= by.largestRounding; rounding = std::max(by.leastRounding, 10 * rounding))
    {
        assembleSchur(state.form, scaling.weights, by.proximal, rounding, system);
        ++factorisations;
        if (system.factorise())
        {
            return true;
        }
    }
    return false;
}

template<int Rows, class Scalar>
void NewtonSystem<Rows, Scalar>::solve(Vector& x)
{
    if (state.form.limits.empty())
    {
        system.solve(x.head(Rows * state.form.bodies));
    }
    else
    {
        solveWithLimits(state.form, scaling.weights, system, x);
    }
    ++solves;
}

template<int Rows, class Scalar>
void NewtonSystem<Rows, Scalar>::solve(Vector& one, Vector& other)
{
    if (state.form.limits.empty())
    {
        system.solve(one.head(Rows * state.form.bodies), other.head(Rows * state.form.bodies));
        solves += 2;
    }
    else
    {
        solve(one);
        solve(other);
    }
}

template<int Rows, class Scalar>
void NewtonSystem<Rows, Scalar>::solveRoughly(Vector& x)
{
    if (!state.form.limits.empty())
    {
        solve(x);
        return;
    }
    system.solveRoughly(x.head(Rows * state.form.bodies));
    ++solves;
}

/// Moves displacements that balance loads to where the live load does no work on them. \return the change of
/// its multiplier that does so
template<int Rows, class Scalar>
Scalar NewtonSystem<Rows, Scalar>::takeLiveWork(Vector& y) const
{
    const Scalar share = -state.liveLoad.dot(y) / liveStiffness;
    y += share * liveSolution;
    return share;
}

template<int Rows, class Scalar>
void NewtonSystem<Rows, Scalar>::predict(Iterate<Scalar>& step)
{
    weighted = -(state.at.z + state.residuals.opening);
    scaling.weights.apply(weighted);
    step.y.setConstant(state.load.size(), Scalar(0));
    addForces(state.form, weighted, step.y);
    step.y = state.residuals.balance - step.y;
    if (state.form.hasMultiplier())
    {
        liveSolution = state.liveLoad;
        solve(step.y, liveSolution);
        liveStiffness = state.liveLoad.dot(liveSolution);
    }
    else
    {
        solve(step.y);
    }
    finishStep(1, step);
}

template<int Rows, class Scalar>
void NewtonSystem<Rows, Scalar>::correct(Vector& weightedPull, Iterate<Scalar>& step)
{
    weighted.swap(weightedPull);
    weightedPull.resize(0); // its memory is wanted in large systems
    step.y.setConstant(state.load.size(), Scalar(0));
    addForces(state.form, weighted, step.y);
    step.y = -step.y;
    if (state.mu > roughComplementarity)
    {
        solveRoughly(step.y);
    }
    else
    {
        solve(step.y);
    }
    finishStep(0, step);
}

/// The rest of Newton's equations, once `weighted` has D (p - R opening) and step.y the solution for the
/// right side of the balance.
template<int Rows, class Scalar>
void NewtonSystem<Rows, Scalar>::finishStep(double reduction, Iterate<Scalar>& step)
{
    step.alpha = 0;
    if (state.form.hasMultiplier())
    {
        step.alpha = (Scalar(reduction) * state.residuals.work - state.liveLoad.dot(step.y)) / liveStiffness;
        step.y += step.alpha * liveSolution;
    }
    // The openings by dy are built up where dz will be; what `weighted` held is in ds from now on.
    Vector& opened = step.z;
    applyTransposed(state.form, step.y, opened);
    step.s.swap(weighted);
    scaling.weights.addApplied(opened, step.s);
    const int refinements = state.mu > firmComplementarity ? 0 : mostRefinements;
    for (int refinement = 0; refinement < refinements; ++refinement)
    {
        // What rounding and regularisation left of the balance. Corrections are added to ds as they come:
        // computing ds anew from dy would lose them, since D is huge where a point presses.
        remainder = Scalar(reduction) * state.residuals.balance;
        if (state.form.hasMultiplier())
        {
            remainder += step.alpha * state.liveLoad;
        }
        Vector& balanced = rowWork;
        balanced.setConstant(state.load.size(), Scalar(0));
        addForces(state.form, step.s, balanced);
        addInertia(state.form, step.y, balanced);
        remainder -= balanced;
        if (largestOf(remainder)
            <= std::max(0.1 * state.settings.tolerance * state.forceSize(), 1e-2 * state.missing()))
        {
            break;
        }
        solve(remainder);
        if (state.form.hasMultiplier())
        {
            step.alpha += takeLiveWork(remainder);
        }
        step.y += remainder;
        Vector& openedMore = weighted;
        applyTransposed(state.form, remainder, openedMore);
        opened += openedMore;
        scaling.weights.addApplied(openedMore, step.s);
    }
    forParts(opened.size(),
             [&](long begin, long end)
             {
                 const long count = end - begin;
                 opened.segment(begin, count) =
                     Scalar(reduction) * state.residuals.opening.segment(begin, count)
                     - opened.segment(begin, count);
             });
}

/// With s = z = e, one Newton step without complementarity: B B' dy = f + ..., s = B' dy.
template<int Rows, class Scalar>
void NewtonSystem<Rows, Scalar>::leastSquares(Iterate<Scalar>& at)
{
    Vector forces = state.load;
    if (!state.form.hasMultiplier())
    {
        solve(forces);
    }
    else
    {
        liveSolution = state.liveLoad;
        solve(forces, liveSolution);
        liveStiffness = state.liveLoad.dot(liveSolution);
        // alpha that makes the forces least: L'(B B')^-1 (f + alpha L) = 0
        at.alpha = -state.liveLoad.dot(forces) / liveStiffness;
        forces += at.alpha * liveSolution;
        at.y = (Scalar(state.form.liveWork) / liveStiffness) * liveSolution;
    }
    applyTransposed(state.form, forces, at.s);
    if (largestOf(state.gap) > 0)
    {
        remainder.setConstant(state.load.size(), Scalar(0));
        addForces(state.form, state.gap, remainder);
        solve(remainder);
        at.y += remainder;
    }
    applyTransposed(state.form, at.y, at.z);
    at.z = state.gap - at.z;
}

template<int Rows, class Scalar>
bool NewtonSystem<Rows, Scalar>::repairBalance()
{
    ++repairs;
    const Iterate<Scalar> before = state.at;
    scaling.update(state.cones, state.at.s, state.at.z, 0);
    const Scalar even = regularisation<Scalar>.evenFlexibility;
    scaling.weights.rays = scaling.weights.rays.cwiseMin(even);
    for (FramedMatrix<Scalar>& round : scaling.weights.rounds)
    {
        round.eigenvalues = round.eigenvalues.cwiseMin(even);
    }
    assembleSchur(state.form, scaling.weights, regularisation<Scalar>.proximal, 0, system);
    ++factorisations;
    if (!system.factorise())
    {
        return false;
    }
    liveSolution = state.liveLoad;
    solve(liveSolution);
    liveStiffness = state.liveLoad.dot(liveSolution);
    const double enough = 0.1 * state.settings.tolerance * state.forceSize();
    Vector change;
    for (int pass = 0; pass < passesOfRepair && state.missing() > enough; ++pass)
    {
        remainder = state.residuals.balance;
        solve(remainder);
        state.at.alpha += takeLiveWork(remainder);
        applyTransposed(state.form, remainder, change);
        scaling.weights.apply(change);
        addWithin(state.cones, change, state.at.s);
        state.measure();
    }
    if (state.isConverged())
    {
        return true;
    }
    state.at = before;
    state.measure();
    return false;
}

template<int Rows, class Scalar>
VectorOf<Scalar> NewtonSystem<Rows, Scalar>::forcesOfLoadAlone(int iteration)
{
    const bool isExpensive = system.factorisationOverSolve() > factorisationOverRest;
    // The forces of the start are too even for walls with windows, but right for solid ones.
    const int passes = iteration == 0 ? (isExpensive ? 9 : 3) : (isExpensive ? 5 : 4);
    constexpr double reflection = 2;
    const double enough = 0.1 * state.settings.tolerance;
    Vector forces = state.at.s;
    Vector change;
    for (int pass = 0; pass < passes; ++pass)
    {
        reflectInside(state.cones, reflection, forces);
        remainder = -state.load;
        addForces(state.form, forces, remainder);
        if (largestOf(remainder) <= enough)
        {
            return forces;
        }
        solveRoughly(remainder);
        applyTransposed(state.form, remainder, change);
        scaling.weights.apply(change);
        forces -= change;
    }
    return {};
}

template class NewtonSystem<3, double>;
template class NewtonSystem<6, double>;
template class NewtonSystem<3, DoubleDouble>;
template class NewtonSystem<6, DoubleDouble>;

} // namespace drystone
