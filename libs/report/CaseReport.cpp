// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Collects the page of a case, section by section.
#include "report/CaseReport.h"

#include "assembly/AssemblyFile.h"
#include "assembly/Materials.h"
#include "contact/AssemblyStatistics.h"
#include "contact/ClosedAssembly.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "functionObjects/Histories.h"
#include "functionObjects/KeptResults.h"
#include "functionObjects/LimitAnalysisResults.h"
#include "functionObjects/LoadMeaning.h"
#include "report/ActiveDrawing.h"
#include "report/ReportSections.h"
#include "report/SortedFiles.h"
#include "runControl/Application.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

namespace drystone
{

namespace
{

namespace fs = std::filesystem;

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
        const bool isWhole = drawing.find("</svg>") != std::string::npos;
        if (!isWhole || isActive(drawing))
        {
            const std::string fault =
                isWhole
                    ? fmt::format("{} has a script, which no picture of Drystone has, and is left out.", name)
                    : fmt::format("{} is cut off, or empty, and left out.", name);
            printWarning(fault);
            page.paragraph(fault);
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
        for (const auto& [unit, plot] : historyPlots(readNumberTable(file), name))
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

/// The warnings that the logs of the case have, each once.
std::vector<std::string> warningsIn(const fs::path& caseDirectory)
{
    std::vector<std::string> warnings;
    for (const std::string& name : namesIn(caseDirectory))
    {
        if (!name.starts_with("log.") || name == "log.report") // of an earlier page
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

/// In front of what they concern.
void addOldResults(HtmlPage& page, std::vector<std::string> warnings)
{
    std::erase(warnings, "");
    if (warnings.empty())
    {
        return;
    }
    page.heading("Results of other input");
    page.paragraph("This page shows results beside input that they do not follow from:");
    for (const std::string& warning : warnings)
    {
        page.verbatim(warning);
    }
}

void addSections(HtmlPage& page, const std::vector<ReportSection>& sections)
{
    for (const ReportSection& section : sections)
    {
        page.heading(section.heading);
        for (const std::string& sentence : section.sentences)
        {
            page.paragraph(sentence);
        }
        if (!section.rows.empty())
        {
            page.table(section.head, section.rows);
        }
    }
}

/// Of a case without blocks.
std::string studyText(const fs::path& caseDirectory, std::vector<std::string> warnings,
                      const std::vector<ReportSection>& sections)
{
    HtmlPage page(caseName(caseDirectory));
    addOldResults(page, std::move(warnings));
    addSections(page, sections);
    addPictures(page, caseDirectory);
    addWarnings(page, caseDirectory);
    addInputs<2>(page, caseDirectory); // the keys of studies, and of most else, are those of space too
    addRepetition(page, caseDirectory);
    return page.text();
}

template<int Dim>
std::string reportText(const fs::path& caseDirectory, std::vector<std::string> warnings,
                       const std::vector<ReportSection>& sections)
{
    const Assembly<Dim> assembly = readAssembly<Dim>(caseDirectory);
    HtmlPage page(caseName(caseDirectory));
    warnings.push_back(compareLimitAnalysis(caseDirectory, assembly));
    const InputOfResults input = warnings.back().empty() ? InputOfResults::same : InputOfResults::other;
    warnings.push_back(compareMotion(caseDirectory, assembly, timesOfStates(caseDirectory)));
    addOldResults(page, warnings);
    const auto freeBlocks = std::count_if(assembly.blocks.begin(), assembly.blocks.end(),
                                          [](const Block<Dim>& block) { return block.support < 0; });
    addDamage(page, caseDirectory, static_cast<std::size_t>(freeBlocks), sections);
    addStructure(page, caseDirectory, assembly);
    addCollapse<Dim>(page, caseDirectory, input);
    addMotion(page, caseDirectory, assembly);
    addSections(page, sections);
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

void writeReport(const fs::path& caseDirectory, const fs::path& file, std::vector<std::string> warnings,
                 const std::vector<ReportSection>& sections)
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
    const bool hasBlocks = fs::exists(caseDirectory / "constant/assembly/blocks", none);
    const auto text = !hasBlocks && !sections.empty()          ? studyText
                      : assemblyDimensions(caseDirectory) == 3 ? reportText<3>
                                                               : reportText<2>;
    writeWholeFile(file, text(caseDirectory, std::move(warnings), sections));
    info("Wrote {}\n", file.string());
}

} // namespace drystone
