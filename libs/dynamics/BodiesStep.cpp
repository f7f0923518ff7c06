// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The program of bodies, with room for those that creep, and without those that rest.
#include "dynamics/BodiesStep.h"

#include "conic/Certificate.h"
#include "dynamics/TurnedGroups.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// With a buffer programs that need more iterations are given up: what is held makes no way for overlaps.
constexpr int mostIterations = 60;

/// And so much closer they are solved, where the interior point alone gets there: what is held afterwards
/// makes an error too.
constexpr double partOfStepTolerance = 0.1;
constexpr double leastTolerance = 1e-10;

/// Of the error allowed in gaps: at the head of a body it is several times what it is at its foot.
template<int Dim>
constexpr double partOfGapOfBodies = Dim == 2 ? partOfGapWithLess : 0.1 * partOfGapWithLess;

/// Bodies that move by less than this part of the farthest are at rest, if the certificate allows it, or else
/// those that move still less.
constexpr double atRest = 1e-9;
constexpr double leastAtRest = 1e-12;

/// The interior of the bodies' program among all blocks; zero at the points within, as if they were new.
template<int Dim>
InteriorStart interiorOfWhole(const Step<Dim>& step, const BlockGroups<Dim>& groups, const InteriorStart& own)
{
    if (own.isEmpty())
    {
        return {};
    }
    InteriorStart interior;
    interior.contactForce = Eigen::VectorXd::Zero(step.program.gap.size());
    interior.opening = Eigen::VectorXd::Zero(step.program.gap.size());
    putInto<Dim>(groups.outer, own.contactForce, interior.contactForce);
    putInto<Dim>(groups.outer, own.opening, interior.opening);
    interior.displacement = linearDisplacement(groups, own.displacement);
    return interior;
}

/// Closes the points between bodies that creep, or are held, where they overlap by no more than a gap that is
/// kept.
template<int Dim>
void closeOverlaps(const std::vector<char>& creeps, double kept, StepProgram<Dim>& program)
{
    const auto creepsOrIsHeld = [&creeps](int body)
    { return body < 0 || creeps[static_cast<std::size_t>(body)]; };
    for (std::size_t point = 0; point < program.contacts.size(); ++point)
    {
        double& gap = program.gap[Dim * static_cast<Eigen::Index>(point)];
        const auto& contact = program.contacts[point];
        if (gap < 0 && gap >= -kept && creepsOrIsHeld(contact.first) && creepsOrIsHeld(contact.second))
        {
            gap = 0;
        }
    }
}

/// Whether all blocks of each body creep, where there is a buffer of them.
template<int Dim>
std::vector<char> creepingBodies(const BlockGroups<Dim>& groups, const GroupChoice<Dim>& choice)
{
    std::vector<char> creeps(groups.blocks.size(), false);
    for (std::size_t body = 0; choice.hasBuffer() && body < creeps.size(); ++body)
    {
        creeps[body] = std::all_of(groups.blocks[body].begin(), groups.blocks[body].end(),
                                   [&choice](int block) { return choice.isCreeping(block); });
    }
    return creeps;
}

} // namespace

template<int Dim>
BodiesStep<Dim> solveBodies(Step<Dim>& step, BlockGroups<Dim> groups, const GroupChoice<Dim>& choice)
{
    BodiesStep<Dim> bodies;
    bodies.groups = std::move(groups);
    bodies.ofBlocks = programOfBlocks(bodies.groups, step.program);
    bodies.program = programOfGroups(bodies.groups, bodies.ofBlocks);
    const std::vector<char> creeps = creepingBodies(bodies.groups, choice);
    const double kept = keptGap(step);
    closeOverlaps<Dim>(creeps, kept, bodies.program);
    const Relinearisation<Dim> ofGroups =
        relinearisationOfGroups(step, bodies.groups, bodies.ofBlocks, bodies.program);
    Relinearisation<Dim> closed;
    if (ofGroups)
    {
        closed = [&](const Eigen::VectorXd& y, const Eigen::VectorXd& c, StepProgram<Dim>& program)
        {
            const double error = ofGroups(y, c, program);
            closeOverlaps<Dim>(creeps, kept, program);
            return error;
        };
    }
    StepSettings settings = step.settings;
    settings.contactTolerance *= partOfGapOfBodies<Dim>;
    settings.keepsMomenta = Dim == 3 || bodies.groups.areSingle(); // else balancedDisplacement does
    if (choice.hasBuffer())
    {
        settings.solver.maximumIterations = std::min(settings.solver.maximumIterations, mostIterations);
        double& tolerance = settings.solver.tolerance;
        tolerance = std::max(partOfStepTolerance * tolerance, std::min(tolerance, leastTolerance));
    }
    bodies.step = solveThetaStep(bodies.program, settings,
                                 guessOfGroups(bodies.groups, bodies.ofBlocks, bodies.program, step.guess),
                                 closed, step.motion.symbolic.get());
    countWork(step, bodies.step.iterations, bodies.step.factorisations, bodies.step.programs);
    if (bodies.step.status == SolveStatus::optimal)
    {
        bodies.interior = interiorOfWhole(step, bodies.groups, bodies.step.interior);
    }
    return bodies;
}

