// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/DynamicCase.h"

#include "assembly/AssemblyFile.h"
#include "assembly/Equilibrium.h"
#include "assembly/Facing.h"
#include "assembly/Loads.h"
#include "assembly/Materials.h"

namespace drystone
{

DynamicCase readDynamicCase(const std::filesystem::path& caseDirectory)
{
    DynamicCase scene;
    scene.schemes = readSchemes(caseDirectory);
    scene.solution = readSolverChoice(caseDirectory, "contactDynamics");
    scene.assembly = readAssembly(caseDirectory);
    refuseOverlaps(scene.assembly, caseDirectory);
    scene.contact = readContactProperties(caseDirectory);
    scene.gravity = readGravity(caseDirectory);
    scene.blocks = blockMasses(scene.assembly);
    scene.free = freeIndices(scene.assembly);
    const std::vector<double> densities = readDensities(caseDirectory, scene.assembly, scene.gravity);
    scene.mass = massDiagonal(scene.assembly, scene.blocks, densities);
    const std::vector<double> masses = massesOf(scene.blocks, densities);
    scene.deadLoad =
        readLoads(caseDirectory, {scene.assembly, masses, scene.gravity}, LiveLoad::optional).dead;
    scene.groundMotion = readGroundMotion(
        Dictionary::readFileIfPresent(caseDirectory / "constant/groundMotion"), caseDirectory);
    scene.blockSize = meanBlockSize(scene.assembly);
    double extent = 0;
    for (const Block<2>& block : scene.assembly.blocks)
    {
        for (const Vector<2>& corner : block.outline)
        {
            extent = std::max(extent, block.support < 0 ? corner.lpNorm<Eigen::Infinity>() : 0);
        }
    }
    scene.roundingGap = 64 * std::numeric_limits<double>::epsilon() * extent;
    return scene;
}

Eigen::VectorXd loadUnder(const DynamicCase& scene, const Eigen::Vector3d& ground)
{
    Eigen::VectorXd load = scene.deadLoad;
    for (Eigen::Index row = 0; row < load.size(); row += 3)
    {
        load.segment<2>(row) -= scene.groundFactor * scene.mass[row] * ground.head<2>();
    }
    return load;
}

} // namespace drystone
