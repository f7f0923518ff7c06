// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Solutions of single-block problems that are independent of Drystone's own time stepping: closed forms, and
/// Housner's equation integrated to the last digits. Errors of the time stepping are measured against them.
#pragma once

#include "timeSeries/GroundAcceleration.h"

#include <functional>
#include <vector>

namespace drystone
{

/// A rectangular block that rocks on a horizontal ground without sliding (Housner 1963).
struct RockingBlock
{
    double width = 0;      ///< [m]
    double height = 0;     ///< [m]
    double gravity = 9.81; ///< [m/s2]

    double radius() const;      ///< R, from a corner to the mass centre [m]
    double slenderness() const; ///< alpha = atan(width/height), between the diagonal and the height [rad]
    double frequencyParameter() const; ///< p = sqrt(3 g/(4 R)) [1/s]
    double restitution() const; ///< angular velocity after an impact over that before: 1 - 3/2 sin^2 alpha
};

/// Rotation is positive counter-clockwise: the block then stands on its left corner.
struct RockingState
{
    double time = 0;            ///< [s]
    double rotation = 0;        ///< [rad]
    double angularVelocity = 0; ///< [rad/s]
};

struct RockingImpact
{
    double time = 0;           ///< [s]
    double velocityBefore = 0; ///< [rad/s]
    double velocityAfter = 0;  ///< [rad/s]
};

enum class RockingVerdict
{
    stands,    ///< the ground is still, and the energy left is too little to overturn it
    overturns, ///< it lies on its side
    rocks      ///< neither is certain at the end of the run
};

struct RockingHistory
{
    std::vector<RockingState> samples; ///< one per requested time, unless the block overturned before
    std::vector<RockingImpact> impacts;
    double largestRotation = 0; ///< absolute value, over the integration steps and impacts [rad]
    RockingState last;
    RockingVerdict verdict = RockingVerdict::rocks;
};

struct RockingRun
{
    RockingState start;
    double endTime = 100;            ///< [s]
    double restitution = -1;         ///< angular velocity ratio of an impact; negative: the block's own
    std::vector<double> sampleTimes; ///< increasing [s]
    bool untilVerdict = true;        ///< stop as soon as it is certain that the block stands or overturns
};

/// Motion of a rocking block by
///     theta'' = -p^2 (sgn(theta) sin(alpha - |theta|) - a/g cos(alpha - |theta|)),
/// a the acceleration of the ground to the right. A block at rest begins to rock when |a| > g tan alpha. It
/// is integrated between the kinks of `ground` by integrateToEvent, to about 1e-12; impacts are its events.
/// Where impacts have become slower than 1e-10 p the block is put to rest.
RockingHistory rockingMotion(const RockingBlock& block, const GroundAcceleration& ground,
                             const RockingRun& run);

/// Four times the time from a rotation, at rest, to upright: the period of free rocking without loss [s].
/// \throws std::domain_error unless 0 < rotation < slenderness
double rockingPeriod(const RockingBlock& block, double rotation);

/// The same of the equation linearised for slender blocks: 4/p acosh(1/(1 - rotation/alpha)) (Housner 1963,
/// eq. 5).
double rockingPeriodLinearised(const RockingBlock& block, double rotation);

/// The amplitude between `low` and `high` at which the verdict on a block changes, by bisection to a relative
/// 1e-9.
/// \param ground  makes the ground motion of an amplitude
/// \throws std::domain_error when the verdicts on the two are the same
double
overturningThreshold(const RockingBlock& block,
                     const std::function<std::unique_ptr<GroundAcceleration>(double amplitude)>& ground,
                     double low, double high);

/// Distance in which a sliding block stops: v^2/(2 mu g) [m].
double slidingDistance(double velocity, double frictionCoefficient, double gravity = 9.81);

/// Distance by which a block lags behind a base that accelerates by `amplitude` for `duration` and then keeps
/// its velocity (Newmark 1965): A (A - mu g) T^2/(2 mu g), or 0 when A <= mu g [m].
double newmarkPulseDistance(double amplitude, double duration, double frictionCoefficient,
                            double gravity = 9.81);

/// Displacement and velocity of a block relative to the ground, along the motion of the ground.
struct SlidingState
{
    double time = 0;         ///< [s]
    double displacement = 0; ///< [m]
    double velocity = 0;     ///< [m/s]
};

/// Motion of a block that starts at rest on a moving ground and slides, without rocking, when |a| > mu g:
///     v' = -a - mu g sgn(v).
/// Integrated between the kinks of `ground`; stops are events.
/// \return the states at the requested times
/// \param sampleTimes increasing, none negative [s]
std::vector<SlidingState> slidingMotion(const GroundAcceleration& ground, double frictionCoefficient,
                                        const std::vector<double>& sampleTimes, double gravity = 9.81);

/// The time at which a point dropped from a height has come to rest: sqrt(2 h/g) (1 + e)/(1 - e) [s].
/// \throws std::domain_error unless 0 <= restitution < 1
double bouncingTime(double height, double restitution, double gravity = 9.81);

/// Height at a time of the same point [m].
double bouncingHeight(double height, double restitution, double time, double gravity = 9.81);

} // namespace drystone
