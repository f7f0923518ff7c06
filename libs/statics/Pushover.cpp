// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/Pushover.h"

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

/// Largest displacement of any corner, to first order.
template<int Dim>
double largestOf(const std::vector<double>& radius, const std::vector<int>& free,
                 const Eigen::VectorXd& rates)
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

const std::vector<Vector<2>>& cornersOf(const Block<2>& block)
{
    return block.outline;
}

const std::vector<Vector<3>>& cornersOf(const Block<3>& block)
{
    return block.shape.vertices;
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
Pushover solvePushover(const PushoverScene<Dim>& scene, const PushoverSettings& settings,
                       const InteriorPointSettings& solver, const PushoverObserver<Dim>& observe)
{
    const std::vector<BlockMass<Dim>> masses = blockMasses(scene.assembly);
    const std::vector<int> free = freeIndices(scene.assembly);
    std::vector<double> radius(masses.size(), 0);
    for (std::size_t block = 0; block < masses.size(); ++block)
    {
        for (const Vector<Dim>& corner : cornersOf(scene.assembly.blocks[block]))
        {
            radius[block] = std::max(radius[block], (corner - masses[block].centroid).norm());
        }
    }
    double liveForce = 0;
    for (Eigen::Index row = 0; row < scene.loads.live.size(); row += freedomCount<Dim>)
    {
        liveForce += scene.loads.live.template segment<Dim>(row).norm();
    }

    StaticProgram<Dim> program;
    program.bodies = static_cast<int>(scene.loads.dead.size() / freedomCount<Dim>);
    program.load = scene.loads.dead;
    program.liveLoad = scene.loads.live;
    PushoverContacts<Dim> contacts(scene.assembly);
    const double margin = farthestContact * meanBlockSize(scene.assembly);
    std::vector<Placement<Dim>> placements(scene.assembly.blocks.size());
    Pushover result;
    CapacityPoint point;
    SymbolicAnalysis symbolic;               // of the last program: blocks touch the same ones for many steps
    double work = settings.step * liveForce; // of the live load in a step
    for (int step = 0; step <= settings.maximumSteps; ++step)
    {
        std::vector<ContactPoint<Dim>> points = contacts.update(placements, margin);
        program.friction.assign(points.size(), scene.mu);
        const auto setGaps = [&]
        {
            program.gap = Eigen::VectorXd::Zero(Dim * program.points());
            for (int i = 0; i < program.points(); ++i)
            {
                program.gap[Dim * i] = points[i].gap / work; // y of the program belongs to unit work
            }
        };
        setColumns(program, scene, masses, placements, points);
        setGaps();
        ConeSolution solution = solveInteriorPoint(program, solver, &symbolic);
        // Where that fails: a shorter step, overlaps of the last steps that cannot all be undone left as they
        // are, and in the end a coarser tolerance, which the certificate of the point tells.
        for (const Attempt& attempt : attempts)
        {
            if (step == 0 || solution.status == SolveStatus::optimal)
            {
                break;
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
        if (solution.status != SolveStatus::optimal)
        {
            StaticProgram<Dim> dead = program;
            dead.liveLoad.resize(0);
            dead.gap.resize(0);
            const bool falls = solveInteriorPoint(dead, solver, &symbolic).status == SolveStatus::infeasible;
            result.end = falls ? (step == 0 ? PushoverEnd::unstable : PushoverEnd::falling)
                         : solution.status == SolveStatus::unbounded ? PushoverEnd::unbounded
                                                                     : PushoverEnd::notConverged;
            if (result.end == PushoverEnd::falling)
            {
                point.alpha = 0;
                result.curve.push_back(point);
                observe(point, placements);
            }
            return result;
        }
        point.alpha = solution.multiplier;
        point.worst = certify(program, solution).worst();
        point.iterations = solution.iterations;
        if (step == 0 && point.alpha < 0)
        {
            result.end = PushoverEnd::unstable;
            return result;
        }
        if (point.alpha <= 0)
        {
            // Between the last two positions.
            const CapacityPoint& before = result.curve.back();
            const double share = before.alpha / (before.alpha - point.alpha);
            point.displacement = before.displacement + share * (point.displacement - before.displacement);
            point.largest = before.largest + share * (point.largest - before.largest);
            point.alpha = 0;
            result.curve.push_back(point);
            observe(point, placements);
            result.end = PushoverEnd::overturned;
            return result;
        }
        result.curve.push_back(point);
        observe(point, placements);

        const double rate = largestOf<Dim>(radius, free, solution.displacement);
        work = std::max(settings.step / rate, leastWork * settings.step * liveForce);
        const std::vector<double> gaps = [&]
        {
            std::vector<double> now;
            for (const ContactPoint<Dim>& at : points)
            {
                now.push_back(at.gap);
            }
            return now;
        }();
        const std::vector<Placement<Dim>> middle =
            pushedOn(placements, free, solution.displacement, work / 2);
        contacts.measure(middle, points);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            points[i].gap = gaps[i];
        }
        setColumns(program, scene, masses, middle, points);
        setGaps();
        ConeSolution motion = solveInteriorPoint(program, solver, &symbolic);
        const Eigen::VectorXd& displacement =
            motion.status == SolveStatus::optimal ? motion.displacement : solution.displacement;
        placements = pushedOn(std::move(placements), free, displacement, work);
        result.overlap = contacts.missed(placements);
        if (result.overlap.block >= 0)
        {
            result.end = PushoverEnd::meeting;
            return result;
        }
        point.displacement += work / liveForce;
        point.largest += work * largestOf<Dim>(radius, free, displacement);
    }
    result.end = PushoverEnd::stepsUsedUp;
    return result;
}

template Pushover solvePushover(const PushoverScene<2>& scene, const PushoverSettings& settings,
                                const InteriorPointSettings& solver, const PushoverObserver<2>& observe);
template Pushover solvePushover(const PushoverScene<3>& scene, const PushoverSettings& settings,
                                const InteriorPointSettings& solver, const PushoverObserver<3>& observe);

} // namespace drystone
