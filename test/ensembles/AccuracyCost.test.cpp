// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What accuracyCost makes of its runs, the readings of its dictionary, and the orders that theta schemes
/// show against Housner's equation.
#include "../Polygons.h"
#include "../ReportOf.h"

#include "ensembles/AccuracyCost.h"
#include "ensembles/HousnerCase.h"

#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "core/Error.h"
#include "effects/GroundMotion.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace drystone;

namespace
{

using test::rectangleOfSize;

/// The block of 0.5 x 2 m, turned about its left corner by half its slenderness, or at rest.
std::shared_ptr<AccuracyCase<2>> rockingCase(double share = 0.5)
{
    const auto shared = std::make_shared<AccuracyCase<2>>();
    AccuracyCase<2>& study = *shared;
    DynamicCase<2> scene;
    Assembly<2> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks.push_back({rectangleOfSize(-4, -0.5, 8, 0.5), 1, 0});
    assembly.blocks.push_back({rectangleOfSize(-0.25, 0, 0.5, 2), 1, -1});
    const std::vector<double> densities(2, 2000);
    setStructure(scene, std::move(assembly), densities);
    scene.gravity = {0, -9.81};
    scene.deadLoad.rows = gravityLoad(scene.assembly, massesOf(scene.blocks, densities), scene.gravity);
    scene.contact.friction = CoulombFriction{1, FlowRule::nonAssociative};
    study.start = stateAtRest(scene.assembly);
    const double rotation = share * std::atan(0.25);
    const Vector<2> corner(-0.25, 0);
    const Vector<2> centre(0, 1);
    study.start.placements[1] = {corner + Eigen::Rotation2Dd(rotation) * (centre - corner) - centre,
                                 rotation};
    study.endTime = 3;
    study.scene = std::move(scene);
    return shared;
}

RunSetting settingWith(double deltaT, double theta)
{
    return {deltaT, theta, FlowRule::nonAssociative, SolverType::automatic, 1e-11,
            0,      0,     Displacements::large};
}

Quantity returnOf(int count, const std::shared_ptr<const AccuracyCase<2>>& study)
{
    return quantityTypes()
        .select(Dictionary::readString("type returnTime; block 1; count " + std::to_string(count)
                                       + "; reference { type Housner; }"))
        .make(study);
}

/// Error of the first return at a step.
double errorAt(double deltaT, double theta)
{
    const Quantity quantity = returnOf(1, rockingCase());
    const Measurement run = quantity.measure(settingWith(deltaT, theta), {});
    EXPECT_EQ(run.end, RunEnd::done);
    return std::abs(run.value / quantity.housner() - 1);
}

AccuracyPoint pointWith(RunSetting setting, double error, double cpuTime, int failed = 0)
{
    AccuracyPoint point;
    point.setting = setting;
    point.runs = 1;
    point.failed = failed;
    point.value = 1 + error;
    point.medianError = error;
    point.worstError = 2 * error;
    point.cpuTime = cpuTime;
    point.runTimes = {failed > 0 ? HUGE_VAL : cpuTime};
    return point;
}

AccuracySettings read(const std::string& text)
{
    return readOptions<AccuracySettings>(Dictionary::readString(text));
}

const std::string quantities = "quantities { a { type multiplier; reference { type finest; } } }\n";

} // namespace

TEST(AccuracyCost, TheReferenceIsTheQuarterPeriodOfHousnersEquation)
{
    EXPECT_NEAR(returnOf(1, rockingCase()).housner(), 1.975213 / 4, 2e-7);
}

TEST(AccuracyCost, AgainstHousnersEquationBackwardEulerHasOrderOneAndTheTrapezoidalRuleTwo)
{
    EXPECT_NEAR(std::log2(errorAt(0.008, 1) / errorAt(0.004, 1)), 1, 0.05);
    EXPECT_NEAR(std::log2(errorAt(0.008, 0.5) / errorAt(0.004, 0.5)), 2, 0.3);
    EXPECT_LT(errorAt(0.004, 0.5), 2e-5);
}

