// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the steps of a run with `selection automatic` have called for, over time: a table and a picture of
/// it, which dynamics does not write.
#pragma once

#include "dynamics/Motion.h"
#include "runControl/PictureFormats.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// Shares of the blocks that were simulated, of the bodies that they were, and of the points or blocks on
/// which each effect acted (dynamics/EffectCalls.h), over time. Of long runs means over several steps are
/// kept, some hundreds of them. Holds a reference to the scene.
template<int Dim>
class EffectHistory
{
public:
    explicit EffectHistory(const DynamicCase<Dim>& dynamicCase);

    /// To be called at the end of each step.
    void observe(const Motion<Dim>& motion);

    /// Writes effects.dat, `Time[s] blocks[%] bodies[%] friction[%] ...`, each row the means since the row
    /// before, and the picture effects.svg into a folder. \return whether there was a step, and it is written
    bool write(const std::filesystem::path& folder, const std::string& title,
               const PictureFormats& formats) const;

private:
    /// Sums over steps.
    struct Sums
    {
        double time = 0; ///< at the end [s]
        long steps = 0;
        std::vector<double> shares; ///< in the order of the columns
    };
    void halve();

    const DynamicCase<Dim>& scene;
    std::vector<std::string> effects;
    std::vector<Sums> sums;
    long stepsOfEach = 1;
};

} // namespace drystone
