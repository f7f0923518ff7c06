// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Incremental analyses of a block on the ground, whose thresholds have a closed form: it slides at mu g and
/// rocks at (width/height) g.
#include "../Polygons.h"
#include "../ReportOf.h"

#include "ensembles/IncrementalDynamics.h"
#include "ensembles/IncrementalDynamicsCase.h"

#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "contact/Equilibrium.h"
#include "core/Error.h"
#include "core/Signals.h"
#include "effects/SupportMotion.h"

#include <csignal>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace drystone;

namespace
{

constexpr double g = 9.81;

using test::rectangleOfSize;

struct BlockCase
{
    double width = 1;
    double height = 1;
    double mu = 0.3;
    FlowRule flowRule = FlowRule::nonAssociative;
    std::string intensity = "type bisection; low 0.1005; high 0.5005; tolerance 0.001;";
    std::string criterion = "type motion; displacement 1e-6;";
    double endTime = 0.4;
    int jobs = 1;
};

StudyMotion constantMotion(double acceleration)
{
    GroundMotion ground;
    ground.components.push_back({{std::make_shared<ConstantAcceleration>(acceleration), ""}, {1, 0, 0}});
    return {"constant", ground, std::abs(acceleration)};
}

IncrementalDynamics<2> studyOf(const BlockCase& block)
{
    IncrementalDynamics<2> study;
    DynamicCase<2>& scene = study.scene;
    scene.assembly.supports.push_back({"ground", "ground"});
    scene.assembly.blocks.push_back({rectangleOfSize(-5, -1, 10 + block.width, 1), 1, 0});
    scene.assembly.blocks.push_back({rectangleOfSize(0, 0, block.width, block.height), 1, -1});
    scene.blocks = blockMasses(scene.assembly);
    scene.free = freeIndices(scene.assembly);
    const std::vector<double> densities(2, 1800);
    scene.mass = massDiagonal(scene.assembly, scene.blocks, densities);
    scene.gravity = {0, -g};
    scene.deadLoad.rows = gravityLoad(scene.assembly, massesOf(scene.blocks, densities), scene.gravity);
    scene.contact.friction = CoulombFriction{block.mu, block.flowRule};
    scene.solution.tolerance = 1e-11;
    scene.blockSize = std::sqrt(block.width * block.height);
    scene.roundingGap = 1e-14;
    study.start = startMotion(scene, stateAtRest(scene.assembly));
    study.controls.deltaT = 0.002;
    study.controls.endTime = block.endTime;
    study.startTime = {0, study.controls.deltaT, 0, 0, 0};
    study.gravity = g;
    study.intensity = intensityTypes().select(Dictionary::readString(block.intensity));
    study.criterion = criterionTypes().select(Dictionary::readString(block.criterion))(scene.assembly);
    study.motions.push_back(constantMotion(2)); // its peak must not matter
    study.jobs = block.jobs;
    return study;
}

LeastIntensity leastOf(const BlockCase& block)
{
    const auto curves = carryOut(studyOf(block));
    EXPECT_EQ(exitStatus(curves), 0);
    return leastIntensity(curves.at(0));
}

} // namespace

TEST(IncrementalDynamics, ABlockSlidesAtTheFrictionCoefficientTimesG)
{
    for (const FlowRule flowRule : {FlowRule::associative, FlowRule::nonAssociative})
    {
        const LeastIntensity least = leastOf({.mu = 0.3, .flowRule = flowRule});
        EXPECT_EQ(least.kind, LeastIntensity::Kind::found);
        EXPECT_NEAR(least.value, 0.3005, 1e-12); // the first of the grid above 0.3
        EXPECT_NEAR(least.below, 0.2995, 1e-12);
    }
}

TEST(IncrementalDynamics, ABlockRocksAtWidthOverHeightTimesG)
{
    for (const FlowRule flowRule : {FlowRule::associative, FlowRule::nonAssociative})
    {
        const LeastIntensity least = leastOf({.width = 0.5,
                                              .height = 2,
                                              .mu = 2,
                                              .flowRule = flowRule,
                                              .criterion = "type rotation; block 1; limit 1e-6;"});
        EXPECT_EQ(least.kind, LeastIntensity::Kind::found);
        EXPECT_NEAR(least.value, 0.2505, 1e-12);
    }
}

TEST(IncrementalDynamics, KnownRunsAreNotRepeated)
{
    const IncrementalDynamics<2> study = studyOf({.mu = 0.3});
    const std::vector<IncrementalCurve> all = carryOut(study);
    EXPECT_EQ(static_cast<long>(all.at(0).size()), study.intensity.mostRuns);
    std::vector<IncrementalCurve> known = all;
    known.at(0).erase(known.at(0).begin() + 1);
    int carriedOut = 0;
    const std::vector<IncrementalCurve> again = carryOut(
        study, [&](std::size_t, const IncrementalRun&) { ++carriedOut; }, known);
    EXPECT_EQ(carriedOut, 1);
    ASSERT_EQ(again.at(0).size(), all.at(0).size());
    for (std::size_t i = 0; i < all.at(0).size(); ++i)
    {
        EXPECT_EQ(again[0][i].intensity, all[0][i].intensity);
        EXPECT_EQ(again[0][i].largest, all[0][i].largest);
    }
}

