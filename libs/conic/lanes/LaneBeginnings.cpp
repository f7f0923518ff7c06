// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The paths of the references, and which of their iterates is the best one to begin at.
#include "conic/lanes/LaneBeginnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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
    for (const double share : sharesOfFriction)
    {
        seekRest(geometry, kernel, share);
    }
    follow(geometry, kernel);
    std::erase_if(references, [](const Reference& reference) { return reference.stages.empty(); });
}

void LaneBeginnings::seekRest(LaneGeometry& geometry, const LaneKernel& kernel, double share)
{
    std::vector<PlaneConeProgram> programs;
    for (const Reference& reference : references)
    {
        programs.push_back(*reference.program);
        for (double& friction : programs.back().friction)
        {
            friction *= share;
        }
    }
    std::vector<const PlaneConeProgram*> pointers;
    for (const PlaneConeProgram& program : programs)
    {
        pointers.push_back(&program);
    }
    geometry.setPrograms(pointers);
    geometry.task.complementarity = complementarities.front();
    geometry.task.isBegun = false;
    kernel.solve(geometry.task);
    for (std::size_t index = 0; index < references.size(); ++index)
    {
        std::vector<double> resting = geometry.restingOf(index);
        if (!references[index].resting.empty() || resting.empty())
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
        references[index].resting = std::move(resting);
    }
}

void LaneBeginnings::follow(LaneGeometry& geometry, const LaneKernel& kernel)
{
    std::vector<Reference*> going;
    for (Reference& reference : references)
    {
        going.push_back(&reference);
    }
    geometry.task.isBegun = false;
    for (const double complementarity : complementarities)
    {
        if (going.empty())
        {
            return;
        }
        std::vector<const PlaneConeProgram*> programs;
        for (const Reference* reference : going)
        {
            programs.push_back(reference->program);
        }
        geometry.setPrograms(programs);
        geometry.task.complementarity = complementarity;
        for (std::size_t index = 0; index < going.size() && geometry.task.isBegun; ++index)
        {
            const Reference& reference = *going[index];
            geometry.task.programs[index].begin =
                beginAt(geometry.scaleOf(index), reference, reference.stages.back(), {});
        }
        kernel.solve(geometry.task);
        geometry.task.isBegun = true;
        std::vector<Reference*> next;
        for (std::size_t index = 0; index < going.size(); ++index)
        {
            if (geometry.task.programs[index].end.isAnswered)
            {
                Reference& reference = *going[index];
                reference.scale = geometry.scaleOf(index);
                reference.stages.push_back(geometry.iterateOf(index));
                if (reference.resting.empty())
                {
                    reference.resting = geometry.restingOf(index);
                }
                next.push_back(&reference);
            }
        }
        going = std::move(next);
    }
}

void LaneBeginnings::begin(LaneGeometry& geometry, const PlaneConeProgram& program, std::size_t index) const
{
    const std::vector<double> friction = geometry.frictionOfFaces(program);
    const Reference* nearest = nullptr;
    Difference least{.size = std::numeric_limits<double>::infinity()};
    for (const Reference& reference : references)
    {
        const Difference difference = differenceOf(friction, program, reference, least.size);
        if (!nearest || difference.size < least.size)
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
    geometry.task.programs[index].begin =
        beginAt(geometry.scaleOf(index), *nearest, nearest->stages[stage], least);
}

/// \param most above which how large it is does not matter, only that it is larger
LaneBeginnings::Difference LaneBeginnings::differenceOf(const std::vector<double>& friction,
                                                        const PlaneConeProgram& program,
                                                        const Reference& reference, double most)
{
    double ofFriction = 0;
    for (std::size_t face = 0; face < friction.size(); ++face)
    {
        ofFriction = std::max(ofFriction, std::abs(friction[face] - reference.friction[face])
                                              / std::min(friction[face], reference.friction[face]));
        if (ofFriction > most)
        {
            return {.size = ofFriction};
        }
    }
    const auto [load, ofLoad] = multipleOf(program.load, reference.load);
    const auto [liveLoad, ofLiveLoad] = multipleOf(program.liveLoad, reference.liveLoad);
    return {ofFriction + ofLoad + ofLiveLoad, load, liveLoad};
}

/// \param scale of the program that begins
LaneBegin LaneBeginnings::beginAt(const LaneScale& scale, const Reference& reference,
                                  const LaneIterate& iterate, const Difference& difference)
{
    const double forces = difference.load * reference.scale.load / scale.load;
    const double alpha = forces / (difference.liveLoad * reference.scale.liveLoad / scale.liveLoad);
    return {.friction = reference.friction.data(),
            .s = iterate.s.data(),
            .z = iterate.z.data(),
            .y = iterate.y.data(),
            .resting = reference.resting.empty() ? nullptr : reference.resting.data(),
            .alpha = alpha * iterate.alpha,
            .forces = forces,
            // The live load does unit work on the mechanism.
            .openings = reference.scale.displacement / (difference.liveLoad * scale.displacement)};
}

} // namespace drystone
