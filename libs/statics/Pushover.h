// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Capacity curve: the collapse load multiplier of the structure as it moves, until it needs none.
#pragma once

#include "conic/InteriorPoint.h"
#include "contact/Penetration.h"
#include "dictionary/Options.h"
#include "statics/LimitAnalysis.h"

#include <functional>

namespace drystone
{

/// Keys of `pushover { ... }` in system/solution/limitAnalysis.
struct PushoverSettings
{
    double step = 0.01;      ///< largest displacement of any corner in a step [m]
    int maximumSteps = 2000; ///< after which the curve ends unfinished
};

void declare(Options& options, PushoverSettings& settings);

/// The structure in one of its positions.
struct CapacityPoint
{
    double displacement = 0; ///< d: what the live load has moved by, weighted mean over the blocks [m]
    double alpha = 0;        ///< multiplier that sets it going on from there
    double largest = 0;      ///< displacement of the corner that has moved most, along its path [m]
    double worst = 0;        ///< figure of the certificate
    int iterations = 0;
};

/// How a curve ended.
enum class PushoverEnd
{
    overturned, ///< alpha reached zero: the last point is there, by interpolation
    falling, ///< in the last position, with alpha 0, it cannot stand by itself: blocks have lost their hold
    meeting, ///< in space: blocks meet where faces do not face each other, and no contact parts them
    stepsUsedUp, ///< maximumSteps
    unbounded,   ///< no live load makes it move
    unstable,    ///< it cannot carry its dead load as built
    notConverged ///< the solver did not reach its tolerance
};

struct Pushover
{
    std::vector<CapacityPoint> curve;
    PushoverEnd end = PushoverEnd::notConverged;
    Penetration overlap; ///< of the position after the last one, with PushoverEnd::meeting
    int stepsToFirstOrder =
        0; ///< taken by the motion at their beginning, as that of their middle was not found
};

/// What is followed, with forces that keep their directions and stay at their points of the blocks.
template<int Dim>
struct PushoverScene
{
    const Assembly<Dim>& assembly;
    double mu = 0;
    LoadVectors loads;
};

/// What displacements of a capacity curve are measured by: the sizes of the live load's forces on the blocks,
/// added up [N].
template<int Dim>
double liveForceOf(const LoadVectors& loads);

/// Called for each position with the placements of all blocks.
template<int Dim>
using PushoverObserver = std::function<void(const CapacityPoint&, const std::vector<Placement<Dim>>&)>;

/// Follows the mechanism of limit analysis over displacements of any size. In each position, with contacts
/// and gaps g of that position and a given work w of the live load, the program of a step without inertia is
///
///     max w alpha - g'c   subject to   A c = fD + alpha fL, c in the friction cones;   z = g - A'y,  fL'y =
///     w:
///
/// alpha is what equilibrium requires there, y moves the blocks on by finite rotations. The motion is taken
/// from a second program with A in the middle of the first one's step: a block that turns about a corner
/// then keeps it to third order in the step. Gaps that remain are closed by the next step.
/// The flow rule is the associative one: what slides rises. In space contacts are those of faces that face
/// each other (PushoverContacts.h); where blocks meet otherwise, deeper than a twentieth of their size, the
/// curve ends before.
template<int Dim>
Pushover solvePushover(const PushoverScene<Dim>& scene, const PushoverSettings& settings,
                       const InteriorPointSettings& solver, const PushoverObserver<Dim>& observe);

} // namespace drystone
