// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The second stage of a step: the program of rigid blocks, and what the last step tells about its solution.
#include "dynamics/Step.h"

#include <algorithm>
#include <numeric>

namespace drystone
{
namespace
{

/// Which point of the last step each of this one is, or -1 where it is new.
template<int Dim>
std::vector<int> pointsOfLastStep(const Motion<Dim>& motion, const std::vector<ContactPoint<Dim>>& points)
{
    std::vector<int> old(points.size(), -1);
    if (!motion.contacts)
    {
        std::iota(old.begin(), old.end(), 0); // they stay as built
        return old;
    }
    // Both lists are sorted by (block, neighbour); a pair has a handful of points.
    std::size_t first = 0;
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        const auto pairOf = [](const ContactPoint<Dim>& p) { return std::pair(p.block, p.neighbour); };
        while (first < motion.points.size() && pairOf(motion.points[first]) < pairOf(points[point]))
        {
            ++first;
        }
        for (std::size_t there = first;
             there < motion.points.size() && pairOf(motion.points[there]) == pairOf(points[point]); ++there)
        {
            if (isSameFeature<Dim>(motion.points[there].feature, points[point].feature))
            {
                old[point] = static_cast<int>(there);
            }
        }
    }
    return old;
}

/// What the points of the last step had, Dim numbers each, at those of this one; zero where a point is new.
/// \param valueOf a point of the last step
template<int Dim, typename ValueOf>
Eigen::VectorXd atPoints(const std::vector<int>& old, const ValueOf& valueOf)
{
    Eigen::VectorXd values = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(old.size()));
    for (std::size_t point = 0; point < old.size(); ++point)
    {
        if (old[point] >= 0)
        {
            values.segment<Dim>(Dim * static_cast<Eigen::Index>(point)) = valueOf(old[point]);
        }
    }
    return values;
}

/// A step's guess: where the blocks are heading, and what the last step knew of its points.
template<int Dim>
StepGuess guessFrom(const Motion<Dim>& motion, const std::vector<ContactPoint<Dim>>& points, double timeStep)
{
    const std::vector<int> old = pointsOfLastStep(motion, points);
    const auto of = [](const Eigen::VectorXd& values)
    { return [&values](int point) { return values.segment<Dim>(Dim * point); }; };
    StepGuess guess;
    guess.displacement = timeStep * motion.state.velocity;
    guess.contactForce =
        atPoints<Dim>(old, [&](int point) { return motion.contactForces[static_cast<std::size_t>(point)]; });
    if (const InteriorStart& interior = motion.interior; !interior.isEmpty())
    {
        guess.interior = {atPoints<Dim>(old, of(interior.contactForce)),
                          atPoints<Dim>(old, of(interior.opening)), interior.displacement};
    }
    return guess;
}

} // namespace

template<int Dim>
void assemble(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::assemble);
    step.program = thetaStepProgram(step.mass, step.motion.state.velocity, step.load, step.points,
                                    step.columns, frictionAt(step.scene, step.points), step.scheme);
    step.loadAtStart = step.program.load;
    step.guess = guessFrom(step.motion, step.points, step.scheme.timeStep);
}

template void assemble(Step<2>& step);
template void assemble(Step<3>& step);

} // namespace drystone
