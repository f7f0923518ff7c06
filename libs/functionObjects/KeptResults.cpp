// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Fingerprints of then against those of now; of a run that goes on, changes of method are only reported.
#include "functionObjects/KeptResults.h"

#include "assembly/AssemblyOrigin.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "functionObjects/LimitAnalysisResults.h"
#include "functionObjects/MotionState.h"
#include "runControl/Solution.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{
namespace
{

/// Whether a change concerns only the numerical method, and neither the structure nor its loads.
bool isMethod(const InputChange& change)
{
    return change.file.starts_with("system/");
}

/// The numbers of a solver, without what it is to write.
InputFile solutionOf(const std::filesystem::path& caseDirectory, const std::string& application)
{
    return {"system/solution", fingerprint(readSolution(caseDirectory, application), {"writeProgram"})};
}

template<int Dim>
std::vector<InputFile> inputOf(const std::filesystem::path& caseDirectory, const Assembly<Dim>& assembly,
                               const std::string& application, const std::vector<std::string>& names)
{
    std::vector<InputFile> files = inputFiles(caseDirectory, names);
    files.push_back({"constant/assembly/blocks", fingerprint(assembly)});
    files.push_back(solutionOf(caseDirectory, application));
    std::sort(files.begin(), files.end(),
              [](const InputFile& a, const InputFile& b) { return a.name < b.name; });
    return files;
}

/// What `compare` warns of; where it finds the input of now at fault, a warning that says so.
template<class Compare>
std::string unlessUnreadable(const std::string& application, const Compare& compare)
{
    try
    {
        return compare();
    }
    catch (const FatalError& error)
    {
        std::string warning =
            fmt::format("Whether the results of {} are those of the input of now is unknown, "
                        "since that cannot be read: {}",
                        application, error.what());
        printWarning(warning);
        return warning;
    }
}

const char* const noInput = "does not say from which input it was computed: an older version has written it, "
                            "and changes since are not noticed.";

} // namespace

template<int Dim>
std::vector<InputFile> inputOfMotion(const std::filesystem::path& caseDirectory,
                                     const Assembly<Dim>& assembly, const Time& time,
                                     const std::string& beginning)
{
    std::vector<InputFile> files = inputOf(
        caseDirectory, assembly, "contactDynamics",
        {"constant/contactProperties", "constant/g", "constant/groundMotion", "constant/loads",
         "constant/materialProperties", "constant/supportMotion", beginning + "/motion", "system/schemes"});
    files.push_back(inputOfSteps(time));
    return files;
}

InputFile inputOfSteps(const Time& time)
{
    Fingerprint steps;
    steps.add(time.controls().deltaT);
    steps.add(time.controls().adjustTimeStep ? 1.0 : 0.0);
    return {"system/controlDict", steps.value()};
}

template<int Dim>
std::vector<InputFile> inputOfLimitAnalysis(const std::filesystem::path& caseDirectory,
                                            const Assembly<Dim>& assembly)
{
    return inputOf(
        caseDirectory, assembly, "limitAnalysis",
        {"constant/contactProperties", "constant/g", "constant/loads", "constant/materialProperties"});
}

template std::vector<InputFile> inputOfLimitAnalysis(const std::filesystem::path& caseDirectory,
                                                     const Assembly<2>& assembly);
template std::vector<InputFile> inputOfLimitAnalysis(const std::filesystem::path& caseDirectory,
                                                     const Assembly<3>& assembly);

void compareWithInput(const State& start, const std::vector<InputFile>& now, const Time& time)
{
    const TimeControls& controls = time.controls();
    const bool isDone = controls.stopAt == StopAt::endTime
                        && time.value() > controls.endTime - 0.5 * std::min(time.deltaT(), controls.deltaT);
    const auto input = start.texts.find(inputInState);
    if (input == start.texts.end())
    {
        info("{} {}", start.file.string(), noInput);
    }
    else if (const std::vector<InputChange> changes = changesOfInput(inputFilesIn(input->second), now);
             !changes.empty())
    {
        const bool isMethodOnly = std::all_of(changes.begin(), changes.end(), isMethod);
        if (isMethodOnly && !isDone)
        {
            info("Continues with other settings than the results so far: {}", textOf(changes));
        }
        else
        {
            printWarning(
                fmt::format("The results at time {} are those of other input: {}.\n\n{} Remove the time "
                            "directories after {} to compute anew, or restore the input.",
                            time.startName(), textOf(changes),
                            isDone ? "Nothing is computed, because endTime is reached: what is there is the "
                                     "old answer."
                                   : "The run continues from them with the input of now.",
                            time.beginningName()),
                {start.file.string(), "", 0});
        }
    }
    if (isDone)
    {
        info(
            "endTime {} s is reached already: there is nothing to compute. Give a later endTime to continue.",
            controls.endTime);
    }
}

std::string beginningOf(const std::vector<std::pair<std::string, State>>& states, const Time& time)
{
    return time.nameOf(timeOf(states.front().second).beginning);
}

