// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// exportBlocks: writes the blocks of a case, as built or at a moment of a motion, for other programs.
#include "ExportFormats.h"

#include "assembly/AssemblyFile.h"
#include "assembly/Materials.h"
#include "contact/JointClosure.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "dynamics/InitialMotion.h"
#include "functionObjects/KeptResults.h"
#include "functionObjects/MotionState.h"
#include "io/FrameReader.h"
#include "runControl/Application.h"

#include <algorithm>
#include <charconv>
#include <limits>

using namespace drystone;
namespace fs = std::filesystem;

namespace
{

template<int Dim>
const ExportFormat<Dim>& formatOf(const CommandLine& commandLine)
{
    const std::string name = commandLine.get("format").value_or("obj");
    std::vector<std::string> names;
    for (const ExportFormat<Dim>& format : exportFormats<Dim>())
    {
        if (format.name == name)
        {
            return format;
        }
        names.emplace_back(format.name);
    }
    throw FatalError(unknownWordMessage("format", name, names));
}

template<class Number>
std::optional<Number> numberOf(const CommandLine& commandLine, const std::string& option, Number lowest,
                               Number highest)
{
    const std::optional<std::string> text = commandLine.get(option);
    if (!text)
    {
        return {};
    }
    Number value{};
    const auto [end, code] = std::from_chars(text->data(), text->data() + text->size(), value);
    if (code != std::errc() || end != text->data() + text->size() || !(value >= lowest && value <= highest))
    {
        throw FatalError(fmt::format("-{} {} is not possible: give a number from {} to {}.", option, *text,
                                     lowest, highest));
    }
    return value;
}

bool hasState(const fs::path& caseDirectory, const std::string& time)
{
    return fs::exists(caseDirectory / time / "state");
}

/// The time directory that -time names, of a state or a start; empty: as built.
std::string timeOf(const CommandLine& commandLine)
{
    std::vector<TimeDirectory> times = timeDirectories(commandLine.caseDirectory);
    std::erase_if(times,
                  [&](const TimeDirectory& directory)
                  {
                      return !hasState(commandLine.caseDirectory, directory.name)
                             && !fs::exists(commandLine.caseDirectory / directory.name / "motion");
                  });
    const std::string text = commandLine.get("time").value_or("");
    if (text.empty())
    {
        return {};
    }
    if (text == "latestTime" && !times.empty())
    {
        return times.back().name;
    }
    const auto wanted =
        text == "latestTime" ? std::nullopt : numberOf<double>(commandLine, "time", -1e300, 1e300);
    const auto found = std::find_if(times.begin(), times.end(),
                                    [&](const TimeDirectory& directory)
                                    { return wanted && std::abs(directory.time - *wanted) <= 1e-9; });
    if (found == times.end())
    {
        std::string names;
        for (const TimeDirectory& directory : times)
        {
            names += " " + directory.name;
        }
        throw FatalError(fmt::format("There is no state or start of time {} in this case.\n\nTimes:{}", text,
                                     names.empty() ? " none; contactDynamics writes them" : names));
    }
    return found->name;
}

/// Where the blocks are at a time: in its state, or else where `motion` has them start. \return none as built
template<int Dim>
std::vector<Placement<Dim>> placementsAt(const fs::path& caseDirectory, const std::string& time,
                                         const Assembly<Dim>& assembly)
{
    if (time.empty())
    {
        return {};
    }
    if (!hasState(caseDirectory, time))
    {
        return readInitialMotion(caseDirectory, time, assembly).state.placements;
    }
    return placementsIn<Dim>(readState(caseDirectory / time / "state"), assembly.blocks.size());
}

/// Refuses options that the format, or the other options, leave without a meaning.
template<int Dim>
void refuseOptions(const CommandLine& commandLine, const ExportFormat<Dim>& format)
{
    const bool isAnimated = commandLine.has("animation");
    if (!isAnimated && commandLine.has("magnification"))
    {
        throw FatalError("-magnification is of the displacements of -animation, which is not given.\n\nAdd "
                         "-animation, or leave -magnification out.");
    }
    if (isAnimated && (!format.takesFrames || commandLine.has("time")))
    {
        throw FatalError("-animation has all moments of a motion, in the format gltf only.\n\nWrite "
                         "exportBlocks -format gltf -animation, without -time.");
    }
    if (commandLine.has("decimals") && !format.takesDecimals)
    {
        throw FatalError(
            fmt::format("-decimals is of obj, compasJson and dxf; {} has all digits.\n\nLeave -decimals out.",
                        format.name));
    }
}

/// The frames of the case with the axes of solids: blocks of the plane lie in x-z.
template<int Dim>
std::vector<SolidFrame> framesOf(const CommandLine& commandLine, std::size_t blocks)
{
    if (!commandLine.has("animation"))
    {
        return {};
    }
    if (!fs::exists(commandLine.caseDirectory / "VTK/blocks.vtp.series"))
    {
        throw FatalError("There is no motion in this case: VTK/blocks.vtp.series does not exist.\n\nRun "
                         "limitAnalysis or contactDynamics first.");
    }
    const double magnification = numberOf<double>(commandLine, "magnification", 0, 1e9).value_or(1);
    std::vector<SolidFrame> frames;
    for (BlockFrame& frame : readBlockFrames(commandLine.caseDirectory / "VTK", "blocks", blocks,
                                             std::numeric_limits<std::size_t>::max()))
    {
        for (Eigen::Matrix3Xd* vectors : {&frame.displacement, &frame.rotation})
        {
            *vectors *= magnification;
            if constexpr (Dim == 2)
            {
                vectors->row(1).swap(vectors->row(2));
            }
        }
        if constexpr (Dim == 2)
        {
            frame.rotation.row(1) *= -1; // from x to z is about -y
        }
        frames.push_back({frame.time, std::move(frame.displacement), std::move(frame.rotation)});
    }
    return frames;
}

/// Warns where what is shown was computed from other input than that of now: old motion of new blocks.
template<int Dim>
void warnOfOtherInput(const CommandLine& commandLine, Assembly<Dim> assembly, const std::string& time)
{
    closeJoints(assembly);
    const fs::path& directory = commandLine.caseDirectory;
    if (!time.empty() && hasState(directory, time))
    {
        compareMotion(directory, assembly, {time});
    }
    if (commandLine.has("animation"))
    {
        compareFrames(directory, assembly);
    }
}

template<int Dim>
BlockExport<Dim> blocksToWrite(const CommandLine& commandLine, const ExportFormat<Dim>& format,
                               const Assembly<Dim>& assembly)
{
    const fs::path& directory = commandLine.caseDirectory;
    BlockExport<Dim> blocks{.caseDirectory = directory, .assembly = assembly};
    blocks.numbers.decimals = numberOf<int>(commandLine, "decimals", 0, 17);
    blocks.time = timeOf(commandLine);
    warnOfOtherInput(commandLine, assembly, blocks.time);
    blocks.frames = framesOf<Dim>(commandLine, assembly.blocks.size());
    blocks.placements = placementsAt(directory, blocks.time, assembly);
    const std::vector<double> densities =
        format.hasDensities ? readDensities<Dim>(directory, assembly, readGravity<Dim>(directory))
                            : std::vector<double>();
    blocks.solids = exportedSolids(assembly, blocks.placements, densities);
    return blocks;
}

void requireEnoughDecimals(const std::vector<ExportedSolid>& solids, int decimals)
{
    if (const int block = flattenedBlock(solids, decimals); block >= 0)
    {
        throw FatalError(
            fmt::format("With {} decimals block {} has less than half of its volume.\n\nGive more of them.",
                        decimals, block));
    }
}

/// Warns of what the file does not say of the blocks.
template<int Dim>
void warnOfLosses(const BlockExport<Dim>& blocks, const ExportFormat<Dim>& format)
{
    WrittenProperties written = format.written;
    if (!blocks.time.empty())
    {
        written.joints = WrittenJoints::none; // they are where they were stated as built only
    }
    for (const std::string& lost : unwritten(blocks.assembly, format.name, written))
    {
        printWarning(lost);
    }
    if (format.ofConcaveBlocks.empty())
    {
        return;
    }
    if (const std::vector<int> concave = concaveBlocks(blocks.solids); !concave.empty())
    {
        printWarning(fmt::format("{} blocks are not convex, as block {}: {} takes convex ones only; {}.",
                                 concave.size(), concave.front(), format.name, format.ofConcaveBlocks));
    }
}

template<int Dim>
fs::path fileOf(const CommandLine& commandLine, const BlockExport<Dim>& blocks,
                const ExportFormat<Dim>& format)
{
    const std::string standard = fmt::format("export/{}{}{}", blocks.frames.empty() ? "blocks" : "motion",
                                             blocks.time.empty() ? "" : "_" + blocks.time, format.ending);
    return commandLine.caseDirectory / commandLine.get("output").value_or(standard);
}

template<int Dim>
int runIn(const CommandLine& commandLine)
{
    const ExportFormat<Dim>& format = formatOf<Dim>(commandLine);
    refuseOptions(commandLine, format);
    const Assembly<Dim> assembly = readBlocks<Dim>(commandLine.caseDirectory);
    const BlockExport<Dim> blocks = blocksToWrite(commandLine, format, assembly);
    if (blocks.numbers.decimals)
    {
        requireEnoughDecimals(blocks.solids, *blocks.numbers.decimals);
    }
    const std::string text = format.text(blocks);
    warnOfLosses(blocks, format);
    const fs::path file = fileOf(commandLine, blocks, format);
    writeWholeFile(file, text);
    info("Blocks: {}, {}", assembly.blocks.size(),
         !blocks.frames.empty() ? fmt::format("in {} frames", blocks.frames.size())
         : blocks.time.empty()  ? "as built"
                                : "at time " + blocks.time);
    info("Wrote {}\n", file.lexically_normal().string());
    printExecutionTime();
    printEnd();
    return 0;
}

int run(const CommandLine& commandLine)
{
    return assemblyDimensions(commandLine.caseDirectory) == 3 ? runIn<3>(commandLine) : runIn<2>(commandLine);
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "exportBlocks";
    description.summary =
        "Writes the blocks of a case, as built, at a moment of a motion, or with the whole of it, into a "
        "file for other programs. Blocks of the plane become solids of their thickness, but in dxf.";
    description.kind = ApplicationKind::utility;
    description.options = {
        {"format", "FORMAT",
         "one of obj compasJson dxf gltf lmgc90 3dec; the last two are a script and commands; default obj"},
        {"time", "TIME",
         "of a state that contactDynamics wrote or of the start in 0/motion, or latestTime; as built if "
         "absent"},
        {"animation", "", "with the frames of the motion or mechanism, in gltf; export/motion.gltf"},
        {"magnification", "M", "of the displacements of -animation; 1 if absent"},
        {"decimals", "N", "of coordinates in obj, compasJson and dxf; all digits if absent"},
        {"output", "FILE", "relative to the case, unlike that of report; export/blocks... if absent"}};
    description.examples = {"exportBlocks -format gltf -animation        # a motion, for viewers and slides",
                            "exportBlocks -format gltf -time latestTime  # its end",
                            "exportBlocks -format compasJson             # for compas_assembly"};
    return runApplication(argc, argv, description, run);
}
