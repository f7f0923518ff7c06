// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether results that a case keeps follow from the input that it has now.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Fingerprint.h"
#include "io/TimeDirectory.h"
#include "runControl/Time.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// What a motion follows from: the assembly, constant/, the motion that it began with, system/schemes,
/// contactDynamics in system/solution, and the steps of system/controlDict. What only says how long to run
/// and what to write is not in it.
/// \param assembly with closed joints \param beginning name of the time at which the motion began
template<int Dim>
std::vector<InputFile> inputOfMotion(const std::filesystem::path& caseDirectory,
                                     const Assembly<Dim>& assembly, const Time& time,
                                     const std::string& beginning);

/// The name of the time at which the motion began that has these states, of which there is one at least.
std::string beginningOf(const std::vector<std::pair<std::string, State>>& states, const Time& time);

/// The last of them: the steps of controlDict, which may be read again while a run goes on.
InputFile inputOfSteps(const Time& time);

/// What limitAnalysis answers from.
template<int Dim>
std::vector<InputFile> inputOfLimitAnalysis(const std::filesystem::path& caseDirectory,
                                            const Assembly<Dim>& assembly);

/// Where a state keeps its input.
inline constexpr const char* inputInState = "input";

/// Compares the state that a run continues from with the input of now. Warns of what has changed; other steps
/// or solver settings alone may be the reason for continuing a run, and are reported on standard output.
/// Reports when there is nothing left to compute, and a state of an older version, which has no fingerprints.
void compareWithInput(const State& start, const std::vector<InputFile>& now, const Time& time);

/// Warns once of all the states that follow from other input. \param states with the names of their times
/// \return the warning; empty: none
std::string compareWithInput(const std::vector<std::pair<std::string, State>>& states,
                             const std::vector<InputFile>& now);

/// `input` in the folder of an application's tables, and what it says; nothing where there is none.
void writeInput(const std::filesystem::path& file, const std::vector<InputFile>& files);
std::optional<std::vector<InputFile>> readInput(const std::filesystem::path& file);
/// Warns when the results in the folder of this file follow from other input. \return the warning; empty:
/// none
std::string compareWithInput(const std::filesystem::path& file, const std::vector<InputFile>& now);

/// For who shows the states of a motion together with the input of now: warns as above, and where that input
/// cannot be read. \param times names of their directories \param assembly with closed joints \return the
/// warning; empty: none
template<int Dim>
std::string compareMotion(const std::filesystem::path& caseDirectory, const Assembly<Dim>& assembly,
                          const std::vector<std::string>& times);
/// The same of the tables and the mechanism of limitAnalysis, where the case has them.
template<int Dim>
std::string compareLimitAnalysis(const std::filesystem::path& caseDirectory, const Assembly<Dim>& assembly);

/// The same of the frames in VTK/, which are of one of the two.
template<int Dim>
std::string compareFrames(const std::filesystem::path& caseDirectory, const Assembly<Dim>& assembly);

/// Whether the frames of a case are of a motion in time, not of a mechanism: what has been run, and where
/// that is both or none the application that controlDict names.
bool isOfMotion(const std::filesystem::path& caseDirectory);

/// The time directories with a state, in the order of their times.
std::vector<std::string> timesOfStates(const std::filesystem::path& caseDirectory);

} // namespace drystone
