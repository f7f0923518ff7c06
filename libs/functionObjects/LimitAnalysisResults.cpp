// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the results of limit analysis.
#include "functionObjects/LimitAnalysisResults.h"

#include "functionObjects/EarlierResults.h"

#include "conic/ProgramFile.h"
#include "contact/ContactState.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "functionObjects/ColumnFile.h"
#include "functionObjects/FunctionList.h"
#include "functionObjects/Histories.h"
#include "functionObjects/KeptResults.h"
#include "functionObjects/LimitAnalysisTables.h"
#include "functionObjects/LoadEnvelope.h"
#include "functionObjects/LoadEnvelopeFiles.h"
#include "functionObjects/LoadMeaning.h"
#include "io/Frames.h"
#include "io/Mechanism.h"
#include "io/ParaViewState.h"
#include "quantities/LimitAnalysisFigures.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{
namespace
{

/// The status in the caption of the picture.
template<int Dim>
std::string caption(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    switch (result.status)
    {
    case CollapseStatus::optimal:
        return structure.movement ? fmt::format("base reaction {:.6g} N", result.alpha)
                                  : "alpha = " + alphaText(result.alpha);
    case CollapseStatus::unstable:
        return "unstable under its dead load";
    case CollapseStatus::unbounded:
        return structure.movement          ? "no force moves the support in this direction"
               : isProvedUnbounded(result) ? "no live load of this direction makes it collapse"
                                           : "no collapse was found";
    case CollapseStatus::upperBound:
        return std::isfinite(result.alpha)
                   ? (result.isReversed ? "alpha at least " : "alpha at most ") + alphaText(result.alpha)
                   : "no collapse was found";
    case CollapseStatus::notConverged:
        break;
    }
    return "not converged";
}

template<int Rows, int Forces>
std::vector<double> cohesionsOf(const ConeProgram<Rows, Forces>& program)
{
    std::vector<double> cohesions;
    for (const Strength& strength : program.strength)
    {
        cohesions.push_back(strength.cohesion);
    }
    return cohesions;
}

} // namespace

std::vector<std::string> suffixesOfAnswers(const std::vector<LimitAnalysis>& results)
{
    std::vector<std::string> names;
    for (std::size_t i = 0; i < results.size(); ++i)
    {
        const std::string& combination = results[i].combination;
        const bool isSecond = i > 0 && results[i - 1].combination == combination;
        names.push_back((combination.empty() ? "" : "_" + combination) + (isSecond ? "Negative" : ""));
    }
    return names;
}

bool isSearchCutShort(const std::filesystem::path& caseDirectory)
{
    std::error_code absent;
    const std::filesystem::directory_iterator files(limitAnalysisTable(caseDirectory).parent_path(), absent);
    return std::any_of(begin(files), end(files),
                       [](const std::filesystem::directory_entry& file)
                       {
                           const std::vector<std::string> columns =
                               file.path().filename().string().starts_with("coulomb")
                                   ? readNumberTable(file.path()).names
                                   : std::vector<std::string>();
                           return std::find(columns.begin(), columns.end(), "cutShortAfter") != columns.end();
                       });
}

std::filesystem::path limitAnalysisTable(const std::filesystem::path& caseDirectory)
{
    return postProcessingFolder(caseDirectory, "limitAnalysis", "0") / "limitAnalysis.dat";
}

std::filesystem::path limitAnalysisInput(const std::filesystem::path& caseDirectory)
{
    return limitAnalysisTable(caseDirectory).replace_filename("input");
}

template<int Dim>
void checkFunctions(const Dictionary& controlDict, const std::filesystem::path& caseDirectory,
                    const Assembly<Dim>& assembly)
{
    const Entry* functions = controlDict.find("functions");
    if (!functions)
    {
        return;
    }
    const FunctionList<Dim> list(functions->dictionary(), caseDirectory, "0", {}, 0, assembly);
    if (!list.names().empty())
    {
        info("Functions of system/controlDict apply to time stepping and are not run here: {}\n",
             fmt::join(list.names(), " "));
    }
}

void confirmResults(const std::filesystem::path& caseDirectory)
{
    const std::filesystem::path table = limitAnalysisTable(caseDirectory);
    if (!std::filesystem::exists(table))
    {
        throw FatalError(fmt::format("There are no results to process: {} is missing.\n\nRun limitAnalysis "
                                     "without -postProcess first.",
                                     table.string()));
    }
    info("limitAnalysis writes all its results when it runs, {} among them: nothing remains to be "
         "processed.\n",
         table.string());
}

void requireWritableResults(const std::filesystem::path& caseDirectory)
{
    requireWritable(limitAnalysisTable(caseDirectory).parent_path());
    requireWritable(caseDirectory / "VTK");
}

namespace
{

void reportRemoved(const std::vector<std::string>& names)
{
    if (!names.empty())
    {
        info("Removed with what belongs to them, of an earlier run with other loads: {}\n",
             fmt::join(names, " "));
    }
}

} // namespace

