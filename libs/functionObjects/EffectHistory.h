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

    /// Whether no step was observed: there is nothing to write.
    bool isEmpty() const { return sums.empty(); }

    /// Writes effects.dat, `Time[s] blocks[%] bodies[%] friction[%] ...`, each row the means since the row
    /// before, into a folder. What is there is replaced as a whole, as rows of long runs are joined.
    /// \throws FatalError naming the file and the system's reason
    void writeTable(const std::filesystem::path& folder) const;

    /// Writes the picture effects.svg of the same into a folder. \throws FatalError likewise
    void writePicture(const std::filesystem::path& folder, const std::string& title,
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
    /// Of the columns but the time.
    std::vector<std::string> names() const;
    /// Mean of a column over the steps of a row [%].
    static double meanShare(const Sums& row, std::size_t column);

    const DynamicCase<Dim>& scene;
    std::vector<std::string> effects;
    std::vector<Sums> sums;
    long stepsOfEach = 1;
};

} // namespace drystone
