// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The capacity curve of a structure: limit analysis of each position on the way of its mechanism.
#include "statics/Pushover.h"

#include "assembly/BlockShape.h"
#include "assembly/TurnedLoad.h"
#include "conic/form/Form.h"
#include "statics/PushoverContacts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace drystone
{
namespace
{

/// Gaps up to this, relative to the mean block size, are contacts to come: a block that has lost its support
/// falls onto what is below it.
constexpr double farthestContact = 2;

/// Least work of the live load in a step, relative to its force over the length of the step. Where a block
/// falls or the structure snaps through, the dead load does the work; it may then move farther, up to what it
/// meets.
constexpr double leastWork = 1e-2;

enum class Overlaps
{
    close,
    stay
};

/// What is tried after a program that was not solved.
struct Attempt
{
    double step = 1; ///< factor on the step
    Overlaps overlaps = Overlaps::close;
    double tolerance = 0;
};
constexpr std::array<Attempt, 6> attempts{{{1, Overlaps::stay},
                                           {0.5},
                                           {2, Overlaps::stay, 1e-8},
                                           {2, Overlaps::close, 1e-7},
                                           {2, Overlaps::stay, 1e-6},
                                           {0.25, Overlaps::stay, 1e-6}}};
constexpr int patience = 500; ///< iterations allowed to an attempt

/// What no displacement of a corner exceeds, to first order.
template<int Dim>
double boundOf(const std::vector<double>& radius, const std::vector<int>& free, const Eigen::VectorXd& rates)
{
    double largest = 0;
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] >= 0)
        {
            const auto rate = rates.segment<freedomCount<Dim>>(freedomCount<Dim> * free[block]);
            largest =
                std::max(largest, rate.template head<Dim>().norm()
                                      + radius[block] * rate.template tail<freedomCount<Dim> - Dim>().norm());
        }
    }
    return largest;
}

/// A of the points, about the mass centres where the blocks are now.
template<int Dim>
void setColumns(StaticProgram<Dim>& program, const PushoverScene<Dim>& scene,
                std::vector<BlockMass<Dim>> masses, const std::vector<Placement<Dim>>& placements,
                const std::vector<ContactPoint<Dim>>& points)
{
    for (std::size_t block = 0; block < masses.size(); ++block)
    {
        masses[block].centroid += placements[block].translation;
    }
    program.contacts.clear();
    for (const ContactColumns<Dim>& column : equilibriumColumns(scene.assembly, masses, points))
    {
        program.contacts.push_back({column.block, column.neighbour, column.onBlock, column.onNeighbour});
    }
}

/// The loads where the blocks are.
template<int Dim>
void setLoads(StaticProgram<Dim>& program, const PushoverScene<Dim>& scene, const std::vector<int>& free,
              const std::vector<Placement<Dim>>& placements)
{
    program.load = turnedLoad<Dim>({scene.loads.dead, scene.loads.firstMomentsOfDead}, free, placements);
    program.liveLoad = turnedLoad<Dim>({scene.loads.live, scene.loads.firstMomentsOfLive}, free, placements);
}

/// A structure on its way, position by position: contacts and gaps, the program of the position, and the
/// motion to the next.
template<int Dim>
class PushoverPath
{
public:
    PushoverPath(const PushoverScene<Dim>& structure, const PushoverSettings& pushoverSettings,
                 const InteriorPointSettings& solverSettings, const PushoverObserver<Dim>& observer);

    Pushover follow();

private:
    void findContacts();
    void setGaps();
    bool isFirstPosition() const { return result.curve.empty(); }
    void solvePosition();
    bool fallsByItself();
    PushoverEnd reasonWhyUnsolved();
    void keepPoint();
    void goBackToZero();
    Eigen::VectorXd motionAboutMiddle();
    double followCorners(const std::vector<Placement<Dim>>& to);
    bool moveOn();

    const PushoverScene<Dim>& scene;
    const PushoverSettings& settings;
    const InteriorPointSettings& solver;
    const PushoverObserver<Dim>& observe;

    std::vector<BlockMass<Dim>> masses;
    std::vector<int> free;
    std::vector<double> radius;             ///< of each block, about its mass centre [m]
    std::vector<std::vector<double>> paths; ///< of the corners of each block: how long they are [m]
    double liveForce;                       ///< see liveForceOf
    double margin;                          ///< gaps up to this are contacts to come [m]
    PushoverContacts<Dim> contacts;

