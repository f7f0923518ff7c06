// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The last column of the paper's table 1: contact by surfaces, with the stress resultants N, T, M of each
/// joint about its middle and |T| <= mu N, |M| <= N l/2. The edges of that pyramid are the forces (1, +-mu)
/// at the two ends, so the programs have the same multiplier; here that is proved for each wall by a primal
/// and a dual solution of the program in resultants, built from the joints and not from the points.
#include "Structures.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace drystone;

namespace
{

/// Rows of a generalised force (N, T, M) of unit size on a block whose centroid is at `arm` from the joint's
/// middle, reversed for the neighbour.
Eigen::Matrix3d columnsOn(const Vector<2>& arm, const Vector<2>& normal, const Vector<2>& along)
{
    Eigen::Matrix3d columns;
    columns.col(0) << normal, cross(arm, normal);
    columns.col(1) << along, cross(arm, along);
    columns.col(2) << 0, 0, cross(along, normal); // pressure that lies further along the tangent
    return columns;
}

} // namespace

TEST(SurfaceContact, HasTheMultipliersOfPointContactOnTheSixWalls)
{
    constexpr double mu = 0.65;
    const double paper[] = {0.643, 0.580, 0.404, 0.332, 0.240, 0.348};
    const std::vector<Wall> walls = paperWalls();
    for (std::size_t wall = 0; wall < walls.size(); ++wall)
    {
        const WeighedStructure structure = standing(walls[wall].bond);
        const LoadVectors loads = structure.weightLoads();
        const PlaneConeProgram program = structure.program(mu, loads);
        const ConeSolution solution = solveInteriorPoint(program);
        ASSERT_EQ(solution.status, SolveStatus::optimal);
        const std::vector<int> free = freeIndices(structure.assembly);
        const double largestRate = solution.displacement.lpNorm<Eigen::Infinity>();
        const double largestForce = solution.contactForce.lpNorm<Eigen::Infinity>();

        Eigen::VectorXd unbalanced = loads.dead + solution.multiplier * loads.live;
        double outside = 0; // of the pyramid
        double against = 0; // of its dual cone: opening >= mu |slip| + |rotation| l/2
        for (std::size_t i = 0; i + 1 < structure.points.size(); i += 2)
        {
            const ContactPoint<2>& from = structure.points[i];
            const ContactPoint<2>& to = structure.points[i + 1];
            ASSERT_EQ(from.joint, to.joint);
            const Vector<2> middle = (from.position + to.position) / 2;
            const Vector<2> along = tangent(from);
            const double half = (to.position - from.position).norm() / 2;
            const auto force = solution.contactForce.segment<4>(2 * static_cast<Eigen::Index>(i));
            const double lever = along.dot(to.position - middle);
            const Eigen::Vector3d resultant(force[0] + force[2], force[1] + force[3],
                                            lever * (force[2] - force[0]));
            outside = std::max({outside, -resultant[0], std::abs(resultant[1]) - mu * resultant[0],
                                std::abs(resultant[2]) - half * resultant[0]});
            Eigen::Vector3d rate = Eigen::Vector3d::Zero(); // opening, slip, rotation
            for (const auto& [block, sign] : {std::pair(from.block, 1.0), std::pair(from.neighbour, -1.0)})
            {
                if (free[block] < 0)
                {
                    continue;
                }
                const Eigen::Matrix3d columns =
                    sign * columnsOn(middle - structure.masses[block].centroid, from.normal, along);
                unbalanced.segment<3>(3 * free[block]) += columns * resultant;
                rate += columns.transpose() * solution.displacement.segment<3>(3 * free[block]);
            }
            against = std::max(against, mu * std::abs(rate[1]) + half * std::abs(rate[2]) - rate[0]);
        }
        EXPECT_LE(unbalanced.lpNorm<Eigen::Infinity>(), 1e-8 * largestForce);
        EXPECT_LE(outside, 1e-8 * largestForce);
        EXPECT_LE(against, 1e-8 * largestRate);
        // Equal objectives of a feasible pair: alpha = -fD'y with fL'y = 1.
        EXPECT_NEAR(loads.live.dot(solution.displacement), 1, 1e-8);
        EXPECT_NEAR(-loads.dead.dot(solution.displacement), solution.multiplier, 1e-8);
        EXPECT_NEAR(solution.multiplier, paper[wall], 5e-4);
    }
}
