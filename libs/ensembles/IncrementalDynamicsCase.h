// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// An incremental analysis in a case directory: its input and its files.
#pragma once

#include "ensembles/IncrementalDynamics.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// Reads the input of contactDynamics (including the solver's settings: system/solution/contactDynamics), the
/// state that it would start from, and system/incrementalDynamicsDict.
/// \param time of this case, its controlDict required
/// \throws FatalIOError or FatalError for the first fault found
template<int Dim>
IncrementalDynamics<Dim> readIncrementalDynamics(const std::filesystem::path& caseDirectory, Time& time);

/// With `smallDisplacements yes;`: that blocks meet the criterion only beyond what these hold for; or empty.
template<int Dim>
std::string doubtAboutCriterion(const IncrementalDynamics<Dim>& study);

/// That supports move by more than the criterion before endTime, so that blocks which they carry along meet
/// it by themselves; or empty.
template<int Dim>
std::string doubtAboutSupports(const IncrementalDynamics<Dim>& study);

/// postProcessing/incrementalDynamics/<startTime>/ of a case.
std::filesystem::path incrementalDynamicsFolder(const std::filesystem::path& caseDirectory, const Time& time);

/// A table of numbers under headings.
struct LeastIntensityTable
{
    std::vector<std::string> headings;
    std::vector<std::vector<double>> rows;
};

/// What leastIntensity.dat has: a row a motion that has runs.
template<int Dim>
LeastIntensityTable leastIntensityTable(const IncrementalDynamics<Dim>& study,
                                        const std::vector<IncrementalCurve>& curves);

/// Writes into incrementalDynamicsFolder
/// - <motion>.dat for each motion of the ground (incrementalDynamics.dat for constant/groundMotion), a row a
///   run by increasing intensity: `intensity[g] factor[-] displacement[m] verdict[-] endTime[s] steps[-]
///   residual[-] cpuTime[s]`; verdict 0 stands, 1 meets the criterion, 2 did not converge;
/// - leastIntensity.dat, a row a motion: `motion[-] leastIntensity[g] below[g] kind[-] runs[-]`, where kind
///   is 0 found, 1 the lowest one tried meets it already, 2 none meets it, 3 not known; leastIntensity is
///   `nan` but for the first two;
/// - incrementalDynamics.svg, the quantity of the criterion over the intensity.
/// \throws FatalError naming what cannot be written
template<int Dim>
void writeIncrementalDynamics(const std::filesystem::path& folder, const IncrementalDynamics<Dim>& study,
                              const std::vector<IncrementalCurve>& curves);

} // namespace drystone