    std::vector<Placement<Dim>> placements;
    std::vector<ContactPoint<Dim>> points;
    StaticProgram<Dim> program;
    SymbolicAnalysis symbolic; ///< of the last program: blocks touch the same ones for many steps
    ConeSolution solution;
    double work; ///< of the live load in a step [J]
    CapacityPoint point;
    Pushover result;
};

template<int Dim>
PushoverPath<Dim>::PushoverPath(const PushoverScene<Dim>& structure, const PushoverSettings& pushoverSettings,
                                const InteriorPointSettings& solverSettings,
                                const PushoverObserver<Dim>& observer)
    : scene(structure),
      settings(pushoverSettings),
      solver(solverSettings),
      observe(observer),
      masses(blockMasses(scene.assembly)),
      free(freeIndices(scene.assembly)),
      radius(masses.size(), 0),
      paths(masses.size()),
      liveForce(liveForceOf<Dim>(scene.loads)),
      margin(farthestContact * meanBlockSize(scene.assembly)),
      contacts(scene.assembly),
      placements(scene.assembly.blocks.size())
{
    for (std::size_t block = 0; block < masses.size(); ++block)
    {
        const std::vector<Vector<Dim>>& corners = cornersOf(scene.assembly.blocks[block]);
        paths[block].assign(corners.size(), 0);
        for (const Vector<Dim>& corner : corners)
        {
            radius[block] = std::max(radius[block], (corner - masses[block].centroid).norm());
        }
    }
    program.bodies = static_cast<int>(scene.loads.dead.size() / freedomCount<Dim>);
    work = settings.step * liveForce;
}

/// Points of the position, with the columns and gaps of the program.
template<int Dim>
void PushoverPath<Dim>::findContacts()
{
    points = contacts.update(placements, margin);
    program.friction.assign(points.size(), scene.mu);
    setColumns(program, scene, masses, placements, points);
    setLoads(program, scene, free, placements);
    setGaps();
}

template<int Dim>
void PushoverPath<Dim>::setGaps()
{
    program.gap = Eigen::VectorXd::Zero(Dim * program.points());
    for (int i = 0; i < program.points(); ++i)
    {
        program.gap[Dim * i] = points[i].gap / work; // y of the program belongs to unit work
    }
}

/// Where the program is not solved: a shorter step, overlaps of the last steps that cannot all be undone left
/// as they are, and in the end a coarser tolerance, which the certificate of the point shows.
template<int Dim>
void PushoverPath<Dim>::solvePosition()
{
    solution = solveInteriorPoint(program, solver, &symbolic);
    for (const Attempt& attempt : attempts)
    {
        if (isFirstPosition() || solution.status == SolveStatus::optimal)
        {
            return;
        }
        work *= attempt.step;
        setGaps();
        if (attempt.overlaps == Overlaps::stay)
        {
            program.gap = program.gap.cwiseMax(0);
        }
        InteriorPointSettings coarser = solver;
        coarser.tolerance = std::max(solver.tolerance, attempt.tolerance);
        coarser.maximumIterations = std::max(solver.maximumIterations, patience);
        solution = solveInteriorPoint(program, coarser, &symbolic);
    }
}

/// Whether the blocks cannot carry the dead load where they are.
template<int Dim>
bool PushoverPath<Dim>::fallsByItself()
{
    StaticProgram<Dim> dead = program;
    dead.liveLoad.resize(0);
    dead.gap.resize(0);
    return solveInteriorPoint(dead, solver, &symbolic).status == SolveStatus::infeasible;
}

template<int Dim>
PushoverEnd PushoverPath<Dim>::reasonWhyUnsolved()
{
    if (fallsByItself())
    {
        return isFirstPosition() ? PushoverEnd::unstable : PushoverEnd::falling;
    }
    return solution.status == SolveStatus::unbounded ? PushoverEnd::unbounded : PushoverEnd::notConverged;
}

template<int Dim>
void PushoverPath<Dim>::keepPoint()
{
    result.curve.push_back(point);
    observe(point, placements);
}

/// The place between the last two positions at which the multiplier is zero.
template<int Dim>
void PushoverPath<Dim>::goBackToZero()
{
    if (!isFirstPosition())
    {
        const CapacityPoint& before = result.curve.back();
        const double share = before.alpha / (before.alpha - point.alpha);
        point.displacement = before.displacement + share * (point.displacement - before.displacement);
        point.largest = before.largest + share * (point.largest - before.largest);
    }
    point.alpha = 0;
}

