// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A step that was taken in parts, from impact to impact, as one.
#pragma once

#include "dynamics/Motion.h"

namespace drystone
{

/// What the parts of a step leave together: forces and their means, the work of the solver, the worst of
/// their residuals.
class PartedStep
{
public:
    /// Another part, which has just been taken.
    void add(const Motion& motion, double length);

    /// Attempts at parts count too, those that were taken and those that were not. \param attempt since `add`
    void count(const StepResiduals& attempt);

    /// Puts together what was added: points of earlier parts that are no longer in the list come back into it
    /// if they carried anything, with the gap that they had then.
    void finish(Motion& motion) const;

private:
    struct Carried
    {
        ContactPoint<2> point;
        Vector<2> impulse = Vector<2>::Zero(); ///< [N s]
    };
    std::vector<Carried> impulses;
    StepResiduals work;
    double duration = 0;
    double leastShare = 1;
    int parts = 0;
    int bondsBroken = 0;
};

} // namespace drystone