void removeLimitAnalysisResults(const std::filesystem::path& caseDirectory)
{
    writeOrRemove(limitAnalysisTable(caseDirectory), "");
    writeOrRemove(limitAnalysisInput(caseDirectory), "");
    writeOrRemove(limitAnalysisTable(caseDirectory).replace_filename("combinations.dat"), "");
    removeCapacityCurve(caseDirectory);
    reportRemoved(removeEarlierResults(caseDirectory, {}));
}

template<int Dim>
void writeLimitAnalysisProgram(const std::filesystem::path& caseDirectory,
                               const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    const WriteProgram when = structure.solution.writeProgram;
    if (when == WriteProgram::always
        || (when == WriteProgram::unsolved && result.status == CollapseStatus::notConverged))
    {
        writeProgram(limitAnalysisTable(caseDirectory).parent_path() / "coneProgram", structure.program);
    }
}

namespace
{

/// The line of thrust: a point at each centre of pressure, with the force there [N].
template<int Dim>
PolyData<Dim> thrustFrame(const std::vector<JointForce<Dim>>& joints)
{
    PolyData<Dim> data;
    data.kind = CellKind::point;
    Field force{"jointForce[N]", Dim, {}};
    for (const JointForce<Dim>& joint : joints)
    {
        data.points.push_back(joint.centre);
        force.values.insert(force.values.end(), joint.force.data(), joint.force.data() + Dim);
    }
    data.fields.push_back(std::move(force));
    return data;
}

/// Whether each block was simulated, with `selection automatic`; else no field.
template<int Dim>
std::vector<Field> awakeBlocks(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    if (structure.effects.selection != EffectSelection::automatic)
    {
        return {};
    }
    Field isAwake{"awake", 1, {}, FieldType::integer};
    for (const int body : freeIndices(structure.assembly))
    {
        isAwake.values.push_back(
            body >= 0 && (result.isSimulated.empty() || result.isSimulated[static_cast<std::size_t>(body)]));
    }
    return {std::move(isAwake)};
}

/// The motion of all blocks as it is shown: with a settlement the support that moves, by its unit movement.
template<int Dim>
Rates<Dim> shownRates(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    const Assembly<Dim>& assembly = structure.assembly;
    Rates<Dim> rates = ratesOfAllBlocks(assembly, result.mechanism);
    if (!structure.movement || result.status != CollapseStatus::optimal)
    {
        return rates;
    }
    for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
    {
        if (assembly.blocks[block].support == structure.movement->support)
        {
            rates.col(static_cast<Eigen::Index>(block)).template head<Dim>() = structure.movement->direction;
        }
    }
    return rates;
}

/// What the pictures of one answer have in common.
template<int Dim>
MechanismPicture pictureOf(const std::filesystem::path& caseDirectory,
                           const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result,
                           const AnswerPictures& pictures)
{
    MechanismPicture picture;
    picture.title = caseName(caseDirectory);
    picture.subtitle =
        fmt::format("{}, {} block{}, {} contact points", caption(structure, result), structure.freeBlocks,
                    structure.freeBlocks == 1 ? "" : "s", structure.points.size());
    if (const std::optional<EnvelopePoint> worst = worstPlace(structure))
    {
        picture.subtitle += fmt::format(", load from {}", placeText(structure, *worst));
    }
    picture.towardsViewer = pictures.towardsViewer;
    picture.load = loadArrow(structure, result);
    picture.loadPlaces = loadPlaces(structure, result);
    return picture;
}

/// Mechanism, contact points and thrust as series of VTK. \param forces of the points \param suffix of the
/// file names
template<int Dim>
void writeFields(const std::filesystem::path& caseDirectory, const LimitAnalysisCase<Dim>& structure,
                 const LimitAnalysis& result, const Rates<Dim>& rates, const std::vector<Vector<Dim>>& forces,
                 const std::string& suffix)
{
    VtkSeries blocks(caseDirectory / "VTK", "blocks" + suffix, 0, "limitAnalysis");
    writeMechanism(blocks, structure.assembly, rates, awakeBlocks(structure, result));
    VtkSeries contacts(caseDirectory / "VTK", "contacts" + suffix, 0, "limitAnalysis");
    contacts.write(0,
                   contactFrame(structure.points, forces,
                                contactStates(forces, structure.friction, cohesionsOf(structure.program))));
    VtkSeries thrust(caseDirectory / "VTK", "thrust" + suffix, 0, "limitAnalysis");
    thrust.write(0, thrustFrame(jointForces(structure.points, forces)));
}

/// Writes mechanism, forces and thrust of one answer. \param suffix of the file names
template<int Dim>
void writeAnswer(const std::filesystem::path& caseDirectory, const LimitAnalysisCase<Dim>& structure,
                 const LimitAnalysis& result, const std::string& suffix, const AnswerPictures& pictures)
{
    const Assembly<Dim>& assembly = structure.assembly;
    const auto file = [&](const std::string& name, const std::string& extension = "")
    { return limitAnalysisTable(caseDirectory).replace_filename(name + suffix + extension); };
    const Rates<Dim> rates = shownRates(structure, result);
    const std::vector<Vector<Dim>> forces = pointForces<Dim>(result.contactForce);
    writeFields(caseDirectory, structure, result, rates, forces, suffix);
    writeWholeFile(file("thrust", ".dat"), thrustText(structure.points, forces));

    MechanismPicture picture = pictureOf(caseDirectory, structure, result, pictures);
    const double drawn = 0.5 * meanBlockSize(assembly);
    if (!rates.isZero(0)) // as where no load of its direction makes it collapse
    {
        picture.motion = fmt::format("moved by up to {:.2g} m in this picture", drawn);
    }
    picture.marks = jointMarks<Dim>(assembly, structure.points, structure.friction, rates);
    writeMechanismPicture(file("mechanism"), assembly, mechanismPlacements(assembly, rates, drawn), picture,
                          pictures.formats);
    if constexpr (Dim == 2)
    {
        picture.thrust = jointForces(structure.points, forces);
        picture.motion.clear();
        // A sliding joint is a line as the thrust is.
        std::erase_if(picture.marks,
                      [](const JointMark& mark) { return mark.motion == JointMotion::sliding; });
        writeMechanismPicture(file("thrust"), assembly, std::vector<Placement<2>>(assembly.blocks.size()),
                              picture, pictures.formats);
    }
    writeOrRemove(file("coulomb", ".dat"), result.coulomb ? coulombText(*result.coulomb) : "");
}

/// The answers of combinations of loads by their names; empty without any.
std::string combinationsText(const std::vector<LimitAnalysis>& results)
{
    std::string text;
    for (const LimitAnalysis& result : results)
    {
        text += result.combination.empty()
                    ? ""
                    : fmt::format("{} {:.12g} {}\n", result.combination, tabledAlpha(result),
                                  static_cast<int>(result.status));
    }
    return text.empty() ? "" : "# combination alpha[-] status[-]\n" + text;
}

} // namespace

