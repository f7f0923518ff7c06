// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sections of the report of a case that a source of their own makes.
#pragma once

#include "assembly/Assembly.h"
#include "report/CaseReport.h"
#include "report/HtmlPage.h"
#include "statics/LimitAnalysis.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace drystone
{

/// What results follow from: the input that the case has now, or another.
enum class InputOfResults
{
    same,
    other ///< what multiplies a result by a load of now is left out
};

/// The status that a number of the table of limitAnalysis stands for; nothing for a number of none.
std::optional<CollapseStatus> storedStatus(double number);

/// The answers of limitAnalysis with what they mean and their certificate; nothing without its table.
template<int Dim>
void addCollapse(HtmlPage& page, const std::filesystem::path& caseDirectory, InputOfResults input);

/// The animation, with what its end shows, and the viewer.
template<int Dim>
void addMotion(HtmlPage& page, const std::filesystem::path& caseDirectory, const Assembly<Dim>& assembly);

/// Results that cannot be read; of a case of which nothing has an answer, that there is none. \param sections
/// of studies that have one
void addDamage(HtmlPage& page, const std::filesystem::path& caseDirectory, std::size_t freeBlocks,
               const std::vector<ReportSection>& sections);

/// All input with units.
template<int Dim>
void addInputs(HtmlPage& page, const std::filesystem::path& caseDirectory);

} // namespace drystone
