// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads an ensemble, and refuses before the first sample what would make each of them fail.
#include "ensembles/Ensemble.h"

#include "core/Log.h"
#include "core/WholeFile.h"
#include "dictionary/NamesIn.h"
#include "ensembles/CaseRuns.h"
#include "ensembles/CopyMessages.h"
#include "ensembles/SampleCase.h"
#include "ensembles/SamplesInProcess.h"
#include "ensembles/WrittenTables.h"
#include "functionObjects/ColumnFile.h"
#include "quantities/TableLine.h"
#include "runControl/Case.h"

#include <algorithm>
#include <exception>
#include <set>

#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// Whether each result is known to a chain of applications without files.
bool canRunInProcess(const EnsembleSettings& settings)
{
    std::vector<std::string> rest = settings.applications;
    for (const char* application :
         {"blockTexture", "limitAnalysis", "contactDynamics", "incrementalDynamics"})
    {
        if (!rest.empty() && rest.front() == application)
        {
            rest.erase(rest.begin());
        }
    }
    return rest.empty()
           && std::all_of(settings.results.begin(), settings.results.end(),
                          [&](const Named<Figure>& result)
                          {
                              return (result.second.ofCollapse && settings.runs("limitAnalysis"))
                                     || (result.second.isOfMotion() && settings.runs("contactDynamics"))
                                     || (result.second.ofLeastIntensity
                                         && settings.runs("incrementalDynamics"));
                          });
}

/// Whether samples differ in what leaves the blocks and their contact points as they are, and results are
/// properties of the structure: certificates and iterations are those of one of its solutions.
bool haveSameBlocks(const Ensemble& ensemble)
{
    const auto isAmong = [](const std::string& name, std::initializer_list<const char*> names)
    { return std::find(names.begin(), names.end(), name) != names.end(); };
    const EnsembleSettings& settings = ensemble.settings;
    return ensemble.isInProcess && settings.runs("limitAnalysis") && !settings.runs("contactDynamics")
           && !settings.runs("incrementalDynamics")
           && std::all_of(settings.variables.begin(), settings.variables.end(),
                          [&](const Named<EnsembleVariable>& variable)
                          {
                              return isAmong(variable.second.place.file,
                                             {"constant/contactProperties", "constant/loads", "constant/g",
                                              "constant/materialProperties"});
                          })
           && std::all_of(settings.results.begin(), settings.results.end(),
                          [&](const Named<Figure>& result)
                          {
                              const std::optional<std::string>& column = result.second.ofCollapse;
                              return column
                                     && (isColumn("alpha[-]", *column) || isColumn("status[-]", *column)
                                         || isColumn("blocks[-]", *column)
                                         || isColumn("contactPoints[-]", *column)
                                         || isColumn("variables[-]", *column));
                          });
}

/// Whether lanes take the limit analysis of the case as it stands (statics/LaneAnalyses.h). Its faults are
/// those of samples.
bool isCaseForLanes(const Ensemble& ensemble)
{
    try
    {
        return SamplesInProcess(ensemble).isForLanes();
    }
    catch (const std::exception&)
    {
        return false;
    }
}

/// Refuses scripts that are not there, before samples are run for nothing.
void requireScripts(const Ensemble& ensemble, const fs::path& caseDirectory)
{
    for (const std::string& application : ensemble.settings.applications)
    {
        if (const std::string fault = faultOfScript(caseDirectory, application); !fault.empty())
        {
            throw FatalIOError(fault, ensemble.dictionary.locationOf("applications"));
        }
    }
}

/// Refuses results that the applications do not have.
void requireResults(const Ensemble& ensemble)
{
    const StudyRuns runs{"", ensemble.settings.applications};
    for (const auto& [name, figure] : ensemble.settings.results)
    {
        const SourceLocation place = ensemble.dictionary.subDict("results").locationOf(name);
        if (figure.isOfMotion() && !ensemble.isInProcess)
        {
            throw FatalIOError(
                fmt::format(
                    "The result {} is a figure of a motion, known to `applications (contactDynamics);` or "
                    "`(blockTexture contactDynamics);` when all results are such figures. Give the table "
                    "and column of a function object instead, or change applications.",
                    name),
                place);
        }
        if (figure.table)
        {
            requireTable(*figure.table, ensemble.caseDirectory, runs,
                         ensemble.dictionary.subDict("results").subDict(name));
        }
        if (figure.ofCollapse && !ensemble.settings.runs("limitAnalysis")
            && !ensemble.settings.runs("parameterSearch") && !hasScript(runs))
        {
            throw FatalIOError(fmt::format("The result {} is one of limitAnalysis, which is not among the "
                                           "applications.",
                                           name),
                               place);
        }
    }
}

