// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The comparison of a step with one that leaves nothing of the case out.
#include "dynamics/VerifiedStep.h"

#include "core/Error.h"
#include "core/Log.h"
#include "dynamics/Advance.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace drystone
{

template<int Dim>
double differenceOf(const DynamicCase<Dim>& scene, const DynamicState<Dim>& one,
                    const DynamicState<Dim>& other)
{
    double largest = 0;
    for (std::size_t block = 0; block < one.placements.size(); ++block)
    {
        const Placement<Dim>& a = one.placements[block];
        const Placement<Dim>& b = other.placements[block];
        largest = std::max(largest, (a.translation - b.translation).norm()
                                        + scene.blockSize * (rowsOf(a.rotation) - rowsOf(b.rotation)).norm());
    }
    return largest;
}

namespace
{

/// The same step with all effects.
template<int Dim>
struct Reference
{
    bool isSolved = false;
    DynamicState<Dim> state;
    double difference = 0; ///< of the step from it [m]
    double flowError = 0;  ///< see StepResiduals [m]
};

/// \param closer how many times smaller its errors are, those in gaps and those of the solver
template<int Dim>
Reference<Dim> referenceOf(const DynamicCase<Dim>& scene, Motion<Dim> before, double timeStep,
                           const Motion<Dim>& after, double closer)
{
    DynamicCase<Dim> everything = scene;
    everything.schemes.effects.selection = EffectSelection::asGiven;
    everything.schemes.contactTolerance /= closer;
    everything.solution.tolerance /= closer;
    if (!advance(everything, before, timeStep))
    {
        return {};
    }
    const double difference = differenceOf(scene, before.state, after.state);
    return {true, std::move(before.state), difference, before.residuals.flowError};
}

/// Why a step that differs by more than is allowed may be as right as its reference; empty: it is not.
/// \param change of the reference where its gaps are closer [m]
std::string doubtOf(double flowError, double change, double allowed)
{
    if (flowError > allowed)
    {
        return fmt::format("with all effects of the case Coulomb's law is met to {:.3g} m only", flowError);
    }
    if (change > allowed) // many impacts in one step
    {
        return fmt::format("with all effects of the case it ends {:.3g} m farther where it is solved closer",
                           change);
    }
    return "";
}

void printNotVerified(double time, const std::string& reason)
{
    printWarning(fmt::format("The step at time {:g} s could not be verified: {}.", time, reason));
}

} // namespace

template<int Dim>
void verifyStep(const DynamicCase<Dim>& scene, const Motion<Dim>& before, double timeStep, Motion<Dim>& after)
{
    // A gap at the foot of a tall column is many times as much at its head: the step with all effects is off
    // by that, too. Where the two differ by more than is allowed a closer one says which of them is off.
    constexpr double closer = 100;
    const double time = after.state.time;
    const double allowed = scene.schemes.contactTolerance * scene.blockSize;
    const double start = clockTime();
    const Reference<Dim> reference = referenceOf(scene, before, timeStep, after, 1);
    const double seconds = clockTime() - start;
    if (!reference.isSolved)
    {
        printNotVerified(time, "it was not solved with all effects of the case");
        return;
    }
    double difference = reference.difference;
    double change = 0;
    if (difference > allowed)
    {
        const Reference<Dim> near = referenceOf(scene, before, timeStep, after, closer);
        difference = near.isSolved ? std::min(difference, near.difference) : difference;
        change = near.isSolved ? differenceOf(scene, reference.state, near.state) : 0;
    }
    if (const std::string doubt = doubtOf(reference.flowError, change, allowed);
        difference > allowed && !doubt.empty())
    {
        printNotVerified(time, doubt);
        return;
    }
    EffectUse& use = after.effectUse;
    use.secondsOfVerified += seconds;
    ++use.verified;
    if (difference > use.largestDifference)
    {
        use.largestDifference = difference;
        use.timeOfLargestDifference = time;
    }
    if (difference > allowed)
    {
        printWarning(
            fmt::format("The step at time {:g} s differs by {:.3g} m from the one with all effects of the "
                        "case; contactTolerance of system/schemes allows {:.3g} m. `selection asGiven;` in "
                        "system/schemes/effects simulates them in every step.",
                        time, difference, allowed));
    }
}

template double differenceOf(const DynamicCase<2>& scene, const DynamicState<2>& one,
                             const DynamicState<2>& other);
template void verifyStep(const DynamicCase<2>& scene, const Motion<2>& before, double timeStep,
                         Motion<2>& after);
template double differenceOf(const DynamicCase<3>& scene, const DynamicState<3>& one,
                             const DynamicState<3>& other);
template void verifyStep(const DynamicCase<3>& scene, const Motion<3>& before, double timeStep,
                         Motion<3>& after);

} // namespace drystone
