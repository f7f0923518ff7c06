// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From closing velocities, forces and where the step ends: what each point does, and which do it together.
#include "dynamics/CollidingPoints.h"

#include "core/DisjointSets.h"
#include "dynamics/Impact.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

namespace drystone
{

template<int Dim>
double slowestRebound(const Step<Dim>& step)
{
    return 0.5 * step.acceleration * step.impacts.shortestFlight;
}

template<int Dim>
bool isReduced(const Step<Dim>& step)
{
    return step.solved.sticks || !step.isAwake.empty();
}

template<int Dim>
bool isByErrors(const Step<Dim>& step)
{
    return step.settings.flowRule == FlowRule::associative;
}

namespace
{

/// A point belongs to the impact when it carries more than this share of the largest contact force, and is
/// closed when the step ends.
constexpr double carriesForce = 1e-9;

/// A step is not parted where more pairs of bodies of one structure meet in it than these: in walls that fall
/// apart impacts come so close that it would be parted for ever, and no single one of them decides what the
/// wall does.
constexpr std::size_t mostMeetingPairs = 2;

/// Whether a point that comes, or has come, with a speed rebounds to a flight that is long enough to count.
/// By the associative law what slides is apart, however little: there any does. \param speed at which the
/// point closes, or parts where it is negative [m/s] \param clearance at the start of the step [m]
template<int Dim>
bool flies(const Step<Dim>& step, double speed, double clearance)
{
    if (step.settings.flowRule == FlowRule::associative)
    {
        return true;
    }
    const double byLoads = 2 * step.acceleration * std::max(0.0, clearance); // as it falls, squared
    const double share = speed > 0 ? step.scene.restitution() : 1; // what parts has rebounded already
    return share * std::sqrt(speed * speed + byLoads) > slowestRebound(step);
}

/// Whether an impact of its own changes what a point does: with theta 1 the step is itself the impact without
/// rebound. So joints that turn or slide in a smooth motion, and close by a little in every step, need none.
/// By the associative rule sliding joints are apart, which looks like a fall.
/// \param speed at which the point closes, or parts where it is negative [m/s] \param clearance at the start
/// of the step [m]
template<int Dim>
bool needsImpact(const Step<Dim>& step, double speed, double clearance)
{
    return step.scheme.theta < 1 || flies(step, speed, clearance);
}

/// Whether the points are closed where the step takes the blocks. Solutions are right to a tolerance, and
/// some solvers end inside the cones, where a point that stays wide apart carries force too, a little. Of
/// force and opening, which the exact solution never has both, the smaller part is then the error: force as a
/// share of the largest one, opening as a share of the farthest motion.
template<int Dim>
std::vector<char> closedAtEnd(const Step<Dim>& step)
{
    const StepProgram<Dim>& program = step.program;
    const ThetaStep& result = step.solved.result;
    const StepSettings& settings = step.settings;
    const Eigen::VectorXd opening = openingAtEnd(step, result.displacement, result.contactForce);
    const double largestForce = result.contactForce.lpNorm<Eigen::Infinity>();
    const double farthest = farthestMotion<Dim>(result.displacement, settings.blockSize);
    const double error = settings.contactTolerance + result.flowError;
    std::vector<char> isClosed(static_cast<std::size_t>(program.points()));
    for (std::size_t point = 0; point < isClosed.size(); ++point)
    {
        const auto row = Dim * static_cast<Eigen::Index>(point);
        // Where points slide, the associative law opens them by mu |u_t|, and they press nevertheless.
        const double byFlow = settings.flowRule == FlowRule::associative
                                  ? program.friction[point] * opening.segment<Dim - 1>(row + 1).norm()
                                  : 0;
        const double apart = opening[row] - byFlow;
        isClosed[point] = apart <= error || apart * largestForce <= result.contactForce[row] * farthest;
    }
    return isClosed;
}

/// Whether a point is open, and not only as points are that have just met.
template<int Dim>
bool isApart(const Step<Dim>& step, std::size_t point, double speed)
{
    const double gap = step.points[point].gap;
    return gap > step.settings.contactTolerance && gap > step.impacts.tolerance * speed;
}

/// What the points of a step do.
template<int Dim>
struct PointMotions
{
    PointMotions(const Step<Dim>& ofStep, const Eigen::VectorXd& closingVelocity)
        : step(ofStep),
          closing(closingVelocity),
          leastForce(carriesForce * step.solved.result.contactForce.template lpNorm<Eigen::Infinity>()),
          isLocated(step.impacts.instant == ImpactInstant::located),
          mayReturn(isLocated && step.scene.restitution() > 0),
          mayCarry(isReduced(step) && !isByErrors(step))
    {
    }

