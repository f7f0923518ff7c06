// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Gaps and slips of moving contacts to the last digits.
#include "dynamics/MovingGeometry.h"

#include "dynamics/FollowedFlow.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

template<int Dim>
std::vector<Placement<Dim>> placementsAfter(const Step<Dim>& step, const Eigen::VectorXd& displacement,
                                            double share)
{
    const std::vector<int>& free = step.measuredPoints ? step.measuredPoints->free : step.scene.free;
    std::vector<Placement<Dim>> placements = moved(step.motion.state.placements, free, displacement, share);
    moveWithSupports(placements, step.supports, share);
    return placements;
}

template<int Dim>
std::vector<ContactColumns<Dim>> columnsAt(const DynamicCase<Dim>& scene,
                                           const std::vector<Placement<Dim>>& placements,
                                           const std::vector<ContactPoint<Dim>>& points)
{
    return equilibriumColumns(scene.assembly, placedMasses(scene.blocks, placements), points);
}

template<int Dim>
void forgetRounding(const DynamicCase<Dim>& scene, std::vector<ContactPoint<Dim>>& points)
{
    for (ContactPoint<Dim>& point : points)
    {
        point.gap = std::abs(point.gap) <= scene.roundingGap ? 0 : point.gap;
    }
}

namespace
{

/// Puts the columns of a step with theta below 1 where its momenta want them. \return A'y with these
template<int Dim>
Eigen::VectorXd moveColumns(const Step<Dim>& step, const Eigen::VectorXd& displacement,
                            StepProgram<Dim>& program)
{
    const auto between = placementsAfter(step, displacement, 1 - step.scheme.theta);
    std::vector<ContactPoint<Dim>> points;
    step.motion.contacts->measure(between, points);
    setColumns(program, columnsAt(step.scene, between, points));
    return applyTransposed(program, displacement);
}

/// The points of the program with the blocks at the placements of the end.
template<int Dim>
std::vector<ContactPoint<Dim>> pointsAfter(const Step<Dim>& step, const std::vector<Placement<Dim>>& after)
{
    const MovingContacts<Dim>& contacts = *step.motion.contacts;
    std::vector<ContactPoint<Dim>> points;
    if (step.measuredPoints)
    {
        points.reserve(step.measuredPoints->points.size());
        for (const std::size_t index : step.measuredPoints->points)
        {
            points.push_back(contacts.pointAt(after, index));
        }
    }
    else
    {
        contacts.measure(after, points);
    }
    // Named solvers leave what their tolerance leaves: rounding would add to it in the ledger of energy.
    if (!followsFlow(step.settings) || step.settings.solver.solver != SolverType::automatic)
    {
        forgetRounding(step.scene, points);
    }
    return points;
}

/// A point of the program at the end of the step, (normal, shear) [m].
template<int Dim>
struct PointAtEnd
{
    double gap;
    Shear<Dim> slip;
    Vector<Dim> ofEffects;     ///< what effects have put into its gap
    Vector<Dim> closingBefore; ///< of A'y, with the columns that the program came with
    Vector<Dim> closing;       ///< likewise, with those that it has now
};

/// By how much what the program had predicted of a point is off, where that matters [m].
template<int Dim>
double errorAt(const PointAtEnd<Dim>& point, const StepProgram<Dim>& program, std::size_t index,
               double normalForce)
{
    const Eigen::Index row = Dim * static_cast<Eigen::Index>(index);
    double error = 0;
    if (normalForce != 0 || point.gap < 0)
    {
        const double predicted = program.gap[row] - point.ofEffects[0] - point.closingBefore[0];
        error = std::abs(point.gap - predicted);
    }
    if (program.hasStrength() && program.strength[index].cohesion > 0) // where slip decides what holds
    {
        const Shear<Dim> missed = point.slip + program.gap.template segment<Dim - 1>(row + 1)
                                  - point.ofEffects.template tail<Dim - 1>()
                                  - point.closingBefore.template tail<Dim - 1>();
        error = std::max(error, missed.norm());
    }
    return error;
}

/// The gap, and minus the slip, of a point for the program to have.
template<int Dim>
Vector<Dim> gapFor(const PointAtEnd<Dim>& point)
{
    Vector<Dim> gap;
    gap[0] = point.gap + point.closing[0] + point.ofEffects[0];
    gap.template tail<Dim - 1>() =
        point.closing.template tail<Dim - 1>() - point.slip + point.ofEffects.template tail<Dim - 1>();
    return gap;
}

} // namespace

template<int Dim>
Relinearisation<Dim> movingContactGeometry(const Step<Dim>& step)
{
    return [&step](const Eigen::VectorXd& displacement, const Eigen::VectorXd& contactForce,
                   StepProgram<Dim>& program)
    {
        const Eigen::VectorXd before = applyTransposed(program, displacement);
        const bool hasMoved = step.scheme.theta < 1;
        const Eigen::VectorXd moved = hasMoved ? moveColumns(step, displacement, program) : Eigen::VectorXd();
        const Eigen::VectorXd& closing = hasMoved ? moved : before;
        const auto after = placementsAfter(step, displacement);
        const std::vector<ContactPoint<Dim>> points = pointsAfter(step, after);
        BlockMotions<Dim> motions(step.motion.state.placements, after);
        double error = turnMomenta(step, displacement, contactForce, program);
        for (std::size_t index = 0; index < points.size(); ++index)
        {
            const std::size_t ofStep = step.measuredPoints ? step.measuredPoints->points[index] : index;
            const Eigen::Index row = Dim * static_cast<Eigen::Index>(index);
            PointAtEnd<Dim> point{points[index].gap, slip(step, motions, ofStep, program.contacts[index]),
                                  Vector<Dim>::Zero(), before.segment<Dim>(row), closing.segment<Dim>(row)};
            if (step.gapsOfEffects.size() > 0)
            {
                point.ofEffects =
                    step.gapsOfEffects.template segment<Dim>(Dim * static_cast<Eigen::Index>(ofStep));
            }
            error = std::max(error, errorAt(point, program, index, contactForce[row]));
            program.gap.template segment<Dim>(row) = gapFor(point);
        }
        return error;
    };
}

template std::vector<Placement<2>> placementsAfter(const Step<2>& step, const Eigen::VectorXd& displacement,
                                                   double share);
template std::vector<ContactColumns<2>> columnsAt(const DynamicCase<2>& scene,
                                                  const std::vector<Placement<2>>& placements,
                                                  const std::vector<ContactPoint<2>>& points);
template void forgetRounding(const DynamicCase<2>& scene, std::vector<ContactPoint<2>>& points);
template Relinearisation<2> movingContactGeometry(const Step<2>& step);
template std::vector<Placement<3>> placementsAfter(const Step<3>& step, const Eigen::VectorXd& displacement,
                                                   double share);
template std::vector<ContactColumns<3>> columnsAt(const DynamicCase<3>& scene,
                                                  const std::vector<Placement<3>>& placements,
                                                  const std::vector<ContactPoint<3>>& points);
template void forgetRounding(const DynamicCase<3>& scene, std::vector<ContactPoint<3>>& points);
template Relinearisation<3> movingContactGeometry(const Step<3>& step);

} // namespace drystone
