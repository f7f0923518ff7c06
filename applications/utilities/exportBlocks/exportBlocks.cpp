// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// exportBlocks: writes the blocks of a case, as built or at a moment of a motion, for other programs.
#include "assembly/AssemblyFile.h"
#include "assembly/Materials.h"
#include "contact/ContactPoint.h"
#include "contact/JointClosure.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "dynamics/InitialMotion.h"
#include "effects/EffectList.h"
#include "functionObjects/KeptResults.h"
#include "import/export/Unwritten.h"
#include "import/export/Writers.h"
#include "io/FrameReader.h"
#include "io/TimeDirectory.h"
#include "runControl/Application.h"

#include <algorithm>
#include <charconv>
#include <limits>

using namespace drystone;
namespace fs = std::filesystem;

namespace
{

/// A format: its name, and the ending of its files.
using Format = std::pair<std::string_view, std::string_view>;
constexpr std::array<Format, 6> formats{{{"obj", ".obj"},
                                         {"compasJson", ".json"},
                                         {"dxf", ".dxf"},
                                         {"gltf", ".gltf"},
                                         {"lmgc90", ".py"},
                                         {"3dec", ".dat"}}};

const Format& formatOf(const CommandLine& commandLine)
{
    const std::string name = commandLine.get("format").value_or("obj");
    const auto found = std::find_if(formats.begin(), formats.end(),
                                    [&](const Format& format) { return format.first == name; });
    if (found == formats.end())
    {
        std::vector<std::string> names;
        for (const Format& format : formats)
        {
            names.emplace_back(format.first);
        }
        throw FatalError(unknownWordMessage("format", name, names));
    }
    return *found;
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
    const std::size_t blocks = assembly.blocks.size();
    const State state = readState(caseDirectory / time / "state");
    constexpr std::size_t rotations = rotationCount<Dim>;
    const std::vector<double>& translation = stateArray(state, "translation", Dim * blocks);
    const std::vector<double>& rotation = stateArray(state, "rotation", rotations * blocks);
    std::vector<Placement<Dim>> placements(blocks);
    for (std::size_t i = 0; i < blocks; ++i)
    {
        for (std::size_t axis = 0; axis < Dim; ++axis)
        {
            placements[i].translation[static_cast<int>(axis)] = translation[Dim * i + axis];
        }
        if constexpr (Dim == 2)
        {
            placements[i].rotation = rotation[i];
        }
        else
        {
            placements[i].rotation = {rotation[3 * i], rotation[3 * i + 1], rotation[3 * i + 2]};
        }
    }
    return placements;
}

/// The frames of the case with the axes of solids: blocks of the plane lie in x-z.
template<int Dim>
std::vector<SolidFrame> framesOf(const CommandLine& commandLine, std::size_t blocks)
{
    if (!commandLine.has("animation") && commandLine.has("magnification"))
    {
        throw FatalError("-magnification is of the displacements of -animation, which is not given.\n\nAdd "
                         "-animation, or leave -magnification out.");
    }
    if (!commandLine.has("animation"))
    {
        return {};
    }
    if (formatOf(commandLine).first != "gltf" || commandLine.has("time"))
    {
        throw FatalError("-animation has all moments of a motion, in the format gltf only.\n\nWrite "
                         "exportBlocks -format gltf -animation, without -time.");
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
void compareWithInput(const CommandLine& commandLine, Assembly<Dim> assembly, const std::string& time)
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

/// The joints as built, for formats that have them.
std::vector<StatedJoint<3>> jointsOf(Assembly<3> assembly)
{
    closeJoints(assembly);
    std::vector<StatedJoint<3>> joints;
    int last = -1;
    for (const ContactPoint<3>& point : findContactPoints(assembly))
    {
        if (point.joint != last)
        {
            joints.push_back({point.block, point.neighbour, point.normal, {}});
            last = point.joint;
        }
        joints.back().points.push_back(point.position);
    }
    return joints;
}
std::vector<StatedJoint<3>> jointsOf(const Assembly<2>&)
{
    return {}; // of the plane are lines, not interfaces
}

std::string dxfOf(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                  const std::vector<ExportedSolid>&, const WrittenNumbers& numbers)
{
    return dxfText(assembly, placements, numbers);
}
std::string dxfOf(const Assembly<3>&, const std::vector<Placement<3>>&,
                  const std::vector<ExportedSolid>& solids, const WrittenNumbers& numbers)
{
    return dxfText(solids, numbers);
}

/// \param time empty: as built, when joints are where they were stated
template<int Dim>
WrittenProperties propertiesIn(std::string_view format, const std::string& time)
{
    WrittenProperties written;
    if (format == "compasJson")
    {
        written.zones = WrittenZones::all;
        written.joints = time.empty() && Dim == 3 ? WrittenJoints::all : WrittenJoints::none;
    }
    if (format == "dxf" && Dim == 2)
    {
        written.thickness = WrittenThickness::none;
    }
    return written;
}

/// What the joints of the case do and an LMGC90 script does not.
void warnOfLaws(const ContactProperties& properties)
{
    std::vector<std::string_view> others;
    for (const auto& [isGiven, name] : {std::pair{properties.restitution.has_value(), "restitution"},
                                        std::pair{properties.cohesion.has_value(), "cohesion"},
                                        std::pair{properties.tension.has_value(), "tension"},
                                        std::pair{properties.crushing.has_value(), "crushing"}})
    {
        if (isGiven)
        {
            others.emplace_back(name);
        }
    }
    if (!others.empty())
    {
        printWarning(fmt::format("The script has friction alone (IQS_CLB): of constant/contactProperties it "
                                 "leaves out {}.",
                                 fmt::join(others, ", ")));
    }
    if (properties.friction && properties.friction->flowRule == FlowRule::associative)
    {
        printWarning("The script slides by Coulomb's law, without dilatancy, where flowRule of "
                     "constant/contactProperties is associative.");
    }
    if (!properties.joints.empty())
    {
        printWarning("The script has one law for all joints: what `joints` of constant/contactProperties "
                     "says of some is not in it.");
    }
}

void requireEnoughDecimals(const std::vector<ExportedSolid>& solids, std::string_view format, int decimals)
{
    if (format != "obj" && format != "compasJson" && format != "dxf")
    {
        throw FatalError(
            fmt::format("-decimals is of obj, compasJson and dxf; {} has all digits.\n\nLeave -decimals "
                        "out.",
                        format));
    }
    if (const int block = flattenedBlock(solids, decimals); block >= 0)
    {
        throw FatalError(
            fmt::format("With {} decimals block {} has less than half of its volume.\n\nGive more "
                        "of them.",
                        decimals, block));
    }
}

template<int Dim>
int runIn(const CommandLine& commandLine)
{
    const fs::path& directory = commandLine.caseDirectory;
    const auto [format, ending] = formatOf(commandLine);
    const WrittenNumbers numbers{numberOf<int>(commandLine, "decimals", 0, 17)};
    const std::string time = timeOf(commandLine);
    const Assembly<Dim> assembly = readBlocks<Dim>(directory);
    compareWithInput(commandLine, assembly, time);
    const std::vector<SolidFrame> frames = framesOf<Dim>(commandLine, assembly.blocks.size());
    const auto placements = placementsAt(directory, time, assembly);
    const bool hasDensities = format == "lmgc90";
    const std::vector<double> densities =
        hasDensities ? readDensities<Dim>(directory, assembly, readGravity<Dim>(directory))
                     : std::vector<double>();
    const std::vector<ExportedSolid> solids = exportedSolids(assembly, placements, densities);
    if (numbers.decimals)
    {
        requireEnoughDecimals(solids, format, *numbers.decimals);
    }
    std::string text;
    if (format == "obj")
    {
        text = objText(solids, numbers);
    }
    else if (format == "compasJson")
    {
        text = compasJsonText(solids, time.empty() ? jointsOf(assembly) : std::vector<StatedJoint<3>>(),
                              numbers);
    }
    else if (format == "dxf")
    {
        text = dxfOf(assembly, placements, solids, numbers);
    }
    else if (format == "gltf")
    {
        text = gltfText(solids, frames);
    }
    else if (format == "lmgc90")
    {
        const ContactProperties properties = readContactProperties(directory);
        text = lmgc90Text(solids, properties.friction ? properties.friction->mu : 0);
        warnOfLaws(properties);
    }
    else
    {
        text = threeDecText(solids);
        info("3DEC commands have the shapes alone: which blocks are fixed stands in comments, densities and "
             "properties of joints are yours to add");
    }
    for (const std::string& lost : unwritten(assembly, format, propertiesIn<Dim>(format, time)))
    {
        printWarning(lost);
    }
    if (format == "lmgc90" || format == "3dec")
    {
        if (const std::vector<int> concave = concaveBlocks(solids); !concave.empty())
        {
            printWarning(
                fmt::format("{} blocks are not convex, as block {}: {} takes convex ones only; {}.",
                            concave.size(), concave.front(), format,
                            format == "3dec" ? "they are left out" : "divide them before it computes"));
        }
    }
    const fs::path file =
        directory
        / commandLine.get("output").value_or(fmt::format(
            "export/{}{}{}", frames.empty() ? "blocks" : "motion", time.empty() ? "" : "_" + time, ending));
    writeWholeFile(file, text);
    info("Blocks: {}, {}", assembly.blocks.size(),
         !frames.empty() ? fmt::format("in {} frames", frames.size())
         : time.empty()  ? "as built"
                         : "at time " + time);
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
        {"output", "FILE", "relative to the case; export/blocks... if absent"}};
    description.examples = {"exportBlocks -format gltf -animation        # a motion, for viewers and slides",
                            "exportBlocks -format gltf -time latestTime  # its end",
                            "exportBlocks -format compasJson             # for compas_assembly"};
    return runApplication(argc, argv, description, run);
}
