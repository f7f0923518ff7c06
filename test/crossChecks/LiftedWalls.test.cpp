// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Walls of the plane lifted into space, with round friction cones: the plane's answers, by as many
/// factorisations.
#include "Walls.h"

#include "Lifted.h"
#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

void expectThePlanesAnswer(const PlaneConeProgram& plane, double tolerance)
{
    const SpaceConeProgram space = lifted(plane);
    const ConeSolution ofPlane = solveInteriorPoint(plane, {.tolerance = tolerance});
    const ConeSolution ofSpace = solveInteriorPoint(space, {.tolerance = tolerance});
    ASSERT_EQ(ofPlane.status, SolveStatus::optimal);
    ASSERT_EQ(ofSpace.status, SolveStatus::optimal);
    EXPECT_LE(certifyOptimal(space, ofSpace).worst(), tolerance);
    EXPECT_NEAR(ofSpace.multiplier, ofPlane.multiplier, 1e-8);
    EXPECT_LE(ofSpace.factorisations, 1.3 * ofPlane.factorisations);
}

TEST(LiftedWalls, HaveThePlanesMultipliersByAsManyFactorisations)
{
    for (int wall = 1; wall <= 6; ++wall)
    {
        SCOPED_TRACE(wall);
        expectThePlanesAnswer(limitAnalysisOf(paperWall(wall)), 1e-9);
    }
    expectThePlanesAnswer(limitAnalysisOf(squareWall(20)), 1e-8);
}

TEST(LiftedWalls, LikewiseWithStrengths)
{
    for (int wall = 1; wall <= 6; ++wall)
    {
        SCOPED_TRACE(wall);
        PlaneConeProgram plane = limitAnalysisOf(paperWall(wall));
        plane.strength.assign(static_cast<std::size_t>(plane.points()), {30, 10, 3000}); // [N]
        expectThePlanesAnswer(plane, 1e-9);
    }
}

TEST(LiftedWalls, MoveAsInThePlane)
{
    for (int wall = 1; wall <= 6; ++wall)
    {
        SCOPED_TRACE(wall);
        const PlaneConeProgram plane = stepOf(paperWall(wall), 0.8);
        const SpaceConeProgram space = lifted(plane);
        const ConeSolution ofPlane = solveInteriorPoint(plane, {.tolerance = 1e-11});
        const ConeSolution ofSpace = solveInteriorPoint(space, {.tolerance = 1e-11});
        ASSERT_EQ(ofPlane.status, SolveStatus::optimal);
        ASSERT_EQ(ofSpace.status, SolveStatus::optimal);
        const double size = ofPlane.displacement.lpNorm<Eigen::Infinity>();
        for (int body = 0; body < plane.bodies; ++body)
        {
            EXPECT_NEAR(ofSpace.displacement[6 * body], ofPlane.displacement[3 * body], 1e-6 * size);
            EXPECT_NEAR(ofSpace.displacement[6 * body + 1], ofPlane.displacement[3 * body + 1], 1e-6 * size);
            EXPECT_NEAR(ofSpace.displacement[6 * body + 5], ofPlane.displacement[3 * body + 2], 1e-5 * size);
        }
    }
}

} // namespace
} // namespace drystone
