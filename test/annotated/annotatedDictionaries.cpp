// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The annotated example of every dictionary in etc/annotated: written from the declared options, or checked.
///
///     annotatedDictionaries --write etc/annotated
///     annotatedDictionaries --check etc/annotated
///
/// With --check the exit status is 1 when a file differs from what would be written, or cannot be read by the
/// application whose example it is.
#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "core/WholeFile.h"
#include "dictionary/Options.h"
#include "dynamics/InitialMotion.h"
#include "effects/GroundMotion.h"
#include "effects/SupportMotion.h"
#include "ensembles/AccuracySettings.h"
#include "ensembles/EnsembleSettings.h"
#include "ensembles/IncrementalDynamics.h"
#include "ensembles/ParameterSearch.h"
#include "functionObjects/FunctionList.h"
#include "runControl/Schemes.h"
#include "runControl/TimeControls.h"
#include "statics/LimitAnalysisCase.h"
#include "texture/Texture.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <set>

using namespace drystone;

namespace
{

/// One dictionary of a case.
struct Example
{
    std::string file; ///< in the case directory
    std::string text;
    std::function<void(const Dictionary&)> readBack;
};

/// \param given optional keys that the example contains
template<Declared Settings>
Example example(const std::string& file, const std::string& doc, const std::vector<std::string>& given = {})
{
    std::vector<OptionDescription> options = describeOptions<Settings>();
    for (OptionDescription& option : options)
    {
        option.given = std::find(given.begin(), given.end(), option.key) != given.end();
    }
    return {file, annotatedDictionary(std::filesystem::path(file).filename().string(), doc, options),
            [](const Dictionary& dictionary) { readOptions<Settings>(dictionary); }};
}

/// system/solution, of which each application reads its own sub-dictionary.
struct SolutionSettings
{
    LimitAnalysisControls limitAnalysis;
    SolverChoice contactDynamics;
};
void declare(Options& options, SolutionSettings& settings)
{
    options.optional("limitAnalysis", settings.limitAnalysis, "how limitAnalysis solves");
    options.optional("contactDynamics", settings.contactDynamics, "how contactDynamics solves");
}

std::vector<Example> examples()
{
    return {
        example<BlockTexture<2>>("system/blockTextureDict", "What blockTexture makes: a structure of blocks.",
                                 {"supports"}),
        example<BlockTexture<3>>("space/system/blockTextureDict",
                                 "What blockTexture makes in space: a structure of blocks. z is up.",
                                 {"dimensions", "supports"}),
        example<ControlDictSettings>("system/controlDict", "Where a run starts and ends, and when it writes.",
                                     {"endTime", "functions"}),
        example<SolutionSettings>("system/solution",
                                  "How the applications solve: a sub-dictionary for each of them, which may "
                                  "be absent.",
                                  {"limitAnalysis", "contactDynamics"}),
        example<Gravity<2>>("constant/g", "Gravity."),
        example<MaterialProperties>("constant/materialProperties", "What the blocks weigh: one of the two.",
                                    {"density"}),
        example<CaseEffects<2>>(
            "constant/contactProperties",
            "One sub-dictionary for each effect that is simulated; without friction contacts "
            "are frictionless.",
            {"friction"}),
        example<CaseEffects<3>>("space/constant/contactProperties",
                                "One sub-dictionary for each effect that is simulated in space; without "
                                "friction contacts are frictionless.",
                                {"friction"}),
        example<LoadCases<2>>("constant/loads",
                              "Dead load, and the live load that limit analysis multiplies by alpha.",
                              {"dead", "live"}),
        example<LoadCases<3>>(
            "space/constant/loads",
            "Dead load, and the live load that limit analysis multiplies by alpha, in space. "
            "z is up.",
            {"dead", "live"}),
        example<GroundMotionSettings>(
            "constant/groundMotion",
            "How the ground moves; without this file it does not. Results are relative to "
            "the moving ground.",
            {"direction", "acceleration"}),
        example<SupportMotionFile<2>>(
            "constant/supportMotion",
            "How supports move; without this file they do not. Relative to the ground."),
        example<SupportMotionFile<3>>(
            "space/constant/supportMotion",
            "How supports move in space; without this file they do not. Relative to the ground."),
        example<Schemes>("system/schemes", "How contactDynamics steps through time.", {"timeIntegration"}),
        example<IncrementalDynamicsSettings>(
            "system/incrementalDynamicsDict",
            "Over which accelerations of the ground incrementalDynamics repeats a motion, and when a run has "
            "gone too far.",
            {"intensity", "criterion"}),
        example<ParameterSearchSettings>(
            "system/parameterSearchDict",
            "Which entries parameterSearch varies, what of the results is to be least or largest, and how it "
            "searches.",
            {"variables", "results", "objective", "search"}),
        example<EnsembleSettings>(
            "system/ensembleDict",
            "Which entries of the case are uncertain, how many samples there are, and what is made of them.",
            {"variables", "results", "statistics"}),
        example<AccuracySettings>(
            "system/accuracyCostDict",
            "Which figures of the case accuracyCost measures, what they are compared with, and over which "
            "settings.",
            {"quantities", "sweeps"}),
        example<InitialMotion<2>>("0/motion", "How blocks start; without this file as built and at rest."),
        example<InitialMotion<3>>("space/0/motion",
                                  "How blocks start in space; without this file as built and at rest."),
    };
}

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

int check(const std::filesystem::path& folder)
{
    int faults = 0;
    std::set<std::filesystem::path> known;
    for (const Example& wanted : examples())
    {
        known.insert(folder / wanted.file);
        if (contentOf(folder / wanted.file) != wanted.text)
        {
            fmt::print("{} is not current: annotatedDictionaries --write {}\n", wanted.file, folder.string());
            ++faults;
        }
        try
        {
            wanted.readBack(Dictionary::readString(wanted.text, wanted.file));
        }
        catch (const FatalError& error)
        {
            fmt::print("{}", error.report());
            ++faults;
        }
    }
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder))
    {
        if (file.is_regular_file() && !known.contains(file.path()))
        {
            fmt::print("{} is the example of nothing\n", file.path().string());
            ++faults;
        }
    }
    fmt::print("{} annotated dictionaries, {} faults\n", known.size(), faults);
    return faults > 0 ? 1 : 0;
}

} // namespace

int main(int count, char** arguments)
{
    return runGuarded(
        [&]
        {
            const std::string mode = count == 3 ? arguments[1] : "";
            if (mode == "--check")
            {
                return check(arguments[2]);
            }
            if (mode != "--write")
            {
                throw FatalError("Usage: annotatedDictionaries --write|--check DIR");
            }
            for (const Example& wanted : examples())
            {
                writeWholeFile(std::filesystem::path(arguments[2]) / wanted.file, wanted.text);
            }
            return 0;
        });
}
