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

template<int Dim>
void EnergyFunction<Dim>::write(const StepObservation<Dim>& step)
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

template<int Dim>
void BlockMotionFunction<Dim>::write(const StepObservation<Dim>& step)
{
    if (tables.empty())
    {
        for (const int block : blocks)
        {
            const std::vector<std::string> ofPlane{"Time[s]", "ux[m]",   "uy[m]",    "rz[rad]",
                                                   "vx[m/s]", "vy[m/s]", "wz[rad/s]"};
            const std::vector<std::string> ofSpace{"Time[s]",   "ux[m]",     "uy[m]",    "uz[m]",   "rx[rad]",
                                                   "ry[rad]",   "rz[rad]",   "vx[m/s]",  "vy[m/s]", "vz[m/s]",
                                                   "wx[rad/s]", "wy[rad/s]", "wz[rad/s]"};
            tables.emplace_back(output.folder / fmt::format("block{}.dat", block),
                                Dim == 2 ? ofPlane : ofSpace, output.precision);
        }
    }
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
        const auto block = static_cast<std::size_t>(blocks[i]);
        const Placement<Dim>& placement = step.placements[block];
        const BlockVelocity<Dim>& velocity = step.velocities[block];
        Eigen::Matrix<double, 1 + 2 * freedomCount<Dim>, 1> row;
        row << step.time, placement.translation, rowsOf(placement.rotation), velocity.linear,
            rowsOf(velocity.angular);
        tables[i].write({row.data(), static_cast<std::size_t>(row.size())});
    }
}

namespace
{

/// Force on the structure and its moment about the origin.
template<int Dim>
struct Reaction
{
    Vector<Dim> force = Vector<Dim>::Zero();
    Eigen::Matrix<double, rotationCount<Dim>, 1> moment =
        Eigen::Matrix<double, rotationCount<Dim>, 1>::Zero();
};

template<int Dim>
std::vector<Reaction<Dim>> supportReactions(const StepObservation<Dim>& step)
{
    std::vector<Reaction<Dim>> reactions(step.assembly->supports.size());
    for (std::size_t i = 0; i < step.contactPoints.size(); ++i)
    {
        const ContactPoint<Dim>& point = step.contactPoints[i];
        const Vector<Dim> onBlock = contactFrame(point) * step.contactForces[i];
        const auto supportOf = [&](int block)
        { return step.assembly->blocks[static_cast<std::size_t>(block)].support; };
        const int under = supportOf(point.neighbour);
        const int own = supportOf(point.block);
        // two blocks of supports press on each other, not on the structure
        if ((under < 0) == (own < 0))
        {
            continue;
        }
        Reaction<Dim>& reaction = reactions[static_cast<std::size_t>(std::max(under, own))];
        const Vector<Dim> force = own < 0 ? onBlock : Vector<Dim>(-onBlock);
        reaction.force += force;
        reaction.moment += momentOf(point.position, force);
    }
    return reactions;
}

} // namespace

template<int Dim>
void ContactForcesFunction<Dim>::openTables(const StepObservation<Dim>& step)
{
    constexpr bool isPlane = Dim == 2;
    std::vector<std::string> columns{"Time[s]",
                                     "points[-]",
                                     "open[-]",
                                     "sticking[-]",
                                     "sliding[-]",
                                     "largestNormalForce[N]",
                                     "largestShearForce[N]"};
    const std::vector<std::string> components =
        isPlane ? std::vector<std::string>{".x[N]", ".y[N]", ".moment[Nm]"}
                : std::vector<std::string>{".x[N]",        ".y[N]",        ".z[N]",
                                           ".momentX[Nm]", ".momentY[Nm]", ".momentZ[Nm]"};
    for (const Support& support : step.assembly->supports)
    {
        for (const std::string& component : components)
        {
            columns.push_back(support.name + component);
        }
    }
    table.emplace(output.folder / "contactForces.dat", columns, output.precision);
    if (listing == ContactPointTable::all)
    {
        std::vector<std::string> ofPoints{"Time[s]", "block[-]", "neighbour[-]", "x[m]", "y[m]"};
        if (!isPlane)
        {
            ofPoints.emplace_back("z[m]");
        }
        ofPoints.insert(ofPoints.end(), {"gap[m]", "normalForce[N]", "shearForce[N]", "state[-]"});
        points.emplace(output.folder / "points.dat", ofPoints, output.precision);
    }
}

template<int Dim>
void ContactForcesFunction<Dim>::writePoint(const StepObservation<Dim>& step, std::size_t index,
                                            ContactState state)
{
    const ContactPoint<Dim>& point = step.contactPoints[index];
    const Vector<Dim>& force = step.contactForces[index];
    // In the plane shear has a sign, in space a size.
    const double shear = Dim == 2 ? force[1] : force.template tail<Dim - 1>().norm();
    Eigen::Matrix<double, 7 + Dim, 1> row;
    row << step.time, 1.0 * point.block, 1.0 * point.neighbour, point.position, point.gap, force.x(), shear,
        1.0 * static_cast<int>(state);
    points->write({row.data(), static_cast<std::size_t>(row.size())});
}

template<int Dim>
void ContactForcesFunction<Dim>::write(const StepObservation<Dim>& step)
{
    if (!table)
    {
        openTables(step);
    }
    double largestNormal = 0;
    double largestShear = 0;
    for (const Vector<Dim>& force : step.contactForces)
    {
        largestNormal = std::max(largestNormal, force.x());
        largestShear = std::max(largestShear, force.template tail<Dim - 1>().norm());
    }
    const std::vector<ContactState> states =
        contactStates(step.contactForces, step.frictionCoefficients, step.cohesions);
    std::array<int, 3> counts{};
    for (std::size_t i = 0; i < step.contactPoints.size(); ++i)
    {
        ++counts[static_cast<std::size_t>(states[i])];
        if (points)
        {
            writePoint(step, i, states[i]);
        }
    }

    std::vector<double> row{step.time,       static_cast<double>(step.contactPoints.size()),
                            1.0 * counts[0], 1.0 * counts[1],
                            1.0 * counts[2], largestNormal,
                            largestShear};
    for (const Reaction<Dim>& reaction : supportReactions(step))
    {
        row.insert(row.end(), reaction.force.begin(), reaction.force.end());
        row.insert(row.end(), reaction.moment.begin(), reaction.moment.end());
    }
    table->write(row);
}

template<int Dim>
void ResidualsFunction<Dim>::write(const StepObservation<Dim>& step)
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
                            r.dualityGap, 1.0 * r.iterations, 1.0 * r.factorisations, 1.0 * r.programs,
                            1.0 * r.retries, r.flowError});
}

template<int Dim>
void StageTimesFunction<Dim>::write(const StepObservation<Dim>& step)
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

template class EnergyFunction<2>;
template class BlockMotionFunction<2>;
template class ContactForcesFunction<2>;
template class ResidualsFunction<2>;
template class StageTimesFunction<2>;
template class EnergyFunction<3>;
template class BlockMotionFunction<3>;
template class ContactForcesFunction<3>;
template class ResidualsFunction<3>;
template class StageTimesFunction<3>;

} // namespace drystone
