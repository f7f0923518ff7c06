// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The report of a case: one page for those who did not run it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// A section that somebody else has text for: the answer of a study.
struct ReportSection
{
    std::string heading;
    std::vector<std::string> sentences;
    std::vector<std::string> head; ///< of the table
    std::vector<std::vector<std::string>> rows;
};

/// Writes a self-contained page of a case: structure, results with what they mean and their certificate,
/// pictures, time histories, a viewer of the motion in three dimensions, all input with units, warnings of
/// the logs, and how to repeat it. What a case does not have is left out; what is left out for its size is
/// named. Results that follow from other input than that of now are warned of, in the log and on the page.
/// Of a case without blocks, as one whose studies make them anew for each run, the page has the sections
/// given, pictures, warnings and how to repeat it. \param file of the page, made whole or not at all \param
/// warnings what else the page is to warn of \param sections that come before the pictures \throws
/// FatalError where the case has no results, and what reading its input throws
void writeReport(const std::filesystem::path& caseDirectory, const std::filesystem::path& file,
                 std::vector<std::string> warnings = {}, const std::vector<ReportSection>& sections = {});

/// The page of a case: report.html in its directory.
std::filesystem::path reportFile(const std::filesystem::path& caseDirectory);

} // namespace drystone
