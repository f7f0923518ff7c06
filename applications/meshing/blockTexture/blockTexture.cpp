// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// blockTexture: generates the blocks of a structure from system/blockTextureDict.
#include "assembly/AssemblyChecks.h"
#include "assembly/AssemblyFile.h"
#include "assembly/AssemblyOrigin.h"
#include "assembly/ContactPoint.h"
#include "assembly/Plausibility.h"
#include "core/CaseFiles.h"
#include "core/CommandLine.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "io/Frames.h"
#include "texture/Texture.h"

using namespace drystone;

namespace
{

void warnOfOverlaps(const Assembly<2>& assembly, const Dictionary& dictionary)
{
    if (const auto overlap = findOverlap(assembly, harmlessOverlap))
    {
        printWarning(
            fmt::format("Blocks {} and {} overlap by {:.6g} m2, {:.3g} of the smaller one. Blocks may touch, "
                        "but not overlap; checkBlocks lists all overlaps.",
                        overlap->block, overlap->neighbour, overlap->area, overlap->fraction),
            dictionary.locationOf("texture"));
    }
}

int run(const CommandLine& commandLine)
{
    printBanner(commandLine);
    const std::filesystem::path& directory = commandLine.caseDirectory;
    refuseMisnamedFiles(directory);
    const std::filesystem::path file = commandLine.dictionaryFile("system/blockTextureDict");
    const Dictionary dictionary = Dictionary::readFile(file);
    const Assembly<2> assembly = makeStructure(dictionary);
    const AssemblyStatistics statistics = countAssembly(assembly);
    info("Blocks: {} free, {} fixed", statistics.freeBlocks, statistics.blocks - statistics.freeBlocks);
    info("Joints: {} with {} contact points\n", statistics.joints, statistics.contactPoints);
    warnOfOverlaps(assembly, dictionary);
    questionSizes(assembly, dictionary.locationOf("texture"));

    const std::filesystem::path picture = (directory / "VTK" / "assembly.vtp").lexically_normal();
    requireWritable(assemblyFile(directory).parent_path());
    requireWritable(picture.parent_path());
    writeAssembly(picture, assembly);
    writeWholeFile(assemblyFile(directory), assemblyText(assembly, originOf(file, directory)));
    info("Wrote {} and {}\n", assemblyFile(directory).string(), picture.string());
    printExecutionTime();
    printEnd();
    return 0;
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
    description.details = []
    { return fmt::format("system/blockTextureDict:\n{}", helpText(describeOptions<BlockTexture>())); };
    return runApplication(argc, argv, description, run);
}