TEST(AccuracyCost, ASettingOfSeveralSweepsHasOneErrorThatOfMostPhases)
{
    AccuracyPoint few = pointWith(settingWith(0.01, 1), 0.042, 1);
    few.planned = few.runs = 5;
    AccuracyPoint many = pointWith(settingWith(0.01, 1), 0.099, 2);
    many.planned = many.runs = 10;
    AccuracyPoint other = pointWith(settingWith(0.02, 1), 0.2, 0.5);
    other.planned = other.runs = 5;
    std::vector<SweepResult> sweeps{{"coarse", 0, SweepAxis::deltaT, {other, few}},
                                    {"fine", 0, SweepAxis::deltaT, {many}},
                                    {"ofAnotherQuantity", 1, SweepAxis::deltaT, {few}}};
    shareMostPhases(sweeps);
    EXPECT_EQ(sweeps[0].points[0].medianError, 0.2);
    EXPECT_EQ(sweeps[0].points[1].medianError, 0.099);
    EXPECT_EQ(sweeps[0].points[1].planned, 10);
    EXPECT_EQ(sweeps[0].points[1].runTimes, std::vector<double>{1});
    EXPECT_EQ(sweeps[1].points[0].medianError, 0.099);
    EXPECT_EQ(sweeps[2].points[0].medianError, 0.042);
}

TEST(AccuracyCost, ImpactsAtOtherPhasesOfAStepGiveOtherErrors)
{
    const Quantity quantity = returnOf(2, rockingCase());
    const double reference = quantity.housner();
    std::vector<Measurement> runs;
    for (int phase = 0; phase < 20; ++phase)
    {
        runs.push_back(quantity.measure(settingWith(0.01, 1), {phase, 20}));
    }
    const AccuracyPoint point = summarise(settingWith(0.01, 1), runs, reference, 20);
    EXPECT_TRUE(point.isWhole());
    EXPECT_GT(point.worstError, 1.05 * point.medianError);
    EXPECT_LT(point.worstError, 0.2);
}

TEST(AccuracyCost, TheFirstStepIsAPartOfOneAndTheLastEndsAtTheEndTime)
{
    const auto study = rockingCase(0);
    std::vector<double> times;
    const Measurement run = stepThrough(*study->scene, *study, settingWith(0.4, 1), {1, 4},
                                        [&](const Motion<2>& motion, double)
                                        {
                                            times.push_back(motion.state.time);
                                            return true;
                                        });
    EXPECT_EQ(run.steps, 9); // 0.15 s, seven of 0.4 s, 0.05 s
    EXPECT_NEAR(times.at(1), 0.375 * 0.4, 1e-15);
    EXPECT_NEAR(times.at(2), 1.375 * 0.4, 1e-15);
    EXPECT_EQ(times.back(), 3);
}

TEST(AccuracyCost, ABlockThatDoesNotComeBackInTimeHasNoFigure)
{
    const auto study = rockingCase();
    study->endTime = 0.3;
    const Quantity quantity = returnOf(1, study);
    const Measurement run = quantity.measure(settingWith(0.01, 1), {});
    EXPECT_EQ(run.end, RunEnd::missing);
    EXPECT_TRUE(std::isnan(run.value));
    EXPECT_THROW(quantity.housner(), FatalError);
}

TEST(AccuracyCost, HousnersEquationIsForOneUprightBlockAlone)
{
    auto study = rockingCase();
    EXPECT_NEAR(housnerCase(*study).block.slenderness(), std::atan(0.25), 1e-15);
    study->scene->contact.restitution = Restitution{0.5};
    EXPECT_THROW(housnerCase(*study), FatalError);
    study = rockingCase();
    study->scene->assembly.blocks[1].outline = {{-0.25, 0}, {0.25, 0}, {0.1, 2}, {-0.1, 2}};
    EXPECT_THROW(housnerCase(*study), FatalError);
    study = rockingCase();
    study->scene->assembly.blocks.push_back({rectangleOfSize(2, 0, 0.5, 2), 1, -1});
    EXPECT_THROW(housnerCase(*study), FatalError);
}

