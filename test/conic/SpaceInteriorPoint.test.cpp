// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Programs of space, with round friction cones, against closed forms and against the plane.
#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"
#include "conic/cones/ConeProduct.h"

#include "Towers.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace drystone
{
namespace
{

Eigen::Vector2d along(double angle)
{
    return {std::cos(angle), std::sin(angle)};
}

/// A tower of boxes of random sizes and places, each with its mass centre over the face it stands on.
Tower randomTower(int boxes, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    Tower tower;
    tower.mu = 0.2 + 0.6 * uniform(random);
    tower.push = along(2 * std::numbers::pi * uniform(random));
    double height = 0;
    for (int box = 0; box < boxes; ++box)
    {
        Tower::Box next;
        next.halfSize = {0.5 + uniform(random), 0.5 + uniform(random), 0.1 + 0.2 * uniform(random)};
        height += next.halfSize.z();
        next.centre = {0.2 * uniform(random), 0.2 * uniform(random), height};
        height += next.halfSize.z();
        next.mass = 8 * next.halfSize.prod() * 2000;
        tower.boxes.push_back(next);
    }
    return tower;
}

void expectMultiplier(const Tower& tower, double tolerance = 1e-9)
{
    const SpaceConeProgram program = spaceLimitAnalysis(tower);
    const double alpha = towerMultiplier(tower, 3);
    const ConeSolution solution = solveInteriorPoint(program, {.tolerance = tolerance});
    ASSERT_EQ(solution.status, SolveStatus::optimal)
        << "certificate " << certifyOptimal(program, solution).worst() << " after " << solution.iterations;
    EXPECT_NEAR(solution.multiplier, alpha, 3 * tolerance * std::max(1.0, alpha));
}

TEST(SecondOrderCone, ScalingTakesOpeningsToForces)
{
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 2000; ++trial)
    {
        const double depth = std::pow(10.0, -(trial % 9));
        Eigen::Vector3d s(0, normal(random), normal(random));
        Eigen::Vector3d z(0, normal(random), normal(random));
        s[0] = s.norm() * (1 + depth);
        z[0] = z.norm() * (1 + depth);
        const NesterovToddScaling<double> W = nesterovToddScaling(s, z);
        EXPECT_LE((W.W.apply(W.W.apply(z)) - s).norm(), 1e-13 / depth * s.norm());
        EXPECT_LE((W.squared(0).apply(z) - s).norm(), 1e-13 / depth * s.norm());
        EXPECT_LE((W.inverse.apply(s) - W.lambda).norm(), 1e-13 / depth * W.lambda.norm());
        EXPECT_LE((W.inverse.apply(W.W.apply(z)) - z).norm(), 1e-13 / depth * z.norm());
        EXPECT_NEAR(s.dot(z), W.lambda.squaredNorm(), 1e-13 / depth * s.dot(z));
        EXPECT_LE((jordanProduct(s, jordanDivide(s, determinant(s), z)) - z).norm(),
                  1e-13 / depth * z.norm());
    }
}

/// A number of one that FourDoubles.h takes together, in the pack of a round cone.
template<class Number>
double ofRound(const Number& numbers, Eigen::Index round)
{
    return oneOf(numbers, static_cast<int>(round % countOf<Number>));
}

TEST(ConeProduct, RoundConesTakenFourAtATimeAreThoseTakenOneByOne)
{
    std::mt19937 random(6);
    std::normal_distribution<double> normal;
    for (Eigen::Index rounds = 1; rounds <= 11; ++rounds)
    {
        const ConeRanges cones{rounds % 3, rounds};
        const auto vectors = [&](double depth)
        {
            Eigen::VectorXd x = unitOf<double>(cones);
            for (Eigen::Index round = 0; round < rounds; ++round)
            {
                Eigen::Vector3d part(0, normal(random), normal(random));
                part.tail<2>() *= round == 3 ? 0 : 1; // one along its axis
                part[0] = part.norm() * (1 + depth) + (round == 3 ? 1 : 0);
                x.segment<3>(cones.at(round)) = part;
            }
            return x;
        };
        const Eigen::VectorXd s = vectors(1e-6);
        const Eigen::VectorXd z = vectors(0.5);
        const Eigen::VectorXd ds = vectors(-2);
        const Eigen::VectorXd dz = vectors(-0.9);
        ConeScaling<double> scaling;
        ASSERT_TRUE(scaling.update(cones, s, z, 1e-9));
        ScaledStep<double> scaled;
        scaling.scale(cones, ds, dz, scaled);
        Eigen::VectorXd weighted = ds;
        scaling.weights.apply(weighted);
        Eigen::VectorXd added = z;
        scaling.weights.addApplied(ds, added);
        double steepest = cones.rays > 0 ? -1 : 0; // of rays from 1 by 1
        double smallest = cones.rays > 0 ? 1 : std::numeric_limits<double>::infinity();
        for (Eigen::Index round = 0; round < rounds; ++round)
        {
            const Eigen::Index at = cones.at(round);
            const auto pack = static_cast<std::size_t>(round / countOf<FourDoubles>);
            const ConeVector<double> force = s.segment<3>(at);
            const ConeVector<double> opening = z.segment<3>(at);
            const NesterovToddScaling<double> alone = nesterovToddScaling(force, opening);
            const ConeVector<double> step = alone.inverse.apply(ds.segment<3>(at));
            const FramedMatrix<double> D = alone.squared(1e-9);
            const auto i = static_cast<std::size_t>(round);
            for (int axis = 0; axis < 3; ++axis)
            {
                EXPECT_EQ(ofRound(scaling.rounds[pack].lambda[axis], round), alone.lambda[axis]);
                EXPECT_EQ(ofRound(scaled.forces[pack][axis], round), step[axis]);
                EXPECT_EQ(scaling.weights.rounds[i].eigenvalues[axis], D.eigenvalues[axis]);
            }
            EXPECT_EQ(weighted.segment<3>(at), D.apply(ds.segment<3>(at)));
            EXPECT_EQ(added.segment<3>(at), opening + D.apply(ds.segment<3>(at)));
            steepest =
                std::max(steepest, steepness(coneFrameOf(alone.lambda, alone.determinant), step).steepest());
            smallest = std::min(smallest, smallerEigenvalue(force));
        }
        EXPECT_EQ(steepestOf(cones, unitOf<double>(cones), ds, scaling.frames, scaled.forces), steepest);
        EXPECT_EQ(smallestEigenvalue(cones, s), smallest);
    }
}

TEST(SecondOrderCone, TheLongestStepEndsOnTheSurface)
{
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 2000; ++trial)
    {
        Eigen::Vector3d x(0, normal(random), normal(random));
        x[0] = x.norm() + std::abs(normal(random));
        const Eigen::Vector3d dx = 3 * Eigen::Vector3d(normal(random), normal(random), normal(random));
        const double steepest = steepness(coneFrameOf(x, determinant(x)), dx).steepest();
        const double step = steepest > 1 ? 1 / steepest : 1;
        const Eigen::Vector3d end = x + step * dx;
        EXPECT_GE(smallerEigenvalue(end), -1e-13 * x.norm());
        if (step < 1)
        {
            EXPECT_NEAR(smallerEigenvalue(end), 0, 1e-12 * (x.norm() + dx.norm()));
        }
    }
}

