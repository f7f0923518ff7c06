// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis against published and closed-form multipliers; each answer's certificate is computed by
/// conic/Certificate.h from the problem data, not by the solver.
#include "Structures.h"
#include "conic/Certificate.h"
#include "conic/UpperBounds.h"
#include "conic/form/Form.h"
#include "contact/PointAreas.h"
#include "core/Threads.h"
#include "statics/CrushingHinges.h"
#include "texture/Arch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

using namespace drystone;

namespace
{

void expectCertified(const LimitAnalysis& result)
{
    EXPECT_LE(result.certificate.primalResidual, 1e-9);
    EXPECT_LE(result.certificate.dualResidual, 1e-9);
    EXPECT_LE(result.certificate.dualityGap, 1e-9);
}

/// A running-bond wall as many courses high as it is units long.
PlaneConeProgram squareWall(int size, double mu)
{
    RunningBond bond;
    bond.unit = {0.4, 0.175};
    bond.length = size;
    bond.courses = size;
    bond.firstCourse = FirstCourse::full;
    const WeighedStructure structure = standing(bond);
    return structure.program(mu, structure.weightLoads());
}

double multiplierOf(const PlaneConeProgram& program)
{
    const LimitAnalysis result = solveLimitAnalysis(program);
    EXPECT_EQ(result.status, CollapseStatus::optimal);
    expectCertified(result);
    return result.alpha;
}

/// Mass centres of voussoirs: of the straight-edged outlines, or moved to those of annular sectors of the
/// same radii. A sector's centre lies at (2/3) (Ro^3 - Ri^3) / (Ro^2 - Ri^2) sin(h)/h from the arch's centre,
/// h half the angle of a voussoir; a trapezoid's at cos(h) in place of sin(h)/h. The published threshold
/// without sliding is for trapezoids, the figures with friction, tilting and point load are for sectors:
/// trapezoids miss them by 2 to 6e-4.
enum class Voussoirs
{
    trapezoids,
    sectors
};

WeighedStructure archStructure(const Arch& arch, Voussoirs voussoirs)
{
    WeighedStructure structure(makeAssembly(arch));
    const double half = std::numbers::pi / 2 / arch.voussoirs;
    for (std::size_t block = 0; block < structure.masses.size(); ++block)
    {
        if (voussoirs == Voussoirs::sectors && structure.assembly.blocks[block].support < 0)
        {
            structure.masses[block].centroid *= std::tan(half) / half;
        }
    }
    return structure;
}

double archMultiplier(double thickness, double mu, Voussoirs voussoirs)
{
    const Vector<2> down(0, -1);
    Arch arch;
    arch.thickness = thickness;
    const WeighedStructure structure = archStructure(arch, voussoirs);
    const LoadVectors loads{gravityLoad(structure.assembly, structure.weights, down),
                            inertialLoad(structure.assembly, structure.weights, {0, -1}, {1, 0})};
    const LimitAnalysis result = solveLimitAnalysis(structure.program(mu, loads));
    return result.status == CollapseStatus::optimal ? result.alpha : -1;
}

/// Least thickness/radius at which the 27-voussoir arch stands under its own weight, to 2e-5:
/// nearer the limit the program is ill-posed and the solver says that it did not converge.
double leastArchThickness(double mu, Voussoirs voussoirs)
{
    double falls = 0.08;
    double stands = 0.25;
    while (stands - falls > 2e-5)
    {
        const double middle = (falls + stands) / 2;
        (archMultiplier(middle, mu, voussoirs) >= 0 ? stands : falls) = middle;
    }
    return stands;
}

} // namespace

TEST(LimitAnalysis, GivesTheMultipliersAndCountsOfThePaperForItsSixWalls)
{
    for (const Wall& wall : paperWalls())
    {
        const WeighedStructure structure = standing(wall.bond);
        EXPECT_EQ(structure.freeBlocks(), wall.blocks);
        EXPECT_EQ(static_cast<int>(structure.points.size()), wall.points);
        EXPECT_NEAR(multiplierOf(structure.program(0.65, structure.weightLoads())), wall.alpha, 1e-6);
    }
}

