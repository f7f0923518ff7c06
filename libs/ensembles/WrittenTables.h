// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which tables the applications of a study write, as far as that is known before they run: common to the
/// studies that take results from tables.
#pragma once

#include "dictionary/Dictionary.h"
#include "ensembles/StudyInput.h"
#include "quantities/TableFigure.h"

#include <filesystem>

namespace drystone
{

/// Refuses a result that the applications do not write: a table or column that limitAnalysis does not have,
/// the table of a function that system/controlDict does not have. Where a script is among the applications,
/// or the table is of another one, nothing is known before it has run.
/// \param runs its applications and cases \param result the dictionary with `table` and `column`, for
/// messages \throws FatalIOError
void requireTable(const TableFigure& figure, const std::filesystem::path& caseDirectory,
                  const StudyRuns& runs, const Dictionary& result);

} // namespace drystone
