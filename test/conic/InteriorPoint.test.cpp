// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The cone program on problems small enough to solve by hand, and the linear algebra under it.
#include "conic/InteriorPoint.h"
#include "conic/Certificate.h"

#include "Towers.h"

#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

using namespace drystone;

namespace
{

/// One body of unit weight on the ground, standing on two points at x = -1/2 and x = 1/2, its centroid at
/// height h.
PlaneConeProgram standingBlock(double mu, double height)
{
    PlaneConeProgram program;
    program.bodies = 1;
    for (const double x : {-0.5, 0.5})
    {
        ConeColumns<3, 2> columns;
        columns.first = 0;
        // Force (n, t) on the body along (0 1), (1 0) at (x, -height) from the centroid; A carries it with a
        // minus.
        columns.onFirst << 0, -1, -1, 0, -x, -height;
        program.contacts.push_back(columns);
        program.friction.push_back(mu);
    }
    program.load = Eigen::Vector3d(0, -1, 0);
    program.liveLoad = Eigen::Vector3d(1, 0, 0);
    return program;
}

} // namespace

TEST(InteriorPoint, OverturnsASlenderBlockAndSlidesASquatOne)
{
    const ConeSolution slender = solveInteriorPoint(standingBlock(0.65, 1));
    EXPECT_EQ(slender.status, SolveStatus::optimal);
    EXPECT_NEAR(slender.multiplier, 0.5, 1e-9);
    const ConeSolution squat = solveInteriorPoint(standingBlock(0.3, 1));
    EXPECT_NEAR(squat.multiplier, 0.3, 1e-9);
}

TEST(InteriorPoint, SolvesATimeStepOfABlockInTheAir)
{
    PlaneConeProgram program = standingBlock(0.65, 1);
    program.liveLoad.resize(0);
    program.inertia.assign(1, Eigen::Vector3d(1e6, 1e6, 2e5).asDiagonal().toDenseMatrix());
    program.gap = Eigen::Vector4d(0.1, 0, 0.1, 0);
    const ConeSolution falling = solveInteriorPoint(program);
    EXPECT_EQ(falling.status, SolveStatus::optimal);
    EXPECT_NEAR(falling.displacement[1], -1e-6, 1e-14);
    EXPECT_NEAR(falling.contactForce.norm(), 0, 1e-8);
}

TEST(InteriorPoint, HoldsABlockThatLiesOnTheGround)
{
    PlaneConeProgram program = standingBlock(0.65, 1);
    program.liveLoad.resize(0);
    program.load[0] = 0.2;
    program.inertia.assign(1, Eigen::Vector3d(1e6, 1e6, 2e5).asDiagonal().toDenseMatrix());
    const ConeSolution resting = solveInteriorPoint(program);
    EXPECT_EQ(resting.status, SolveStatus::optimal);
    EXPECT_LE(resting.displacement.norm(), 1e-14);
    EXPECT_NEAR(resting.contactForce[0] + resting.contactForce[2], 1, 1e-8);
}

TEST(InteriorPoint, ProvesThatABlockInTheAirCannotBeHeld)
{
    PlaneConeProgram program = standingBlock(0.65, 1);
    program.load[1] = 1; // upwards
    const ConeSolution solution = solveInteriorPoint(program);
    ASSERT_EQ(solution.status, SolveStatus::infeasible);
    EXPECT_GT(program.load.dot(solution.displacement), 0);
}

/// With the push that it carries times `share` as a dead load.
template<class Program>
Program pushedTower(Program program, double share)
{
    program.load += share * solveInteriorPoint(program).multiplier * program.liveLoad;
    program.liveLoad.resize(0);
    return program;
}

template<class Program>
void expectProof(const Program& program, SolveStatus status, int mostFactorisations)
{
    const ConeSolution solution = solveInteriorPoint(program);
    ASSERT_EQ(solution.status, status);
    EXPECT_LE(certify(program, solution).worst(), 1e-9);
    EXPECT_LE(solution.factorisations, mostFactorisations);
}

template<class Program>
void expectProofOfFallByFewFactorisations(const Program& program)
{
    expectProof(program, SolveStatus::infeasible, 40);
}