/// Files that samples may draw for an entry `file`, as records of earthquakes.
std::vector<std::string> filesToDraw(const EnsembleVariable& variable)
{
    std::vector<std::string> files;
    if (variable.distribution && fs::path(variable.place.entry).filename() == "file")
    {
        for (const SampleValue& choice : variable.distribution->choices)
        {
            files.push_back(choice.text);
            std::erase(files.back(), '"');
        }
    }
    return files;
}

/// Refuses files that samples may draw and that are not there: most samples would run before one of them is
/// missed. Scripts may yet make them.
void requireFiles(const Ensemble& ensemble)
{
    if (hasScript({"", ensemble.settings.applications}))
    {
        return;
    }
    for (const auto& [name, variable] : ensemble.settings.variables)
    {
        for (const std::string& file : filesToDraw(variable))
        {
            std::error_code unknown;
            if (!fs::exists(ensemble.caseDirectory / file, unknown))
            {
                throw FatalIOError(
                    fmt::format("There is no file {}, which samples may draw.\n\nCheck the "
                                "name: it is relative to the case directory.",
                                file),
                    ensemble.dictionary.subDict("variables").subDict(name).locationOf("distribution"));
            }
        }
    }
}

/// The content of files that a dictionary takes values from.
std::string contentOfNamedFiles(const Ensemble& ensemble, const Dictionary& dictionary)
{
    std::string content;
    for (const std::string& file : filesNamedIn(dictionary))
    {
        content += contentOfFile(ensemble.caseDirectory / file) + '\0';
    }
    return content;
}

} // namespace

StudyRuns runsOf(const Ensemble& ensemble)
{
    StudyRuns runs;
    runs.dictionary = "system/ensembleDict";
    runs.applications = ensemble.settings.applications;
    for (const auto& [name, variable] : ensemble.settings.variables)
    {
        const std::vector<std::string> files = filesToDraw(variable);
        runs.data.insert(runs.data.end(), files.begin(), files.end());
    }
    return runs;
}

namespace
{

/// All that the samples depend on. With random and sobol more samples extend the earlier ones.
std::string planOf(const Ensemble& ensemble)
{
    const EnsembleSettings& settings = ensemble.settings;
    std::string variables = toText(ensemble.dictionary.subDict("variables"));
    for (const auto& [name, variable] : settings.variables)
    {
        const Dictionary& own = ensemble.dictionary.subDict("variables").subDict(name);
        if (const Entry* distribution = own.find("distribution");
            distribution && distribution->isDictionary())
        {
            variables += contentOfNamedFiles(ensemble, distribution->dictionary());
        }
    }
    std::string design = contentOfNamedFiles(ensemble, ensemble.dictionary.subDict("design"));
    for (const Entry& entry : ensemble.dictionary.subDict("design").entries())
    {
        const bool isExtended =
            settings.design.type == DesignType::random || settings.design.type == DesignType::sobol;
        if (entry.keyword() != "samples" || !isExtended)
        {
            design += toText(entry);
        }
    }
    std::string results;
    for (const auto& [name, figure] : settings.results)
    {
        results += toText(ensemble.dictionary.subDict("results").lookup(name));
    }
    const Entry* correlations = ensemble.dictionary.find("correlations");
    return fmt::format("{}applications {} {}\nvariables {:016x}\ncorrelations {}\ndesign {:016x}\nresults "
                       "{:016x}\nattempts {}\n",
                       inputLines(inputOfStudy(ensemble.caseDirectory, runsOf(ensemble))),
                       fmt::join(settings.applications, " "), fmt::join(ensemble.options, " "),
                       fingerprint(variables), correlations ? correlations->valueText() : "none",
                       fingerprint(design), fingerprint(results), settings.failures.attempts);
}

} // namespace

std::string_view textOf(SampleStatus status)
{
    switch (status)
    {
    case SampleStatus::done:
        return "done";
    case SampleStatus::notFinite:
        return "a result is no finite number";
    case SampleStatus::failed:
        return "an application ended with an error";
    case SampleStatus::notConverged:
        return "a solver did not converge";
    case SampleStatus::crashed:
        return "crashed";
    case SampleStatus::timeExceeded:
        return "took longer than maximumTime";
    case SampleStatus::outOfMemory:
        break;
    }
    return "ran out of memory";
}

fs::path ensembleFolder(const fs::path& caseDirectory)
{
    return postProcessingFolder(caseDirectory, "ensemble", "0");
}

fs::path ensembleWork(const fs::path& caseDirectory)
{
    return ensembleFolder(caseDirectory) / "work";
}