TEST(LimitAnalysis, ProvesTheDeadLoadCarriedForLittle)
{
    // Work, not time: where the solver has not come by forces that carry it alone, they are found in a few
    // iterations of their own.
    int alone = 0;
    for (const Wall& wall : paperWalls())
    {
        const WeighedStructure structure = standing(wall.bond);
        const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
        const ConeSolution solution = solveInteriorPoint(program, {.tolerance = 1e-9});
        EXPECT_LE(solution.iterations, 17);
        const int further = solveLimitAnalysis(program, {.tolerance = 1e-9}).iterations - solution.iterations;
        EXPECT_LE(further, 4);
        alone += further == 0;
    }
    EXPECT_GE(alone, 4); // of six
}

TEST(LimitAnalysis, IsTheSameForAMirroredWallPushedTheOtherWay)
{
    for (const Wall& wall : paperWalls())
    {
        const WeighedStructure structure = standing(wall.bond);
        const WeighedStructure mirror(mirrored(structure.assembly));
        LoadVectors loads = mirror.weightLoads();
        for (int block = 0; block < mirror.freeBlocks(); ++block)
        {
            loads.live[3 * block] *= -1;
        }
        EXPECT_NEAR(multiplierOf(mirror.program(0.65, loads)),
                    multiplierOf(structure.program(0.65, structure.weightLoads())), 1e-9);
    }
}

TEST(LimitAnalysis, DoesNotDependOnTheUnitOfLoads)
{
    for (const Wall& wall : paperWalls())
    {
        const WeighedStructure structure = standing(wall.bond);
        const double reference = multiplierOf(structure.program(0.65, structure.weightLoads()));
        for (const double unit : {1e-6, 1e-3, 1e3, 1e6})
        {
            EXPECT_NEAR(multiplierOf(structure.program(0.65, structure.weightLoads(unit))) / reference, 1,
                        1e-9)
                << "loads times " << unit;
        }
    }
}

TEST(LimitAnalysis, OfAMonolithIsTheLesserOfFrictionAndSlenderness)
{
    for (const double mu : {0.1, 0.24, 0.26, 0.65, 3.0})
    {
        Assembly<2> assembly;
        assembly.supports = {{"ground", "ground"}};
        assembly.blocks = {rectangle(0, 0, 0.5, 2), rectangle(-1, -1, 2, 0, 0)};
        const WeighedStructure structure(std::move(assembly));
        EXPECT_NEAR(multiplierOf(structure.program(mu, structure.weightLoads())), std::min(mu, 0.25), 1e-9);
    }
}

TEST(LimitAnalysis, OfAMonolithWhoseToeCrushesConvergesWithThePointsOfTheJoint)
{
    // alpha = (b - W/(2 s t))/h with b = 0.25, h = 1, W = 1000, t = 1; the error is at most s t d2/(8 W h), d
    // the distance of the points.
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {rectangle(0, 0, 0.5, 2), rectangle(-1, -1, 2, 0, 0)};
    WeighedStructure structure(std::move(assembly));
    const std::vector<ContactPoint<2>> ends = structure.points;
    for (const double strength : {3e3, 1e4, 1e5, 1e9})
    {
        for (const int count : {2, 5, 11, 41, 161, 641})
        {
            structure.points = divideJoints(ends, count);
            const std::vector<double> areas = pointAreas(structure.assembly, structure.points);
            PlaneConeProgram program = structure.program(3, structure.weightLoads());
            for (const double area : areas)
            {
                program.strength.push_back({.crushing = strength * area});
            }
            const double distance = 0.5 / (count - 1);
            const double bound = std::min(strength * distance * distance / 8000, 0.25);
            EXPECT_NEAR(multiplierOf(program), 0.25 - 1000 / (2 * strength), bound + 1e-9) << count;
        }
    }
}