/// Iterates run off slowly, for the proximal term holds them: until all iterations were used up, of both
/// starts, some 400.
TEST(InteriorPoint, ProvesThatATowerFallsAboutAsSoonAsThatItStands)
{
    for (const double share : {1.001, 1.5, 10.0})
    {
        for (const int boxes : {2, 10, 50})
        {
            SCOPED_TRACE(fmt::format("{} boxes, {} times what they carry", boxes, share));
            expectProofOfFallByFewFactorisations(pushedTower(planeLimitAnalysis(evenTower(boxes)), share));
            expectProofOfFallByFewFactorisations(pushedTower(spaceLimitAnalysis(evenTower(boxes)), share));
        }
    }
}

TEST(InteriorPoint, ProvesThatPressingNeverBreaks)
{
    PlaneConeProgram program = standingBlock(0.65, 1);
    program.liveLoad = Eigen::Vector3d(0, -1, 0);
    const ConeSolution solution = solveInteriorPoint(program);
    ASSERT_EQ(solution.status, SolveStatus::unbounded);
    EXPECT_NEAR(solution.contactForce[0] + solution.contactForce[2], 1, 1e-9);
}

template<class Program>
void expectProofOfNoLimitByFewFactorisations(const Program& program)
{
    expectProof(program, SolveStatus::unbounded, 25);
}

/// That nothing falls was sought before, and each program begun twice: 40 to 60 factorisations.
TEST(InteriorPoint, ProvesThatATowerCarriesAnyWeightAboutAsSoonAsThatItStands)
{
    for (const int boxes : {2, 10, 50})
    {
        SCOPED_TRACE(fmt::format("{} boxes", boxes));
        const auto pressed = [](auto program, double push)
        {
            program.liveLoad = program.load + push * program.liveLoad;
            return program;
        };
        for (const double push : {0.0, 0.2 / boxes})
        {
            expectProofOfNoLimitByFewFactorisations(pressed(planeLimitAnalysis(evenTower(boxes)), push));
            expectProofOfNoLimitByFewFactorisations(pressed(spaceLimitAnalysis(evenTower(boxes)), push));
        }
        // What falls by itself may stand under more weight.
        const auto steadied = [](auto program)
        {
            const auto weight = program.load;
            program = pushedTower(program, 1.5);
            program.liveLoad = weight;
            return program;
        };
        expectProofOfNoLimitByFewFactorisations(steadied(planeLimitAnalysis(evenTower(boxes))));
        expectProofOfNoLimitByFewFactorisations(steadied(spaceLimitAnalysis(evenTower(boxes))));
    }
}

TEST(InteriorPoint, DoesNotTakeForALimitThatItHasNoneWhereSomethingFalls)
{
    PlaneConeProgram program = planeLimitAnalysis(evenTower(3));
    program.liveLoad = program.load; // carried, whatever happens to another body
    program.bodies += 1;
    program.load.conservativeResize(12);
    program.liveLoad.conservativeResize(12);
    program.liveLoad.tail<3>().setZero();
    for (const double weight : {1.0, 1e-3, 1e-6})
    {
        program.load.tail<3>() = Eigen::Vector3d(0, -weight * program.load.lpNorm<Eigen::Infinity>(), 0);
        const ConeSolution solution = solveInteriorPoint(program);
        ASSERT_EQ(solution.status, SolveStatus::infeasible) << weight;
        EXPECT_LT(solution.displacement[10], 0) << weight;
    }
}

TEST(InteriorPoint, NamesABodyThatNothingTouches)
{
    PlaneConeProgram program = standingBlock(0.65, 1);
    program.bodies = 2;
    program.load.conservativeResize(6);
    program.load.tail<3>() = Eigen::Vector3d(0, -1, 0);
    program.liveLoad.conservativeResize(6);
    program.liveLoad.tail<3>() = Eigen::Vector3d(1, 0, 0);
    const ConeSolution solution = solveInteriorPoint(program);
    ASSERT_EQ(solution.status, SolveStatus::infeasible);
    EXPECT_LT(solution.displacement[4], 0); // the second body falls
}