template<int Dim>
void writeLimitAnalysisResults(const std::filesystem::path& caseDirectory,
                               const LimitAnalysisCase<Dim>& structure,
                               const std::vector<LimitAnalysis>& results, double cpuTime,
                               const AnswerPictures& pictures)
{
    const std::vector<std::string> names = suffixesOfAnswers(results);
    reportRemoved(removeEarlierResults(caseDirectory, names));
    for (std::size_t i = 0; i < results.size(); ++i)
    {
        writeAnswer(caseDirectory, structure, results[i], names[i], pictures);
    }
    writeOrRemove(limitAnalysisTable(caseDirectory).replace_filename("combinations.dat"),
                  combinationsText(results));
    if (!structure.pushover)
    {
        removeCapacityCurve(caseDirectory);
    }
    const std::filesystem::path folder = limitAnalysisTable(caseDirectory).parent_path();
    writeLoadCases<Dim>(folder / "loadCases.dat", structure.loads);
    writeEnvelope(folder, structure, caseName(caseDirectory), pictures.formats);
    writeInput(limitAnalysisInput(caseDirectory), inputOfLimitAnalysis(caseDirectory, structure.assembly));
    writeWholeFile(limitAnalysisTable(caseDirectory), tableText(structure, results, cpuTime));
    const bool isMoving = !structure.envelope.empty();
    info("Wrote {}: limitAnalysis.dat, {}thrust.dat (tables), {}{}{} ({}{})",
         folder.lexically_normal().string(), isMoving ? "movingLoad.dat, " : "",
         pictureNames("mechanism", pictures.formats),
         isMoving && worstPlace(structure) ? ", " + pictureNames("movingLoad", pictures.formats) : "",
         Dim == 2 ? " and " + pictureNames("thrust", pictures.formats) : "",
         Dim == 2 || isMoving || pictures.formats.size() > 1 ? "pictures" : "picture",
         results.size() > 1 ? ", one an answer" : "");
    const bool hasState = writeParaViewState(caseDirectory);
    info("Wrote {}: blocks (mechanism), contacts (forces), thrust; .vtp.series opens in ParaView{}\n",
         (caseDirectory / "VTK").lexically_normal().string(),
         hasState ? ", paraviewState.py (Load State) shows all of it" : "");
}

template void checkFunctions(const Dictionary& controlDict, const std::filesystem::path& caseDirectory,
                             const Assembly<2>& assembly);
template void checkFunctions(const Dictionary& controlDict, const std::filesystem::path& caseDirectory,
                             const Assembly<3>& assembly);
template void writeLimitAnalysisProgram(const std::filesystem::path& caseDirectory,
                                        const LimitAnalysisCase<2>& structure, const LimitAnalysis& result);
template void writeLimitAnalysisProgram(const std::filesystem::path& caseDirectory,
                                        const LimitAnalysisCase<3>& structure, const LimitAnalysis& result);
template void writeLimitAnalysisResults(const std::filesystem::path& caseDirectory,
                                        const LimitAnalysisCase<2>& structure,
                                        const std::vector<LimitAnalysis>& results, double cpuTime,
                                        const AnswerPictures& pictures);
template void writeLimitAnalysisResults(const std::filesystem::path& caseDirectory,
                                        const LimitAnalysisCase<3>& structure,
                                        const std::vector<LimitAnalysis>& results, double cpuTime,
                                        const AnswerPictures& pictures);

} // namespace drystone