TEST(LimitAnalysis, OfAMonolithWhoseToeCrushesIsExactWithAPointWhereTheHingeIs)
{
    // With the tension T l t as well: W alpha h = P (l - u)/2, P = W + T, u = l P/(S + T).
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {rectangle(0, 0, 0.5, 2), rectangle(-1, -1, 2, 0, 0)};
    WeighedStructure structure(std::move(assembly));
    const std::vector<ContactPoint<2>> ends = structure.points;
    for (const double tension : {0.0, 400.0})
    {
        for (const double strength : {2.5e3, 1e4, 1e5, 1e7, 1e9})
        {
            JointPoints<2> joints{ends, {3, 3}, {}};
            joints.strength.assign(2, {3 * tension / 2, tension / 2, strength * 0.5 / 2});
            const double resultant = 1000 + tension;
            const double depth = 0.5 * resultant / (strength * 0.5 + tension);
            const double exact = resultant * (0.5 - depth) / 2 / 1000;
            double alpha = 0;
            int rounds = 0;
            for (bool isAdded = true; isAdded && rounds < 30; ++rounds)
            {
                structure.points = joints.points;
                PlaneConeProgram program = structure.program(3, structure.weightLoads());
                program.strength = joints.strength;
                const LimitAnalysis result = solveLimitAnalysis(program);
                ASSERT_EQ(result.status, CollapseStatus::optimal);
                EXPECT_GE(result.alpha, exact - 1e-8) << "never too low";
                alpha = result.alpha;
                isAdded = addCrushingHinges(joints, {result.contactForce}, 1e-9);
            }
            EXPECT_NEAR(alpha, exact, 1e-7) << strength << ' ' << tension << ' ' << rounds;
            EXPECT_LE(rounds, 4);
            EXPECT_LE(joints.points.size(), 6U);
        }
    }
}

TEST(CrushingHinges, LeaveJointsThatBearAnyPressureAsTheyAre)
{
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {rectangle(0, 0, 0.5, 2), rectangle(-1, -1, 2, 0, 0)};
    const WeighedStructure structure(std::move(assembly));
    JointPoints<2> joints{structure.points, {3, 3}, {Strength{1, 0}, Strength{1, 0}}};
    Eigen::VectorXd atOneEnd(4);
    atOneEnd << 1000, 0, 0, 0;
    EXPECT_FALSE(addCrushingHinges(joints, {atOneEnd}, 1e-9));
    EXPECT_EQ(joints.points.size(), 2U);
    // A joint without a force has no hinge either.
    joints.strength.assign(2, {.crushing = 1e4});
    EXPECT_FALSE(addCrushingHinges(joints, {Eigen::VectorXd::Zero(4)}, 1e-9));
    EXPECT_TRUE(addCrushingHinges(joints, {atOneEnd}, 1e-9));
    ASSERT_EQ(joints.points.size(), 3U);
    // 1000 N over 2e4/0.5 N/m, from whichever end bears it.
    EXPECT_NEAR((joints.points[1].position - joints.points[0].position).norm(), 0.025, 1e-12);
    EXPECT_NEAR(joints.strength[0].crushing, 2e4 * 0.0125 / 0.5, 1e-9);
    EXPECT_NEAR(joints.strength[1].crushing, 2e4 / 2, 1e-9);
}

TEST(LimitAnalysis, OfAFrictionlessWallIsZero)
{
    const WeighedStructure structure = standing(paperWalls()[0].bond);
    EXPECT_EQ(multiplierOf(structure.program(0, structure.weightLoads())), 0);
}

// Nothing presses the joints: what pulls the wall is not carried at all, and what presses on it always.
TEST(LimitAnalysis, WithoutADeadLoadIsZeroOrWithoutBound)
{
    PlaneConeProgram program = squareWall(4, 0.65);
    program.load.setZero();
    const LimitAnalysis pulled = solveLimitAnalysis(program);
    EXPECT_EQ(pulled.status, CollapseStatus::optimal);
    EXPECT_EQ(pulled.alpha, 0);
    expectCertified(pulled);
    EXPECT_GT(program.liveLoad.dot(pulled.mechanism), 0);

    program.liveLoad = squareWall(4, 0.65).load;
    EXPECT_EQ(solveLimitAnalysis(program).status, CollapseStatus::unbounded);
}

