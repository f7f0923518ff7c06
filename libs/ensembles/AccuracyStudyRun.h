// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// accuracyCost in a case directory: its runs, its log and its files.
///
/// postProcessing/accuracyCost/0/
///     history.dat              a row for each run; a study that is restarted repeats none of them
///     accuracyCost.csv         a row for each setting: errors and CPU time
///     accuracyCost.md          the page with all tables and pictures
///     <sweep>.svg              error over CPU time, tolerance, or points per joint
///     <sweep>Solvers<tolerance>.svg    profiles of the solvers of a sweep
#pragma once

#include "ensembles/AccuracyHistory.h"

namespace drystone
{

/// Before the first run: quantities, references, sweeps.
void printAccuracyStudy(const AccuracyStudy& study);

/// The contents of the page.
struct AccuracyResults
{
    std::vector<Reference> references; ///< one per quantity
    std::vector<double> unitsOfWork;   ///< F of each quantity [s]
    std::vector<SweepResult> sweeps;   ///< completed ones
    bool isInterrupted = false;
};

/// The quantity, the plan and the settings of a sweep, and the error of its reference, relative.
const StudyQuantity& quantityOf(const AccuracyStudy& study, const SweepResult& sweep);
const Sweep& planOf(const AccuracyStudy& study, const SweepResult& sweep);
std::vector<RunSetting> settingsAt(const std::vector<AccuracyPoint>& points);
double uncertaintyOf(const AccuracyResults& results, const SweepResult& sweep);

/// Carries out the runs that are not known, one at a time so that CPU times are comparable, and prints a line
/// for each setting. Completed runs are written after each setting, and when a signal ends the study.
AccuracyResults carryOut(const AccuracyStudy& study, AccuracyRuns& runs);

/// The end of the log: cheapest settings.
void printAccuracyResults(const AccuracyStudy& study, const AccuracyResults& results);

/// Table, page and pictures. \throws FatalError naming what cannot be written
void writeAccuracyResults(const AccuracyStudy& study, const AccuracyResults& results);

/// 0; where all runs of all sweeps failed 2 when some were not solved, else 1; 128 + signal (130 for Ctrl-C)
/// when the study was interrupted.
int exitStatus(const AccuracyResults& results);

} // namespace drystone
