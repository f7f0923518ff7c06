// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// accuracyCost in a case directory: its input, its runs, its log and its files.
///
/// postProcessing/accuracyCost/0/
///     history.dat              a row for each run; a study that is restarted repeats none of them
///     accuracyCost.csv         a row for each setting: errors and CPU time
///     accuracyCost.md          the page with all tables and pictures
///     <sweep>.svg              error over CPU time, tolerance, or points per joint
///     <sweep>Solvers<tolerance>.svg    profiles of the solvers of a sweep
#pragma once

#include "ensembles/AccuracyCost.h"

#include <cstdint>
#include <filesystem>
#include <map>

namespace drystone
{

/// One run: its quantity, setting and phase.
struct RunKey
{
    std::size_t quantity = 0;
    RunSetting setting;
    StepPhase phase;

    friend auto operator<=>(const RunKey&, const RunKey&) = default;
};

/// A quantity with its reference and units.
struct StudyQuantity
{
    std::string name;
    QuantityKind kind = QuantityKind::motion;
    Quantity quantity;
    ReferencePlan reference;
    RunSetting ofCase;                  ///< how the case itself is computed
    std::function<double()> unitOfWork; ///< measures F, of the setting of the case [s]
    double housner = 0;                 ///< the value of that reference, where it is used
};

/// A study that has been read and checked; its quantities hold the case, of the plane or of space.
struct AccuracyStudy
{
    std::filesystem::path caseDirectory;
    double duration = 0; ///< of a motion [s]
    std::vector<StudyQuantity> quantities;
    std::vector<Named<Sweep>> sweeps;
    std::vector<std::size_t> quantityOfSweep;
    std::string heading; ///< of the history: everything that its rows depend on
};

/// Reads system/accuracyCostDict and, as far as its quantities need them, the input of contactDynamics and
/// limitAnalysis. \throws FatalIOError or FatalError for the first fault found
template<int Dim>
AccuracyStudy readAccuracyStudy(const std::filesystem::path& caseDirectory);

/// Before the first run: quantities, references, sweeps.
void printAccuracyStudy(const AccuracyStudy& study);

/// All completed runs.
class AccuracyRuns
{
public:
    /// Reads the runs of an earlier call; writes nothing yet. \throws FatalError when they belong to another
    /// study
    explicit AccuracyRuns(const AccuracyStudy& accuracyStudy);

    const Measurement* find(const RunKey& key) const;
    void add(const RunKey& key, const Measurement& run);
    std::size_t size() const { return order.size(); }
    /// Writes all runs to disk.
    void write() const;

private:
    const AccuracyStudy& study;
    std::filesystem::path file;
    std::map<RunKey, Measurement> runs;
    std::vector<RunKey> order;
};

/// The contents of the page.
struct AccuracyResults
{
    std::vector<Reference> references; ///< one per quantity
    std::vector<double> unitsOfWork;   ///< F of each quantity [s]
    std::vector<SweepResult> sweeps;   ///< completed ones
    bool isInterrupted = false;
};

/// Carries out the runs that are not known, one at a time so that CPU times are comparable, and prints a line
/// for each setting. Completed runs are written after each setting, and when a signal ends the study.
AccuracyResults carryOut(const AccuracyStudy& study, AccuracyRuns& runs);

/// The end of the log: cheapest settings.
void printAccuracyResults(const AccuracyStudy& study, const AccuracyResults& results);

/// Table, page and pictures. \throws FatalError naming what cannot be written
void writeAccuracyResults(const AccuracyStudy& study, const AccuracyResults& results);

/// postProcessing/accuracyCost/0/ of a case.
std::filesystem::path accuracyFolder(const std::filesystem::path& caseDirectory);

/// `Intel(R) Xeon(R) ... 2.10GHz`, or `an unknown processor`.
std::string processorName();

/// 0; 128 + signal (130 for Ctrl-C) when the study was interrupted.
int exitStatus(const AccuracyResults& results);

} // namespace drystone
