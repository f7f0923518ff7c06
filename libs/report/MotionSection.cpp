// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Frames of a motion or of a mechanism, and what they show.
#include "report/ReportSections.h"

#include "assembly/AssemblyFile.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "functionObjects/KeptResults.h"
#include "io/TimeDirectory.h"
#include "io/VtkSeries.h"
#include "report/ViewerData.h"
#include "runControl/Case.h"
#include "runControl/TimeControls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// How fast blocks move at the last frame.
struct SpeedsAtEnd
{
    std::vector<double> ofBlock; ///< 0 of what is fixed [m/s]
    bool isMean = false;         ///< since the frame before
};

/// From the state that was written with the last frame. \param free see freeIndices \return empty: there is
/// none, or it is damaged or of another structure
template<int Dim>
std::vector<double> speedsOfState(const fs::path& caseDirectory, const std::vector<int>& free, double time)
{
    const auto rows =
        freedomCount<Dim> * static_cast<std::size_t>(*std::max_element(free.begin(), free.end()) + 1);
    for (const TimeDirectory& directory : timeDirectories(caseDirectory))
    {
        const fs::path file = caseDirectory / directory.name / "state";
        if (std::abs(directory.time - time) > 1e-9 * directory.time || !fs::exists(file))
        {
            continue;
        }
        try
        {
            const std::vector<double> velocity = stateArray(readState(file), "velocity", rows);
            std::vector<double> speeds(free.size());
            for (std::size_t block = 0; block < free.size(); ++block)
            {
                const auto first = static_cast<std::ptrdiff_t>(freedomCount<Dim>) * free[block];
                speeds[block] =
                    free[block] < 0 ? 0 : Eigen::Map<const Vector<Dim>>(velocity.data() + first).norm();
            }
            return speeds;
        }
        catch (const FatalError&)
        {
            break;
        }
    }
    return {};
}

/// Between two frames. \param free likewise
std::vector<double> meanSpeeds(const BlockFrame& before, const BlockFrame& after,
                               const std::vector<int>& free)
{
    std::vector<double> speeds(free.size());
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        const auto column = static_cast<Eigen::Index>(block);
        speeds[block] = free[block] < 0
                            ? 0
                            : (after.displacement.col(column) - before.displacement.col(column)).norm()
                                  / (after.time - before.time);
    }
    return speeds;
}

/// From the state of the last frame, or if there is none from the last two frames. \return nothing where
/// neither says it
template<int Dim>
std::optional<SpeedsAtEnd> speedsAtEnd(const fs::path& caseDirectory, const Assembly<Dim>& assembly,
                                       const std::vector<BlockFrame>& frames)
{
    const std::vector<int> free = freeIndices(assembly);
    if (std::vector<double> ofState = speedsOfState<Dim>(caseDirectory, free, frames.back().time);
        !ofState.empty())
    {
        return SpeedsAtEnd{std::move(ofState), false};
    }
    return frames.size() < 2
               ? std::nullopt
               : std::optional(SpeedsAtEnd{meanSpeeds(frames[frames.size() - 2], frames.back(), free), true});
}

/// What can be said of a structure none of whose blocks is far from its place. It stands unless a block still
/// moves: as fast as at the last frame it would have come, in the time of the whole run, a hundredth of
/// `far`.
std::string standing(const std::optional<SpeedsAtEnd>& speeds, const std::vector<BlockFrame>& frames,
                     double far)
{
    if (!speeds)
    {
        return ""; // nothing of its motion is known
    }
    constexpr double hardlyAnything = 0.01;
    const auto fastest = std::max_element(speeds->ofBlock.begin(), speeds->ofBlock.end());
    return *fastest * (frames.back().time - frames.front().time) <= hardlyAnything * far
               ? ": the structure stands"
               : fmt::format(", but block {} still moves there, by {:.4g} m/s{}",
                             fastest - speeds->ofBlock.begin(), *fastest,
                             speeds->isMean ? " between the last two frames" : "");
}

