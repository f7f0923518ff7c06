// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Collects the page of a case, section by section.
#include "report/CaseReport.h"

#include "assembly/AssemblyFile.h"
#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "contact/AssemblyChecks.h"
#include "contact/ClosedAssembly.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "dynamics/InitialMotion.h"
#include "dynamics/Schemes.h"
#include "effects/EffectList.h"
#include "effects/GroundMotion.h"
#include "effects/SupportMotion.h"
#include "functionObjects/FunctionList.h"
#include "functionObjects/Histories.h"
#include "functionObjects/LimitAnalysisResults.h"
#include "functionObjects/LoadMeaning.h"
#include "report/HtmlPage.h"
#include "report/InputTable.h"
#include "report/ViewerData.h"
#include "runControl/Application.h"
#include "runControl/CaseFiles.h"
#include "texture/Texture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

namespace drystone
{

namespace
{

namespace fs = std::filesystem;

/// Whether a name comes before another one, numbers by their value: motion_3 before motion_3.5.
bool isBefore(std::string_view one, std::string_view other)
{
    const auto numberIn = [](std::string_view& text)
    {
        double value = 0;
        const auto end =
            std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        return value;
    };
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    while (!one.empty() && !other.empty())
    {
        if (isDigit(one.front()) && isDigit(other.front()))
        {
            const double first = numberIn(one);
            const double second = numberIn(other);
            if (first != second)
            {
                return first < second;
            }
            continue;
        }
        if (one.front() != other.front())
        {
            return one.front() < other.front();
        }
        one.remove_prefix(1);
        other.remove_prefix(1);
    }
    return one.empty() && !other.empty();
}

/// Files below a folder with an ending, sorted, so that a report is the same each time.
std::vector<fs::path> filesWithEnding(const fs::path& folder, const std::string& ending)
{
    std::vector<fs::path> files;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, none))
    {
        if (entry.is_regular_file(none) && entry.path().extension() == ending)
        {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end(),
              [](const fs::path& one, const fs::path& other)
              {
                  // Without the ending, whose full stop may follow a number.
                  const auto name = [](fs::path file) { return file.replace_extension().string(); };
                  return isBefore(name(one), name(other));
              });
    return files;
}

template<int Dim>
void addStructure(HtmlPage& page, const fs::path& caseDirectory, const Assembly<Dim>& assembly)
{
    const AssemblyStatistics<Dim> counts = countAssembly(assembly);
    const std::vector<BlockMass<Dim>> shapes = blockMasses(assembly);
    double volume = 0;
    for (std::size_t block = 0; block < shapes.size(); ++block)
    {
        volume += assembly.blocks[block].support < 0 ? shapes[block].volume : 0;
    }
    std::vector<std::string> lengths;
    for (int axis = 0; axis < Dim; ++axis)
    {
        lengths.push_back(fmt::format("{:.4g}", counts.upper(axis) - counts.lower(axis)));
    }
    std::vector<std::vector<std::string>> rows{
        {"blocks", fmt::format("{} free, {} fixed", counts.freeBlocks, counts.blocks - counts.freeBlocks)},
        {"joints",
         fmt::format("{} with {} contact points at their corners", counts.joints, counts.contactPoints)},
        {"extent of the free blocks", fmt::format("{} m", fmt::join(lengths, " x "))},
        {"volume of the free blocks", fmt::format("{:.4g} m3", volume)}};
    std::error_code none;
    if (fs::exists(caseDirectory / "constant/materialProperties", none)
        && fs::exists(caseDirectory / "constant/g", none))
    {
        const Vector<Dim> gravity = readGravity<Dim>(caseDirectory);
        const std::vector<double> masses =
            massesOf(shapes, readDensities<Dim>(caseDirectory, assembly, gravity));
        double mass = 0;
        for (std::size_t block = 0; block < masses.size(); ++block)
        {
            mass += assembly.blocks[block].support < 0 ? masses[block] : 0;
        }
        rows.push_back({"weight of the free blocks",
                        fmt::format("{} ({:.4g} kg under {:.4g} m/s2)", forceText(mass * gravity.norm()),
                                    mass, gravity.norm())});
    }
    page.heading("Structure");
    page.table({}, rows);
}

/// The answers of limitAnalysis as its tables have them.
std::vector<LimitAnalysis> storedAnswers(const fs::path& caseDirectory, const NumberTable& table)
{
    // Combinations of loads are named in a table of their own, in the same order.
    std::vector<std::string> names;
    std::istringstream combinations(
        contentOfFile(limitAnalysisTable(caseDirectory).replace_filename("combinations.dat")));
    std::string line;
    std::getline(combinations, line);
    while (std::getline(combinations, line))
    {
        names.push_back(line.substr(0, line.find(' ')));
    }
    std::vector<LimitAnalysis> answers;
    for (std::size_t row = 0; row < table.columns.front().size(); ++row)
    {
        LimitAnalysis answer;
        answer.alpha = table.columns[0][row];
        answer.status = static_cast<CollapseStatus>(static_cast<int>(table.columns[1][row]));
        answer.combination = row < names.size() ? names[row] : "";
        answers.push_back(std::move(answer));
    }
    return answers;
}

std::string verdict(const LimitAnalysis& answer)
{
    switch (answer.status)
    {
    case CollapseStatus::optimal:
        return fmt::format("alpha = {:.6g}", answer.alpha);
    case CollapseStatus::unstable:
        return "unstable: the blocks cannot carry their dead load";
    case CollapseStatus::unbounded:
        return "unbounded: no load of this direction makes it collapse";
    case CollapseStatus::upperBound:
        return "no collapse by Coulomb's law was found: alpha is at most that of the associative law, as the "
               "log "
               "says";
    case CollapseStatus::notConverged:
        break;
    }
    return "no answer";
}

template<int Dim>
void addLimitAnalysis(HtmlPage& page, const fs::path& caseDirectory)
{
    const NumberTable table = readNumberTable(limitAnalysisTable(caseDirectory));
    if (table.columns.size() < 10)
    {
        return;
    }
    page.heading("Collapse");
    page.paragraph(
        "The live load times the multiplier alpha is the largest that the structure carries: forces between "
        "the "
        "blocks balance it without tension and with friction, and a mechanism shows that more cannot be "
        "carried (Portioli, Cascini and Landolfo 2017, eq. 10).");
    const LimitAnalysisCase<Dim> structure = readLimitAnalysisCase<Dim>(caseDirectory);
    for (const LimitAnalysis& answer : storedAnswers(caseDirectory, table))
    {
        page.paragraph((answer.combination.empty() ? "" : "Combination " + answer.combination + ": ")
                       + verdict(answer) + ".");
        if (answer.status == CollapseStatus::optimal)
        {
            for (const std::string& sentence : loadMeaning(structure, answer))
            {
                page.paragraph(sentence + ".");
            }
        }
    }
    std::vector<std::vector<std::string>> rows;
    for (std::size_t row = 0; row < table.columns.front().size(); ++row)
    {
        const auto value = [&](std::size_t column)
        { return fmt::format("{:.3g}", table.columns[column][row]); };
        rows.push_back({fmt::format("{:.9g}", table.columns[0][row]), value(6), value(7), value(8),
                        fmt::format("{:g}", table.columns[5][row]), value(9) + " s"});
    }
    page.paragraph("Certificate: the residual of equilibrium and of the cones, that of the mechanism, and "
                   "the gap between "
                   "the bounds that they give, each relative.");
    page.table({"alpha", "primal residual", "dual residual", "gap", "iterations", "CPU time"}, rows);
}

/// Pictures that applications have left, but for those that are too large for a page.
void addPictures(HtmlPage& page, const fs::path& caseDirectory)
{
    constexpr std::size_t largest = 2 << 20;
    std::error_code none;
    std::vector<fs::path> files = filesWithEnding(caseDirectory / "postProcessing", ".svg");
    for (const fs::path& file : filesWithEnding(caseDirectory / "postProcessing", ".png"))
    {
        if (!fs::exists(fs::path(file).replace_extension(".svg"), none))
        {
            files.push_back(file); // of a case whose pictureFormats has no svg
        }
    }
    if (!files.empty())
    {
        page.heading("Pictures");
    }
    for (const fs::path& file : files)
    {
        const std::string name = fs::relative(file, caseDirectory).string();
        const std::string drawing = contentOfFile(file);
        if (drawing.size() > largest)
        {
            page.paragraph(fmt::format("Left out for its size, {:.1f} MB: {}.",
                                       static_cast<double>(drawing.size()) / 1e6, name));
            continue;
        }
        if (file.extension() == ".png")
        {
            page.image(drawing, name);
            continue;
        }
        page.picture(drawing, name);
    }
}

void addHistories(HtmlPage& page, const fs::path& caseDirectory)
{
    constexpr std::size_t most = 40;
    std::size_t count = 0;
    std::error_code none;
    for (const fs::path& file : filesWithEnding(caseDirectory / "postProcessing", ".dat"))
    {
        const std::string name = fs::relative(file, caseDirectory).string();
        for (const auto& [unit, plot] : historyPlotsOfUnits(readNumberTable(file), name))
        {
            const std::string drawn = historyPicture(file, unit).string();
            if (fs::exists(drawn + ".svg", none) || fs::exists(drawn + ".png", none))
            {
                continue; // among the pictures already
            }
            if (count == 0)
            {
                page.heading("Time histories");
            }
            if (++count <= most)
            {
                page.picture(plotSvg(plot), "");
            }
        }
    }
    if (count > most)
    {
        page.paragraph(
            fmt::format("{} more are left out; their tables are in postProcessing/.", count - most));
    }
}

bool isOfMotion(const fs::path& caseDirectory)
{
    const Dictionary controls = Dictionary::readFileIfPresent(caseDirectory / "system/controlDict");
    const Entry* application = controls.find("application");
    return application && application->valueText() != "limitAnalysis";
}

/// How far blocks go in the frames of a motion, and where they are at its end.
template<int Dim>
std::vector<std::string> motionMeaning(const Assembly<Dim>& assembly, const std::vector<BlockFrame>& frames)
{
    struct Farthest
    {
        double distance = 0; ///< [m]
        std::size_t block = 0;
        double time = 0; ///< [s]
    };
    Farthest largest;
    Farthest atTheEnd;
    const double far = 0.5 * meanBlockSize(assembly);
    int away = 0;
    int freeBlocks = 0;
    for (const BlockFrame& frame : frames)
    {
        const bool isLast = &frame == &frames.back();
        for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
        {
            const double distance = frame.displacement.col(static_cast<Eigen::Index>(block)).norm();
            if (assembly.blocks[block].support >= 0)
            {
                continue;
            }
            if (distance > largest.distance) // not where it is NaN, of a block that was deleted
            {
                largest = {distance, block, frame.time};
            }
            if (isLast)
            {
                atTheEnd = distance > atTheEnd.distance ? Farthest{distance, block, frame.time} : atTheEnd;
                away += distance <= far ? 0 : 1;
                ++freeBlocks;
            }
        }
    }
    return {
        fmt::format(
            "The largest displacement of a block in these frames is {:.4g} m, of block {} at {:.4g} s.",
            largest.distance, largest.block, largest.time),
        fmt::format("After {:.4g} s the largest displacement of a block is {:.4g} m, of block {}; {} of {} "
                    "blocks are farther from their places than half the mean block size of {:.3g} m{}.",
                    frames.back().time, atTheEnd.distance, atTheEnd.block, away, freeBlocks, 2 * far,
                    away == 0 ? ": the structure stands" : "")};
}

/// The animation, with what its end shows, and the viewer.
template<int Dim>
void addMotion(HtmlPage& page, const fs::path& caseDirectory, const Assembly<Dim>& assembly)
{
    constexpr std::size_t mostNumbers = 150'000; // of positions: some 2 MB of page
    const std::size_t mostFrames = mostNumbers / std::max<std::size_t>(1, assembly.blocks.size());
    if (!fs::exists(caseDirectory / "VTK" / "blocks.vtp.series"))
    {
        return;
    }
    const bool isMotion = isOfMotion(caseDirectory);
    page.heading(isMotion ? "Motion" : "Mechanism");
    const std::vector<BlockFrame> frames = readBlockFrames(
        caseDirectory / "VTK", "blocks", assembly.blocks.size(), std::clamp<std::size_t>(mostFrames, 2, 101));
    if (isMotion && !frames.empty())
    {
        for (const std::string& sentence : motionMeaning(assembly, frames))
        {
            page.paragraph(sentence);
        }
    }
    const std::optional<std::string> script = viewerScript();
    if (!script)
    {
        page.paragraph(
            "This page has no viewer in three dimensions, since Drystone was built without npm; open "
            "VTK/blocks.vtp.series in ParaView.");
        return;
    }
    if (mostFrames < 2)
    {
        page.paragraph(
            fmt::format("{} blocks are too many for a viewer in this page; open VTK/blocks.vtp.series in "
                        "ParaView.",
                        assembly.blocks.size()));
        return;
    }
    const AnimationTime time =
        isMotion ? AnimationTime{"time", " s", 1} : AnimationTime{"part of the mechanism", "", 1};
    page.markup(viewerMarkup(viewerJson(assembly, frames, time), "motion"));
    page.markup(fmt::format("<script>{}</script>\n", *script));
}

/// A dictionary of the case and what describes it.
struct Input
{
    std::string file;
    std::vector<OptionDescription> options;
};

OptionDescription subDictionary(const std::string& key, std::vector<OptionDescription> members)
{
    OptionDescription option;
    option.key = key;
    option.form = OptionDescription::Form::dictionary;
    option.members = std::move(members);
    return option;
}

template<int Dim>
std::vector<Input> inputsOf()
{
    return {{"constant/g", describeOptions<Gravity<Dim>>()},
            {"constant/materialProperties", describeOptions<MaterialProperties>()},
            {"constant/contactProperties", describeOptions<CaseEffects<2>>()},
            {"constant/loads", describeOptions<LoadCases<Dim>>()},
            {"constant/groundMotion", describeOptions<GroundMotionSettings>()},
            {"constant/supportMotion", describeOptions<SupportMotionFile<2>>()},
            {"0/motion", describeOptions<InitialMotion<2>>()},
            {"system/controlDict", describeOptions<ControlDictSettings>()},
            {"system/schemes", describeOptions<Schemes>()},
            {"system/solution",
             {subDictionary("limitAnalysis", describeOptions<LimitAnalysisControls>()),
              subDictionary("contactDynamics", describeOptions<SolverChoice>())}},
            {"system/blockTextureDict", describeOptions<BlockTexture<Dim>>()},
            // Of studies, whose keys this library does not know: without units.
            {"system/incrementalDynamicsDict", {}},
            {"system/parameterSearchDict", {}},
            {"system/ensembleDict", {}},
            {"system/accuracyCostDict", {}}};
}

template<int Dim>
void addInputs(HtmlPage& page, const fs::path& caseDirectory)
{
    page.heading("Input");
    for (const Input& input : inputsOf<Dim>())
    {
        std::error_code none;
        if (!fs::exists(caseDirectory / input.file, none))
        {
            continue;
        }
        page.paragraph(input.file);
        page.table({"key", "value", "unit", "what it is"},
                   inputRows(Dictionary::readFile(caseDirectory / input.file), input.options));
    }
}

/// The warnings that the logs of the case have, each once.
std::vector<std::string> warningsIn(const fs::path& caseDirectory)
{
    std::vector<std::string> warnings;
    for (const std::string& name : namesIn(caseDirectory))
    {
        if (!name.starts_with("log."))
        {
            continue;
        }
        std::istringstream log(contentOfFile(caseDirectory / name));
        for (std::string line; std::getline(log, line);)
        {
            if (!line.starts_with("--> DRYSTONE Warning"))
            {
                continue;
            }
            // The text, an empty line, and where the place is known a line that names it.
            std::string text;
            while (std::getline(log, line) && !line.empty())
            {
                text += line + "\n";
            }
            if (std::getline(log, line) && line.starts_with("file:"))
            {
                text += line + "\n";
            }
            if (std::find(warnings.begin(), warnings.end(), text) == warnings.end())
            {
                warnings.push_back(text);
            }
        }
    }
    return warnings;
}

void addWarnings(HtmlPage& page, const fs::path& caseDirectory)
{
    const std::vector<std::string> warnings = warningsIn(caseDirectory);
    if (!warnings.empty())
    {
        page.heading("Warnings");
    }
    for (const std::string& warning : warnings)
    {
        page.verbatim(warning);
    }
}

void addRepetition(HtmlPage& page, const fs::path& caseDirectory)
{
    page.heading("How to repeat it");
    std::vector<std::string> commands;
    for (const std::string& name : namesIn(caseDirectory))
    {
        std::istringstream log(name.starts_with("log.") ? contentOfFile(caseDirectory / name) : "");
        for (std::string line; std::getline(log, line);)
        {
            if (line.starts_with("Exec    : "))
            {
                commands.push_back(line.substr(10));
            }
        }
    }
    if (commands.empty())
    {
        std::error_code none;
        commands = fs::exists(caseDirectory / "system/blockTextureDict", none)
                       ? std::vector<std::string>{"blockTexture"}
                       : std::vector<std::string>{};
        commands.emplace_back(isOfMotion(caseDirectory) ? "contactDynamics" : "limitAnalysis");
    }
    page.paragraph(fmt::format("{}, with the input above, in the directory of the case:", versionText()));
    page.verbatim(fmt::format("{}", fmt::join(commands, "\n")));
    const std::string fingerprints = contentOfFile(limitAnalysisInput(caseDirectory));
    if (!fingerprints.empty())
    {
        page.paragraph("Fingerprints of the input that the multiplier follows from:");
        page.verbatim(fingerprints);
    }
}

template<int Dim>
std::string reportText(const fs::path& caseDirectory)
{
    const Assembly<Dim> assembly = readAssembly<Dim>(caseDirectory);
    HtmlPage page(caseName(caseDirectory));
    addStructure(page, caseDirectory, assembly);
    addLimitAnalysis<Dim>(page, caseDirectory);
    addMotion(page, caseDirectory, assembly);
    addPictures(page, caseDirectory);
    addHistories(page, caseDirectory);
    addWarnings(page, caseDirectory);
    addInputs<Dim>(page, caseDirectory);
    addRepetition(page, caseDirectory);
    return page.text();
}

} // namespace

fs::path reportFile(const fs::path& caseDirectory)
{
    return (caseDirectory / "report.html").lexically_normal();
}

void writeReport(const fs::path& caseDirectory, const fs::path& file)
{
    std::error_code none;
    if (!fs::is_directory(caseDirectory / "postProcessing", none)
        && !fs::is_directory(caseDirectory / "VTK", none))
    {
        throw FatalError(fmt::format(
            "There is nothing to report: {} has no results.\n\nRun limitAnalysis, contactDynamics "
            "or a study first.",
            caseDirectory.string()));
    }
    writeWholeFile(file, assemblyDimensions(caseDirectory) == 3 ? reportText<3>(caseDirectory)
                                                                : reportText<2>(caseDirectory));
    info("Wrote {}\n", file.string());
}

} // namespace drystone
