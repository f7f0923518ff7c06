// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the runs of a study follow from, so that it is continued only where that is as it was.
#pragma once

#include "dictionary/Fingerprint.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// What a study runs.
struct StudyRuns
{
    std::string dictionary;                ///< of the study, in the case; no input of its runs
    std::vector<std::string> applications; ///< one after the other; a script of the case as "./prepare"
    std::vector<std::string> cases{"."};   ///< in the case directory: in each all of them are run
    std::vector<std::string> data = {};    ///< files that the dictionary of the study names for its runs
};

/// Whether a script is among the applications: it may read dictionaries in its own way, and write anything.
bool hasScript(const StudyRuns& runs);

/// The files that the runs read, sorted by name: 0/, constant/ and system/, what these include or name with
/// `file`, `data`, scripts, and files of the case that a script mentions. Dictionaries by their tokens, as
/// variables of a study change them before they are read: comments and layout do not count. All else byte by
/// byte, and dictionaries too where a script is run, which may read them in its own way. Neither copies of
/// editors (`g~`, `g.orig`), hidden files, logs and results, nor dictionaries of other studies; nor
/// constant/assembly where blockTexture comes first and writes it anew.
std::vector<InputFile> inputOfStudy(const std::filesystem::path& caseDirectory, const StudyRuns& runs);

/// What a study makes of its runs, or requests of them: its dictionary, as objective and constraints of a
/// search. How many runs there are at a time (`jobs`) is no part of it.
std::vector<InputFile> inputOfQuestions(const std::filesystem::path& caseDirectory, const std::string& study);

/// As a file of a study keeps them: `input 1f2e3d4c5b6a7988 constant/g`, a line each behind `mark`, after one
/// that says how dictionaries were compared.
std::string inputLines(const std::vector<InputFile>& files, const std::string& mark = "");

/// Whether a text begins with such lines; those of older versions do not, and cannot be compared with them.
bool hasInputLines(const std::string& text, const std::string& mark = "");

/// The files that a text with such lines names.
std::vector<std::string> namesOfInput(const std::string& text, const std::string& mark = "");

/// How the input differs between two texts with such lines: `constant/g has changed`. Empty: not at all.
/// \param mark before each of the lines
std::string changedInput(const std::string& before, const std::string& now, const std::string& mark = "");

/// Why a study ends whose case has been edited meanwhile. \param begun as `the search was` \param kept what
/// it has found so far \param study its folder in postProcessing
std::string editedCaseText(const std::string& change, const std::string& begun, const std::string& kept,
                           const std::string& study);

/// Sees that the input of a study is what it was when the study began: somebody may edit the case meanwhile,
/// and runs read it anew each.
class InputWatch
{
public:
    /// \param lines as `inputLines` has made them at the beginning, with `mark`
    InputWatch(std::filesystem::path watchedCase, StudyRuns runsOfStudy, std::string lines,
               std::string markOfLines = "");
    /// `constant/g has changed`. Empty: nothing has. Files are read only where one of them, or a folder, has
    /// been touched.
    std::string change();

private:
    std::string touches() const;

    std::filesystem::path caseDirectory;
    StudyRuns runs;
    std::string before;
    std::string mark;
    std::vector<InputFile> files;
    std::string known; ///< touches of files that say what they said
};

} // namespace drystone