TEST(LimitAnalysis, FindsTheLeastThicknessOfASemicircularArch)
{
    // 27 trapezoids; without sliding 0.106721, of many voussoirs 0.10748 (Milankovitch).
    EXPECT_NEAR(leastArchThickness(10, Voussoirs::trapezoids), 0.106721, 1e-4);
    EXPECT_NEAR(leastArchThickness(0.395, Voussoirs::sectors), 0.106721, 1e-4);
    EXPECT_NEAR(leastArchThickness(0.38, Voussoirs::sectors), 0.12055, 1e-4);
    EXPECT_NEAR(leastArchThickness(0.34, Voussoirs::sectors), 0.16116, 1e-4);
    EXPECT_LT(archMultiplier(0.25, 0.305, Voussoirs::sectors), 0);
}

TEST(LimitAnalysis, TiltsAnArchToTheKnownAngle)
{
    // On a base tilted by an angle of tangent alpha, weights have the horizontal part alpha times the
    // vertical one.
    EXPECT_NEAR(archMultiplier(0.15, 10, Voussoirs::sectors), 0.14510, 1e-4);
}

TEST(LimitAnalysis, FindsTheForceOnTheExtradosThatBreaksAnArch)
{
    Arch arch;
    arch.voussoirs = 28;
    const WeighedStructure structure = archStructure(arch, Voussoirs::sectors);
    LoadVectors loads = structure.weightLoads();
    // The point of the extrados at x = -R/2: on the straight outer edge of the voussoir there.
    const double step = std::numbers::pi / 28;
    const double outer = 1.075;
    double y = 0;
    for (int k = 0; k < 28; ++k)
    {
        const Vector<2> right(outer * std::cos(k * step), outer * std::sin(k * step));
        const Vector<2> left(outer * std::cos((k + 1) * step), outer * std::sin((k + 1) * step));
        if (left.x() <= -0.5 && -0.5 < right.x())
        {
            y = right.y() + (left.y() - right.y()) * (-0.5 - right.x()) / (left.x() - right.x());
        }
    }
    const Vector<2> at(-0.5, y);
    const std::vector<int> blocks = findLoadedBlocks(structure.assembly, at, 1e-9).blocks;
    ASSERT_EQ(blocks.size(), 1U);
    const int block = blocks.front();
    loads.live = pointLoad(structure.assembly, block, at, {0, -1}).rows;
    int row = 0;
    for (int other = 0; other < block; ++other)
    {
        row += structure.assembly.blocks[other].support < 0 ? 3 : 0;
    }
    loads.live[row + 2] = cross(at - structure.masses[block].centroid, {0, -1}); // about the sector's centre
    double weight = 0;
    for (std::size_t i = 0; i < structure.weights.size(); ++i)
    {
        weight += structure.assembly.blocks[i].support < 0 ? structure.weights[i] : 0;
    }
    EXPECT_NEAR(multiplierOf(structure.program(10, loads)) / weight, 0.22696, 1e-4);
}