template<int Dim>
Eigen::VectorXd forcesBetween(const Step<Dim>& step, const BodiesStep<Dim>& bodies)
{
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(step.program.gap.size());
    putInto<Dim>(bodies.groups.outer, bodies.step.contactForce, forces);
    return forces;
}

namespace
{

/// The program that the step is the solution of. With theta 1 its columns are those at the start.
template<int Dim>
StepProgram<Dim> lastProgram(const BodiesStep<Dim>& bodies)
{
    StepProgram<Dim> program = bodies.program;
    if (bodies.step.load.size() > 0)
    {
        program.load = bodies.step.load;
        program.gap = bodies.step.gap;
    }
    return program;
}

/// How far the step moves the farthest of the blocks of each body [m].
template<int Dim>
std::vector<double> motions(const BodiesStep<Dim>& bodies, double blockSize)
{
    const std::vector<double> ofBlocks =
        motionsOfBlocks<Dim>(displacementOfBlocks(bodies.groups, bodies.step.displacement), blockSize);
    std::vector<double> moved(bodies.groups.blocks.size(), 0);
    for (std::size_t body = 0; body < moved.size(); ++body)
    {
        for (const int block : bodies.groups.blocks[body])
        {
            moved[body] = std::max(moved[body], ofBlocks[static_cast<std::size_t>(block)]);
        }
    }
    return moved;
}

/// Holds bodies. \param moved by the step, each [m] \param most by which those move that are to be held [m]
/// \return whether that leaves a solution; otherwise nothing is changed
template<int Dim>
bool holdBodies(const Step<Dim>& step, BodiesStep<Dim>& bodies, const std::vector<double>& moved, double most)
{
    std::vector<char> isKept(moved.size());
    std::transform(moved.begin(), moved.end(), isKept.begin(), [most](double own) { return own > most; });
    const auto left = partWithOthersHeld(lastProgram(bodies), isKept);
    std::vector<int> group = bodies.groups.group;
    for (int& ofBlock : group)
    {
        ofBlock = ofBlock >= 0 && isKept[static_cast<std::size_t>(ofBlock)] ? ofBlock : -1;
    }
    BlockGroups<Dim> groups = blockGroups(step, std::move(group));
    ConeSolution solution;
    solution.displacement = takenFrom<freedomCount<Dim>>(left.bodies, bodies.step.displacement);
    solution.contactForce = takenFrom<Dim>(left.points, bodies.step.contactForce);
    const Certificate certificate = certifyOptimal(left.program, solution);
    if (certificate.worst() > step.settings.solver.tolerance)
    {
        return false;
    }
    Eigen::VectorXd load = std::move(bodies.ofBlocks.load);
    bodies.ofBlocks = programOfBlocks(groups, step.program);
    bodies.ofBlocks.load = std::move(load);
    bodies.program = programOfGroups(groups, bodies.ofBlocks);
    bodies.groups = std::move(groups);
    bodies.step.certificate = certificate;
    bodies.step.displacement = std::move(solution.displacement);
    bodies.step.contactForce = std::move(solution.contactForce);
    return true;
}

} // namespace

template<int Dim>
void holdBodiesAtRest(const Step<Dim>& step, BodiesStep<Dim>& bodies)
{
    const std::vector<double> moved = motions(bodies, step.scene.blockSize);
    const double farthest = *std::max_element(moved.begin(), moved.end());
    for (double part = atRest; part >= leastAtRest; part /= 10)
    {
        if (holdBodies(step, bodies, moved, part * farthest))
        {
            return;
        }
    }
}

template BodiesStep<2> solveBodies(Step<2>& step, BlockGroups<2> groups, const GroupChoice<2>& choice);
template void holdBodiesAtRest(const Step<2>& step, BodiesStep<2>& bodies);
template Eigen::VectorXd forcesBetween(const Step<2>& step, const BodiesStep<2>& bodies);
template BodiesStep<3> solveBodies(Step<3>& step, BlockGroups<3> groups, const GroupChoice<3>& choice);
template void holdBodiesAtRest(const Step<3>& step, BodiesStep<3>& bodies);
template Eigen::VectorXd forcesBetween(const Step<3>& step, const BodiesStep<3>& bodies);

} // namespace drystone