TEST(IncrementalDynamics, ARunThatStandsMayStillGrow)
{
    IncrementalDynamics<2> study = studyOf({.mu = 0.3, .intensity = "type list; values (0.2 0.5);"});
    const double slides = runAt(study, study.motions.front(), 0.5).largest;
    study.stopWhenMet = false;
    study.criterion.limit = 1.2 * runAt(study, study.motions.front(), 0.5).largest;
    EXPECT_GT(study.criterion.limit, 1.2 * slides);
    const IncrementalCurve curve = carryOut(study).at(0);
    EXPECT_EQ(curve[0].verdict, Verdict::stands);
    EXPECT_FALSE(curve[0].isGrowing);
    EXPECT_EQ(curve[1].verdict, Verdict::stands);
    EXPECT_TRUE(curve[1].isGrowing);
}

TEST(IncrementalDynamics, MirroredGroundGivesTheSameThreshold)
{
    IncrementalDynamics<2> study = studyOf({.width = 0.5, .height = 2, .mu = 2});
    study.motions = {constantMotion(-7)};
    EXPECT_NEAR(leastIntensity(carryOut(study).at(0)).value, 0.2505, 1e-12);
}

TEST(IncrementalDynamics, UnitOfTheIntensityIsOneOfAcceleration)
{
    const LeastIntensity least =
        leastOf({.mu = 0.3, .intensity = "type bisection; unit m/s2; low 2; high 4; tolerance 0.01;"});
    EXPECT_NEAR(least.value, 2.95, 1e-12); // 0.3 g = 2.943 m/s2
}

TEST(IncrementalDynamics, StepFindsWhatBisectionFinds)
{
    const LeastIntensity steps =
        leastOf({.mu = 0.3, .intensity = "type step; from 0.2805; to 0.3205; step 0.001;"});
    EXPECT_EQ(steps.kind, LeastIntensity::Kind::found);
    EXPECT_NEAR(steps.value, 0.3005, 1e-12);
    EXPECT_TRUE(steps.isMonotone);
}

TEST(IncrementalDynamics, NoIntensityInRangeIsSaidAndIsNoFailure)
{
    EXPECT_EQ(leastOf({.intensity = "type list; values (0.1 0.2);"}).kind, LeastIntensity::Kind::aboveRange);
    EXPECT_EQ(leastOf({.intensity = "type list; values (0.4 0.5);"}).kind, LeastIntensity::Kind::belowRange);
    EXPECT_EQ(leastOf({.intensity = "type bisection; low 0.1; high 0.2; tolerance 0.001;"}).kind,
              LeastIntensity::Kind::aboveRange);
}

TEST(IncrementalDynamics, AnyNumberOfThreadsGivesTheSameBits)
{
    const std::string intensity = "type step; from 0.25; to 0.35; step 0.01;";
    std::vector<std::vector<double>> reports(2);
    std::vector<std::vector<IncrementalCurve>> results;
    for (const int jobs : {1, 3})
    {
        IncrementalDynamics<2> study = studyOf({.mu = 0.3, .intensity = intensity, .jobs = jobs});
        study.motions.push_back(constantMotion(-1));
        study.stopWhenMet = false;
        auto& order = reports[results.size()];
        results.push_back(carryOut(study, [&](std::size_t motion, const IncrementalRun& run)
                                   { order.push_back(static_cast<double>(motion) + run.intensity); }));
    }
    EXPECT_EQ(reports[0].size(), 22u);
    EXPECT_EQ(reports[0], reports[1]);
    for (std::size_t motion = 0; motion < 2; ++motion)
    {
        ASSERT_EQ(results[0][motion].size(), results[1][motion].size());
        for (std::size_t i = 0; i < results[0][motion].size(); ++i)
        {
            const IncrementalRun& one = results[0][motion][i];
            const IncrementalRun& three = results[1][motion][i];
            EXPECT_EQ(one.intensity, three.intensity);
            EXPECT_EQ(one.verdict, three.verdict);
            EXPECT_EQ(one.largest, three.largest);
            EXPECT_EQ(one.worstResidual, three.worstResidual);
        }
    }
}

