// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A step that is taken in parts, from impact to impact, and that observers see as one.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// What the parts of a step leave together: forces and their means, the work of the solver, the worst of
/// their residuals.
template<int Dim>
class PartedStep
{
public:
    /// Another part, which has just been taken.
    void add(const Motion<Dim>& motion, double length);

    /// Attempts at parts count too, those that were taken and those that were not. \param attempt since `add`
    void count(const StepResiduals& attempt);

    /// Puts together what was added: points of earlier parts that are no longer in the list come back into it
    /// if they carried anything, with the gap that they had then.
    void finish(Motion<Dim>& motion) const;

private:
    struct Carried
    {
        ContactPoint<Dim> point;
        Vector<Dim> impulse = Vector<Dim>::Zero(); ///< [N s]
    };
    std::vector<Carried> impulses;
    StepResiduals work;
    double duration = 0;
    double leastShare = 1;
    int parts = 0;
};

/// A step, in parts up to where blocks meet and on from there. A rebound that would last less than a tenth of
/// the step is none: bounces that grow shorter for ever end. After eight attempts at parts, in structures of
/// which more than two pairs of bodies meet in one, and with `impacts stepStart`, points that the step closes
/// and that were closing when it began collide at its start, wherever they meet. \return whether it was
/// solved; otherwise see `advance`
template<int Dim>
bool advanceInParts(const DynamicCase<Dim>& scene, Motion<Dim>& motion, double timeStep);

} // namespace drystone
