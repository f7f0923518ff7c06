// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The completed runs of an incremental analysis on disk, so that one that was interrupted goes on.
#pragma once

#include "ensembles/IncrementalDynamics.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// history.dat in the folder of the results: a row for each completed run, in the order in which they were
/// reported: the number of the motion, then the columns of its table with all digits. Its first lines
/// say what the runs depend on: the files of the case, the motions, the criterion.
template<int Dim>
class IncrementalHistory
{
public:
    /// Reads the runs of an earlier analysis with the same input; those of another are left aside, and
    /// replaced with the first `add`. Nothing is written yet.
    /// \throws FatalError where the file is damaged
    IncrementalHistory(const std::filesystem::path& caseDirectory, const std::filesystem::path& folder,
                       const IncrementalDynamics<Dim>& study);

    /// The known runs of each motion.
    const std::vector<IncrementalCurve>& known() const { return curves; }
    std::size_t count() const;
    /// How the input differs from that of a history which was there; empty: not at all.
    const std::string& changeOfInput() const { return change; }

    /// Writes the run to disk with all before it. \throws FatalError when that fails
    void add(std::size_t motion, const IncrementalRun& run);

private:
    std::filesystem::path file;
    std::string text; ///< of the file, as it is to be
    std::vector<IncrementalCurve> curves;
    std::string change;
};

} // namespace drystone