TEST(AccuracyCost, HousnersEquationHasTheMotionOfTheGround)
{
    const auto study = rockingCase();
    GroundMotion ground;
    ground.components.emplace_back();
    ground.components.back().acceleration = std::make_shared<ConstantAcceleration>(1);
    ground.components.back().direction = {-1, 0, 0};
    study->scene->effects.push_back(std::make_shared<MovingGround<2>>(ground));
    const Quantity quantity = returnOf(1, study);
    const Measurement run = quantity.measure(settingWith(0.001, 0.5), {});
    ASSERT_EQ(run.end, RunEnd::done);
    EXPECT_NEAR(run.value / quantity.housner(), 1, 1e-4);
    EXPECT_LT(quantity.housner(), 0.9 * returnOf(1, rockingCase()).housner());

    ground.components.back().direction = {0, 1, 0};
    study->scene->effects.back() = std::make_shared<MovingGround<2>>(ground);
    EXPECT_THROW(quantity.housner(), FatalError);
}

TEST(AccuracyCost, HousnersEquationIsForABlockOnItsCornerThatDoesNotSlide)
{
    const auto faultOf = [](const AccuracyCase<2>& study) { return reportOf([&] { housnerCase(study); }); };
    auto study = rockingCase();
    EXPECT_EQ(faultOf(*study), "no error");
    study->start.placements[1].translation.y() += 0.1;
    EXPECT_THAT(faultOf(*study), testing::HasSubstr("stands on a corner"));
    study = rockingCase();
    study->start.velocity[0] = 1;
    EXPECT_THAT(faultOf(*study), testing::HasSubstr("turns about a corner"));
    study = rockingCase();
    study->start.velocity[2] = 0.3;
    EXPECT_THAT(faultOf(*study), testing::HasSubstr("turns about a corner"));
    study = rockingCase();
    study->scene->contact.friction->mu = 0.05;
    EXPECT_THAT(faultOf(*study), testing::HasSubstr("does not slide"));
}

TEST(AccuracyCost, AFailedRunMakesThePointNoAnswer)
{
    Measurement good;
    good.value = 1.5;
    Measurement bad;
    bad.end = RunEnd::unsolved;
    bad.value = std::nan("");
    const AccuracyPoint point = summarise({}, {good, bad, good}, 1, 3);
    EXPECT_EQ(point.failed, 1);
    EXPECT_TRUE(std::isnan(point.medianError));
    EXPECT_EQ(cheapest({point}, 1e9, ErrorMeasure::worst), nullptr);
}

TEST(AccuracyCost, MedianAndWorstErrorAreRelativeToTheReference)
{
    std::vector<Measurement> runs(3);
    runs[0].value = 2.2;
    runs[1].value = 1.9;
    runs[2].value = 2.02;
    runs[0].cpuTime = 5;
    const AccuracyPoint point = summarise({}, runs, 2, 3);
    EXPECT_NEAR(point.medianError, 0.05, 1e-12);
    EXPECT_NEAR(point.worstError, 0.1, 1e-12);
    EXPECT_EQ(point.cpuTime, 0); // the median of 5, 0, 0
}

TEST(AccuracyCost, TheKneeIsWhereATighterToleranceGainsNothing)
{
    const auto curve = [](const std::vector<double>& errors)
    {
        std::vector<AccuracyPoint> points;
        for (const double error : errors)
        {
            points.push_back(pointWith({}, error, 1));
        }
        return points;
    };
    EXPECT_EQ(kneeOf(curve({1e-1, 1e-2, 1.5e-3, 1e-3, 1e-3})), std::optional<std::size_t>(2));
    EXPECT_EQ(kneeOf(curve({1e-3, 1e-3})), std::optional<std::size_t>(0));
    EXPECT_EQ(kneeOf(curve({1e-3, 1e-1, 1e-3, 1e-3})), std::optional<std::size_t>(2)); // luck is no knee
    EXPECT_EQ(kneeOf(curve({1e-2, 1e-4, 1e-6})), std::nullopt);
    EXPECT_EQ(kneeOf({}), std::nullopt);
    auto failing = curve({1e-1, 1e-3, 1e-3, 1e-3, 1e-3});
    failing[4].failed = 1; // out of the solver's reach
    EXPECT_EQ(kneeOf(failing), std::optional<std::size_t>(1));
    failing[2].failed = 1;
    EXPECT_EQ(kneeOf(failing), std::nullopt);
    const auto falling = curve({1e-6, 1e-8, 1e-10, 1e-13, 0}); // the last is the reference itself
    EXPECT_EQ(kneeOf(falling), std::nullopt);
    EXPECT_EQ(kneeOf(falling, 1e-9), std::optional<std::size_t>(2));
}

