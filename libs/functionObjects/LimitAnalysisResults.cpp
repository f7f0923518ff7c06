// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/LimitAnalysisResults.h"

#include "assembly/Facing.h"
#include "core/WholeFile.h"
#include "functionObjects/ColumnFile.h"
#include "io/Frames.h"
#include "io/Mechanism.h"
#include "io/MechanismPicture.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

std::filesystem::path tableFolder(const std::filesystem::path& caseDirectory)
{
    return postProcessingFolder(caseDirectory, "limitAnalysis", "0");
}

std::string statusText(const LimitAnalysis& result)
{
    switch (result.status)
    {
    case CollapseStatus::optimal:
        return fmt::format("alpha = {:.6f}", result.alpha);
    case CollapseStatus::unstable:
        return "unstable under its dead load";
    case CollapseStatus::unbounded:
        return "no live load of this direction makes it collapse";
    case CollapseStatus::notConverged:
        break;
    }
    return "not converged";
}

std::string tableText(const LimitAnalysisCase& structure, const LimitAnalysis& result, double cpuTime)
{
    return fmt::format(
        "# alpha[-] status[-] blocks[-] contactPoints[-] variables[-] iterations[-] primalResidual[-] "
        "dualResidual[-] gap[-] cpuTime[s]\n{:.12g} {} {} {} {} {} {:.3e} {:.3e} {:.3e} {:.6g}\n",
        result.alpha, static_cast<int>(result.status), structure.freeBlocks, structure.points.size(),
        result.variables, result.iterations, result.certificate.primalResidual,
        result.certificate.dualResidual, result.certificate.gap, cpuTime);
}

} // namespace

void requireWritableResults(const std::filesystem::path& caseDirectory)
{
    requireWritable(tableFolder(caseDirectory));
    requireWritable(caseDirectory / "VTK");
}

void writeLimitAnalysisResults(const std::filesystem::path& caseDirectory, const LimitAnalysisCase& structure,
                               const LimitAnalysis& result, double cpuTime)
{
    const Assembly<2>& assembly = structure.assembly;
    const Eigen::Matrix3Xd rates = ratesOfAllBlocks(assembly, result.mechanism);
    VtkSeries blocks(caseDirectory / "VTK", "blocks", 0);
    writeMechanism(blocks, assembly, rates);

    const std::vector<Vector<2>> forces = pointForces(result.contactForce);
    VtkSeries contacts(caseDirectory / "VTK", "contacts", 0);
    contacts.write(0, contactFrame(structure.points, forces, contactStates(forces, structure.friction)));

    MechanismPicture picture;
    picture.title = std::filesystem::absolute(caseDirectory).lexically_normal().filename().string();
    picture.subtitle = fmt::format("{}, {} blocks, {} contact points", statusText(result),
                                   structure.freeBlocks, structure.points.size());
    writeMechanismPicture(tableFolder(caseDirectory) / "mechanism.svg", assembly,
                          mechanismPlacements(assembly, rates, 0.5 * meanBlockSize(assembly)), picture);
    writeWholeFile(tableFolder(caseDirectory) / "limitAnalysis.dat", tableText(structure, result, cpuTime));
}

} // namespace drystone