/// The last time of a table over time; 0 of another [s].
double lastTimeOf(const fs::path& table)
{
    const std::string text = contentOfFile(table);
    const std::size_t end = text.find_last_not_of('\n');
    const std::size_t line = end == std::string::npos ? end : text.rfind('\n', end);
    return text.starts_with("# Time") && line != std::string::npos ? std::strtod(text.c_str() + line, nullptr)
                                                                   : 0;
}

/// How a run has ended, as its log, its tables and its states have it.
struct RunEnd
{
    double time = 0;       ///< [s]
    double wanted = 0;     ///< endTime of system/controlDict, 0 where a run ends by stopAt [s]
    bool isBroken = false; ///< by an error

    bool isAtItsEnd() const { return time >= wanted * (1 - 1e-9); }
};
RunEnd endOfRun(const fs::path& caseDirectory)
{
    RunEnd end;
    const TimeControls controls =
        readTimeControls(Dictionary::readFile(caseDirectory / "system/controlDict"), ControlDict::optional);
    end.wanted = controls.stopAt == StopAt::endTime ? controls.endTime : 0;
    std::istringstream log(contentOfFile(caseDirectory / "log.contactDynamics"));
    for (std::string line; std::getline(log, line);)
    {
        if (line.starts_with("Time = "))
        {
            end.time = std::max(end.time, std::strtod(line.c_str() + 7, nullptr));
        }
        end.isBroken = end.isBroken || line.find("DRYSTONE FATAL") != std::string::npos;
    }
    std::error_code ignored;
    for (const auto& entry : fs::recursive_directory_iterator(caseDirectory / "postProcessing", ignored))
    {
        end.time = std::max(end.time, entry.path().extension() == ".dat" ? lastTimeOf(entry.path()) : 0);
    }
    for (const TimeDirectory& directory : timeDirectories(caseDirectory))
    {
        end.time = std::max(end.time, directory.time);
    }
    return end;
}

struct Farthest
{
    double distance = 0; ///< [m]
    std::size_t block = 0;
    double time = 0; ///< [s]
};

/// How far free blocks go.
struct Distances
{
    Farthest inAllFrames;
    Farthest atTheEnd;
    int away = 0; ///< blocks that are far from their places at the end
    int blocks = 0;
};

/// \param far beyond which blocks are away [m]
template<int Dim>
Distances distancesOf(const Assembly<Dim>& assembly, const std::vector<BlockFrame>& frames, double far)
{
    Distances distances;
    for (const BlockFrame& frame : frames)
    {
        const bool isLast = &frame == &frames.back();
        for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
        {
            if (assembly.blocks[block].support >= 0)
            {
                continue;
            }
            const Farthest own{frame.displacement.col(static_cast<Eigen::Index>(block)).norm(), block,
                               frame.time};
            if (own.distance > distances.inAllFrames.distance) // not NaN, of a block that was deleted
            {
                distances.inAllFrames = own;
            }
            if (isLast)
            {
                distances.atTheEnd = own.distance > distances.atTheEnd.distance ? own : distances.atTheEnd;
                distances.away += own.distance <= far ? 0 : 1;
                ++distances.blocks;
            }
        }
    }
    return distances;
}

/// How far blocks go in the frames of a motion, and where they are at its end.
template<int Dim>
std::vector<std::string> motionMeaning(const fs::path& caseDirectory, const Assembly<Dim>& assembly,
                                       const std::vector<BlockFrame>& frames)
{
    const RunEnd end = endOfRun(caseDirectory);
    const double far = 0.5 * meanBlockSize(assembly);
    const Distances distances = distancesOf(assembly, frames, far);
    const Farthest& largest = distances.inAllFrames;
    const Farthest& atTheEnd = distances.atTheEnd;
    const bool isWhole = end.time <= frames.back().time * (1 + 1e-9);
    std::vector<std::string> sentences{
        fmt::format(
            "The largest displacement of a block in these frames is {:.4g} m, of block {} at {:.4g} s.",
            largest.distance, largest.block, largest.time),
        fmt::format("After {:.4g} s the largest displacement of a block is {:.4g} m, of block {}; {} of {} "
                    "blocks are farther from their places than half the mean block size of {:.3g} m{}.",
                    frames.back().time, atTheEnd.distance, atTheEnd.block, distances.away, distances.blocks,
                    2 * far,
                    distances.away == 0 && isWhole && end.isAtItsEnd() && !end.isBroken
                        ? standing(speedsAtEnd(caseDirectory, assembly, frames), frames, far)
                        : "")};
    if (!isWhole)
    {
        sentences.push_back(
            fmt::format("The run went on to {:.4g} s without another frame: what moved by then is "
                        "in its log and histories.",
                        end.time));
    }
    if (end.isBroken)
    {
        sentences.emplace_back("The run broke off with an error, which its log has.");
    }
    if (!end.isAtItsEnd())
    {
        sentences.push_back(fmt::format(
            "The run has come to {:.6g} s, and endTime is {:.6g} s: it was stopped, or a step was not "
            "solved. contactDynamics goes on from its last state where startFrom is latestTime.",
            end.time, end.wanted));
        printWarning(sentences.back());
    }
    return sentences;
}