TEST(InteriorPoint, DropsABlockWithoutAnyContact)
{
    PlaneConeProgram program = standingBlock(0.65, 1);
    program.contacts.clear();
    program.friction.clear();
    const ConeSolution solution = solveInteriorPoint(program);
    ASSERT_EQ(solution.status, SolveStatus::infeasible);
    EXPECT_LT(solution.displacement[1], 0);
}

TEST(Certificate, TellsAWrongAnswer)
{
    const PlaneConeProgram program = standingBlock(0.65, 1);
    ConeSolution solution = solveInteriorPoint(program);
    EXPECT_LE(certifyOptimal(program, solution).worst(), 1e-9);
    ConeSolution wrong = solution;
    wrong.multiplier *= 1 + 1e-6;
    EXPECT_GT(certifyOptimal(program, wrong).worst(), 1e-7);
    wrong = solution;
    wrong.contactForce[0] = -1e-3;
    EXPECT_GT(certifyOptimal(program, wrong).primalResidual, 1e-4);
    wrong = solution;
    wrong.displacement *= 1.001;
    EXPECT_GT(certifyOptimal(program, wrong).dualResidual, 1e-4);
    wrong = solution;
    wrong.displacement[0] = std::nan("");
    EXPECT_FALSE(certifyOptimal(program, wrong).worst() <= 1);
}

TEST(Certificate, RefusesRaysThatProveNothing)
{
    PlaneConeProgram program = standingBlock(0.65, 1);
    EXPECT_FALSE(certifyInfeasible<3>(program, Eigen::Vector3d(0, -1, 0)).worst() < 0.5); // into the ground
    EXPECT_FALSE(certifyInfeasible<3>(program, Eigen::Vector3d(0, 1, 0)).worst() < 1);    // against the load
    EXPECT_FALSE(certifyUnbounded<3>(program, Eigen::Vector4d(1, 1, 1, 1)).worst() < 1e-3);
}

TEST(InteriorPoint, BeginsNearTheSolutionOfTheLastStep)
{
    // The next step of a falling tower pushed a little more: the same blocks slide and open.
    const Tower tower = evenTower(20);
    const ConeSolution last = solveInteriorPoint(planeStep(tower, 0.40));
    const PlaneConeProgram program = planeStep(tower, 0.402);
    const ConeSolution cold = solveInteriorPoint(program);
    const ConeSolution warm = solveInteriorPoint(program, {}, nullptr, &last);
    ASSERT_EQ(cold.status, SolveStatus::optimal);
    ASSERT_EQ(warm.status, SolveStatus::optimal);
    EXPECT_LE(certifyOptimal(program, warm).worst(), 1e-9);
    EXPECT_LT(warm.iterations, 0.8 * cold.iterations);
    EXPECT_NEAR((warm.displacement - cold.displacement).lpNorm<Eigen::Infinity>(), 0,
                1e-6 * cold.displacement.lpNorm<Eigen::Infinity>());
}

TEST(InteriorPoint, BeginsFromNothingWhereWhatItIsGivenIsFar)
{
    const PlaneConeProgram program = planeStep(evenTower(20), 0.4);
    const ConeSolution cold = solveInteriorPoint(program);
    ConeSolution far = cold;
    far.displacement *= -1;
    far.contactForce.setConstant(1e3 * cold.contactForce.maxCoeff());
    far.interior = {};
    const ConeSolution solution = solveInteriorPoint(program, {}, nullptr, &far);
    EXPECT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_EQ(solution.iterations, cold.iterations);
    EXPECT_EQ(solution.displacement, cold.displacement);
}

/// What the last step of a falling tower left, its forces of no use.
ConeSolution withInteriorOnly(const ConeSolution& last)
{
    ConeSolution start = last;
    start.contactForce *= 3;
    return start;
}

