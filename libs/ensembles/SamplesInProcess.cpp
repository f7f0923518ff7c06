// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The applications of an ensemble, one after the other, on the case of each sample.
#include "ensembles/SamplesInProcess.h"

#include "conic/form/Form.h"
#include "dynamics/Advance.h"
#include "ensembles/IncrementalDynamicsCase.h"
#include "ensembles/SampleCase.h"
#include "functionObjects/MotionResults.h"
#include "quantities/LimitAnalysisFigures.h"
#include "quantities/TableLine.h"
#include "statics/LaneAnalyses.h"
#include "statics/SolveCase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// As many as take the time of some ten samples each process; twice as many save a tenth of the iterations.
constexpr int references = 16;

} // namespace

SampleOutcome outcomeOf(std::vector<double> results)
{
    const bool isFinite =
        std::all_of(results.begin(), results.end(), [](double value) { return std::isfinite(value); });
    return {isFinite ? SampleStatus::done : SampleStatus::notFinite, std::move(results), {}};
}

struct SamplesInProcess::Cases
{
    explicit Cases(const Ensemble& of)
        : ensemble(of), sampleCase(of), results(of.settings.results.size(), std::nan(""))
    {
    }

    std::vector<double> run(const std::vector<SampleValue>& values)
    {
        beginFromReferences();
        std::fill(results.begin(), results.end(), std::nan(""));
        sampleCase.setEntries(values);
        const Dictionary blocks = sampleCase.dictionaryOfBlocks();
        sampleCase.dimensions(blocks) == 3 ? runApplications<3>(blocks) : runApplications<2>(blocks);
        return results;
    }

    bool runs(const std::string& application) const { return ensemble.settings.runs(application); }

    template<int Dim>
    void runApplications(const Dictionary& blocks)
    {
        if (runs("blockTexture") && (runs("contactDynamics") || runs("incrementalDynamics")))
        {
            sampleCase.build<Dim>(blocks);
        }
        if (runs("limitAnalysis"))
        {
            analyse<Dim>(sampleCase.soundOf<Dim>(blocks));
        }
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

    /// Samples that are solved in lanes begin near the solutions of references that depend on the study
    /// alone, so that no sample depends on another one, nor on which process computes it. Once.
    void beginFromReferences()
    {
        if (ensemble.areAlike && !hasReferences)
        {
            hasReferences = true;
            std::vector<std::size_t> read;
            beginLanesFrom(sampleCase.readAll(ensemble.sampler->spread(references), read), lanes);
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
        std::vector<LimitAnalysisCase<2>> structures = sampleCase.readAll(samples, read);
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
                    sampleCase.keepAlike(structures[i]);
                }
            }
            catch (const NotConverged&)
            {
                // Reported where the sample is run by itself.
            }
        }
        return outcomes;
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
            sampleCase.build<Dim>(dictionary);
        }
        Time time(ensemble.caseDirectory, ControlDict::required, RunsOfCase::many);
        const DynamicCase<Dim> scene = readDynamicCase<Dim>(ensemble.caseDirectory);
        watchesOf(scene, startOrContinue(ensemble.caseDirectory, scene, time));
    }

    void requireFigures(const std::vector<SampleValue>& values)
    {
        sampleCase.setEntries(values);
        if (!runs("contactDynamics"))
        {
            return;
        }
        const Dictionary dictionary = sampleCase.dictionaryOfBlocks();
        sampleCase.dimensions(dictionary) == 3 ? requireFiguresOfMotion<3>(dictionary)
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
    SampleCase sampleCase;
    SymbolicAnalysis symbolic; ///< of the last limit analysis: most samples have the same blocks touch
    LaneSolver lanes;          ///< likewise
    bool hasReferences = false;
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
    const std::optional<LimitAnalysisCase<2>> structure = cases->sampleCase.readPlane();
    return structure && drystone::isForLanes(*structure);
}

} // namespace drystone
