// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The results of an ensemble: its table, its statistics and pictures, the end of its log.
#pragma once

#include "ensembles/SampleStore.h"

namespace drystone
{

/// All samples that are computed, from the journals.
SampleTable collectSamples(const Ensemble& ensemble, std::map<long, SampleRow>& rows);

/// Writes into postProcessing/ensemble/0/
/// - samples.dat: `sample[-]`, variables, results, `status[-] attempts[-] cpuTime[s]`, a row a sample,
/// sorted;
///   status is the number of SampleStatus; words with signs stand between quotes. samples.csv has the same;
/// - statistics.dat: `statistic quantity value standardError lower upper`, nan for what is not known; and
///   <statistic>.dat with the curve or histogram;
/// - <statistic>.svg, and scatter_<variable>.svg: the first result over each variable.
///
/// Prints what they say. All but cpuTime is the same for any number of processes and any interruption.
/// \return 0; 2 when more than maximumPart of the samples have failed
int writeEnsemble(const Ensemble& ensemble, const std::map<long, SampleRow>& rows, const SampleTable& table);

} // namespace drystone
