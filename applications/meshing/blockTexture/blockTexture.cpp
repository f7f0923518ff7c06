// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// blockTexture: generates the blocks of a structure from system/blockTextureDict.
#include "assembly/AssemblyFile.h"
#include "assembly/AssemblyOrigin.h"
#include "assembly/Plausibility.h"
#include "contact/AlmostJoints.h"
#include "contact/AssemblyStatistics.h"
#include "contact/ClosedAssembly.h"
#include "contact/JointClosure.h"
#include "contact/space/StatedJointChecks.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "geometry/PolygonShape.h"
#include "geometry/space/PolyhedronFault.h"
#include "io/VtkLibrary.h"
#include "runControl/Application.h"
#include "texture/Texture.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

using namespace drystone;

namespace
{

/// What is wrong with a block; empty: nothing.
std::string faultOf(const Block<2>& block)
{
    const std::string fault = outlineFault(block.outline);
    const double area = areaProperties(block.outline).area;
    return fault.empty() && !std::isnormal(area) ? fmt::format("has an area of {:g} m2", area) : fault;
}
std::string faultOf(const Block<3>& block)
{
    const double volume = blockMass(block).volume; // with room for products of more than three lengths
    if (!std::isnormal(volume * volume))
    {
        return fmt::format("has a volume of {:g} m3", volume);
    }
    const std::optional<PolyhedronFault> fault = findFault(block.shape);
    return fault ? fmt::format("is no solid: {}", fault->text) : "";
}

/// Lengths so small or large that no numbers are left for the shapes of blocks, or that do not go together.
template<int Dim>
void refuseShapes(const Assembly<Dim>& assembly, const Dictionary& dictionary)
{
    for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
    {
        if (const std::string fault = faultOf(assembly.blocks[block]); !fault.empty())
        {
            throw FatalIOError(
                fmt::format("This texture makes no blocks: block {} {}.\n\nIts lengths are in "
                            "metres; correct those that are too small or too large, also beside "
                            "each other.",
                            block, fault),
                dictionary.locationOf("texture"));
        }
    }
}

/// The user may say within what distance faces are a joint, of all blocks or of those of an imported file.
ToleranceOrigin toleranceOriginOf(const Dictionary& dictionary)
{
    const auto hasOwn = [](const Dictionary& texture) { return texture.find("tolerance") != nullptr; };
    const Dictionary& texture = dictionary.subDict("texture");
    const bool isStated = dictionary.find("jointTolerance") || hasOwn(texture)
                          || (texture.find("of") && hasOwn(texture.subDict("of"))); // of an extrusion
    return isStated ? ToleranceOrigin::stated : ToleranceOrigin::ofDigits;
}

/// What the blocks will be refused for, and joints that they lack though nobody has said so.
template<int Dim>
void warnOfFaults(const Assembly<Dim>& assembly, const Dictionary& dictionary)
{
    if (const std::vector<Overlap<Dim>> overlaps = findOverlaps(assembly); !overlaps.empty())
    {
        printWarning(overlapText(overlaps.front()), dictionary.locationOf("texture"));
    }
    else if (const std::string fault = almostJointsText(assembly, toleranceOriginOf(dictionary));
             !fault.empty())
    {
        printWarning(fault, dictionary.locationOf("texture"));
    }
    if constexpr (Dim == 3)
    {
        if (const std::string lacking = facesWithoutStatedJointText(assembly); !lacking.empty())
        {
            printWarning(lacking, dictionary.locationOf("texture"));
        }
    }
}

template<int Dim>
int runIn(const CommandLine& commandLine, const Dictionary& dictionary)
{
    const std::filesystem::path& directory = commandLine.caseDirectory;
    const Assembly<Dim> assembly = makeStructure<Dim>(dictionary, directory);
    refuseShapes(assembly, dictionary);
    Assembly<Dim> closed =
        assembly; // as it will be read; the file keeps the coordinates as they were written
    closeJoints(closed);
    const AssemblyStatistics<Dim> statistics = countAssembly(closed);
    info("Blocks: {} free, {} fixed", statistics.freeBlocks, statistics.blocks - statistics.freeBlocks);
    info("Joints: {} with {} contact points", statistics.joints, statistics.contactPoints);
    printClosure(closed);
    printLine();
    warnOfFaults(closed, dictionary);
    questionSizes(assembly, dictionary.locationOf("texture"));
    if (commandLine.dryRun)
    {
        printEnd();
        return 0;
    }

    const std::filesystem::path picture = (directory / "VTK" / "assembly.vtp").lexically_normal();
    requireWritable(assemblyFile(directory).parent_path());
    requireWritable(picture.parent_path());
    writeAssembly(picture, assembly);
    const std::filesystem::path file = commandLine.dictionaryFile("system/blockTextureDict");
    writeWholeFile(assemblyFile(directory), assemblyText(assembly, originOf(file, directory)));
    info("Wrote {} and {}\n", assemblyFile(directory).string(), picture.string());
    printExecutionTime();
    printEnd();
    return 0;
}

int run(const CommandLine& commandLine)
{
    const Dictionary dictionary = Dictionary::readFile(commandLine.dictionaryFile("system/blockTextureDict"));
    return dimensionsOf(dictionary) == 3 ? runIn<3>(commandLine, dictionary)
                                         : runIn<2>(commandLine, dictionary);
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "blockTexture";
    description.summary =
        "Generates the blocks of a structure from system/blockTextureDict and writes them to "
        "constant/assembly/ and VTK/assembly.vtp.";
    description.kind = ApplicationKind::preProcessor;
    description.options = {{"dry-run", "", "read and check everything, write nothing"}};
    description.examples = {"blockTexture -case wall",
                            "blockTexture -dict system/otherDict   # relative to the case directory"};
    description.tutorial = "blockTexture/runningBond";
    description.dictionaries = {{"system/blockTextureDict in the plane", describeOptions<BlockTexture<2>>},
                                {"system/blockTextureDict in space", describeOptions<BlockTexture<3>>}};
    return runApplication(argc, argv, description, run);
}
