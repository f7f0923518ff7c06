// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a step that gives the blocks their new placements and velocities.
#include "dynamics/Step.h"

#include <algorithm>
#include <initializer_list>

namespace drystone
{
namespace
{

/// What a step gives a block that is fixed to a support: it moves by `way` and has `velocity` at the end.
template<int Dim>
struct CarriedMotion
{
    BlockVector<Dim> way = BlockVector<Dim>::Zero();
    BlockVector<Dim> velocity = BlockVector<Dim>::Zero();
};

/// The motions of all free blocks, were they fixed to the supports; zero where these rest, or are several,
/// which may move apart. The placements are those at the end of the step.
template<int Dim>
std::vector<CarriedMotion<Dim>> carriedMotions(const Step<Dim>& step)
{
    const DynamicCase<Dim>& scene = step.scene;
    const std::vector<Placement<Dim>>& ends = step.motion.state.placements;
    std::vector<CarriedMotion<Dim>> carried(static_cast<std::size_t>(step.program.bodies));
    if (step.supports.empty() || scene.assembly.supports.size() != 1)
    {
        return carried;
    }
    const auto fixed =
        static_cast<std::size_t>(std::find(scene.free.begin(), scene.free.end(), -1) - scene.free.begin());
    constexpr double last = 1e-6; // of the step: a velocity that jumps at its end does so after it
    const double end = step.motion.state.time;
    const BlockVector<Dim> velocity =
        velocitiesOfAllBlocks(scene, step.motion.state, end - last * step.scheme.timeStep, end)[fixed];
    const Turn<Dim> spin = turnOf<Dim>(velocity.template tail<rotationCount<Dim>>());
    const auto centreOf = [&](std::size_t block) -> Vector<Dim>
    { return scene.blocks[block].centroid + ends[block].translation; };
    const Vector<Dim> way = displacementAfter(step.supports[fixed]).template head<Dim>();
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        if (scene.free[block] < 0)
        {
            continue;
        }
        const Eigen::Index row = freedomCount<Dim> * scene.free[block];
        const Vector<Dim> arm = centreOf(block) - centreOf(fixed);
        SupportStep<Dim> own = step.supports[fixed];
        own.arm += arm - (step.solved.result.displacement.template segment<Dim>(row) - way); // at the start
        CarriedMotion<Dim>& motion = carried[static_cast<std::size_t>(scene.free[block])];
        motion.way = displacementAfter(own);
        motion.velocity << velocity.template head<Dim>() + velocityOfArm(spin, arm), rowsOf(spin);
    }
    return carried;
}

/// Bodies that joints hold in their places over the whole step are at rest at its end, or move as the support
/// does that carries all. The rule, v1 = (dx/dt - (1-theta) v0)/theta, would turn the velocity round that a
/// body had when it stopped sliding in the last step, -(1-theta)/theta v0: with theta 1/2 for ever, and its
/// shear with it, between mu N and -mu N. What it still had is lost. A body that flies or rocks may be back
/// where it was after a step, too, but in no case to this part of the way that its velocity would take it,
/// and not on as many points that press.
template<int Dim>
void stopWhatStands(Step<Dim>& step)
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
    const std::vector<CarriedMotion<Dim>> carried = carriedMotions(step);
    const double timeStep = step.scheme.timeStep;
    for (int body = 0; body < program.bodies; ++body)
    {
        const auto own = [body](const Eigen::VectorXd& motion) -> BlockVector<Dim>
        { return motion.segment<freedomCount<Dim>>(freedomCount<Dim> * body); };
        const auto farthest = [&step](const BlockVector<Dim>& motion)
        { return farthestMotion<Dim>(Eigen::VectorXd(motion), step.settings.blockSize); };
        const auto& [way, velocityCarried] = carried[static_cast<std::size_t>(body)];
        auto velocity =
            step.motion.state.velocity.template segment<freedomCount<Dim>>(freedomCount<Dim> * body);
        if (pressing[static_cast<std::size_t>(body)] >= Dim && velocity != velocityCarried
            && farthest(own(step.solved.result.displacement) - way)
                   <= partOfWay * farthest(timeStep * own(step.solved.velocity) - way))
        {
            step.lostInStopping += 0.5
                                   * (squareOf(step.mass, body, BlockVector<Dim>(velocity))
                                      - squareOf(step.mass, body, velocityCarried));
            velocity = velocityCarried;
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
    state.velocity = solved.velocity;
    step.velocityAtEnd = advance(state, step.scene.free, solved.result.displacement, step.scheme);
    moveWithSupports(state.placements, step.supports);
    stopWhatStands(step);
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
