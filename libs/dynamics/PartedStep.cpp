// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Here: those who watch a run see steps, not the parts that impacts make of them.
#include "dynamics/PartedStep.h"

#include <algorithm>

namespace drystone
{
namespace
{

bool isSame(const ContactPoint<2>& a, const ContactPoint<2>& b)
{
    return a.block == b.block && a.neighbour == b.neighbour && a.feature == b.feature;
}

} // namespace

void PartedStep::count(const StepResiduals& attempt)
{
    work.initialResidual = std::max(work.initialResidual, attempt.initialResidual);
    work.primalResidual = std::max(work.primalResidual, attempt.primalResidual);
    work.dualResidual = std::max(work.dualResidual, attempt.dualResidual);
    work.gap = std::max(work.gap, attempt.gap);
    work.flowError = std::max(work.flowError, attempt.flowError);
    work.iterations += attempt.iterations;
    work.factorisations += attempt.factorisations;
    work.programs += attempt.programs;
}

void PartedStep::add(const Motion& motion, double length)
{
    const std::vector<Vector<2>>& forces = meanContactForces(motion);
    for (std::size_t i = 0; i < motion.points.size(); ++i)
    {
        const auto there =
            std::find_if(impulses.begin(), impulses.end(),
                         [&](const Carried& carried) { return isSame(carried.point, motion.points[i]); });
        const Vector<2> impulse = length * forces[i];
        if (there != impulses.end())
        {
            there->point = motion.points[i];
            there->impulse += impulse;
        }
        else if (!impulse.isZero(0))
        {
            impulses.push_back({motion.points[i], impulse});
        }
    }
    duration += length;
    leastShare = std::min(leastShare, motion.restitutionShare);
    bondsBroken += motion.bondsBrokenInStep;
    ++parts;
}

void PartedStep::finish(Motion& motion) const
{
    if (parts < 2)
    {
        return;
    }
    motion.residuals = work;
    motion.attempt = work;
    motion.restitutionShare = leastShare;
    motion.bondsBrokenInStep = bondsBroken;
    motion.meanForces.assign(motion.points.size(), Vector<2>::Zero());
    for (const Carried& carried : impulses)
    {
        auto there = std::find_if(motion.points.begin(), motion.points.end(),
                                  [&](const ContactPoint<2>& point) { return isSame(point, carried.point); });
        auto index = there - motion.points.begin();
        if (there == motion.points.end())
        {
            const auto pairOf = [](const ContactPoint<2>& point)
            { return std::pair(point.block, point.neighbour); };
            index = std::upper_bound(motion.points.begin(), motion.points.end(), carried.point,
                                     [&](const ContactPoint<2>& a, const ContactPoint<2>& b)
                                     { return pairOf(a) < pairOf(b); })
                    - motion.points.begin();
            motion.points.insert(motion.points.begin() + index, carried.point);
            motion.contactForces.insert(motion.contactForces.begin() + index, Vector<2>::Zero());
            motion.meanForces.insert(motion.meanForces.begin() + index, Vector<2>::Zero());
            for (Eigen::VectorXd* ofPoints : {&motion.interior.contactForce, &motion.interior.opening})
            {
                if (!motion.interior.isEmpty())
                {
                    const Eigen::VectorXd old = *ofPoints;
                    ofPoints->resize(old.size() + 2);
                    *ofPoints << old.head(2 * index), 0, 0, old.tail(old.size() - 2 * index);
                }
            }
        }
        motion.meanForces[static_cast<std::size_t>(index)] += carried.impulse / duration;
    }
}

} // namespace drystone