TEST(SecondOrderCone, ProjectionIsNearestAndItsDerivativeIsOne)
{
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 2000; ++trial)
    {
        const Eigen::Vector3d x(normal(random), normal(random), normal(random));
        const ConeProjection projection = projectOntoCone(x);
        const Eigen::Vector3d rest = projection.point - x; // in the dual cone, at right angles to the point
        EXPECT_GE(smallerEigenvalue(projection.point), -1e-15);
        EXPECT_GE(smallerEigenvalue(rest), -1e-14);
        EXPECT_NEAR(rest.dot(projection.point), 0, 1e-14 * x.squaredNorm());
        const Eigen::Vector3d dx = 1e-6 * Eigen::Vector3d(normal(random), normal(random), normal(random));
        const double gap = std::abs(std::abs(x[0]) - x.tail<2>().norm());
        if (gap > 1e-2 && x.tail<2>().norm() > 1e-2)
        {
            const Eigen::Vector3d change = projectOntoCone(x + dx).point - projection.point;
            EXPECT_LE((change - projection.derivative.apply(dx)).norm(), 1e-8);
        }
    }
}

TEST(SpaceInteriorPoint, ABoxPushedInAnyDirectionSlidesAtMu)
{
    for (int direction = 0; direction < 12; ++direction)
    {
        Tower tower = evenTower(1, 1, 0.3);
        tower.push = along(0.1 + 0.5 * direction);
        expectMultiplier(tower);
        EXPECT_DOUBLE_EQ(towerMultiplier(tower, 3), 0.3);
    }
}