/// The motion by the columns in the middle of the step, with the gaps of its beginning; that of the beginning
/// where the solver does not find it.
template<int Dim>
Eigen::VectorXd PushoverPath<Dim>::motionAboutMiddle()
{
    std::vector<double> gaps;
    for (const ContactPoint<Dim>& at : points)
    {
        gaps.push_back(at.gap);
    }
    const std::vector<Placement<Dim>> middle = pushedOn(placements, free, solution.displacement, work / 2);
    contacts.measure(middle, points);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        points[i].gap = gaps[i];
    }
    setColumns(program, scene, masses, middle, points);
    setLoads(program, scene, free, middle);
    setGaps();
    const ConeSolution motion = solveInteriorPoint(program, solver, &symbolic);
    const bool isFound = motion.status == SolveStatus::optimal;
    result.stepsToFirstOrder += isFound ? 0 : 1;
    return isFound ? motion.displacement : solution.displacement;
}

/// Lengthens the paths of corners by a step. \return the longest path [m]
template<int Dim>
double PushoverPath<Dim>::followCorners(const std::vector<Placement<Dim>>& to)
{
    double longest = 0;
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] < 0)
        {
            continue;
        }
        const auto before = placedCorners(scene.assembly.blocks[block], placements[block]);
        const auto after = placedCorners(scene.assembly.blocks[block], to[block]);
        for (std::size_t corner = 0; corner < before.size(); ++corner)
        {
            paths[block][corner] += (after[corner] - before[corner]).norm();
            longest = std::max(longest, paths[block][corner]);
        }
    }
    return longest;
}

/// \return false where blocks meet without a contact to part them
template<int Dim>
bool PushoverPath<Dim>::moveOn()
{
    const double rate = boundOf<Dim>(radius, free, solution.displacement);
    work = std::max(settings.step / rate, leastWork * settings.step * liveForce);
    const Eigen::VectorXd displacement = motionAboutMiddle();
    std::vector<Placement<Dim>> next = pushedOn(placements, free, displacement, work);
    point.displacement += work / liveForce;
    point.largest = followCorners(next);
    placements = std::move(next);
    result.overlap = contacts.missed(placements);
    return result.overlap.block < 0;
}

template<int Dim>
Pushover PushoverPath<Dim>::follow()
{
    for (int step = 0; step <= settings.maximumSteps; ++step)
    {
        findContacts();
        solvePosition();
        if (solution.status != SolveStatus::optimal)
        {
            result.end = reasonWhyUnsolved();
            if (result.end == PushoverEnd::falling)
            {
                point.alpha = 0;
                keepPoint();
            }
            return std::move(result);
        }
        point.alpha = solution.multiplier;
        point.worst = certify(program, solution).worst();
        point.iterations = solution.iterations;
        // The live load may hold up what does not stand by itself.
        if (isFirstPosition() && (point.alpha < 0 || fallsByItself()))
        {
            result.end = PushoverEnd::unstable;
            return std::move(result);
        }
        const bool isOverturned = point.alpha <= 0;
        if (isOverturned)
        {
            goBackToZero();
        }
        keepPoint();
        if (isOverturned)
        {
            result.end = PushoverEnd::overturned;
            return std::move(result);
        }
        if (!moveOn())
        {
            result.end = PushoverEnd::meeting;
            return std::move(result);
        }
    }
    result.end = PushoverEnd::stepsUsedUp;
    return std::move(result);
}

} // namespace

void declare(Options& options, PushoverSettings& settings)
{
    options.optional("step", settings.step, "largest displacement of any corner in a step")
        .unit("m")
        .above(0);
    options.optional("maximumSteps", settings.maximumSteps, "after which the curve ends").atLeast(1);
}

template<int Dim>
double liveForceOf(const LoadVectors& loads)
{
    double force = 0;
    for (Eigen::Index row = 0; row < loads.live.size(); row += freedomCount<Dim>)
    {
        force += loads.live.segment<Dim>(row).norm();
    }
    return force;
}

template<int Dim>
Pushover solvePushover(const PushoverScene<Dim>& scene, const PushoverSettings& settings,
                       const InteriorPointSettings& solver, const PushoverObserver<Dim>& observe)
{
    return PushoverPath<Dim>(scene, settings, solver, observe).follow();
}

template double liveForceOf<2>(const LoadVectors& loads);
template double liveForceOf<3>(const LoadVectors& loads);
template Pushover solvePushover(const PushoverScene<2>& scene, const PushoverSettings& settings,
                                const InteriorPointSettings& solver, const PushoverObserver<2>& observe);
template Pushover solvePushover(const PushoverScene<3>& scene, const PushoverSettings& settings,
                                const InteriorPointSettings& solver, const PushoverObserver<3>& observe);

} // namespace drystone
