// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What an incremental analysis reports while it runs, and of its answers.
#pragma once

#include "ensembles/IncrementalDynamics.h"

#include <string>
#include <vector>

namespace drystone
{

/// Before the first run: effects, motions of the ground, criterion, jobs.
template<int Dim>
void printStudy(const IncrementalDynamics<Dim>& study);

/// One line for a completed run. \param timeLeft added to it
template<int Dim>
void printRun(const IncrementalDynamics<Dim>& study, std::size_t motion, const IncrementalRun& run,
              const std::string& timeLeft);

/// How long the runs that are not done will take at most, by those that are.
class StudyClock
{
public:
    /// \param runs of the whole study, at most \param known of them, which take no time
    StudyClock(long runs, long known);
    void count() { ++done; }      ///< a run that is done
    std::string timeLeft() const; ///< `at most 12 s left`

private:
    long toDo;
    long done = 0;
    double start;
};

/// `Least acceleration that meets the criterion a_g = 0.643 g`, or why there is none; for each motion.
template<int Dim>
void printLeast(const IncrementalDynamics<Dim>& study, const std::vector<IncrementalCurve>& curves);

} // namespace drystone