TEST(LimitAnalysis, KnowsWhichHarmonicStackStands)
{
    // n = 4 bricks of length 1 overhang by (1 + 1/2 + 1/3 + 1/4)/2 = 1.0416667 at most.
    const auto stack = [](double factor)
    {
        constexpr int bricks = 4;
        Assembly<2> assembly;
        assembly.supports = {{"table", "blocks"}};
        assembly.blocks.push_back(rectangle(-3, -1, 0, 0, 0));
        double end = 0;
        for (int brick = 0; brick < bricks; ++brick)
        {
            end += factor * 0.5 / (bricks - brick);
            assembly.blocks.push_back(rectangle(end - 1, 0.2 * brick, end, 0.2 * (brick + 1)));
        }
        EXPECT_NEAR(end, factor * 1.0416667, 1e-7);
        const WeighedStructure structure(std::move(assembly));
        return solveLimitAnalysis(structure.program(0.65, structure.weightLoads()));
    };
    const LimitAnalysis stands = stack(1 - 1e-6);
    EXPECT_EQ(stands.status, CollapseStatus::optimal);
    EXPECT_GT(stands.alpha, 0);
    expectCertified(stands);
    const LimitAnalysis falls = stack(1 + 1e-6);
    EXPECT_EQ(falls.status, CollapseStatus::unstable);
    EXPECT_GT(falls.mechanism.norm(), 0);
    expectCertified(falls);
}

TEST(LimitAnalysis, SaysWhenTheLiveLoadNeverBreaksTheStructure)
{
    const WeighedStructure structure = standing(paperWalls()[0].bond);
    LoadVectors loads = structure.weightLoads();
    loads.live = loads.dead;
    const LimitAnalysis result = solveLimitAnalysis(structure.program(0.65, loads));
    EXPECT_EQ(result.status, CollapseStatus::unbounded);
    expectCertified(result);
}

TEST(LimitAnalysis, SaysWhenTheDeadLoadCannotBeCarriedThoughALiveLoadWouldHoldItUp)
{
    const WeighedStructure structure = standing(paperWalls()[0].bond);
    LoadVectors loads = structure.weightLoads();
    loads.dead += 0.7 * loads.live;
    loads.live *= -1;
    const PlaneConeProgram program = structure.program(0.65, loads);
    const LimitAnalysis result = solveLimitAnalysis(program);
    EXPECT_EQ(result.status, CollapseStatus::unstable);
    expectCertified(result);

    // What it holds up for follows from the multipliers to either side of the wall as it is.
    LoadVectors reversed = structure.weightLoads();
    const double forward = multiplierOf(structure.program(0.65, reversed));
    reversed.live *= -1;
    const double backward = multiplierOf(structure.program(0.65, reversed));
    SymbolicAnalysis kept;
    const std::optional<MultiplierRange> held = multipliersThatHold(program, {}, kept);
    ASSERT_TRUE(held);
    EXPECT_NEAR(held->least, 0.7 - forward, 1e-7);
    EXPECT_NEAR(held->largest, 0.7 + backward, 1e-7);
}

TEST(LimitAnalysis, SaysThatNoLiveLoadHoldsABlockUpThatHasNoJoint)
{
    Assembly<2> assembly;
    assembly.supports = {{"table", "blocks"}};
    assembly.blocks = {rectangle(0, -1, 1, 0, 0), rectangle(0, 0, 1, 1), rectangle(0, 2, 1, 3)};
    const WeighedStructure structure(std::move(assembly));
    SymbolicAnalysis kept;
    EXPECT_FALSE(multipliersThatHold(structure.program(0.65, structure.weightLoads()), {}, kept));
}

namespace
{

/// A keystone of weight W with faces at an angle beta to the vertical, between two fixed springers. The live
/// load lifts or presses it, so that the multipliers give the range of the normal force N on a face: W/2 = N
/// (sin b +- mu cos b).
struct Keystone
{
    WeighedStructure structure;
    double weight;
};

Keystone keystone(double beta)
{
    const double tangent = std::tan(beta);
    Assembly<2> assembly;
    assembly.supports = {{"springers", "blocks"}};
    const double lower = 0.5;
    const double upper = lower + tangent;
    assembly.blocks.push_back({{{-lower, 0}, {lower, 0}, {upper, 1}, {-upper, 1}}, 1, -1});
    assembly.blocks.push_back({{{lower, 0}, {3, 0}, {3, 1}, {upper, 1}}, 1, 0});
    assembly.blocks.push_back({{{-3, 0}, {-lower, 0}, {-upper, 1}, {-3, 1}}, 1, 0});
    WeighedStructure structure(std::move(assembly));
    const double weight = structure.weights[0];
    return {std::move(structure), weight};
}

} // namespace

