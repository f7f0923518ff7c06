// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a step that gives the blocks their new placements and velocities.
#include "dynamics/CarriedMotion.h"
#include "dynamics/Step.h"

#include <initializer_list>

namespace drystone
{
namespace
{

/// Of the step: a velocity that jumps at its begin does so before it, and one that jumps at its end after it.
constexpr double instant = 1e-6;

/// What a body that stands on a support moves by, and velocities of the support [m, m/s].
struct Standing
{
    Eigen::VectorXd displacement;    ///< in the step
    Eigen::VectorXd velocityAtBegin; ///< of the step, as velocities at the mass centres of bodies
};

template<int Dim>
Standing standingIn(const Step<Dim>& step)
{
    if (step.scheme.theta == 1)
    {
        return {};
    }
    const double begin = step.motion.state.time;
    return {carriedDisplacement(step), carriedVelocity(step, begin, begin + instant * step.scheme.timeStep)};
}

/// The velocity at the end of the step of bodies that stand on a support. While it is accelerated by a, the
/// rule, v1 = (dx/dt - (1-theta) v0)/theta, keeps them (theta - 1/2) a dt behind the support: only so is
/// their inertia that of a. With the velocity of the support itself it would be that of a/(2 theta).
template<int Dim>
Eigen::VectorXd standingVelocity(const Step<Dim>& step, const Standing& standing)
{
    const double end = step.motion.state.time;
    const Eigen::VectorXd velocity = carriedVelocity(step, end - instant * step.scheme.timeStep, end);
    return velocity.size() > 0
               ? Eigen::VectorXd(velocity - (step.scheme.theta - 0.5) * (velocity - standing.velocityAtBegin))
               : velocity;
}

/// Bodies that joints hold in their places over the whole step are at rest at its end, or move as the support
/// does that carries all. The rule, v1 = (dx/dt - (1-theta) v0)/theta, would turn the velocity round that a
/// body had when it stopped sliding in the last step, -(1-theta)/theta v0: with theta 1/2 for ever, and its
/// shear with it, between mu N and -mu N. What it still had is lost. A body that flies or rocks may be back
/// where it was after a step, too, but in no case to this part of the way that its velocity would take it,
/// and not on as many points that press.
template<int Dim>
void stopWhatStands(Step<Dim>& step, const Standing& carried)
{
    constexpr double partOfWay = 1e-6;
    const StepProgram<Dim>& program = step.program;
    const Eigen::VectorXd& force = step.solved.result.contactForce;
    if (step.scheme.theta == 1 || program.hasCompliance() || force.size() == 0)
    {
        return;
    }
    std::vector<int> pressing(static_cast<std::size_t>(program.bodies), 0);
    for (std::size_t point = 0; point < program.contacts.size(); ++point)
    {
        for (const int body : {program.contacts[point].first, program.contacts[point].second})
        {
            if (body >= 0 && force[Dim * static_cast<Eigen::Index>(point)] > 0)
            {
                ++pressing[static_cast<std::size_t>(body)];
            }
        }
    }
    const Eigen::VectorXd velocities = standingVelocity(step, carried);
    const double timeStep = step.scheme.timeStep;
    for (int body = 0; body < program.bodies; ++body)
    {
        const auto own = [body](const Eigen::VectorXd& motion) -> BlockVector<Dim>
        {
            return motion.size() > 0
                       ? BlockVector<Dim>(motion.segment<freedomCount<Dim>>(freedomCount<Dim> * body))
                       : BlockVector<Dim>(BlockVector<Dim>::Zero());
        };
        const auto farthest = [&step](const BlockVector<Dim>& motion)
        { return farthestMotion<Dim>(Eigen::VectorXd(motion), step.settings.blockSize); };
        const BlockVector<Dim> way = own(carried.displacement);
        const BlockVector<Dim> standing = own(velocities);
        auto velocity =
            step.motion.state.velocity.template segment<freedomCount<Dim>>(freedomCount<Dim> * body);
        if (pressing[static_cast<std::size_t>(body)] >= Dim && velocity != standing
            && farthest(own(step.solved.result.displacement) - way)
                   <= partOfWay * farthest(timeStep * own(step.solved.velocity) - way))
        {
            // The support stops it by an impulse M (s - v) and works on it by s: of the change of the kinetic
            // energy, (s'M s - v'M v)/2, only -(s - v)'M (s - v)/2 is a loss.
            const BlockVector<Dim> change = standing - velocity;
            step.lostInStopping += 0.5 * squareOf(step.mass, body, change);
            step.solved.workOfSupports += standing.dot(times(step.mass, body, change));
            velocity = standing;
        }
    }
}

/// Moves the blocks that fly on by the flight. In space a turn beyond the step's is no turn after it, and the
/// velocity is that which makes the mean. \param start where the blocks were, in space
template<int Dim>
void fly(Step<Dim>& step, const std::vector<Placement<Dim>>& start)
{
    DynamicState<Dim>& state = step.motion.state;
    StepSolution& solved = step.solved;
    if constexpr (Dim == 2)
    {
        state.placements = moved(std::move(state.placements), step.scene.free, solved.flight);
        solved.result.displacement += solved.flight;
        return;
    }
    solved.result.displacement += solved.flight;
    const std::vector<Placement<Dim>> flown = moved(start, step.scene.free, solved.result.displacement);
    for (std::size_t block = 0; block < step.scene.free.size(); ++block)
    {
        const Eigen::Index row = freedomCount<Dim> * step.scene.free[block];
        if (row < 0 || solved.flight.template segment<freedomCount<Dim>>(row).isZero(0))
        {
            continue;
        }
        state.placements[block] = flown[block];
        const BlockVector<Dim> displacement =
            solved.result.displacement.template segment<freedomCount<Dim>>(row);
        BlockVector<Dim> velocity = 2 / step.scheme.timeStep * displacement
                                    - solved.velocity.template segment<freedomCount<Dim>>(row);
        step.velocityAtEnd.template segment<freedomCount<Dim>>(row) = velocity;
        state.velocity.template segment<freedomCount<Dim>>(row) =
            turnedWithBlocks<Dim>(Eigen::VectorXd(velocity), Eigen::VectorXd(displacement));
    }
}

template<int Dim>
void moveBlocks(Step<Dim>& step)
{
    DynamicState<Dim>& state = step.motion.state;
    StepSolution& solved = step.solved;
    const bool isAnyFlying = solved.flight.size() > 0;
    const std::vector<Placement<Dim>> start =
        Dim == 3 && isAnyFlying ? state.placements : std::vector<Placement<Dim>>();
    const Standing carried = standingIn(step);
    state.velocity = solved.velocity;
    step.velocityAtEnd = advance(state, step.scene.free, solved.result.displacement, step.scheme);
    moveWithSupports(state.placements, step.supports);
    stopWhatStands(step, carried);
    if (!isAnyFlying)
    {
        return;
    }
    fly(step, start);
    if (solved.result.closing.size() > 0)
    {
        solved.result.closing += applyTransposed(step.program, solved.flight);
    }
    const Eigen::VectorXd change = step.velocityAtEnd - solved.velocity;
    for (int body = 0; body < step.program.bodies; ++body)
    {
        const Eigen::Index row = freedomCount<Dim> * body;
        const bool flies = !solved.flight.segment<freedomCount<Dim>>(row).isZero(0);
        step.keptInFlight += flies ? (step.scheme.theta - 0.5)
                                         * squareOf(step.mass, body, change.segment<freedomCount<Dim>>(row))
                                   : 0;
    }
}

} // namespace

template<int Dim>
void move(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::move);
    moveBlocks(step);
    if (step.motion.contacts)
    {
        step.motion.contacts->measure(step.motion.state.placements, step.pointsAtEnd);
    }
    else
    {
        step.pointsAtEnd = step.points;
    }
}

template void move(Step<2>& step);
template void move(Step<3>& step);

} // namespace drystone
