// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sets entries in texts in memory; blocks and symbolic analysis are kept from sample to sample.
#include "ensembles/SamplesInProcess.h"

#include "assembly/AssemblyFile.h"
#include "assembly/AssemblyOrigin.h"
#include "conic/form/Form.h"
#include "contact/ClosedAssembly.h"
#include "contact/JointClosure.h"
#include "core/WholeFile.h"
#include "dictionary/DictionaryEdit.h"
#include "dictionary/FilesInMemory.h"
#include "dictionary/Fingerprint.h"
#include "dynamics/Advance.h"
#include "ensembles/IncrementalDynamicsCase.h"
#include "functionObjects/MotionResults.h"
#include "quantities/LimitAnalysisFigures.h"
#include "quantities/TableLine.h"
#include "statics/LaneAnalyses.h"
#include "statics/SolveCase.h"
#include "texture/Texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// As many as take the time of some ten samples each process; twice as many save a tenth of the iterations.
constexpr int references = 16;

constexpr const char* textureFile = "system/blockTextureDict";

/// The blocks of the last sample, and the fingerprint of the dictionary that they are made of.
template<int Dim>
struct KeptStructure
{
    std::uint64_t key = 0;
    std::optional<SoundStructure<Dim>> blocks;
};

} // namespace

std::string entryText(const SampleValue& value)
{
    const bool isPlain =
        !std::isnan(value.number)
        || std::all_of(value.text.begin(), value.text.end(),
                       [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
    return isPlain ? value.text : fmt::format("\"{}\"", value.text);
}

SampleOutcome outcomeOf(std::vector<double> results)
{
    const bool isFinite =
        std::all_of(results.begin(), results.end(), [](double value) { return std::isfinite(value); });
    return {isFinite ? SampleStatus::done : SampleStatus::notFinite, std::move(results), {}};
}

struct SamplesInProcess::Cases
{
    explicit Cases(const Ensemble& of) : ensemble(of), results(of.settings.results.size(), std::nan("")) {}

    std::vector<double> run(const std::vector<SampleValue>& values)
    {
        beginFromReferences();
        std::fill(results.begin(), results.end(), std::nan(""));
        setEntries(values);
        if (runs("blockTexture"))
        {
            const Dictionary dictionary = Dictionary::readFile(ensemble.caseDirectory / textureFile);
            dimensionsOf(dictionary) == 3 ? runBuilt<3>(dictionary) : runBuilt<2>(dictionary);
        }
        else
        {
            assemblyDimensions(ensemble.caseDirectory) == 3 ? runAsItStands<3>() : runAsItStands<2>();
        }
        return results;
    }

    void setEntries(const std::vector<SampleValue>& values)
    {
        std::map<std::string, std::string> changed;
        for (std::size_t k = 0; k < values.size(); ++k)
        {
            const CaseEntry& place = ensemble.settings.variables[k].second.place;
            auto [text, isNew] = changed.try_emplace(place.file);
            if (isNew)
            {
                text->second = original(place.file);
            }
            text->second = withEntrySet(text->second, place.file, place.entry, entryText(values[k]));
        }
        for (auto& [file, text] : changed)
        {
            files.set(ensemble.caseDirectory / file, std::move(text));
        }
    }

    const std::string& original(const std::string& file)
    {
        const auto [text, isNew] = originals.try_emplace(file);
        if (isNew)
        {
            text->second = contentOfFile(ensemble.caseDirectory / file);
        }
        return text->second;
    }

    bool runs(const std::string& application) const { return ensemble.settings.runs(application); }

    /// The blocks of a dictionary, of a texture or of an assembly, with their contact points. Most samples
    /// differ in properties or loads, not in blocks: those of the last sample are kept.
    template<int Dim>
    const SoundStructure<Dim>& soundOf(const Dictionary& dictionary)
    {
        auto& [key, blocks] = std::get<KeptStructure<Dim>>(kept);
        const std::uint64_t wanted = fingerprint(dictionary);
        if (!blocks || key != wanted)
        {
            blocks.reset(); // also where those of the dictionary are refused
            blocks = soundStructure(ensemble.caseDirectory, assemblyOf<Dim>(dictionary));
            key = wanted;
        }
        return *blocks;
    }

    /// Joints closed.
    template<int Dim>
    Assembly<Dim> assemblyOf(const Dictionary& dictionary) const
    {
        if (!runs("blockTexture"))
        {
            return readAssembly<Dim>(ensemble.caseDirectory);
        }
        Assembly<Dim> assembly = makeStructure<Dim>(dictionary);
        closeJoints(assembly);
        return assembly;
    }

    /// Has the case the blocks of a texture.
    template<int Dim>
    void build(const Dictionary& dictionary)
    {
        const fs::path& directory = ensemble.caseDirectory;
        files.set(assemblyFile(directory),
                  assemblyText(makeStructure<Dim>(dictionary), originOf(directory / textureFile, directory)));
    }

    template<int Dim>
    void runBuilt(const Dictionary& dictionary)
    {
        if (runs("contactDynamics") || runs("incrementalDynamics"))
        {
            build<Dim>(dictionary);
        }
        if (runs("limitAnalysis"))
        {
            analyse<Dim>(soundOf<Dim>(dictionary));
        }
        runMotions<Dim>();
    }

    /// With the blocks of constant/assembly.
    template<int Dim>
    void runAsItStands()
    {
        if (runs("limitAnalysis"))
        {
            analyse<Dim>(soundOf<Dim>(Dictionary::readFile(assemblyFile(ensemble.caseDirectory))));
        }
        runMotions<Dim>();
    }

    template<int Dim>
    void analyse(const SoundStructure<Dim>& blocks)
    {
        std::vector<LimitAnalysisCase<Dim>> structures;
        structures.push_back(readLimitAnalysisCase<Dim>(ensemble.caseDirectory, blocks));
        std::vector<std::optional<LimitAnalysis>> inLanes(1);
        if (ensemble.areAlike) // as together with others, to the last bit
        {
            inLanes = solveInLanes(structures, lanes, symbolic);
        }
        finish(structures.front(), inLanes.front());
    }

    /// \param answer of lanes, or none: it is then solved by itself
    template<int Dim>
    void finish(LimitAnalysisCase<Dim>& structure, const std::optional<LimitAnalysis>& answer)
    {
        const std::vector<LimitAnalysis> answers =
            answer ? std::vector<LimitAnalysis>{*answer} : solveLimitAnalyses(structure, &symbolic);
        for (const LimitAnalysis& each : answers)
        {
            if (!hasAnswer(each))
            {
                throw NotConverged{"limitAnalysis has no answer"};
            }
        }
        if (structure.cutShort > 0)
        {
            printWarningOnce(
                "maximumTime has ended the search for collapses by Coulomb's law in a sample before all was "
                "tried: its multiplier depends on how fast this machine is and what else it does, and is not "
                "a number where no collapse was found. Raise maximumTime, or remove it.",
                structure.solutionLocations.of("nonAssociative/maximumTime"));
        }
        takeFigures(structure, answers);
    }

    /// Of a texture, or of the assembly that is there.
    Dictionary dictionaryOfBlocks() const
    {
        const fs::path& directory = ensemble.caseDirectory;
        return Dictionary::readFile(runs("blockTexture") ? directory / textureFile : assemblyFile(directory));
    }

    /// The case with the entries that are set, where it is one of the plane.
    std::optional<LimitAnalysisCase<2>> readPlane()
    {
        const Dictionary dictionary = dictionaryOfBlocks();
        if (dimensionsOf(dictionary) != 2)
        {
            return {};
        }
        return readLimitAnalysisCase<2>(ensemble.caseDirectory, soundOf<2>(dictionary));
    }

    /// Likewise, by what the samples differ in alone where that is contact properties: of a structure that
    /// has been read for another sample.
    std::optional<LimitAnalysisCase<2>> readAlike()
    {
        if (!alike.empty())
        {
            LimitAnalysisCase<2> structure = std::move(alike.back());
            alike.pop_back();
            if (readContactAnew(structure, ensemble.caseDirectory))
            {
                return structure;
            }
        }
        return readPlane();
    }

    /// Keeps a structure that has been analysed, and not changed meanwhile, for other samples.
    void keepAlike(LimitAnalysisCase<2>& structure)
    {
        constexpr const char* contactFile = "constant/contactProperties";
        const auto& variables = ensemble.settings.variables;
        if (std::all_of(variables.begin(), variables.end(),
                        [&](const Named<EnsembleVariable>& variable)
                        { return variable.second.place.file == contactFile; })
            && !files.isIncluded(ensemble.caseDirectory / contactFile))
        {
            alike.push_back(std::move(structure));
        }
    }

    /// The structures of several samples. \param read gets the numbers of those without a fault
    std::vector<LimitAnalysisCase<2>> readAll(const std::vector<std::vector<SampleValue>>& samples,
                                              std::vector<std::size_t>& read)
    {
        std::vector<LimitAnalysisCase<2>> structures;
        structures.reserve(samples.size());
        for (std::size_t i = 0; i < samples.size(); ++i)
        {
            setEntries(samples[i]);
            try
            {
                if (std::optional<LimitAnalysisCase<2>> structure = readAlike())
                {
                    structures.push_back(std::move(*structure));
                    read.push_back(i);
                }
            }
            catch (const FatalError&)
            {
                // Reported where the sample is run by itself.
            }
        }
        return structures;
    }

    /// Samples that are solved in lanes begin near the solutions of references that depend on the study
    /// alone, so that no sample depends on another one, nor on which process computes it. Once.
    void beginFromReferences()
    {
        if (ensemble.areAlike && !hasReferences)
        {
            hasReferences = true;
            std::vector<std::size_t> read;
            beginLanesFrom(readAll(ensemble.sampler->spread(references), read), lanes);
        }
    }

    /// The limit analyses of several samples. \return nothing for those with a fault; all of nothing where
    /// lanes take none of them
    std::vector<std::optional<SampleOutcome>>
    runTogether(const std::vector<std::vector<SampleValue>>& samples,
                const std::function<void(std::size_t)>& begins)
    {
        beginFromReferences();
        std::vector<std::optional<SampleOutcome>> outcomes(samples.size());
        std::vector<std::size_t> read;
        std::vector<LimitAnalysisCase<2>> structures = readAll(samples, read);
        if (std::none_of(structures.begin(), structures.end(), drystone::isForLanes))
        {
            return outcomes;
        }
        const std::vector<std::optional<LimitAnalysis>> answers = solveInLanes(structures, lanes, symbolic);
        for (std::size_t i = 0; i < structures.size(); ++i)
        {
            begins(read[i]);
            std::fill(results.begin(), results.end(), std::nan(""));
            try
            {
                finish(structures[i], answers[i]);
                outcomes[read[i]] = outcomeOf(results);
                if (answers[i])
                {
                    keepAlike(structures[i]);
                }
            }
            catch (const NotConverged&)
            {
                // Likewise.
            }
        }
        return outcomes;
    }

    template<int Dim>
    void runMotions()
    {
        if (runs("contactDynamics"))
        {
            move<Dim>();
        }
        if (runs("incrementalDynamics"))
        {
            findLeastIntensities<Dim>();
        }
    }

    template<int Dim>
    void findLeastIntensities()
    {
        Time time(ensemble.caseDirectory, ControlDict::required, RunsOfCase::many);
        IncrementalDynamics<Dim> study = readIncrementalDynamics<Dim>(ensemble.caseDirectory, time);
        study.jobs = 1; // the other cores have samples of their own
        const std::vector<IncrementalCurve> curves = carryOut(study);
        if (exitStatus(curves) == 2)
        {
            throw NotConverged{"incrementalDynamics: a run did not converge"};
        }
        const LeastIntensityTable table = leastIntensityTable(study, curves);
        for (std::size_t i = 0; i < results.size(); ++i)
        {
            const Figure& figure = ensemble.settings.results[i].second;
            if (!figure.ofLeastIntensity)
            {
                continue;
            }
            const std::optional<std::size_t> place = findColumn(table.headings, *figure.ofLeastIntensity);
            if (!place)
            {
                throw FatalError(
                    fmt::format("{} has no column {}.", leastIntensityTableName, *figure.ofLeastIntensity));
            }
            std::vector<double> column;
            for (const std::vector<double>& row : table.rows)
            {
                // With the digits of the table, as one that is read has them.
                column.push_back(std::strtod(fmt::format("{:.12g}", row[*place]).c_str(), nullptr));
            }
            results[i] = taken(column, figure.table->take);
        }
    }

    template<int Dim>
    void takeFigures(const LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& answers)
    {
        std::vector<std::vector<TabledFigure>> rows;
        for (const LimitAnalysis& answer : answers)
        {
            rows.push_back(limitAnalysisFigures(structure, answer, 0));
        }
        for (std::size_t i = 0; i < results.size(); ++i)
        {
            const Figure& figure = ensemble.settings.results[i].second;
            if (!figure.ofCollapse)
            {
                continue;
            }
            std::vector<double> column;
            for (const std::vector<TabledFigure>& row : rows)
            {
                const auto found = std::find_if(row.begin(), row.end(),
                                                [&](const TabledFigure& tabled)
                                                { return isColumn(tabled.heading, *figure.ofCollapse); });
                // Of the text, so that a sample has the same number as one that a table is read for.
                column.push_back(std::strtod(found->text.c_str(), nullptr));
            }
            results[i] = taken(column, figure.table->take);
        }
    }

    /// One for each result that is a figure of the motion, with the number of the result.
    template<int Dim>
    std::vector<std::pair<std::size_t, std::unique_ptr<MotionWatch<Dim>>>>
    watchesOf(const DynamicCase<Dim>& scene, const Motion<Dim>& motion) const
    {
        std::vector<std::pair<std::size_t, std::unique_ptr<MotionWatch<Dim>>>> watches;
        for (std::size_t i = 0; i < results.size(); ++i)
        {
            if (const auto& watch = std::get<WatchMaker<Dim>>(ensemble.settings.results[i].second.watch))
            {
                watches.emplace_back(i, watch(scene, motion));
            }
        }
        return watches;
    }

    template<int Dim>
    void requireFiguresOfMotion(const Dictionary& dictionary)
    {
        if (runs("blockTexture"))
        {
            build<Dim>(dictionary);
        }
        Time time(ensemble.caseDirectory, ControlDict::required, RunsOfCase::many);
        const DynamicCase<Dim> scene = readDynamicCase<Dim>(ensemble.caseDirectory);
        watchesOf(scene, startOrContinue(ensemble.caseDirectory, scene, time));
    }

    void requireFigures(const std::vector<SampleValue>& values)
    {
        setEntries(values);
        if (!runs("contactDynamics"))
        {
            return;
        }
        const Dictionary dictionary = dictionaryOfBlocks();
        dimensionsOf(dictionary) == 3 ? requireFiguresOfMotion<3>(dictionary)
                                      : requireFiguresOfMotion<2>(dictionary);
    }

    template<int Dim>
    void move()
    {
        const fs::path& directory = ensemble.caseDirectory;
        Time time(directory, ControlDict::required, RunsOfCase::many);
        const DynamicCase<Dim> scene = readDynamicCase<Dim>(directory);
        Motion<Dim> motion = startOrContinue(directory, scene, time);
        chooseFirstTimeStep(scene, motion, time);
        const auto watches = watchesOf(scene, motion);
        for (const auto& [index, watch] : watches)
        {
            watch->observe(motion, 0);
        }
        while (time.loop())
        {
            const double before = motion.state.time;
            if (!advance(scene, motion, time))
            {
                throw NotConverged{fmt::format("contactDynamics: the step at {:g} s was not solved", before)};
            }
            for (const auto& [index, watch] : watches)
            {
                watch->observe(motion, motion.state.time - before);
            }
        }
        for (const auto& [index, watch] : watches)
        {
            results[index] = watch->value();
        }
    }

    const Ensemble& ensemble;
    FilesInMemory files;
    std::map<std::string, std::string> originals;
    std::tuple<KeptStructure<2>, KeptStructure<3>> kept;
    SymbolicAnalysis symbolic; ///< of the last limit analysis: most samples have the same blocks touch
    LaneSolver lanes;          ///< likewise
    bool hasReferences = false;
    std::vector<LimitAnalysisCase<2>> alike; ///< read for other samples
    std::vector<double> results;
};

SamplesInProcess::SamplesInProcess(const Ensemble& ensemble) : cases(std::make_unique<Cases>(ensemble)) {}
SamplesInProcess::~SamplesInProcess() = default;

std::vector<double> SamplesInProcess::run(const std::vector<SampleValue>& values)
{
    return cases->run(values);
}

std::vector<std::optional<SampleOutcome>>
SamplesInProcess::runTogether(const std::vector<std::vector<SampleValue>>& samples,
                              const std::function<void(std::size_t)>& begins)
{
    return cases->runTogether(samples, begins);
}

void SamplesInProcess::requireFigures(const std::vector<SampleValue>& values)
{
    cases->requireFigures(values);
}

bool SamplesInProcess::isForLanes()
{
    const std::optional<LimitAnalysisCase<2>> structure = cases->readPlane();
    return structure && drystone::isForLanes(*structure);
}

} // namespace drystone