Ensemble readEnsemble(const fs::path& caseDirectory, const std::vector<std::string>& options)
{
    Ensemble ensemble;
    ensemble.caseDirectory = caseDirectory;
    ensemble.pictureFormats = readPictureFormats(caseDirectory);
    ensemble.options = options;
    ensemble.dictionary = Dictionary::readFile(
        requireCaseFile(caseDirectory, "system/ensembleDict",
                        "It specifies which entries are uncertain and what is made of the samples; "
                        "etc/annotated/system/ensembleDict is one to copy."));
    sayTable(ensemble.dictionary, "results");
    ensemble.settings = readOptions<EnsembleSettings>(ensemble.dictionary);
    for (const auto& [name, variable] : ensemble.settings.variables)
    {
        lookUp(caseDirectory, variable.place, ensemble.dictionary.subDict("variables").subDict(name));
    }
    ensemble.sampler =
        std::make_shared<Sampler>(ensemble.settings.variables, ensemble.settings.correlations,
                                  ensemble.settings.design, ensemble.dictionary, caseDirectory);
    ensemble.isInProcess = canRunInProcess(ensemble.settings);
    ensemble.areAlike = haveSameBlocks(ensemble) && isCaseForLanes(ensemble);
    requireScripts(ensemble, caseDirectory);
    requireResults(ensemble);
    requireFiles(ensemble);
    const std::vector<std::string> variables = namesIn(ensemble.settings.variables);
    std::vector<std::string> names = namesIn(ensemble.settings.variables, ensemble.settings.results);
    for (const auto& [name, statistic] : ensemble.settings.statistics)
    {
        if (!statistic.curve.empty())
        {
            requireVariable(statistic.curve, variables, statistic.curveLocation);
        }
        statistic.check({.names = names, .hasSensitivityRuns = ensemble.settings.design.sensitivity});
    }
    ensemble.plan = planOf(ensemble);
    return ensemble;
}

std::vector<OtherEntry> entriesOf(const Ensemble& ensemble, const std::vector<SampleValue>& values)
{
    std::vector<OtherEntry> entries;
    for (std::size_t k = 0; k < values.size(); ++k)
    {
        entries.emplace_back(ensemble.settings.variables[k].second.place, entryText(values[k]));
    }
    return entries;
}

namespace
{

/// As requireReadableCase: one of the samples has to have them.
void requireFigures(const Ensemble& ensemble, const std::set<long>& tried)
{
    SamplesInProcess samples(ensemble);
    std::exception_ptr first;
    for (const long sample : tried)
    {
        try
        {
            samples.requireFigures(ensemble.sampler->at(sample));
            return;
        }
        catch (const FatalError&)
        {
            first = first ? first : std::current_exception();
        }
    }
    std::rethrow_exception(first);
}

} // namespace

void requireReadableCase(const Ensemble& ensemble)
{
    std::vector<std::vector<OtherEntry>> sets;
    const long count = ensemble.samples();
    const std::set<long> tried{0, count / 2, count - 1};
    for (const long sample : tried)
    {
        sets.push_back(entriesOf(ensemble, ensemble.sampler->at(sample)));
    }
    // Samples in this process find files from the case: a copy has to lie where the case does.
    const std::string name = fmt::format("case.{}.{}.dryRun", hostName(), ::getpid());
    const fs::path directory = fs::absolute(ensemble.caseDirectory).lexically_normal();
    const fs::path beside =
        (directory.has_filename() ? directory : directory.parent_path()).parent_path() / ("." + name);
    WarningsOfCopies().print(requireReadableCase(
        ensemble.caseDirectory, ensemble.isInProcess ? beside : ensembleWork(ensemble.caseDirectory) / name,
        sets, {ensemble.settings.applications, {"."}, ensemble.options}));
    if (ensemble.isInProcess)
    {
        requireFigures(ensemble, tried);
    }
}

void printEnsemble(const Ensemble& ensemble)
{
    const EnsembleSettings& settings = ensemble.settings;
    info("Applications: {}{}", fmt::join(settings.applications, " "),
         !ensemble.isInProcess ? ", each sample in a copy of the case"
         : ensemble.areAlike   ? ", without files, several samples at once"
                               : ", without files");
    info("Variables:");
    for (const auto& [name, variable] : settings.variables)
    {
        info("    {}: {}/{}{}", name, variable.place.file, variable.place.entry,
             variable.distribution ? ", " + variable.distribution->summary : "");
    }
    for (const Correlation& correlation : settings.correlations)
    {
        info("    correlation of {} and {}: {:g}", correlation.one, correlation.other, correlation.value);
    }
    std::string results;
    for (const auto& [name, figure] : settings.results)
    {
        results += " " + name;
    }
    info("Results:{}", results);
    info("Samples: {}", ensemble.samples());
    printLine();
}

} // namespace drystone