    /// At which a point closes when the step begins [m/s].
    double speedOf(std::size_t point) const { return closing[Dim * static_cast<Eigen::Index>(point)]; }
    double gapOf(std::size_t point) const { return step.points[point].gap; }
    bool isOpen(std::size_t point) const { return isApart(step, point, speedOf(point)); }
    bool isClosing(std::size_t point) const { return speedOf(point) > step.solved.slowest; }

    bool carries(std::size_t point) const
    {
        return mayCarry
               || step.solved.result.contactForce[Dim * static_cast<Eigen::Index>(point)] > leastForce;
    }
    /// Points that bonds hold are together already.
    bool mayMeet(std::size_t point) const { return carries(point) && !isBonded(step.program, point); }
    bool collides(std::size_t point) const { return mayMeet(point) && isClosing(point); }
    /// Whether it parts, and is back before the end of the step.
    bool returns(std::size_t point) const
    {
        return mayReturn && mayMeet(point) && speedOf(point) < -step.solved.slowest
               && flies(step, speedOf(point), gapOf(point));
    }
    /// Which of several points that meet at once the step gives its force is one choice of many: at its
    /// start, or where impacts are not located, in it.
    bool meetsNow(std::size_t point, bool isClosedAtEnd) const
    {
        return !isByErrors(step) && !isBonded(step.program, point) && isClosing(point)
               && (isLocated ? !isOpen(point) : isClosedAtEnd);
    }
    bool isImpact(std::size_t point) const { return needsImpact(step, speedOf(point), gapOf(point)); }
    bool meetsLater(std::size_t point) const
    {
        return isLocated && isImpact(point) && (isOpen(point) || returns(point));
    }