TEST(SpaceInteriorPoint, ABoxTipsAboutTheEdgeThatItsPushMeetsFirst)
{
    for (int direction = 0; direction < 12; ++direction)
    {
        Tower tower = evenTower(1, 1, 3);
        tower.boxes[0].halfSize = {0.5, 0.3, 1};
        tower.boxes[0].centre.z() = 1;
        tower.push = along(0.1 + 0.5 * direction);
        expectMultiplier(tower);
        const double expected = std::min(0.5 / std::abs(tower.push.x()), 0.3 / std::abs(tower.push.y()));
        EXPECT_NEAR(towerMultiplier(tower, 3), expected, 1e-14);
    }
}

TEST(SpaceInteriorPoint, TheMechanismOfATippingBoxTurnsItAboutTheEdge)
{
    Tower tower = evenTower(1, 1, 3);
    tower.boxes[0].halfSize = {0.5, 0.3, 1};
    tower.boxes[0].centre.z() = 1;
    tower.push = along(1.2);
    const ConeSolution solution = solveInteriorPoint(spaceLimitAnalysis(tower));
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    // About the edge y = 0.3, z = 0: velocity of the centre w x (0, -0.3, 1), w along -x.
    const Eigen::VectorXd& y = solution.displacement;
    const double w = y[3];
    EXPECT_LT(w, 0);
    EXPECT_NEAR(y[0], 0, 1e-7 * std::abs(w));
    EXPECT_NEAR(y[1], -w, 1e-6 * std::abs(w));
    EXPECT_NEAR(y[2], -0.3 * w, 1e-6 * std::abs(w));
    EXPECT_NEAR(y[4], 0, 1e-6 * std::abs(w));
}

TEST(SpaceInteriorPoint, StacksAndRandomTowersMeetTheirClosedForms)
{
    for (const int boxes : {2, 5, 20})
    {
        Tower tower = evenTower(boxes, 1, 0.65);
        tower.push = along(0.4);
        expectMultiplier(tower);
    }
    for (unsigned seed = 1; seed <= 40; ++seed)
    {
        SCOPED_TRACE(seed);
        expectMultiplier(randomTower(2 + static_cast<int>(seed % 9), seed));
    }
}

TEST(SpaceInteriorPoint, RedundantPointsChangeNothing)
{
    for (const int points : {2, 5, 76}) // 4, 16, 300 a face
    {
        Tower tower = evenTower(3, 1, 0.65, points);
        tower.push = along(0.7);
        expectMultiplier(tower);
    }
}

