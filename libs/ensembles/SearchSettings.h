// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Smallest or largest value of a result of a case over some of its entries: system/parameterSearchDict.
///
///     applications (blockTexture limitAnalysis);      // run one after the other in a copy of the case
///     variables
///     {
///         thickness { file "system/blockTextureDict"; entry "texture/thickness"; bounds (0.05 0.3); }
///     }
///     results
///     {
///         alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column alpha; otherwise -0.1; }
///     }
///     objective   { goal minimise; value thickness; }
///     constraints { stands { value alpha; atLeast 0; } }
///     search      ( { algorithm DIRECT_L; maximumEvaluations 30; } { algorithm COBYLA; } );
#pragma once

#include "dictionary/EntryLocations.h"
#include "dictionary/Options.h"
#include "ensembles/CaseEntry.h"
#include "ensembles/SearchStage.h"
#include "quantities/TableFigure.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// An entry of a dictionary of the case that is varied. It must be a number.
struct SearchVariable
{
    CaseEntry place;
    std::array<double, 2> bounds{0, 0};
    std::optional<double> start; ///< absent: the value of the case, or the nearer bound
    double firstStep = 0.25;     ///< of local algorithms [width of the bounds]
};
void declare(Options& options, SearchVariable& variable);

/// A number in a table of the applications.
struct SearchResult
{
    TableFigure figure;
    std::optional<double> otherwise; ///< where the table has none, or one that is not finite
};
void declare(Options& options, SearchResult& result);

enum class SearchGoal
{
    minimise,
    maximise,
};
inline std::array<std::pair<std::string_view, SearchGoal>, 2> namesOf(SearchGoal)
{
    return {{{"minimise", SearchGoal::minimise}, {"maximise", SearchGoal::maximise}}};
}

/// The value to be minimised or maximised: arithmetic of variables and results.
struct SearchObjective
{
    SearchGoal goal = SearchGoal::minimise;
    std::string value;

    double sign() const { return goal == SearchGoal::minimise ? 1 : -1; } ///< times the value is to be least
};
void declare(Options& options, SearchObjective& objective);

/// A condition: arithmetic of variables and results, within limits.
struct SearchConstraint
{
    std::string value;
    std::optional<double> atLeast;
    std::optional<double> atMost;
    double tolerance = 1e-8; ///< by which the limits may be missed, in the unit of the value
};
void declare(Options& options, SearchConstraint& constraint);

/// The contents of the dictionary.
struct ParameterSearchSettings
{
    std::vector<std::string> applications;
    std::vector<std::string> cases{"."}; ///< in which they are run, in the case directory
    std::vector<Named<SearchVariable>> variables;
    std::vector<Named<SearchResult>> results;
    SearchObjective objective;
    std::vector<Named<SearchConstraint>> constraints;
    std::vector<SearchStage> search;
    int seed = 1;             ///< of the random numbers of CRS2_LM, ISRES and ESCH
    EntryLocations locations; ///< of the entries of the dictionary, for messages
};
void declare(Options& options, ParameterSearchSettings& settings);

/// Settings with the places of their entries. \throws FatalIOError
ParameterSearchSettings readSearchSettings(const Dictionary& dictionary);

/// The value of an expression of variables and results. \throws std::invalid_argument
double valueOf(const std::string& expression, const ParameterSearchSettings& settings,
               const std::vector<double>& variables, const std::vector<double>& results);

} // namespace drystone