TEST(AccuracyCost, TheCheapestSettingIsTheFastestOfThoseWithinTheLevel)
{
    const std::vector<AccuracyPoint> points{
        pointWith(settingWith(0.1, 1), 0.04, 1), pointWith(settingWith(0.05, 1), 0.02, 2),
        pointWith(settingWith(0.05, 0.5), 0.01, 1.5), pointWith(settingWith(0.01, 1), 0.001, 9, 1)};
    EXPECT_EQ(cheapest(points, 0.05, ErrorMeasure::median), &points[0]);
    EXPECT_EQ(cheapest(points, 0.05, ErrorMeasure::worst), &points[2]);
    EXPECT_EQ(cheapest(points, 0.005, ErrorMeasure::median), nullptr); // it failed
}

TEST(AccuracyCost, ProfilesOfSolversAreThoseOfDolanAndMore)
{
    std::vector<AccuracyPoint> points;
    const auto add = [&](double deltaT, SolverType solver, double time, int failed = 0)
    {
        RunSetting setting = settingWith(deltaT, 1);
        setting.solver = solver;
        setting.tolerance = 1e-4;
        points.push_back(pointWith(setting, 0.1, time, failed));
    };
    using enum SolverType;
    add(0.1, interiorPoint, 2);
    add(0.1, augmentedLagrangian, 1);
    add(0.2, interiorPoint, 3);
    add(0.2, augmentedLagrangian, 1, 1);
    add(0.3, interiorPoint, 1, 1); // no solver solves it
    add(0.3, augmentedLagrangian, 1, 1);
    const std::vector<SolverProfile> profiles = solverProfiles(points, 1e-4);
    ASSERT_EQ(profiles.size(), 2u);
    EXPECT_EQ(profiles[0].problems, 2u);
    EXPECT_EQ(profiles[0].at(1), 0.5);
    EXPECT_EQ(profiles[0].at(2), 1);
    EXPECT_EQ(profiles[1].at(1), 0.5);
    EXPECT_EQ(profiles[1].at(1e9), 0.5);
    EXPECT_TRUE(solverProfiles(points, 1e-8).empty());
}

TEST(AccuracyCost, EachPhaseIsAProblemOfAProfileAndThoseNotTriedAreNotSolved)
{
    Measurement quick;
    quick.value = 1;
    quick.cpuTime = 1;
    Measurement slow = quick;
    slow.cpuTime = 3;
    Measurement bad = quick;
    bad.end = RunEnd::unsolved;
    RunSetting setting = settingWith(0.1, 1);
    setting.tolerance = 1e-4;
    std::vector<AccuracyPoint> points;
    setting.solver = SolverType::interiorPoint;
    points.push_back(summarise(setting, {quick, slow, quick, quick}, 1, 4));
    setting.solver = SolverType::augmentedLagrangian;
    points.push_back(summarise(setting, {slow, quick, bad, quick}, 1, 4));
    setting.solver = SolverType::gaussSeidel;
    points.push_back(summarise(setting, {bad, bad, bad}, 1, 4)); // given up
    EXPECT_EQ(points[2].planned, 4);
    EXPECT_EQ(points[2].runs, 3);
    const std::vector<SolverProfile> profiles = solverProfiles(points, 1e-4);
    ASSERT_EQ(profiles.size(), 3u);
    EXPECT_EQ(profiles[0].problems, 4u);
    EXPECT_EQ(profiles[0].at(1), 0.75);
    EXPECT_EQ(profiles[0].at(3), 1);
    EXPECT_EQ(profiles[1].at(1), 0.5);
    EXPECT_EQ(profiles[1].at(3), 0.75);
    EXPECT_EQ(profiles[2].at(1e9), 0);
}

