// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The contents of system/ensembleDict: many samples of one case.
///
///     applications (blockTexture limitAnalysis);
///     variables  { mu { file "constant/contactProperties"; entry "friction/mu"; distribution { ... } } }
///     design     { type latinHypercube; samples 100000; seed 1; }
///     results    { alpha { type multiplier; } }
///     failures   { attempts 2; maximumTime 600; maximumPart 0.01; }
///     statistics { capacity { type distribution; value alpha; } }
#pragma once

#include "ensembles/Design.h"
#include "ensembles/Statistic.h"
#include "quantities/Figure.h"

namespace drystone
{

/// What a sample that fails costs, and how many may.
struct FailureSettings
{
    int attempts = 2;                    ///< of a sample that crashed, hung or ran out of memory
    std::optional<double> maximumTime;   ///< of an attempt [s]; absent: any
    std::optional<double> maximumMemory; ///< of a process [MB]; absent: any
    double maximumPart = 0.01;           ///< of the samples that may fail
};
void declare(Options& options, FailureSettings& failures);

struct EnsembleSettings
{
    std::vector<std::string> applications;
    std::vector<Named<EnsembleVariable>> variables;
    std::vector<Correlation> correlations;
    Design design;
    std::vector<Named<Figure>> results;
    FailureSettings failures;
    std::vector<Named<Statistic>> statistics;

    /// Whether an application of this name is among those of a sample.
    bool runs(std::string_view application) const;
};
void declare(Options& options, EnsembleSettings& settings);

} // namespace drystone
