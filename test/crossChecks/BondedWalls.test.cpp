// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Walls of bonded bricks in space, where many points of a joint carry nothing or slide: pushed in all
/// directions each is solved, by few factorisations.
#include "assembly/Assembly.h"
#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"
#include "contact/ContactPoint.h"
#include "texture/Texture.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace drystone
{
namespace
{

/// Unit weight, and the same along `push`.
SpaceConeProgram programOf(const Assembly<3>& assembly, double friction, const Eigen::Vector3d& push)
{
    SpaceConeProgram program;
    const std::vector<int> free = freeIndices(assembly);
    std::vector<BlockMass<3>> masses;
    for (const Block<3>& block : assembly.blocks)
    {
        masses.push_back(blockMass(block));
        program.bodies += free[masses.size() - 1] >= 0;
    }
    program.load = Eigen::VectorXd::Zero(6 * program.bodies);
    program.liveLoad = program.load;
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] >= 0)
        {
            program.load[6 * free[block] + 2] = -masses[block].volume;
            program.liveLoad.segment<3>(6 * free[block]) = masses[block].volume * push;
        }
    }
    for (const ContactPoint<3>& point : findContactPoints(assembly))
    {
        Eigen::Matrix3d axes;
        axes << point.normal, point.normal.unitOrthogonal(),
            point.normal.cross(point.normal.unitOrthogonal());
        ConeColumns<6, 3> columns;
        columns.first = free[static_cast<std::size_t>(point.block)];
        columns.second = free[static_cast<std::size_t>(point.neighbour)];
        for (int axis = 0; axis < 3; ++axis)
        {
            const Eigen::Vector3d force = axes.col(axis);
            const auto armOf = [&](int block)
            { return Eigen::Vector3d(point.position - masses[static_cast<std::size_t>(block)].centroid); };
            columns.onFirst.col(axis) << -force, -armOf(point.block).cross(force);
            columns.onSecond.col(axis) << force, armOf(point.neighbour).cross(force);
        }
        program.contacts.push_back(columns);
        program.friction.push_back(friction);
    }
    return program;
}

Assembly<3> bondedWall(const std::string& bond, int length, int courses)
{
    return makeStructure<3>(Dictionary::readString(
        fmt::format("dimensions 3;\n"
                    "texture {{ type walls; unit (0.24 0.12 0.08); bond {}; courses {};\n"
                    "    walls {{ wall {{ from (0 0); direction (1 0); length {}; thickness left; }} }} }}\n"
                    "supports {{ ground {{ type ground; }} }}\n",
                    bond, courses, length)));
}

TEST(BondedWalls, AreSolvedInAllDirections)
{
    const std::vector<Assembly<3>> walls{bondedWall("flemish", 6, 10), bondedWall("flemish", 5, 14),
                                         bondedWall("english", 4, 6)};
    for (const Assembly<3>& wall : walls)
    {
        for (int direction = 0; direction < 8; ++direction)
        {
            SCOPED_TRACE(fmt::format("{} blocks, direction {} of 8", wall.blocks.size(), direction));
            const double angle = direction * std::acos(-1.0) / 4;
            const SpaceConeProgram program = programOf(wall, 0.6, {std::cos(angle), std::sin(angle), 0});
            const ConeSolution solution = solveInteriorPoint(program, {.tolerance = 1e-9});
            ASSERT_EQ(solution.status, SolveStatus::optimal);
            EXPECT_LE(certifyOptimal(program, solution).worst(), 1e-9);
            EXPECT_LE(solution.factorisations, 25);
        }
    }
}

} // namespace
} // namespace drystone