TEST(AccuracyCost, RichardsonsExtrapolationFindsLimitAndOrder)
{
    const auto figure = [](double h) { return 3 + 0.5 * std::pow(h, 1.5); };
    const Extrapolation found = extrapolate(figure(0.4), figure(0.2), figure(0.1));
    EXPECT_NEAR(found.value, 3, 1e-12);
    EXPECT_NEAR(found.order, 1.5, 1e-12);
    EXPECT_NEAR(found.uncertainty, figure(0.1) - 3, 1e-12);
    const Extrapolation none = extrapolate(3.1, 2.9, 3.1); // no order
    EXPECT_EQ(none.order, 0);
    EXPECT_EQ(none.value, 3.1);
    EXPECT_NEAR(none.uncertainty, 0.2, 1e-12);
    EXPECT_EQ(extrapolate(3, 3, 3).value, 3);
}

TEST(AccuracyCost, ASweepHasAllCombinationsAndTheCasesOwnWhereItGivesNone)
{
    const AccuracySettings settings =
        read(quantities
             + "sweeps { s { quantity a; deltaT (0.2 0.1); theta (0.5 1); flowRule (associative "
               "nonAssociative); tolerance (1e-4); displacements (small); } }");
    const RunSetting ofCase = settingWith(9, 0.75);
    const Sweep& sweep = settings.sweeps.at(0).second;
    const std::vector<RunSetting> all = settingsOf(sweep, ofCase);
    EXPECT_EQ(all.size(), 8u);
    for (const RunSetting& setting : all)
    {
        EXPECT_EQ(setting.solver, SolverType::automatic);
        EXPECT_EQ(setting.tolerance, 1e-4);
        EXPECT_EQ(setting.displacements, Displacements::small);
    }
    EXPECT_EQ(settingsOf(Sweep{}, ofCase), std::vector<RunSetting>{ofCase});
    EXPECT_EQ(axisOf(sweep, QuantityKind::motion), SweepAxis::deltaT);
    EXPECT_EQ(sweep.phases, 20);
}

TEST(AccuracyCost, ASweepOverPointsASideGoesFromFewToMany)
{
    const AccuracySettings settings =
        read(quantities + "sweeps { s { quantity a; pointsPerSide (9 2 5); } }");
    SweepResult sweep;
    sweep.axis = axisOf(settings.sweeps.at(0).second, QuantityKind::limitAnalysis);
    EXPECT_EQ(sweep.axis, SweepAxis::pointsPerSide);
    for (const RunSetting& setting : settingsOf(settings.sweeps[0].second, {}))
    {
        EXPECT_EQ(jointPointsOf<3>(setting), setting.pointsPerSide);
        EXPECT_EQ(jointPointsOf<2>(setting), 0);
        sweep.points.push_back(pointWith(setting, 0.1, 1));
    }
    const auto curves = curvesOf(sweep);
    ASSERT_EQ(curves.size(), 1u);
    ASSERT_EQ(curves[0].size(), 3u);
    EXPECT_EQ(curves[0][0].setting.pointsPerSide, 2);
    EXPECT_EQ(curves[0][2].setting.pointsPerSide, 9);
}

TEST(AccuracyCost, CurvesHoldWhatDiffersAlongTheAxisAloneFromCoarseToFine)
{
    SweepResult sweep;
    sweep.axis = SweepAxis::deltaT;
    for (const double theta : {0.5, 1.0})
    {
        for (const double deltaT : {0.1, 0.4, 0.2})
        {
            sweep.points.push_back(pointWith(settingWith(deltaT, theta), 0.1, 1));
        }
    }
    const auto curves = curvesOf(sweep);
    ASSERT_EQ(curves.size(), 2u);
    ASSERT_EQ(curves[1].size(), 3u);
    EXPECT_EQ(curves[1][0].setting, settingWith(0.4, 1));
    EXPECT_EQ(curves[1][2].setting, settingWith(0.1, 1));
}

