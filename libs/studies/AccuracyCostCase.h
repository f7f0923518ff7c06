// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// accuracyCost in a case directory: what it reads, runs, says and leaves behind.
///
/// postProcessing/accuracyCost/0/
///     history.dat              a row for each run; a study that is begun again makes none of them anew
///     accuracyCost.csv         a row for each setting: errors beside CPU time
///     accuracyCost.md          the page with all tables and pictures
///     <sweep>.svg              error over CPU time, tolerance, or points a joint
///     <sweep>Solvers<tolerance>.svg    profiles of the solvers of a sweep
#pragma once

#include "studies/AccuracyCost.h"

#include <cstdint>
#include <filesystem>
#include <map>

namespace drystone
{

/// One run: of which quantity, with what, at which phase.
struct RunKey
{
    std::size_t quantity = 0;
    RunSetting setting;
    StepPhase phase;

    friend auto operator<=>(const RunKey&, const RunKey&) = default;
};

/// A quantity with all that is known of it.
struct StudyQuantity
{
    std::string name;
    QuantityKind kind = QuantityKind::motion;
    Quantity quantity;
    ReferencePlan reference;
    RunSetting ofCase;  ///< how the case itself is computed
    double housner = 0; ///< with that reference, what it says
};

/// A study that has been read and checked.
struct AccuracyStudy
{
    AccuracyCase scene;
    std::vector<StudyQuantity> quantities;
    std::vector<Named<Sweep>> sweeps;
    std::vector<std::size_t> quantityOfSweep;
    std::string heading; ///< of the history: what its rows depend on
};

/// Reads system/accuracyCostDict and, as its quantities need them, what contactDynamics and limitAnalysis
/// read. \throws FatalIOError or FatalError for the first thing that is wrong
AccuracyStudy readAccuracyStudy(const std::filesystem::path& caseDirectory);

/// Before the first run: quantities, references, sweeps.
void printAccuracyStudy(const AccuracyStudy& study);

/// All runs that have been made.
class AccuracyRuns
{
public:
    /// Reads what an earlier call has left; writes nothing yet. \throws FatalError when that is of another
    /// study
    explicit AccuracyRuns(const AccuracyStudy& study);

    const Measurement* find(const RunKey& key) const;
    void add(const RunKey& key, const Measurement& run);
    std::size_t size() const { return order_.size(); }
    /// Puts all on the disk.
    void write() const;

private:
    const AccuracyStudy& study_;
    std::filesystem::path file_;
    std::map<RunKey, Measurement> runs_;
    std::vector<RunKey> order_;
};

/// What the page tells.
struct AccuracyResults
{
    std::vector<Reference> references; ///< one a quantity
    std::vector<double> unitsOfWork;   ///< F of each quantity [s]
    std::vector<SweepResult> sweeps;   ///< those that are done
    bool isInterrupted = false;
};

/// Makes the runs that are not known, one at a time so that CPU times are comparable, and prints a line for
/// each setting. What is done is on the disk after each setting, and when a signal ends the study.
AccuracyResults carryOut(const AccuracyStudy& study, AccuracyRuns& runs);

/// What the log says at the end: cheapest settings.
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
