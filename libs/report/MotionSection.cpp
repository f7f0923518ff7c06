// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Frames of a motion or of a mechanism, and what they show.
#include "report/ReportSections.h"

#include "assembly/AssemblyFile.h"
#include "contact/AssemblyChecks.h"
#include "functionObjects/KeptResults.h"
#include "report/ViewerData.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// What can be said of a structure none of whose blocks is far from its place. It stands unless a block still
/// moves: as fast as in the last frame it would have come, in the time of the whole run, a hundredth of
/// `far`.
template<int Dim>
std::string standing(const Assembly<Dim>& assembly, const std::vector<BlockFrame>& frames, double far)
{
    constexpr double hardlyAnything = 0.01;
    double fastest = 0; // [m/s]
    std::size_t moving = 0;
    for (std::size_t block = 0; frames.size() > 1 && block < assembly.blocks.size(); ++block)
    {
        const BlockFrame& last = frames.back();
        const BlockFrame& before = frames[frames.size() - 2];
        const auto column = static_cast<Eigen::Index>(block);
        const double speed = (last.displacement.col(column) - before.displacement.col(column)).norm()
                             / (last.time - before.time);
        if (assembly.blocks[block].support < 0 && speed > fastest)
        {
            fastest = speed;
            moving = block;
        }
    }
    return fastest * (frames.back().time - frames.front().time) <= hardlyAnything * far
               ? ": the structure stands"
               : fmt::format(", but block {} still moves there, by {:.4g} m/s between the last two frames",
                             moving, fastest);
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
                    away == 0 ? standing(assembly, frames, far) : "")};
}

} // namespace

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

template void addMotion(HtmlPage& page, const fs::path& caseDirectory, const Assembly<2>& assembly);
template void addMotion(HtmlPage& page, const fs::path& caseDirectory, const Assembly<3>& assembly);

} // namespace drystone
