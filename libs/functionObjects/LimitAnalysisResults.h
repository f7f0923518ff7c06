// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Results of limit analysis for the user: the tables, the animation and picture of the mechanism, the
/// contact forces. It combines statics with output, which statics does not see.
#pragma once

#include "io/MechanismPicture.h"
#include "statics/LimitAnalysisCase.h"

#include <filesystem>

namespace drystone
{

/// postProcessing/limitAnalysis/0/limitAnalysis.dat
std::filesystem::path limitAnalysisTable(const std::filesystem::path& caseDirectory);

/// postProcessing/limitAnalysis/0/input: the input that the results there follow from
std::filesystem::path limitAnalysisInput(const std::filesystem::path& caseDirectory);

/// Checks the functions of controlDict and reports that they are not run: they follow motion, which limit
/// analysis does not have.
/// \throws FatalIOError for faults in them
template<int Dim>
void checkFunctions(const Dictionary& controlDict, const std::filesystem::path& caseDirectory,
                    const Assembly<Dim>& assembly);

/// For `-postProcess`: the solver has already written all its results.
/// \throws FatalError when there are no results
void confirmResults(const std::filesystem::path& caseDirectory);

/// Checks, before anything is computed, whether the folders of the results can be written.
/// \throws FatalError naming the one that cannot
void requireWritableResults(const std::filesystem::path& caseDirectory);

/// Removes what an earlier run has written, tables, pictures and VTK series, so that after a run that did not
/// converge none of it is taken for an answer.
void removeLimitAnalysisResults(const std::filesystem::path& caseDirectory);

/// Writes the cone program as postProcessing/limitAnalysis/0/coneProgram, when `writeProgram` of
/// system/solution requests it.
template<int Dim>
void writeLimitAnalysisProgram(const std::filesystem::path& caseDirectory,
                               const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result);

/// What the names of the files of each answer end in: its combination, and `Negative` for the negative end.
std::vector<std::string> suffixesOfAnswers(const std::vector<LimitAnalysis>& results);

/// Whether the tables of a case say that maximumTime has ended a search for collapses by Coulomb's law: of a
/// moving load that of the position with the lowest multiplier.
bool isSearchCutShort(const std::filesystem::path& caseDirectory);

/// How the pictures of the answers are drawn.
struct AnswerPictures
{
    Vector<3> towardsViewer = usualView(); ///< of mechanisms in space
    PictureFormats formats{PictureFormat::svg};
};

/// Writes
/// - postProcessing/limitAnalysis/0/limitAnalysis.dat, a row of figures; alpha is `inf` for unbounded and
/// `nan` for unstable;
/// - postProcessing/limitAnalysis/0/coulomb.dat for the non-associative flow rule: the range of collapses
/// found, with a column `cutShortAfter` where maximumTime has ended the search;
/// - postProcessing/limitAnalysis/0/mechanism.svg (or .png, .pdf), the mechanism over the structure as built;
/// - postProcessing/limitAnalysis/0/thrust.dat and, in the plane, thrust.svg: stress resultants and centre of
/// pressure of each joint that carries a load, the line of thrust;
/// - VTK/blocks.vtp.series, the mechanism growing from the structure as built, with displacement rates;
/// - VTK/contacts.vtp.series, contact forces at collapse, gap and state;
/// - VTK/thrust.vtp.series, the line of thrust: centres of pressure with the force of the joint.
///
/// A second answer, for the negative end of the range, has a second row, and files with `Negative` in their
/// names. With combinations of loads each has its row and `_<name>` in the names of its files;
/// combinations.dat lists names, multipliers and statuses. Named loads (`cases`) are in loadCases.dat with
/// their forces; a moving load has movingLoad.dat and movingLoad.svg (LoadEnvelope.h), and the other files
/// are those of its worst place. \param cpuTime of the solution [s] \throws FatalError naming what cannot be
/// written
template<int Dim>
void writeLimitAnalysisResults(const std::filesystem::path& caseDirectory,
                               const LimitAnalysisCase<Dim>& structure,
                               const std::vector<LimitAnalysis>& results, double cpuTime,
                               const AnswerPictures& pictures = {});

} // namespace drystone