    const Step<Dim>& step;
    const Eigen::VectorXd& closing;
    double leastForce; ///< that counts [N]
    bool isLocated;
    bool mayReturn;
    bool mayCarry; ///< all points, whatever force they have
};

/// A pair of bodies that have a point in common; what is fixed is one body, -1, in however many pieces.
template<int Dim>
std::pair<int, int> bodiesAt(const Step<Dim>& step, std::size_t point)
{
    const auto bodyOf = [&step](int block) { return step.scene.free[static_cast<std::size_t>(block)]; };
    return std::minmax({bodyOf(step.points[point].block), bodyOf(step.points[point].neighbour)});
}

/// Finds the structures, bodies that are connected by points, of which too many pairs meet: all their points
/// are `crowded` then.
template<int Dim>
void moveCrowded(const Step<Dim>& step, CollidingPoints& colliding)
{
    std::set<std::pair<int, int>> pairs;
    for (const std::size_t point : colliding.later)
    {
        pairs.insert(bodiesAt(step, point));
    }
    if (pairs.size() <= mostMeetingPairs)
    {
        return;
    }
    DisjointSets structures(step.scene.free.size());
    for (std::size_t point = 0; point < step.points.size(); ++point)
    {
        if (const auto [one, other] = bodiesAt(step, point); one >= 0)
        {
            structures.join(one, other);
        }
    }
    std::vector<std::size_t> pairsOf(step.scene.free.size());
    const auto ofStructure = [&](const std::pair<int, int>& pair) -> std::size_t&
    { return pairsOf[static_cast<std::size_t>(structures.firstOf(pair.second))]; };
    for (const auto& pair : pairs)
    {
        ++ofStructure(pair);
    }
    const auto isCrowded = [&](std::size_t point)
    { return ofStructure(bodiesAt(step, point)) > mostMeetingPairs; };
    for (std::vector<std::size_t>* together : {&colliding.now, &colliding.later})
    {
        const auto crowded =
            std::stable_partition(together->begin(), together->end(), std::not_fn(isCrowded));
        colliding.crowded.insert(colliding.crowded.end(), crowded, together->end());
        together->erase(crowded, together->end());
    }
    std::sort(colliding.crowded.begin(), colliding.crowded.end());
}

} // namespace

template<int Dim>
std::vector<std::size_t> withOthersApart(const Step<Dim>& step, const Eigen::VectorXd& closing,
                                         const CollidingPoints& colliding)
{
    const auto isIn = [](const std::vector<std::size_t>& points, std::size_t point)
    { return std::binary_search(points.begin(), points.end(), point); };
    std::vector<std::size_t> apart;
    for (std::size_t point = 0; point < step.points.size(); ++point)
    {
        const double speed = closing[Dim * static_cast<Eigen::Index>(point)];
        const bool mayMeet =
            speed > step.solved.slowest && isApart(step, point, speed) && !isIn(colliding.crowded, point);
        if (mayMeet || isIn(colliding.later, point))
        {
            apart.push_back(point);
        }
    }
    return apart;
}

template<int Dim>
CollidingPoints collidingPoints(const Step<Dim>& step, const Eigen::VectorXd& closing)
{
    const PointMotions<Dim> motions(step, closing);
    std::vector<std::size_t> points(static_cast<std::size_t>(step.program.points()));
    std::iota(points.begin(), points.end(), 0);
    const auto mayCollide = [&motions](std::size_t point)
    { return motions.collides(point) || motions.returns(point); };
    if (std::none_of(points.begin(), points.end(), mayCollide))
    {
        return {};
    }
    const std::vector<char> isClosed = closedAtEnd(step);
    const auto takesPart = [&](std::size_t point)
    { return (motions.carries(point) && isClosed[point]) || motions.meetsNow(point, isClosed[point]); };
    std::erase_if(points, std::not_fn(takesPart));
    const auto rebounds = [&](std::size_t point) {
        return (motions.collides(point) || motions.meetsNow(point, isClosed[point]))
               && motions.isImpact(point);
    };

    CollidingPoints colliding;
    for (const std::size_t point : points)
    {
        (motions.meetsLater(point) ? colliding.later : colliding.now).push_back(point);
    }
    moveCrowded(step, colliding);
    for (std::vector<std::size_t>* together : {&colliding.now, &colliding.crowded})
    {
        if (std::none_of(together->begin(), together->end(), rebounds))
        {
            together->clear(); // at rest
        }
    }
    colliding.isReturning = std::none_of(points.begin(), points.end(), rebounds);
    colliding.all = std::move(points);
    return colliding;
}

template double slowestRebound(const Step<2>& step);
template bool isReduced(const Step<2>& step);
template bool isByErrors(const Step<2>& step);
template CollidingPoints collidingPoints(const Step<2>& step, const Eigen::VectorXd& closing);
template std::vector<std::size_t> withOthersApart(const Step<2>& step, const Eigen::VectorXd& closing,
                                                  const CollidingPoints& colliding);
template double slowestRebound(const Step<3>& step);
template bool isReduced(const Step<3>& step);
template bool isByErrors(const Step<3>& step);
template CollidingPoints collidingPoints(const Step<3>& step, const Eigen::VectorXd& closing);
template std::vector<std::size_t> withOthersApart(const Step<3>& step, const Eigen::VectorXd& closing,
                                                  const CollidingPoints& colliding);

} // namespace drystone
