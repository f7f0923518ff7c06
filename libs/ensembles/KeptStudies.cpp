// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Takes what a study notes of its input, and compares it with that of now.
#include "ensembles/KeptStudies.h"

#include "core/Error.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "ensembles/SampleStore.h"
#include "ensembles/StudyInput.h"
#include "functionObjects/KeptResults.h"
#include "runControl/CaseFiles.h"

#include <sstream>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// What a study has run, as its plan or history notes it.
StudyRuns runsIn(const std::string& notes, const std::string& study, const std::string& mark)
{
    StudyRuns runs;
    runs.dictionary = "system/" + study + "Dict";
    runs.data = namesOfInput(notes, mark); // records among them, of which the dictionary may name others now
    std::istringstream stream(notes);
    for (std::string line; std::getline(stream, line);)
    {
        std::istringstream words(line.starts_with("# ") ? line.substr(2) : line);
        std::string word;
        words >> word;
        if (word != "applications")
        {
            continue;
        }
        std::vector<std::string>* names = &runs.applications;
        while (words >> word)
        {
            if (word == "in")
            {
                runs.cases.clear();
                names = &runs.cases;
                continue;
            }
            if (word.back() == ';') // of a search: its variables follow
            {
                names->push_back(word.substr(0, word.size() - 1));
                break;
            }
            if (word.front() != '-') // an option
            {
                names->push_back(word);
            }
        }
        break;
    }
    return runs;
}

/// How system/ensembleDict differs from what the samples were computed for. Empty where it does not.
std::string changedPlan(const fs::path& caseDirectory)
{
    const fs::path work = ensembleWork(caseDirectory);
    const std::string plan = contentOfFile(work / "plan");
    std::vector<std::string> options;
    if (plan.find(" -noFunctionObjects\n") != plan.npos)
    {
        options.emplace_back("-noFunctionObjects");
    }
    try
    {
        const std::optional<PlanChange> change = planChange(work, readEnsemble(caseDirectory, options).plan);
        return change ? change->questions : "";
    }
    catch (const FatalError& error)
    {
        return fmt::format("system/ensembleDict cannot be compared: {}", error.what());
    }
}

/// How the dictionary of a study differs from what its answer was found for. Empty where it does not, or
/// there is no answer.
std::string changedQuestions(const fs::path& caseDirectory, const std::string& study, const fs::path& folder)
{
    if (study == "ensemble")
    {
        return changedPlan(caseDirectory);
    }
    const std::optional<std::vector<InputFile>> before = readInput(folder / "input");
    return before ? textOf(changesOfInput(*before, inputOfQuestions(caseDirectory, study))) : "";
}

} // namespace

std::vector<std::string> compareStudies(const fs::path& caseDirectory)
{
    std::vector<std::string> warnings;
    for (const std::string study : {"accuracyCost", "ensemble", "incrementalDynamics", "parameterSearch"})
    {
        const fs::path folder = caseDirectory / "postProcessing" / study;
        for (const std::string& time : namesIn(folder))
        {
            const bool isEnsemble = study == "ensemble";
            const fs::path file = folder / time / (isEnsemble ? "work/plan" : "history.dat");
            const std::string notes = contentOfFile(file);
            const std::string mark = isEnsemble ? "" : "# ";
            if (!hasInputLines(notes, mark))
            {
                info("{} does not say from which input the results of {} were computed: it is damaged or "
                     "gone, "
                     "or an older version has written it, and changes since are not noticed.",
                     file.string(), study);
                continue;
            }
            std::string changes = changedInput(
                notes, inputLines(inputOfStudy(caseDirectory, runsIn(notes, study, mark)), mark), mark);
            if (const std::string questions = changedQuestions(caseDirectory, study, folder / time);
                !questions.empty())
            {
                changes += (changes.empty() ? "" : ", ") + questions;
            }
            if (!changes.empty())
            {
                warnings.push_back(fmt::format("The results of {} are those of other input: {}. Remove "
                                               "postProcessing/{} and run {} to compute anew.",
                                               study, changes, study, study));
                printWarning(warnings.back(), {file.string(), "", 0});
            }
        }
    }
    return warnings;
}

} // namespace drystone
