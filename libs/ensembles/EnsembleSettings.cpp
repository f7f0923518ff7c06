// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declares the keys of system/ensembleDict.
#include "ensembles/EnsembleSettings.h"

#include "dictionary/NamesIn.h"
#include "ensembles/ApplicationRun.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace drystone
{
namespace
{

const std::vector<std::string>& knownApplications()
{
    static const std::vector<std::string> names{"blockTexture",    "checkBlocks",         "limitAnalysis",
                                                "contactDynamics", "incrementalDynamics", "parameterSearch"};
    return names;
}

std::string faultOfApplications(const std::vector<std::string>& applications)
{
    if (applications.empty())
    {
        return "Nothing is run: give applications.";
    }
    for (const std::string& application : applications)
    {
        const auto& known = knownApplications();
        if (isScript(application) ? !isInsideCase(application)
                                  : std::find(known.begin(), known.end(), application) == known.end())
        {
            return unknownWordMessage("application", application, known)
                   + "\n\nA script of your own in the case is given with its folder: \"./prepare\".";
        }
    }
    return "";
}

} // namespace

void declare(Options& options, FailureSettings& failures)
{
    options
        .optional(
            "attempts", failures.attempts,
            "of a sample that crashes, hangs or runs out of memory; one that ends with a message is not "
            "repeated")
        .atLeast(1)
        .atMost(100);
    options.optional("maximumTime", failures.maximumTime, "of an attempt, which is ended then; absent: any")
        .unit("s")
        .above(0)
        .example("600");
    options
        .optional("maximumMemory", failures.maximumMemory,
                  "that a process may take, in megabytes; absent: any")
        .atLeast(64)
        .example("2000");
    options
        .optional("maximumPart", failures.maximumPart,
                  "of the samples that may fail; when there are more, the exit status is 2")
        .atLeast(0)
        .atMost(1);
}

bool EnsembleSettings::runs(std::string_view application) const
{
    return std::find(applications.begin(), applications.end(), application) != applications.end();
}

namespace
{

/// Of a column that samples.dat has anyway.
std::string faultOfColumn(const std::string& name)
{
    static constexpr std::array taken{"sample", "status", "attempts", "cpuTime"};
    return std::find(taken.begin(), taken.end(), name) == taken.end()
               ? ""
               : fmt::format("samples.dat has a column {} of its own: choose another name.", name);
}

std::string faultOfVariables(const EnsembleSettings& settings)
{
    std::set<std::string> places;
    for (const auto& [name, variable] : settings.variables)
    {
        if (std::string fault = faultOfName(name); !fault.empty())
        {
            return fault;
        }
        if (std::string fault = faultOfColumn(name); !fault.empty())
        {
            return fault;
        }
        if (std::string fault = faultOfNextEntry(variable.place, places); !fault.empty())
        {
            return fault;
        }
    }
    return settings.variables.empty() ? "There is no variable." : "";
}

std::string faultOfResults(const EnsembleSettings& settings)
{
    const std::vector<std::string> variables = namesIn(settings.variables);
    std::set<std::string> names(variables.begin(), variables.end());
    for (const auto& [name, result] : settings.results)
    {
        if (std::string fault = faultOfNextName(name, names); !fault.empty())
        {
            return fault;
        }
        if (std::string fault = faultOfColumn(name); !fault.empty())
        {
            return fault;
        }
    }
    return settings.results.empty() ? "There is no result." : "";
}

std::string faultOfStatistics(const EnsembleSettings& settings)
{
    for (const auto& [name, statistic] : settings.statistics)
    {
        if (name.find('/') != std::string::npos || name == "samples" || name == "statistics")
        {
            return "The name " + name + " cannot be that of a table: choose another one.";
        }
    }
    return "";
}

} // namespace

void declare(Options& options, EnsembleSettings& settings)
{
    options
        .required("applications", settings.applications,
                  "run one after the other for each sample; a script in the case as \"./prepare\"")
        .example("(blockTexture limitAnalysis)");
    options
        .required(
            "variables", settings.variables,
            "entries of the case that are uncertain; any names. Limit analyses in the plane that differ in "
            "friction, density, g and loads alone, without strength of joints, with results as alpha, and "
            "with the default solver, are solved several at once: the log says so")
        .example("mu");
    options.optional("correlations", settings.correlations, "of two variables with numbers (Nataf)")
        .example("((mu unit 0.3))");
    options.required("design", settings.design, designTypes(), "which values the samples have");
    options.required("results", settings.results, figureTypes(), "figures of each sample; any names")
        .example("alpha");
    options.optional("failures", settings.failures, "samples that fail");
    options
        .optional("statistics", settings.statistics, statisticTypes(),
                  "what is made of the samples; any names, also used for files")
        .example("capacity");
    options.check("applications", [&settings] { return faultOfApplications(settings.applications); });
    options.check("variables", [&settings] { return faultOfVariables(settings); });
    options.check("results", [&settings] { return faultOfResults(settings); });
    options.check("statistics", [&settings] { return faultOfStatistics(settings); });
}

} // namespace drystone
