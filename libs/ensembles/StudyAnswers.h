// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the studies of a case have found, for who shows it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// The answer of a study as text: sentences, and a table.
struct StudyAnswer
{
    std::string study; ///< ensemble
    std::vector<std::string> sentences;
    std::vector<std::string> faults; ///< what is not there, with the repair
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
};

/// From the tables in postProcessing: what samples have come to and their statistics, least accelerations of
/// incremental analyses, the best point of a search, errors and times of accuracyCost.
std::vector<StudyAnswer> answersOfStudies(const std::filesystem::path& caseDirectory);

} // namespace drystone