/// How many frames a page has room for.
template<int Dim>
std::size_t framesInPage(const Assembly<Dim>& assembly)
{
    constexpr std::size_t mostNumbers = 150'000; // of positions: some 2 MB of page
    return mostNumbers / std::max<std::size_t>(1, assembly.blocks.size());
}

/// The viewer in three dimensions with the frames, or why the page has none.
template<int Dim>
void addViewer(HtmlPage& page, const Assembly<Dim>& assembly, const std::vector<BlockFrame>& frames,
               const AnimationTime& time)
{
    const std::optional<std::string> script = viewerScript();
    if (!script)
    {
        page.paragraph(
            "This page has no viewer in three dimensions, since Drystone was built without npm; open "
            "VTK/blocks.vtp.series in ParaView.");
        return;
    }
    if (framesInPage(assembly) < 2)
    {
        page.paragraph(
            fmt::format("{} blocks are too many for a viewer in this page; open VTK/blocks.vtp.series in "
                        "ParaView.",
                        assembly.blocks.size()));
        return;
    }
    page.markup(viewerMarkup(viewerJson(assembly, frames, time), "motion"));
    page.markup(fmt::format("<script>{}</script>\n", *script));
}

} // namespace

template<int Dim>
void addMotion(HtmlPage& page, const fs::path& caseDirectory, const Assembly<Dim>& assembly)
{
    const std::string ofFrames = readSeries(caseDirectory / "VTK", "blocks").application;
    const bool hasMotion = isOfMotion(caseDirectory);
    const bool isMotion = hasMotion && (ofFrames.empty() || ofFrames == "contactDynamics");
    if (!fs::exists(caseDirectory / "VTK" / "blocks.vtp.series"))
    {
        if (isMotion && !timesOfStates(caseDirectory).empty())
        {
            page.heading("Motion");
            page.paragraph(
                "There are states, but no frames: VTK/blocks.vtp.series is missing, from which this "
                "section is made. contactDynamics writes frames as it goes.");
        }
        return;
    }
    page.heading(isMotion ? "Motion" : "Mechanism");
    if (hasMotion && !isMotion)
    {
        page.paragraph(fmt::format("There are states of a motion, too, but the frames are those of {}, which "
                                   "ran after it. contactDynamics writes frames as it goes.",
                                   ofFrames));
    }
    const std::vector<BlockFrame> frames =
        readBlockFrames(caseDirectory / "VTK", "blocks", assembly.blocks.size(),
                        std::clamp<std::size_t>(framesInPage(assembly), 2, 101));
    if (isMotion && !frames.empty())
    {
        for (const std::string& sentence : motionMeaning(caseDirectory, assembly, frames))
        {
            page.paragraph(sentence);
        }
    }
    addViewer(page, assembly, frames,
              isMotion ? AnimationTime{"time", " s", 1} : AnimationTime{"part of the mechanism", "", 1});
}

template void addMotion(HtmlPage& page, const fs::path& caseDirectory, const Assembly<2>& assembly);
template void addMotion(HtmlPage& page, const fs::path& caseDirectory, const Assembly<3>& assembly);

} // namespace drystone