TEST(InteriorPoint, BeginsFromTheInteriorOfTheLastStep)
{
    const Tower tower = evenTower(20);
    const ConeSolution last = solveInteriorPoint(planeStep(tower, 0.40));
    ASSERT_FALSE(last.interior.isEmpty());
    const PlaneConeProgram program = planeStep(tower, 0.402);
    for (int point = 0; point < program.points(); ++point)
    {
        const Eigen::Vector2d force = last.interior.contactForce.segment<2>(2 * point);
        const Eigen::Vector2d opening = last.interior.opening.segment<2>(2 * point);
        EXPECT_GT(program.friction[point] * force[0], std::abs(force[1]));
        EXPECT_GT(opening[0], program.friction[point] * std::abs(opening[1]));
    }
    const ConeSolution cold = solveInteriorPoint(program);
    const ConeSolution start = withInteriorOnly(last);
    ASSERT_GT(certifyOptimal(program, start).worst(), 0.1);
    const ConeSolution warm = solveInteriorPoint(program, {}, nullptr, &start);
    ASSERT_EQ(warm.status, SolveStatus::optimal);
    EXPECT_LE(certifyOptimal(program, warm).worst(), 1e-9);
    EXPECT_LT(warm.iterations, 0.8 * cold.iterations);
    EXPECT_NEAR((warm.displacement - cold.displacement).lpNorm<Eigen::Infinity>(), 0,
                1e-6 * cold.displacement.lpNorm<Eigen::Infinity>());
    EXPECT_FALSE(warm.interior.isEmpty());
}

TEST(InteriorPoint, BeginsFromAnInteriorThatKnowsNothingOfSomePoints)
{
    const Tower tower = evenTower(20);
    ConeSolution start = withInteriorOnly(solveInteriorPoint(planeStep(tower, 0.40)));
    for (Eigen::Index point = 0; 2 * point < start.contactForce.size(); point += 7)
    {
        start.interior.contactForce.segment<2>(2 * point).setZero();
        start.interior.opening.segment<2>(2 * point).setZero();
    }
    const PlaneConeProgram program = planeStep(tower, 0.402);
    const ConeSolution cold = solveInteriorPoint(program);
    const ConeSolution warm = solveInteriorPoint(program, {}, nullptr, &start);
    ASSERT_EQ(warm.status, SolveStatus::optimal);
    EXPECT_LE(certifyOptimal(program, warm).worst(), 1e-9);
    EXPECT_LE(warm.iterations, cold.iterations);
}

TEST(InteriorPoint, BeginsFromNothingWhereTheInteriorIsOfAnotherProgram)
{
    const PlaneConeProgram program = planeStep(evenTower(20), 0.402);
    const ConeSolution cold = solveInteriorPoint(program);
    const ConeSolution last = withInteriorOnly(solveInteriorPoint(planeStep(evenTower(20), 0.40)));
    ConeSolution start = last;
    start.interior.contactForce *= -1; // none inside
    EXPECT_EQ(solveInteriorPoint(program, {}, nullptr, &start).displacement, cold.displacement);
    start.interior = last.interior;
    start.interior.opening *= 1e6; // of much longer steps
    EXPECT_EQ(solveInteriorPoint(program, {}, nullptr, &start).displacement, cold.displacement);
    start.interior.opening.setConstant(std::nan(""));
    EXPECT_EQ(solveInteriorPoint(program, {}, nullptr, &start).displacement, cold.displacement);
    start.interior = solveInteriorPoint(planeStep(evenTower(5), 0.40)).interior; // of other points
    EXPECT_EQ(solveInteriorPoint(program, {}, nullptr, &start).displacement, cold.displacement);
}

TEST(InteriorPoint, BeginsNearASolutionOfStepsOnly)
{
    const PlaneConeProgram program = standingBlock(0.65, 1);
    const ConeSolution solution = solveInteriorPoint(program);
    EXPECT_THROW(solveInteriorPoint(program, {}, nullptr, &solution), std::invalid_argument);
}

TEST(InteriorPoint, NeedsOppositeForcesOnTheTwoBodiesOfAContact)
{
    PlaneConeProgram program = planeStep(evenTower(2), 0.4);
    program.contacts.back().onSecond *= 1.01;
    EXPECT_THROW(solveInteriorPoint(program), std::invalid_argument);
}