TEST(IncrementalDynamics, ARunThatGoesOnReachesTheClosedFormOfSliding)
{
    IncrementalDynamics<2> study = studyOf({.mu = 0.3, .intensity = "type list; values (0.5);"});
    study.stopWhenMet = false;
    const IncrementalRun run = carryOut(study).at(0).at(0);
    EXPECT_EQ(run.verdict, Verdict::meets);
    EXPECT_EQ(run.steps, 200);
    EXPECT_NEAR(run.endTime, 0.002, 1e-12);
    // a t (t + dt)/2 with backward Euler
    EXPECT_NEAR(run.largest, 0.2 * g * 0.4 * 0.402 / 2, 1e-8);
    study.stopWhenMet = true;
    EXPECT_EQ(carryOut(study).at(0).at(0).steps, 1);
}

TEST(IncrementalDynamics, ARunThatDoesNotConvergeIsNeverCountedAsStanding)
{
    IncrementalDynamics<2> study = studyOf({.mu = 0.3, .intensity = "type list; values (0.2 0.5);"});
    study.scene.solution.solver = SolverType::interiorPoint;
    study.scene.solution.maximumIterations = 1;
    const auto curves = carryOut(study);
    EXPECT_EQ(curves.at(0).at(0).verdict, Verdict::notConverged);
    EXPECT_EQ(curves.at(0).at(1).verdict, Verdict::notConverged);
    EXPECT_EQ(leastIntensity(curves.at(0)).kind, LeastIntensity::Kind::notConverged);
    EXPECT_EQ(exitStatus(curves), 2);
}

TEST(IncrementalDynamics, CriteriaBeyondSmallDisplacementsAreQuestioned)
{
    const auto doubtAbout = [](const std::string& criterion, bool isSmall)
    {
        IncrementalDynamics<2> study = studyOf({.width = 0.5, .height = 2, .criterion = criterion});
        study.scene.schemes.smallDisplacements = isSmall;
        return doubtAboutCriterion(study);
    };
    EXPECT_EQ(doubtAbout("type motion; displacement 1e-6;", true), "");
    EXPECT_EQ(doubtAbout("type displacement; limit 0.04;", true), "");
    EXPECT_EQ(doubtAbout("type displacement; limit 0.2;", false), "");
    EXPECT_NE(doubtAbout("type displacement; limit 0.2;", true).find("moved by 0.2 of the mean block size"),
              std::string::npos);
    EXPECT_NE(doubtAbout("type rotation; limit 0.3;", true).find("moved by 0.15 of"), std::string::npos);
    EXPECT_NE(doubtAbout("type collapse;", true).find("moved by 0.5 of"), std::string::npos);
}

// It was said of the lowest acceleration that it meets the criterion, and to try lower ones.
TEST(IncrementalDynamics, CriteriaThatSupportsMeetByThemselvesAreQuestioned)
{
    const auto doubtAbout = [](const std::string& criterion, double velocity)
    {
        IncrementalDynamics<2> study = studyOf({.criterion = criterion, .endTime = 0.4});
        study.scene.effects.push_back(std::make_shared<MovingSupports<2>>(std::vector<SupportMotion<2>>{
            {0,
             {1, 0},
             tabulatedAcceleration({0, 1}, {velocity, velocity}, Interpolation::linear,
                                   OutOfBounds::zero)}}));
        return doubtAboutSupports(study);
    };
    EXPECT_NE(doubtAbout("type motion; displacement 1e-6;", 0.1).find("Supports move by up to 0.04 m"),
              std::string::npos);
    EXPECT_EQ(doubtAbout("type displacement; limit 0.05;", 0.1), "");
    EXPECT_NE(doubtAbout("type displacement; limit 0.05;", 0.2), "");
    EXPECT_EQ(doubtAbout("type rotation; limit 0.001;", 0.1), "");
    EXPECT_EQ(doubtAboutSupports(studyOf({})), "");
}

TEST(IncrementalDynamics, ASignalStopsIt)
{
    catchStopSignals();
    std::raise(SIGINT);
    const auto curves = carryOut(studyOf({}));
    EXPECT_EQ(exitStatus(curves), 130);
    EXPECT_TRUE(curves.at(0).empty());
    const IncrementalDynamics<2> study = studyOf({});
    EXPECT_EQ(runAt(study, study.motions[0], 0.2).verdict, Verdict::interrupted);
    forgetStopSignal();
    EXPECT_EQ(runAt(study, study.motions[0], 0.2).verdict, Verdict::stands);
}