TEST(SpaceInteriorPoint, WithoutFrictionNothingCanBePushed)
{
    for (const double mu : {0.0, 1e-12})
    {
        const SpaceConeProgram program = spaceLimitAnalysis(evenTower(2, 1, mu));
        const ConeSolution solution = solveInteriorPoint(program);
        ASSERT_EQ(solution.status, SolveStatus::optimal) << mu;
        EXPECT_NEAR(solution.multiplier, mu, 1e-11);
    }
}

TEST(SpaceInteriorPoint, UnitsChangeNothing)
{
    Tower tower = evenTower(4, 1, 0.65);
    tower.push = along(0.7);
    for (const double unit : {1e-6, 1.0, 1e6})
    {
        SpaceConeProgram program = spaceLimitAnalysis(tower);
        program.load *= unit;
        program.liveLoad *= unit;
        const ConeSolution solution = solveInteriorPoint(program);
        ASSERT_EQ(solution.status, SolveStatus::optimal) << unit;
        EXPECT_NEAR(solution.multiplier, towerMultiplier(tower, 3), 1e-8) << unit;
    }
}

TEST(SpaceInteriorPoint, ProvesThatAnOverhangFallsWhateverThePush)
{
    Tower tower = evenTower(2);
    tower.boxes[1].centre.y() = 0.6; // its weight beside the box below; pushed along x
    const SpaceConeProgram program = spaceLimitAnalysis(tower);
    const ConeSolution solution = solveInteriorPoint(program);
    ASSERT_EQ(solution.status, SolveStatus::infeasible);
    EXPECT_GT(program.load.dot(solution.displacement), 0);
    EXPECT_LE(certify(program, solution).worst(), 1e-9);
}

TEST(SpaceInteriorPoint, ProvesThatPressingNeverBreaks)
{
    SpaceConeProgram program = spaceLimitAnalysis(evenTower(3));
    program.liveLoad = program.load;
    const ConeSolution solution = solveInteriorPoint(program);
    ASSERT_EQ(solution.status, SolveStatus::unbounded);
    EXPECT_LE(certify(program, solution).worst(), 1e-9);
}

TEST(SpaceInteriorPoint, NamesABodyThatNothingTouches)
{
    SpaceConeProgram program = spaceLimitAnalysis(evenTower(1));
    program.bodies = 2;
    program.load.conservativeResize(12);
    program.liveLoad.conservativeResize(12);
    program.load.tail<6>() = program.load.head<6>().eval();
    program.liveLoad.tail<6>() = program.liveLoad.head<6>().eval();
    const ConeSolution solution = solveInteriorPoint(program);
    ASSERT_EQ(solution.status, SolveStatus::infeasible);
    EXPECT_LT(solution.displacement[8], 0);
}

TEST(SpaceInteriorPoint, AStepOfATowerPushedAlongXIsThatOfThePlane)
{
    for (const double alpha : {0.1, 0.5, 0.9})
    {
        // A slender tower rocks, and slides from 0.65 on: as the plane has it, with half the forces a point.
        const Tower tower = evenTower(3, 1, 0.65);
        const ConeSolution plane = solveInteriorPoint(planeStep(tower, alpha), {.tolerance = 1e-10});
        const SpaceConeProgram program = spaceStep(tower, alpha);
        const ConeSolution space = solveInteriorPoint(program, {.tolerance = 1e-10});
        ASSERT_EQ(plane.status, SolveStatus::optimal);
        ASSERT_EQ(space.status, SolveStatus::optimal) << certifyOptimal(program, space).worst();
        const double scale = 9.81 * 0.002 * 0.002;
        for (int body = 0; body < program.bodies; ++body)
        {
            const Eigen::Vector3d inPlane = plane.displacement.segment<3>(3 * body);
            const Eigen::Matrix<double, 6, 1> inSpace = space.displacement.segment<6>(6 * body);
            EXPECT_NEAR(inSpace[0], inPlane[0], 1e-4 * scale) << alpha;
            EXPECT_NEAR(inSpace[1], 0, 1e-4 * scale);
            EXPECT_NEAR(inSpace[2], inPlane[1], 1e-4 * scale);
            EXPECT_NEAR(inSpace[4], -inPlane[2], 1e-4 * scale); // about -y, as x and z have it
        }
    }
}

