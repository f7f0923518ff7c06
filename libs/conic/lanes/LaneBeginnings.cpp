// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The paths of the references, and which of their iterates is the best one to begin at.
#include "conic/lanes/LaneBeginnings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace drystone
{
namespace
{

/// Mean products s z of scaled programs.
constexpr std::array<double, 5> complementarities{3e-2, 3e-3, 3e-4, 3e-5, 3e-6};

/// Of the square of the difference of two programs: the complementarity at which one is best begun from the
/// other, measured (test/benchmark/results/TUNING.md).
constexpr double ofSquare = 0.3;

/// Forces that carry the dead load alone are sought with less friction first: they carry it with any friction
/// from there on.
constexpr std::array<double, 2> sharesOfFriction{0.35, 0.65};

/// The multiple of `other` that is nearest to `rows`, and how far it is away relative to it.
std::pair<double, double> multipleOf(const Eigen::VectorXd& rows, const Eigen::VectorXd& other)
{
    if (rows == other)
    {
        return {1, 0};
    }
    const double square = other.squaredNorm();
    const double share = square > 0 ? rows.dot(other) / square : 0;
    if (!(share > 0))
    {
        return {1, 1};
    }
    return {share, (rows - share * other).norm() / (share * std::sqrt(square))};
}

} // namespace

LaneBeginnings::LaneBeginnings(LaneGeometry& geometry, const LaneKernel& kernel,
                               const std::vector<PlaneConeProgram>& programs, double ofTask)
    : tolerance(ofTask), references(programs.size())
{
    for (std::size_t index = 0; index < programs.size(); ++index)
    {
        const PlaneConeProgram& program = programs[index];
        references[index].program = &program;
        references[index].friction = geometry.frictionOfFaces(program);
        references[index].load = program.load;
        references[index].liveLoad = program.liveLoad;
    }
    geometry.task.tolerance = tolerance;
    const auto lanes = static_cast<std::size_t>(kernel.lanes);
    for (std::size_t first = 0; first < references.size(); first += lanes)
    {
        std::vector<Reference*> together;
        for (std::size_t index = first; index < std::min(first + lanes, references.size()); ++index)
        {
            together.push_back(&references[index]);
        }
        for (const double share : sharesOfFriction)
        {
            seekRest(geometry, kernel, together, share);
        }
        follow(geometry, kernel, std::move(together));
    }
    std::erase_if(references, [](const Reference& reference) { return reference.stages.empty(); });
}

/// \param of at most as many as there are lanes
void LaneBeginnings::seekRest(LaneGeometry& geometry, const LaneKernel& kernel,
                              const std::vector<Reference*>& of, double share)
{
    std::vector<PlaneConeProgram> programs;
    for (const Reference* reference : of)
    {
        programs.push_back(*reference->program);
        for (double& friction : programs.back().friction)
        {
            friction *= share;
        }
    }
    std::vector<const PlaneConeProgram*> ofLane;
    for (const PlaneConeProgram& program : programs)
    {
        ofLane.push_back(&program);
    }
    ofLane.resize(static_cast<std::size_t>(kernel.lanes), ofLane.front());
    geometry.setPrograms(ofLane);
    geometry.task.complementarity = complementarities.front();
    geometry.task.isBegun = false;
    kernel.solve(geometry.task);
    for (std::size_t lane = 0; lane < of.size(); ++lane)
    {
        std::vector<double> resting = geometry.restingOf(static_cast<int>(lane));
        if (!of[lane]->resting.empty() || resting.empty())
        {
            continue;
        }
        for (std::size_t ray = 0; ray < resting.size(); ray += 2)
        {
            // The same normal force and shear of rays that are farther apart.
            const double sum = 0.5 * (resting[ray] + resting[ray + 1]);
            const double difference = 0.5 * share * (resting[ray] - resting[ray + 1]);
            resting[ray] = sum + difference;
            resting[ray + 1] = sum - difference;
        }
        of[lane]->resting = std::move(resting);
    }
}

/// \param going at most as many as there are lanes
void LaneBeginnings::follow(LaneGeometry& geometry, const LaneKernel& kernel, std::vector<Reference*> going)
{
    for (const double complementarity : complementarities)
    {
        if (going.empty())
        {
            return;
        }
        std::vector<const PlaneConeProgram*> ofLane;
        for (const Reference* reference : going)
        {
            ofLane.push_back(reference->program);
        }
        ofLane.resize(static_cast<std::size_t>(kernel.lanes), going.front()->program);
        geometry.setPrograms(ofLane);
        geometry.task.complementarity = complementarity;
        geometry.task.isBegun = !going.front()->stages.empty();
        for (int lane = 0; lane < kernel.lanes && geometry.task.isBegun; ++lane)
        {
            const Reference& reference = *going[static_cast<std::size_t>(lane) < going.size() ? lane : 0];
            setBegin(geometry, reference, reference.stages.back(), {}, lane);
        }
        kernel.solve(geometry.task);
        std::vector<Reference*> next;
        for (std::size_t lane = 0; lane < going.size(); ++lane)
        {
            const int of = static_cast<int>(lane);
            if (geometry.task.ends[lane].isAnswered)
            {
                Reference& reference = *going[lane];
                reference.scale = geometry.scaleOf(of);
                reference.stages.push_back(geometry.iterateOf(of));
                if (reference.resting.empty())
                {
                    reference.resting = geometry.restingOf(of);
                }
                next.push_back(&reference);
            }
        }
        going = std::move(next);
    }
}

void LaneBeginnings::begin(LaneGeometry& geometry, const PlaneConeProgram& program, int lane) const
{
    const std::vector<double> friction = geometry.frictionOfFaces(program);
    const Reference* nearest = &references.front();
    Difference least = differenceOf(friction, program, *nearest);
    for (const Reference& reference : references)
    {
        const Difference difference = differenceOf(friction, program, reference);
        if (difference.size < least.size)
        {
            least = difference;
            nearest = &reference;
        }
    }
    // Stages are ten times apart: the one that is nearest in its logarithm.
    const double best = std::sqrt(10.0) * ofSquare * least.size * least.size;
    std::size_t stage = 0;
    while (stage + 1 < nearest->stages.size() && complementarities[stage] > best)
    {
        ++stage;
    }
    setBegin(geometry, *nearest, nearest->stages[stage], least, lane);
}

LaneBeginnings::Difference LaneBeginnings::differenceOf(const std::vector<double>& friction,
                                                        const PlaneConeProgram& program,
                                                        const Reference& reference)
{
    double ofFriction = 0;
    for (std::size_t face = 0; face < friction.size(); ++face)
    {
        ofFriction = std::max(ofFriction, std::abs(friction[face] - reference.friction[face])
                                              / std::min(friction[face], reference.friction[face]));
    }
    const auto [load, ofLoad] = multipleOf(program.load, reference.load);
    const auto [liveLoad, ofLiveLoad] = multipleOf(program.liveLoad, reference.liveLoad);
    return {ofFriction + ofLoad + ofLiveLoad, load, liveLoad};
}

void LaneBeginnings::setBegin(LaneGeometry& geometry, const Reference& reference, const LaneIterate& iterate,
                              const Difference& difference, int lane)
{
    const LaneScale& scale = geometry.scaleOf(lane);
    const double forces = difference.load * reference.scale.load / scale.load;
    const double alpha = forces / (difference.liveLoad * reference.scale.liveLoad / scale.liveLoad);
    geometry.task.begins[lane] = {.friction = reference.friction.data(),
                                  .s = iterate.s.data(),
                                  .z = iterate.z.data(),
                                  .y = iterate.y.data(),
                                  .resting = reference.resting.empty() ? nullptr : reference.resting.data(),
                                  .alpha = alpha * iterate.alpha,
                                  .forces = forces,
                                  // The live load does unit work on the mechanism.
                                  .openings = reference.scale.displacement
                                              / (difference.liveLoad * scale.displacement)};
}

} // namespace drystone