TEST(AccuracyCost, PairsDifferInOneThingAlone)
{
    RunSetting associative = settingWith(0.1, 1);
    associative.flowRule = FlowRule::associative;
    RunSetting other = associative;
    other.theta = 0.5;
    const std::vector<AccuracyPoint> points{pointWith(associative, 0.1, 1), pointWith(other, 0.1, 1),
                                            pointWith(settingWith(0.1, 1), 0.2, 2)};
    const std::vector<PointPair> pairs = flowRulePairs(points);
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0].first, &points[0]);
    EXPECT_EQ(pairs[0].second, &points[2]);
    EXPECT_TRUE(displacementPairs(points).empty());
    EXPECT_TRUE(jointPointsPairs(points).empty());
    EXPECT_TRUE(formulationPairs(points).empty());
    RunSetting coarse = associative;
    coarse.pointsPerSide = 2;
    RunSetting fine = coarse;
    fine.pointsPerSide = 9;
    const std::vector<AccuracyPoint> grids{pointWith(fine, 0.1, 1), pointWith(coarse, 0.1, 1)};
    const std::vector<PointPair> sides = jointPointsPairs(grids);
    ASSERT_EQ(sides.size(), 1u);
    EXPECT_EQ(sides[0].first, &grids[1]);
    EXPECT_EQ(sides[0].second, &grids[0]);
    RunSetting surface = other;
    surface.formulation = ContactFormulation::surface;
    const std::vector<AccuracyPoint> both{pointWith(surface, 0.1, 1), pointWith(other, 0.1, 1)};
    const std::vector<PointPair> formulations = formulationPairs(both);
    ASSERT_EQ(formulations.size(), 1u);
    EXPECT_EQ(formulations[0].first, &both[1]);
    EXPECT_EQ(formulations[0].second, &both[0]);
}

TEST(AccuracyCost, EverythingOnIsOneSettingWhateverLawAndDisplacementsASweepHas)
{
    const AccuracySettings settings =
        read(quantities
             + "sweeps { s { quantity a; flowRule (associative nonAssociative); displacements (large small); "
               "effects (asGiven automatic everything); } }");
    const std::vector<RunSetting> all = settingsOf(settings.sweeps.at(0).second, settingWith(0.1, 1));
    ASSERT_EQ(all.size(), 9u);
    std::vector<AccuracyPoint> points;
    for (const RunSetting& setting : all)
    {
        points.push_back(pointWith(setting, 0.1, 1));
        if (setting.effects == EffectSelection::everything)
        {
            EXPECT_EQ(setting.flowRule, FlowRule::nonAssociative);
            EXPECT_EQ(setting.displacements, Displacements::large);
        }
    }
    EXPECT_EQ(effectPairs(points).size(), 4u);
    const std::vector<PointPair> pairs = everythingPairs(points);
    ASSERT_EQ(pairs.size(), 8u);
    for (const PointPair& pair : pairs)
    {
        EXPECT_NE(pair.first->setting.effects, EffectSelection::everything);
        EXPECT_EQ(pair.second->setting.effects, EffectSelection::everything);
    }
    EXPECT_TRUE(everythingPairs({points[0], points[1]}).empty());
}

TEST(AccuracyCost, FaultyEntriesAreRefusedWithTheirLine)
{
    const auto lineOf = [](const std::string& text)
    {
        try
        {
            read(text);
        }
        catch (const FatalIOError& error)
        {
            return error.location().line;
        }
        return 0;
    };
    EXPECT_EQ(lineOf(quantities + "sweeps { s { quantity a; tolerance (1e-4 1e-8); } }"), 0);
    EXPECT_EQ(lineOf(quantities + "sweeps { s { quantity a;\ntolerance (1e-4 0); } }"), 3);
    EXPECT_EQ(lineOf(quantities + "sweeps { s { quantity a;\ntolerances (1e-4); } }"), 3);
    EXPECT_EQ(lineOf(quantities + "sweeps { s { quantity a;\n\ntheta (0.4); } }"), 4);
    EXPECT_EQ(lineOf(quantities + "sweeps { s { quantity a;\nflowRule (plastic); } }"), 3);
    EXPECT_EQ(lineOf(quantities + "sweeps { s { quantity a;\ndeltaT (1 1); } }"), 3);
    EXPECT_EQ(lineOf(quantities + "sweeps\n{ }"), 2);
}
