// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// An ensemble as jobs of Slurm.
#pragma once

#include "ensembles/Ensemble.h"

#include <string>

namespace drystone
{

/// The script of a job: each of its tasks computes samples of the case.
/// \param program the application \param options of sbatch, `--array=1-32 --time=2:00:00`
std::string slurmScript(const std::filesystem::path& program, const std::filesystem::path& caseDirectory,
                        const std::string& options);

/// The script of the job that follows: tables, statistics and pictures.
std::string slurmMergeScript(const std::filesystem::path& program, const std::filesystem::path& caseDirectory,
                             const std::string& options);

/// Writes both into the folder of the ensemble and submits them; the second waits for the end of the first.
/// \throws FatalError when sbatch is missing or refuses; the scripts then stay
void submitToSlurm(const Ensemble& ensemble, const std::string& options);

} // namespace drystone
