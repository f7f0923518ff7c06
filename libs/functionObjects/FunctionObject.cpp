// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Fills the tables of the function objects from the observation of a step.
#include "functionObjects/FunctionObject.h"

#include "contact/ContactState.h"
#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace drystone
{

template<>
void EnergyFunction<2>::write(const StepObservation<2>& step)
{
    if (!table)
    {
        table.emplace(output.folder / "energy.dat",
                      std::vector<std::string>{"Time[s]", "kinetic[J]", "potential[J]", "externalWork[J]",
                                               "frictionLoss[J]", "impactLoss[J]", "algorithmicLoss[J]",
                                               "imbalance[J]", "elastic[J]", "dampingLoss[J]"},
                      output.precision);
    }
    const EnergyLedger& energy = step.energy;
    table->write(std::array{step.time, energy.kinetic, energy.potential, energy.externalWork,
                            energy.frictionLoss, energy.impactLoss, energy.algorithmicLoss, imbalance(energy),
                            energy.elastic, energy.dampingLoss});
}

template<>
void BlockMotionFunction<2>::write(const StepObservation<2>& step)
{
    if (tables.empty())
    {
        for (const int block : blocks)
        {
            tables.emplace_back(output.folder / fmt::format("block{}.dat", block),
                                std::vector<std::string>{"Time[s]", "ux[m]", "uy[m]", "rz[rad]", "vx[m/s]",
                                                         "vy[m/s]", "wz[rad/s]"},
                                output.precision);
        }
    }
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
        const auto block = static_cast<std::size_t>(blocks[i]);
        const Placement<2>& placement = step.placements[block];
        const BlockVelocity<2>& velocity = step.velocities[block];
        tables[i].write(std::array{step.time, placement.translation.x(), placement.translation.y(),
                                   placement.rotation, velocity.linear.x(), velocity.linear.y(),
                                   velocity.angular});
    }
}

namespace
{

/// Force on the structure and its moment about the origin.
struct Reaction
{
    Vector<2> force = Vector<2>::Zero();
    double moment = 0;
};

std::vector<Reaction> supportReactions(const StepObservation<2>& step)
{
    std::vector<Reaction> reactions(step.assembly->supports.size());
    for (std::size_t i = 0; i < step.contactPoints.size(); ++i)
    {
        const ContactPoint<2>& point = step.contactPoints[i];
        const Vector<2> onBlock =
            step.contactForces[i].x() * point.normal + step.contactForces[i].y() * tangent(point);
        const auto supportOf = [&](int block)
        { return step.assembly->blocks[static_cast<std::size_t>(block)].support; };
        const int under = supportOf(point.neighbour);
        const int own = supportOf(point.block);
        // two blocks of supports press on each other, not on the structure
        if ((under < 0) == (own < 0))
        {
            continue;
        }
        Reaction& reaction = reactions[static_cast<std::size_t>(std::max(under, own))];
        const Vector<2> force = own < 0 ? onBlock : Vector<2>(-onBlock);
        reaction.force += force;
        reaction.moment += cross(point.position, force);
    }
    return reactions;
}

} // namespace

template<>
void ContactForcesFunction<2>::write(const StepObservation<2>& step)
{
    if (!table)
    {
        std::vector<std::string> columns{"Time[s]",
                                         "points[-]",
                                         "open[-]",
                                         "sticking[-]",
                                         "sliding[-]",
                                         "largestNormalForce[N]",
                                         "largestShearForce[N]"};
        for (const Support& support : step.assembly->supports)
        {
            for (const char* component : {".x[N]", ".y[N]", ".moment[Nm]"})
            {
                columns.push_back(support.name + component);
            }
        }
        table.emplace(output.folder / "contactForces.dat", columns, output.precision);
        if (listing == ContactPointTable::all)
        {
            points.emplace(output.folder / "points.dat",
                           std::vector<std::string>{"Time[s]", "block[-]", "neighbour[-]", "x[m]", "y[m]",
                                                    "gap[m]", "normalForce[N]", "shearForce[N]", "state[-]"},
                           output.precision);
        }
    }

    double largestNormal = 0;
    double largestShear = 0;
    for (const Vector<2>& force : step.contactForces)
    {
        largestNormal = std::max(largestNormal, force.x());
        largestShear = std::max(largestShear, std::abs(force.y()));
    }
    const std::vector<ContactState> states =
        contactStates(step.contactForces, step.frictionCoefficients, step.cohesions);
    std::array<int, 3> counts{};
    for (std::size_t i = 0; i < step.contactPoints.size(); ++i)
    {
        const ContactPoint<2>& point = step.contactPoints[i];
        const Vector<2>& force = step.contactForces[i];
        const auto state = static_cast<int>(states[i]);
        ++counts[static_cast<std::size_t>(state)];
        if (points)
        {
            points->write(std::array{step.time, 1.0 * point.block, 1.0 * point.neighbour, point.position.x(),
                                     point.position.y(), point.gap, force.x(), force.y(), 1.0 * state});
        }
    }

    std::vector<double> row{step.time,       static_cast<double>(step.contactPoints.size()),
                            1.0 * counts[0], 1.0 * counts[1],
                            1.0 * counts[2], largestNormal,
                            largestShear};
    for (const Reaction& reaction : supportReactions(step))
    {
        row.insert(row.end(), {reaction.force.x(), reaction.force.y(), reaction.moment});
    }
    table->write(row);
}

template<>
void ResidualsFunction<2>::write(const StepObservation<2>& step)
{
    if (!table)
    {
        table.emplace(output.folder / "residuals.dat",
                      std::vector<std::string>{"Time[s]", "timeStep[s]", "initialResidual[-]",
                                               "primalResidual[-]", "dualResidual[-]", "gap[-]",
                                               "iterations[-]", "factorisations[-]", "programs[-]",
                                               "retries[-]", "flowError[m]"},
                      output.precision);
    }
    const StepResiduals& r = step.residuals;
    table->write(std::array{step.time, step.timeStep, r.initialResidual, r.primalResidual, r.dualResidual,
                            r.gap, 1.0 * r.iterations, 1.0 * r.factorisations, 1.0 * r.programs,
                            1.0 * r.retries, r.flowError});
}

template<>
void StageTimesFunction<2>::write(const StepObservation<2>& step)
{
    if (!step.stageTimes)
    {
        if (!isWarned)
        {
            printWarning(
                "A state does not keep the times of the stages: the function stageTimes writes no table "
                "for results that are read.");
            isWarned = true;
        }
        return;
    }
    if (!table)
    {
        std::vector<std::string> columns{"Time[s]"};
        for (const auto& [name, stage] : namesOf(Stage{}))
        {
            columns.push_back(std::string(name) + "[s]");
        }
        table.emplace(output.folder / "stageTimes.dat", columns, output.precision);
    }
    std::vector<double> row{step.time};
    row.insert(row.end(), step.stageTimes->seconds.begin(), step.stageTimes->seconds.end());
    table->write(row);
}

} // namespace drystone
