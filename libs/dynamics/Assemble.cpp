// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The second stage of a step: the program of rigid blocks, and what the last step says of its solution.
#include "contact/PointsOfPair.h"
#include "dynamics/Step.h"

#include <algorithm>
#include <numeric>

namespace drystone
{
namespace
{

/// Whether the points of a step are those of all others.
enum class PointLayout
{
    asBuilt, ///< they are, in the same order
    followed ///< they are found anew where the blocks are
};

template<int Dim>
PointLayout layoutOf(const Motion<Dim>& motion)
{
    return motion.contacts ? PointLayout::followed : PointLayout::asBuilt;
}

/// Which of the points of an earlier step, or of another attempt, each of this one is, or -1 where it is new.
template<int Dim>
std::vector<int> pointsAmong(const std::vector<ContactPoint<Dim>>& earlier,
                             const std::vector<ContactPoint<Dim>>& points, PointLayout layout)
{
    std::vector<int> old(points.size(), -1);
    const auto isSame = [](const ContactPoint<Dim>& one, const ContactPoint<Dim>& other)
    { return pairOf(one) == pairOf(other) && isSameFeature<Dim>(one.feature, other.feature); };
    if (layout == PointLayout::asBuilt // in motion too most steps have the points of the last one
        || std::equal(earlier.begin(), earlier.end(), points.begin(), points.end(), isSame))
    {
        std::iota(old.begin(), old.end(), 0);
        return old;
    }
    auto first = earlier.begin(); // both lists are sorted by pairs
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        const std::pair<int, int> pair = pairOf(points[point]);
        first = std::find_if(first, earlier.end(),
                             [&pair](const ContactPoint<Dim>& other) { return pairOf(other) >= pair; });
        for (auto there = first; there != earlier.end() && pairOf(*there) == pair; ++there)
        {
            if (isSameFeature<Dim>(there->feature, points[point].feature))
            {
                old[point] = static_cast<int>(there - earlier.begin());
            }
        }
    }
    return old;
}

/// Whether one end of a joint of the plane has become the other block's corner, as where blocks of one width
/// slide over each other: each corner is an end of the edge that the other one was against.
bool havePassedEachOther(const ContactFeature& a, const ContactFeature& b)
{
    // Edge i runs from corner i to the next one, and the last edge to corner 0.
    const auto isEnd = [](int vertex, int edge)
    { return vertex == edge || vertex == edge + 1 || (vertex == 0 && edge > 1); };
    return a.vertexBlock != b.vertexBlock && isEnd(a.vertex, b.edge) && isEnd(b.vertex, a.edge);
}

/// Adds the points of a step that were another corner's in the one before: they are at its place, and springs
/// there keep their shear. \param old as pointsAmong has found it
void addPointsPassed(const std::vector<ContactPoint<2>>& earlier, const std::vector<ContactPoint<2>>& points,
                     std::vector<int>& old)
{
    std::vector<char> isTaken(earlier.size(), 0);
    for (const int there : old)
    {
        if (there >= 0)
        {
            isTaken[static_cast<std::size_t>(there)] = 1;
        }
    }
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        if (old[point] >= 0)
        {
            continue;
        }
        const auto [first, last] =
            entriesOf(pairOf(points[point]), earlier.begin(), earlier.end(), pairOf<2>);
        const auto there =
            std::find_if(first, last,
                         [&](const ContactPoint<2>& other)
                         {
                             return !isTaken[static_cast<std::size_t>(&other - earlier.data())]
                                    && havePassedEachOther(other.feature, points[point].feature);
                         });
        if (there != last)
        {
            old[point] = static_cast<int>(there - earlier.begin());
            isTaken[static_cast<std::size_t>(old[point])] = 1;
        }
    }
}

/// What earlier points had, Dim numbers each, at those of this step; zero where a point is new.
/// \param valueOf an earlier point
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

/// Which of the points of the last step each of this one is, see pointsAmong; where points are springs, whose
/// forces are not a guess, also that of another corner at its place.
template<int Dim>
std::vector<int> pointsOfLastStep(const Step<Dim>& step)
{
    const Motion<Dim>& motion = step.motion;
    std::vector<int> old = pointsAmong<Dim>(motion.points, step.points, layoutOf(motion));
    if constexpr (Dim == 2)
    {
        if (traitsOf(step.scene.effects).isCompliant && motion.contacts)
        {
            addPointsPassed(motion.points, step.points, old);
        }
    }
    return old;
}

/// A step's guess: where the blocks move to, and what the last step knew of its points.
/// \param old as pointsOfLastStep has found it
template<int Dim>
StepGuess guessFrom(const Motion<Dim>& motion, const std::vector<int>& old, double timeStep)
{
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

/// Friction coefficient of each point, by name only where the blocks were never near each other before.
template<int Dim>
std::vector<double> learnFriction(const Step<Dim>& step)
{
    const DynamicCase<Dim>& scene = step.scene;
    FrictionOfJoints& known = step.motion.jointFriction;
    const FrictionOfJoints ofNew = frictionOfNewPairs(scene.contact, scene.assembly, known, step.points);
    const auto before = static_cast<std::ptrdiff_t>(known.size());
    known.insert(known.end(), ofNew.begin(), ofNew.end());
    std::inplace_merge(known.begin(), known.begin() + before, known.end());
    return frictionAt(scene.contact, scene.assembly, known, step.points);
}

} // namespace

template<int Dim>
void assemble(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::assemble);
    step.program = thetaStepProgram(step.mass, step.motion.state.velocity, step.load, step.points,
                                    step.columns, learnFriction(step), step.scheme);
    step.loadAtStart = step.program.load;
    step.guess = guessFrom(step.motion, pointsOfLastStep(step), step.scheme.timeStep);
    if (step.attemptForces && !step.attemptForces->start.forces.empty())
    {
        const PointForces<Dim>& start = step.attemptForces->start;
        step.nearForce =
            atPoints<Dim>(pointsAmong<Dim>(start.points, step.points, layoutOf(step.motion)),
                          [&](int point) { return start.forces[static_cast<std::size_t>(point)]; });
    }
}

template void assemble(Step<2>& step);
template void assemble(Step<3>& step);

} // namespace drystone