TEST(LimitAnalysis, BoundsTheForceOnAKeystone)
{
    const double beta = 0.4;
    for (const double mu : {0.1, 0.3})
    {
        const Keystone stone = keystone(beta);
        const double mean = stone.weight / 2;
        const double least = mean / (std::sin(beta) + mu * std::cos(beta));
        const double most = mean / (std::sin(beta) - mu * std::cos(beta));
        const auto extreme = [&](double sign)
        {
            // The right springer becomes a plate that is pressed against the keystone by a force N along its
            // normal.
            Assembly<2> assembly = stone.structure.assembly;
            const double tangent = std::tan(beta);
            const Vector<2> normal(std::cos(beta), -std::sin(beta)); // out of the keystone's right face
            const double lower = 0.5;
            Block<2> plate{{{lower, 0},
                            Vector<2>(lower, 0) + 0.1 * normal,
                            Vector<2>(lower + tangent, 1) + 0.1 * normal,
                            {lower + tangent, 1}},
                           1,
                           -1};
            assembly.blocks[1] = plate;
            WeighedStructure cut(std::move(assembly));
            LoadVectors loads;
            loads.dead = Eigen::VectorXd::Zero(6);
            loads.dead[1] = -stone.weight;
            loads.live = Eigen::VectorXd::Zero(6);
            PlaneConeProgram part = cut.program(mu, loads);
            // The plate is held against turning and against sliding along the face by frictionless stops ...
            const Vector<2> along = perpendicular(normal);
            for (const double side : {1.0, -1.0})
            {
                for (const double lever : {1.0, -1.0})
                {
                    ConeColumns<3, 2> stop;
                    stop.first = 1;
                    stop.onFirst.col(0) << -side * along.x(), -side * along.y(), -lever;
                    part.contacts.push_back(stop);
                    part.friction.push_back(0);
                }
            }
            // ... and pressed; the live load adds to the force or takes from it.
            const double pressed = mean / std::sin(beta); // what it takes without friction
            part.load.segment<2>(3) = -pressed * normal;
            part.liveLoad = Eigen::VectorXd::Zero(6);
            part.liveLoad.segment<2>(3) = -sign * stone.weight * normal;
            const LimitAnalysis result = solveLimitAnalysis(part);
            EXPECT_EQ(result.status, CollapseStatus::optimal);
            expectCertified(result);
            return pressed + sign * result.alpha * stone.weight;
        };
        EXPECT_NEAR(extreme(-1), least, 1e-8 * least);
        EXPECT_NEAR(extreme(1), most, 1e-8 * most);
    }
}

TEST(LimitAnalysis, LetsAKeystoneWedgeWithoutBoundWhenFrictionExceedsItsTangent)
{
    const double beta = 0.4;
    // Pulled down ever harder, the keystone holds when mu > tan b and fails when mu < tan b.
    for (const double mu : {std::tan(beta) * 1.001, std::tan(beta) * 0.999})
    {
        const Keystone stone = keystone(beta);
        LoadVectors loads = stone.structure.weightLoads();
        loads.live = -loads.dead; // lifted: only friction holds it
        const LimitAnalysis result = solveLimitAnalysis(stone.structure.program(mu, loads));
        EXPECT_EQ(result.status, mu > std::tan(beta) ? CollapseStatus::unbounded : CollapseStatus::optimal);
        expectCertified(result);
    }
}

