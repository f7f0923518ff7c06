// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Observes states as if just computed; a table with more times than states is a run's, which stops it.
#include "functionObjects/StoredStates.h"

#include "core/Log.h"
#include "core/WholeFile.h"
#include "functionObjects/FunctionList.h"
#include "functionObjects/KeptResults.h"
#include "functionObjects/MotionState.h"
#include "io/TimeDirectory.h"
#include "quantities/TableLine.h"
#include "runControl/Case.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>

#include <set>
#include <sstream>

namespace drystone
{
namespace
{

/// How many different times the rows of a table have.
std::size_t timesIn(const std::filesystem::path& table)
{
    std::set<double> times;
    std::istringstream stream(contentOfFile(table));
    for (TableLine line; nextLine(stream, line);)
    {
        const std::optional<double> time =
            line.isHeading || line.words.empty() ? std::nullopt : numberIn(line.words.front());
        if (time)
        {
            times.insert(*time);
        }
    }
    return times.size();
}

/// A run that began at the first state has tables of its own in the folders that would be written into: of
/// more times than there are states. \throws FatalError for such a table
void refuseTablesOfRun(const std::filesystem::path& caseDirectory, const Dictionary& functions,
                       const std::string& firstTime, std::size_t states)
{
    for (const Entry& function : functions.entries())
    {
        const std::filesystem::path folder =
            postProcessingFolder(caseDirectory, function.keyword(), firstTime);
        std::error_code none;
        for (const auto& entry : std::filesystem::directory_iterator(folder, none))
        {
            if (entry.path().extension() == ".dat" && timesIn(entry.path()) > states)
            {
                throw FatalError(fmt::format(
                    "{} is a table of the run that began at {}, and would be written "
                    "over: it has more times than there are states.\n\nRename the "
                    "folder {} to keep it, or remove it.",
                    entry.path().lexically_normal().string(), firstTime, folder.lexically_normal().string()));
            }
        }
    }
}

} // namespace

template<int Dim>
void postProcess(const std::filesystem::path& caseDirectory, const DynamicCase<Dim>& scene, const Time& time)
{
    std::vector<std::pair<std::string, State>> states;
    for (const std::string& name : timesOfStates(caseDirectory))
    {
        states.emplace_back(name, readState(caseDirectory / name / "state"));
    }
    if (states.empty())
    {
        throw FatalError("There are no results to process: no time directory of this case has a state. Run "
                         "contactDynamics without -postProcess first.");
    }
    compareWithInput(states, inputOfMotion(caseDirectory, scene.assembly, time, beginningOf(states, time)));
    const Dictionary functions =
        time.controlDict().found("functions") ? time.controlDict().subDict("functions") : Dictionary();
    refuseTablesOfRun(caseDirectory, functions, states.front().first, states.size());
    FunctionList<Dim> list(functions, caseDirectory, states.front().first, {}, 0, scene.assembly);
    ObservedLists<Dim> lists;
    for (const auto& [name, saved] : states)
    {
        info("Time = {}", name);
        const Motion<Dim> motion = motionOf(scene, saved);
        StepObservation<Dim> seen = observe(scene, motion, time, lists);
        const TimeState then = timeOf(saved);
        seen.time = then.value;
        seen.timeStep = then.stepLength;
        seen.step = then.index;
        seen.stageTimes.reset();
        list.writeStored(seen, {then.value, then.stepLength, then.index, 0, 0, 0});
    }
    list.writePictures();
}

template void postProcess(const std::filesystem::path& caseDirectory, const DynamicCase<2>& scene,
                          const Time& time);
template void postProcess(const std::filesystem::path& caseDirectory, const DynamicCase<3>& scene,
                          const Time& time);

} // namespace drystone