std::string compareWithInput(const std::vector<std::pair<std::string, State>>& states,
                             const std::vector<InputFile>& now)
{
    std::string old;
    std::string unknown;
    std::vector<InputChange> last;
    for (const auto& [name, state] : states)
    {
        const auto input = state.texts.find(inputInState);
        if (input == state.texts.end())
        {
            unknown += " " + name;
        }
        else if (std::vector<InputChange> changes = changesOfInput(inputFilesIn(input->second), now);
                 !changes.empty())
        {
            old += " " + name;
            last = std::move(changes);
        }
    }
    if (!unknown.empty())
    {
        info("The state at{} {}", unknown, noInput);
    }
    if (!old.empty())
    {
        std::string warning = fmt::format("The results at time{} are those of other input than that of now: "
                                          "{}. What follows is of the old results.",
                                          old, textOf(last));
        printWarning(warning);
        return warning;
    }
    return {};
}

void writeInput(const std::filesystem::path& file, const std::vector<InputFile>& files)
{
    std::string text = headerText("input") + "\ninput\n(\n";
    for (const std::string& line : textsOf(files))
    {
        text += "    \"" + line + "\"\n";
    }
    writeWholeFile(file, text + ");\n");
}

std::optional<std::vector<InputFile>> readInput(const std::filesystem::path& file)
{
    const Dictionary kept = Dictionary::readFileIfPresent(file);
    return kept.found("input") ? std::optional(inputFilesIn(kept.get<std::vector<std::string>>("input")))
                               : std::nullopt;
}

std::string compareWithInput(const std::filesystem::path& file, const std::vector<InputFile>& now)
{
    const std::optional<std::vector<InputFile>> kept = readInput(file);
    if (!kept)
    {
        info("{} {}", file.parent_path().string(), noInput);
        return {};
    }
    const std::vector<InputChange> changes = changesOfInput(*kept, now);
    if (changes.empty())
    {
        return {};
    }
    std::string warning = fmt::format("The results of limitAnalysis are those of other input: {}. Run "
                                      "limitAnalysis to compute anew.",
                                      textOf(changes));
    printWarning(warning, {file.string(), "", 0});
    return warning;
}

template<int Dim>
std::string compareMotion(const std::filesystem::path& caseDirectory, const Assembly<Dim>& assembly,
                          const std::vector<std::string>& times)
{
    if (times.empty())
    {
        return {};
    }
    return unlessUnreadable("contactDynamics",
                            [&]
                            {
                                const Time time(caseDirectory);
                                std::vector<std::pair<std::string, State>> states;
                                for (const std::string& name : times)
                                {
                                    states.emplace_back(name, readState(caseDirectory / name / "state"));
                                }
                                return compareWithInput(states, inputOfMotion(caseDirectory, assembly, time,
                                                                              beginningOf(states, time)));
                            });
}

template<int Dim>
std::string compareLimitAnalysis(const std::filesystem::path& caseDirectory, const Assembly<Dim>& assembly)
{
    std::error_code none;
    if (!std::filesystem::exists(limitAnalysisTable(caseDirectory), none))
    {
        return {};
    }
    return unlessUnreadable("limitAnalysis",
                            [&]
                            {
                                return compareWithInput(limitAnalysisInput(caseDirectory),
                                                        inputOfLimitAnalysis(caseDirectory, assembly));
                            });
}

bool isOfMotion(const std::filesystem::path& caseDirectory)
{
    std::error_code none;
    const bool hasMotion = !timesOfStates(caseDirectory).empty();
    const bool hasMechanism = std::filesystem::exists(limitAnalysisTable(caseDirectory), none);
    const Dictionary controls = Dictionary::readFileIfPresent(caseDirectory / "system/controlDict");
    const Entry* application = controls.find("application");
    return hasMotion != hasMechanism ? hasMotion : application && application->valueText() != "limitAnalysis";
}

template<int Dim>
std::string compareFrames(const std::filesystem::path& caseDirectory, const Assembly<Dim>& assembly)
{
    const std::vector<std::string> times = timesOfStates(caseDirectory);
    return !times.empty() && isOfMotion(caseDirectory) ? compareMotion(caseDirectory, assembly, times)
                                                       : compareLimitAnalysis(caseDirectory, assembly);
}

std::vector<std::string> timesOfStates(const std::filesystem::path& caseDirectory)
{
    std::vector<std::string> names;
    for (const TimeDirectory& directory : timeDirectories(caseDirectory))
    {
        std::error_code none;
        if (std::filesystem::exists(caseDirectory / directory.name / "state", none)) // 0/motion is a start
        {
            names.push_back(directory.name);
        }
    }
    return names;
}

template std::vector<InputFile> inputOfMotion(const std::filesystem::path& caseDirectory,
                                              const Assembly<2>& assembly, const Time& time,
                                              const std::string& beginning);
template std::vector<InputFile> inputOfMotion(const std::filesystem::path& caseDirectory,
                                              const Assembly<3>& assembly, const Time& time,
                                              const std::string& beginning);
template std::string compareMotion(const std::filesystem::path& caseDirectory, const Assembly<2>& assembly,
                                   const std::vector<std::string>& times);
template std::string compareMotion(const std::filesystem::path& caseDirectory, const Assembly<3>& assembly,
                                   const std::vector<std::string>& times);
template std::string compareFrames(const std::filesystem::path& caseDirectory, const Assembly<2>& assembly);
template std::string compareFrames(const std::filesystem::path& caseDirectory, const Assembly<3>& assembly);
template std::string compareLimitAnalysis(const std::filesystem::path& caseDirectory,
                                          const Assembly<2>& assembly);
template std::string compareLimitAnalysis(const std::filesystem::path& caseDirectory,
                                          const Assembly<3>& assembly);

} // namespace drystone
