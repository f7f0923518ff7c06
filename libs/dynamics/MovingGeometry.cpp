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

template<int Dim>
Relinearisation<Dim> movingContactGeometry(const Step<Dim>& step)
{
    return [&step](const Eigen::VectorXd& displacement, const Eigen::VectorXd& contactForce,
                   StepProgram<Dim>& program)
    {
        const DynamicCase<Dim>& scene = step.scene;
        const Motion<Dim>& motion = step.motion;
        std::vector<ContactPoint<Dim>> points;
        const double early = 1 - step.scheme.theta;
        const std::vector<std::size_t>* some = step.measuredPoints ? &step.measuredPoints->points : nullptr;
        const Eigen::VectorXd linear = applyTransposed(program, displacement);
        Eigen::VectorXd between; // with the lever arms of the mean time
        if (early > 0)
        {
            const auto placements = placementsAfter(step, displacement, early);
            motion.contacts->measure(placements, points);
            setColumns(program, columnsAt(scene, placements, points));
            between = applyTransposed(program, displacement);
        }
        const Eigen::VectorXd& closing = early > 0 ? between : linear;
        const auto after = placementsAfter(step, displacement);
        if (some)
        {
            points.reserve(some->size());
            for (const std::size_t index : *some)
            {
                points.push_back(motion.contacts->pointAt(after, index));
            }
        }
        else
        {
            motion.contacts->measure(after, points);
        }
        // Named solvers leave what their tolerance leaves: rounding would add to it in the ledger of energy.
        if (!followsFlow(step.settings) || step.settings.solver.solver != SolverType::automatic)
        {
            forgetRounding(scene, points);
        }
        BlockMotions<Dim> motions(motion.state.placements, after);
        double error = turnMomenta(step, displacement, contactForce, program);
        for (std::size_t k = 0; k < points.size(); ++k)
        {
            const std::size_t i = some ? (*some)[k] : k; // of the step
            const Eigen::Index row = Dim * static_cast<Eigen::Index>(k);
            Vector<Dim> own = Vector<Dim>::Zero();
            if (step.gapsOfEffects.size() > 0)
            {
                own = step.gapsOfEffects.template segment<Dim>(Dim * static_cast<Eigen::Index>(i));
            }
            const Vector<Dim> before = linear.segment<Dim>(row);
            const Vector<Dim> now = closing.segment<Dim>(row);
            const double predicted = program.gap[row] - own[0] - before[0];
            if (contactForce[row] != 0 || points[k].gap < 0)
            {
                error = std::max(error, std::abs(points[k].gap - predicted));
            }
            const Shear<Dim> slid = slip(step, motions, i, program.contacts[k]);
            auto shear = program.gap.template segment<Dim - 1>(row + 1);
            if (program.hasStrength() && program.strength[k].cohesion > 0) // where slip decides what holds
            {
                const Shear<Dim> missed =
                    slid + shear - own.template tail<Dim - 1>() - before.template tail<Dim - 1>();
                error = std::max(error, missed.norm());
            }
            program.gap[row] = points[k].gap + now[0] + own[0];
            shear = now.template tail<Dim - 1>() - slid + own.template tail<Dim - 1>();
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