TEST(SpaceInteriorPoint, ATurnedStepHasATurnedSolution)
{
    Tower tower = evenTower(3, 1, 0.4);
    const SpaceConeProgram straight = spaceStep(tower, 0.6);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const auto turned = [&turn](const Eigen::VectorXd& vector)
    {
        Eigen::VectorXd result = vector;
        for (Eigen::Index row = 0; row < vector.size(); row += 3)
        {
            result.segment<3>(row) = turn * vector.segment<3>(row);
        }
        return result;
    };
    SpaceConeProgram oblique = straight;
    oblique.load = turned(straight.load);
    for (auto& columns : oblique.contacts)
    {
        for (int column = 0; column < 3; ++column)
        {
            columns.onFirst.col(column) = turned(columns.onFirst.col(column));
            columns.onSecond.col(column) = turned(columns.onSecond.col(column));
        }
    }
    for (auto& inertia : oblique.inertia)
    {
        inertia.topLeftCorner<3, 3>() = turn * inertia.topLeftCorner<3, 3>() * turn.transpose();
        inertia.bottomRightCorner<3, 3>() = turn * inertia.bottomRightCorner<3, 3>() * turn.transpose();
    }
    const ConeSolution one = solveInteriorPoint(straight, {.tolerance = 1e-10});
    const ConeSolution other = solveInteriorPoint(oblique, {.tolerance = 1e-10});
    ASSERT_EQ(one.status, SolveStatus::optimal);
    ASSERT_EQ(other.status, SolveStatus::optimal);
    EXPECT_LT((turned(one.displacement) - other.displacement).norm(), 1e-4 * one.displacement.norm());
    EXPECT_GT(one.displacement.norm(), 1e-6);
}

TEST(SpaceInteriorPoint, ABoxThatRocksTurnsAsItsEquationSays)
{
    // Pushed just beyond tipping the box turns about its edge: with J about the edge, J phi = dt^2 m (alpha g
    // h
    // - g b).
    Tower tower = evenTower(1, 1, 3);
    tower.boxes[0].halfSize = {0.25, 0.5, 1};
    tower.boxes[0].centre.z() = 1;
    const double alpha = 0.4;
    const ConeSolution solution = solveInteriorPoint(spaceStep(tower, alpha), {.tolerance = 1e-11});
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    const double radiusSquared = 1 + 0.25 * 0.25;
    const double turn = 0.002 * 0.002 * 9.81 * (alpha - 0.25) / (radiusSquared / 3 + radiusSquared);
    EXPECT_NEAR(solution.displacement[4], turn, 1e-5 * turn);
    EXPECT_NEAR(solution.displacement[0], turn, 1e-5 * turn);
    EXPECT_NEAR(solution.displacement[2], 0.25 * turn, 1e-5 * turn);
}

TEST(SpaceInteriorPoint, ABoxInTheAirFalls)
{
    SpaceConeProgram program = spaceStep(evenTower(1), 0.2);
    for (int point = 0; point < 4; ++point)
    {
        program.gap[3 * point] = 0.1;
    }
    const ConeSolution solution = solveInteriorPoint(program, {.tolerance = 1e-9});
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_NEAR(solution.displacement[2], -9.81 * 0.002 * 0.002, 1e-13);
    EXPECT_NEAR(solution.displacement[0], 0.2 * 9.81 * 0.002 * 0.002, 1e-13);
}

TEST(SpaceInteriorPoint, SaysSoWhenTheIterationsAreTooFew)
{
    const ConeSolution solution = solveInteriorPoint(spaceStep(evenTower(3), 0.5), {.maximumIterations = 2});
    EXPECT_EQ(solution.status, SolveStatus::notConverged);
}

} // namespace
} // namespace drystone