TEST(LimitAnalysis, UpperBoundsFromAnywhereGiveTheSameMultiplier)
{
    const WeighedStructure structure = standing(paperWalls()[0].bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    for (const double from : {-1.0, 0.0, 0.6, 0.7, 100.0})
    {
        const ConeSolution solution = solveByUpperBounds(program, from, 1e-9, 200);
        EXPECT_EQ(solution.status, SolveStatus::optimal) << "from " << from;
        EXPECT_NEAR(solution.multiplier, 0.642859, 1e-6) << "from " << from;
        EXPECT_LE(certifyOptimal(program, solution).worst(), 1e-9) << "from " << from;
    }
}

TEST(LimitAnalysis, StatesThatItDidNotConvergeRatherThanGiveANumber)
{
    const WeighedStructure structure = standing(paperWalls()[5].bond);
    InteriorPointSettings settings;
    settings.maximumIterations = 3;
    const LimitAnalysis result =
        solveLimitAnalysis(structure.program(0.65, structure.weightLoads()), settings);
    EXPECT_EQ(result.status, CollapseStatus::notConverged);
    EXPECT_EQ(result.alpha, 0);
}

/// Work, not time, so that it says the same on a loaded machine: 12 factorisations and 68 solves when this
/// was written; the margin is for other compilers' rounding.
TEST(LimitAnalysis, WorkOnTheSixthWallDoesNotGrow)
{
    const WeighedStructure structure = standing(paperWalls()[5].bond);
    const LimitAnalysis result = solveLimitAnalysis(structure.program(0.65, structure.weightLoads()));
    ASSERT_EQ(result.status, CollapseStatus::optimal);
    EXPECT_GT(result.factorisations, 0);
    EXPECT_LE(result.factorisations, 18);
    EXPECT_GE(result.solves, result.factorisations);
    EXPECT_LE(result.solves, 95);
}

/// The base carries thousands of times what is to be balanced to 1e-8 at the top: rounding kept the balance
/// from the tolerance, with a friction of 0.3 for 34 factorisations, with 25,680 blocks and 0.6 for good.
TEST(LimitAnalysis, OfSquareWallsTakesFewFactorisationsWhateverTheFriction)
{
    const auto expectFew = [](int size, double mu)
    {
        SCOPED_TRACE(testing::Message() << size << " units, friction " << mu);
        const LimitAnalysis result = solveLimitAnalysis(squareWall(size, mu), {.tolerance = 1e-8});
        EXPECT_EQ(result.status, CollapseStatus::optimal);
        EXPECT_LE(result.certificate.worst(), 1e-8);
        EXPECT_LE(result.factorisations, 26);
    };
    for (const double mu : {0.3, 0.4, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 1.0})
    {
        expectFew(20, mu);
        expectFew(40, mu);
    }
    expectFew(160, 0.6);
}

/// All numbers of a solution, one after the other.
Eigen::VectorXd numbersOf(const ConeSolution& solution)
{
    Eigen::VectorXd all(solution.contactForce.size() + solution.displacement.size() + 3);
    all << solution.contactForce, solution.displacement, solution.multiplier, solution.factorisations,
        solution.solves;
    return all;
}

// 3,630 blocks: large enough for shares of the contact points, parts of vectors, and tasks of the factor.
TEST(LimitAnalysis, AndAStepAreTheSameToTheLastBitWhateverTheNumberOfThreads)
{
    const PlaneConeProgram atRest = squareWall(60, 0.65);
    PlaneConeProgram step = withUnitInertia(atRest);
    step.load += 0.3 * step.liveLoad;
    step.liveLoad.resize(0);
    for (const PlaneConeProgram& program : {atRest, step})
    {
        const auto solvedWith = [&program](int count)
        {
            setThreads(count);
            const ConeSolution solution = solveInteriorPoint(program, {.tolerance = 1e-8});
            setThreads(1);
            EXPECT_EQ(solution.status, SolveStatus::optimal);
            return numbersOf(solution);
        };
        const Eigen::VectorXd alone = solvedWith(1);
        EXPECT_TRUE(alone == solvedWith(2));
        EXPECT_TRUE(alone == solvedWith(4));
    }
}

TEST(LimitAnalysis, OfSquareWallsComesByForcesThatCarryTheDeadLoad)
{
    for (const int size : {20, 30, 40})
    {
        EXPECT_GT(solveInteriorPoint(squareWall(size, 0.65), {.tolerance = 1e-8}).forceOfLoadAlone.size(), 0)
            << size;
    }
}
