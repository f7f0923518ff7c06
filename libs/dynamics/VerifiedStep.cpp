// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The comparison of a step with one that leaves nothing of the case out.
#include "dynamics/VerifiedStep.h"

#include "core/Error.h"
#include "core/Log.h"
#include "dynamics/Advance.h"

#include <fmt/format.h>

#include <algorithm>

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

template<int Dim>
void verifyStep(const DynamicCase<Dim>& scene, Motion<Dim> before, double timeStep, Motion<Dim>& after)
{
    DynamicCase<Dim> everything = scene;
    everything.schemes.effects.selection = EffectSelection::asGiven;
    const double start = cpuTime();
    const bool isSolved = advance(everything, before, timeStep);
    EffectUse& use = after.effectUse;
    if (!isSolved)
    {
        printWarning(fmt::format("The step at time {:g} s could not be verified: it was not solved with "
                                 "all effects of the case.",
                                 after.state.time));
        return;
    }
    use.secondsOfVerified += cpuTime() - start;
    ++use.verified;
    const double difference = differenceOf(scene, before.state, after.state);
    if (difference > use.largestDifference)
    {
        use.largestDifference = difference;
        use.timeOfLargestDifference = after.state.time;
    }
    const double allowed = scene.schemes.contactTolerance * scene.blockSize;
    if (difference > allowed)
    {
        printWarning(
            fmt::format("The step at time {:g} s differs by {:.3g} m from the one with all effects of the "
                        "case; contactTolerance of system/schemes allows {:.3g} m. `selection asGiven;` in "
                        "system/schemes/effects simulates them in every step.",
                        after.state.time, difference, allowed));
    }
}

template double differenceOf(const DynamicCase<2>& scene, const DynamicState<2>& one,
                             const DynamicState<2>& other);
template void verifyStep(const DynamicCase<2>& scene, Motion<2> before, double timeStep, Motion<2>& after);
template double differenceOf(const DynamicCase<3>& scene, const DynamicState<3>& one,
                             const DynamicState<3>& other);
template void verifyStep(const DynamicCase<3>& scene, Motion<3> before, double timeStep, Motion<3>& after);

} // namespace drystone