// A box of 0.5 x 1 x 2 m, pushed along (3 4 0): it slides at mu g, or rocks where the force meets an edge of
// the face: the ground accelerates along (0.6 0.8 0) a, and about the edge across x it turns at 0.6 a = 0.5/2
// g.
TEST(IncrementalDynamics, InSpaceABoxSlidesAndRocksAtTheClosedForms)
{
    const auto leastOfBox = [](double mu, const std::string& criterion)
    {
        IncrementalDynamics<3> study;
        DynamicCase<3>& scene = study.scene;
        Assembly<3> assembly;
        assembly.supports.push_back({"ground", "ground"});
        assembly.blocks.resize(2);
        assembly.blocks[0].shape = makeBox({-5, -5, -1}, {5, 5, 0});
        assembly.blocks[0].support = 0;
        assembly.blocks[1].shape = makeBox({0, 0, 0}, {0.5, 1, 2});
        const std::vector<double> densities(2, 1800);
        setStructure(scene, std::move(assembly), densities);
        scene.gravity = {0, 0, -g};
        scene.deadLoad.rows = gravityLoad(scene.assembly, massesOf(scene.blocks, densities), scene.gravity);
        scene.contact.friction = CoulombFriction{mu, FlowRule::nonAssociative};
        scene.solution.tolerance = 1e-11;
        study.start = startMotion(scene, stateAtRest(scene.assembly));
        study.controls.deltaT = 0.002;
        study.controls.endTime = 0.1;
        study.startTime = {0, study.controls.deltaT, 0, 0, 0};
        study.gravity = g;
        study.intensity = intensityTypes().select(
            Dictionary::readString("type bisection; low 0.1005; high 0.5005; tolerance 0.001;"));
        study.criterion = criterionTypes().select(Dictionary::readString(criterion))(scene.assembly);
        GroundMotion ground;
        ground.components.push_back({{std::make_shared<ConstantAcceleration>(3), ""}, {0.6, 0.8, 0}});
        study.motions.push_back({"constant", ground, 3});
        const auto curves = carryOut(study);
        EXPECT_EQ(exitStatus(curves), 0);
        return leastIntensity(curves.at(0)).value;
    };
    EXPECT_NEAR(leastOfBox(0.3, "type motion; displacement 1e-6;"), 0.3005, 1e-12);
    EXPECT_NEAR(leastOfBox(2, "type rotation; limit 1e-6;"), 0.4175, 1e-12); // above 0.25/0.6 = 0.41667
}

TEST(Criterion, MeasuresFromWhereTheRunBegan)
{
    const IncrementalDynamics<2> study = studyOf({.width = 0.5, .height = 2});
    const auto measured = [&](const std::string& text, const Placement<2>& start, const Placement<2>& now)
    {
        DynamicState<2> before = study.start.state;
        Motion<2> after = study.start;
        before.placements[1] = start;
        after.state.placements[1] = now;
        return criterionTypes()
            .select(Dictionary::readString(text))(study.scene.assembly)
            .figure.at(before, after);
    };
    const Placement<2> start{{1, 2}, 0.1};
    EXPECT_EQ(measured("type motion;", start, start), 0);
    EXPECT_NEAR(measured("type motion;", start, {{1.3, 2.4}, 0.1}), 0.5, 1e-14);
    // half a turn about the centre takes a corner to the other end of the diagonal
    EXPECT_NEAR(measured("type motion;", {}, {{0, 0}, std::numbers::pi}), std::hypot(0.5, 2), 1e-14);
    EXPECT_NEAR(measured("type displacement; limit 1;", start, {{1.3, 1.6}, 0.7}), 0.5, 1e-14);
    EXPECT_NEAR(measured("type rotation; limit 1;", start, {{0, 0}, -0.2}), 0.3, 1e-14);
    EXPECT_NEAR(measured("type collapse; drop 0.5;", start, {{0, 1.3}, 0}), 0.7, 1e-14);
    EXPECT_EQ(measured("type collapse;", start, {{0, 3}, 0}), 0);
}

TEST(Criterion, CollapseIsInBlockSizes)
{
    const IncrementalDynamics<2> study =
        studyOf({.width = 0.5, .height = 2, .criterion = "type collapse; drop 0.25;"});
    EXPECT_DOUBLE_EQ(study.criterion.limit, 0.25);
    EXPECT_DOUBLE_EQ(
        studyOf({.width = 2, .height = 2, .criterion = "type collapse; drop 0.25;"}).criterion.limit, 0.5);
}

TEST(Criterion, RefusesBlocksThatCannotMove)
{
    const Assembly<2> assembly = studyOf({}).scene.assembly;
    const auto faultOf = [&](const std::string& text)
    { return reportOf([&] { criterionTypes().select(Dictionary::readString(text, "dict"))(assembly); }); };
    EXPECT_THAT(faultOf("type displacement;\nblock 2;\nlimit 1;"),
                testing::AllOf(testing::HasSubstr("blocks 0 to 1"), testing::HasSubstr("line 2")));
    EXPECT_THAT(faultOf("type rotation; block 0; limit 1;"), testing::HasSubstr("fixed"));
    EXPECT_THAT(faultOf("type rotation; limit 0;"), testing::HasSubstr("limit"));
    EXPECT_EQ(faultOf("type displacement; block 1; limit 1;"), "no error");
}
