// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The envelope of a moving load, and its worst place.
#include "functionObjects/LoadEnvelope.h"
#include "functionObjects/LoadEnvelopeFiles.h"

#include "core/WholeFile.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <unistd.h>

using namespace drystone;

namespace
{

LimitAnalysisCase<2> solvedCase()
{
    LimitAnalysisCase<2> structure;
    const auto add = [&](double distance, int block, CollapseStatus status, double alpha)
    {
        structure.loads.positions.push_back({distance,
                                             {distance, 1},
                                             {block},
                                             {{{distance, 0.5}, block, 1}, {{distance - 1, 0.5}, 0, 0.5}},
                                             {}});
        structure.envelope.push_back({status, alpha});
    };
    add(0, 0, CollapseStatus::unbounded, 0);
    add(0.5, 0, CollapseStatus::optimal, 40);
    add(1, 0, CollapseStatus::optimal, 7);
    add(1, 1, CollapseStatus::optimal, 5); // the other side of a joint
    add(1.5, 1, CollapseStatus::optimal, 6);
    add(2, 1, CollapseStatus::optimal, 5 * (1 - 1e-9)); // as good as the same
    return structure;
}

TEST(LoadEnvelope, StatesWhereTheAxlesOfTheWorstPlaceStand)
{
    const std::vector<LoadPlace> places = loadPlaces(solvedCase(), LimitAnalysis());
    ASSERT_EQ(places.size(), 2u);
    EXPECT_EQ(places[0].place, Vector<3>(1, 0.5, 0));
    EXPECT_EQ(places[0].block, 1);
    EXPECT_EQ(places[0].part, 1);
    EXPECT_EQ(places[1].place, Vector<3>(0, 0.5, 0));
    EXPECT_EQ(places[1].part, 0.5);
    EXPECT_TRUE(loadPlaces(LimitAnalysisCase<2>(), LimitAnalysis()).empty());
}

TEST(LoadEnvelope, TakesTheLowerSideOfAJointAndTheFirstOfEqualPlaces)
{
    const LimitAnalysisCase<2> structure = solvedCase();
    const std::vector<EnvelopePoint> points = envelopeOf(structure);
    ASSERT_EQ(points.size(), 5u);
    EXPECT_TRUE(std::isinf(points[0].alpha));
    EXPECT_EQ(points[2].alpha, 5);
    EXPECT_EQ(points[2].position, 3u);
    const auto worst = worstPlace(structure);
    ASSERT_TRUE(worst);
    EXPECT_EQ(worst->distance, 1);
    EXPECT_EQ(placeText(structure, *worst), "(1 1)");
    EXPECT_FALSE(worstPlace(LimitAnalysisCase<2>{}));
}

// The multiplier of the side that has one was dropped for that of the other, and the log named the worst
// place as if all had one.
TEST(LoadEnvelope, PlacesWithoutACollapseByCoulombsLawAreWarnedOf)
{
    LimitAnalysisCase<2> structure = solvedCase();
    structure.envelope[0] = {CollapseStatus::upperBound, std::numeric_limits<double>::infinity()};
    std::swap(structure.envelope[2], structure.envelope[3]);
    structure.envelope[3] = {CollapseStatus::upperBound, 9};
    EXPECT_EQ(envelopeOf(structure)[2].alpha, 5);
    const auto warning = [&]
    {
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        printEnvelope(structure);
        testing::internal::GetCapturedStdout();
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_NE(
        warning().find("At 2 of these places, 0, 1 m along the path, no collapse by Coulomb's law was found, "
                       "where by the associative law alpha <= 9: the worst place is that of the others"),
        std::string::npos);
    structure = solvedCase();
    EXPECT_EQ(warning(), "");
}

// Nothing was said of the places, not even of those that are left out.
TEST(LoadEnvelope, SaysThatNoPlaceCollapses)
{
    LimitAnalysisCase<2> structure = solvedCase();
    structure.loads.placesLeftOut = {-1};
    for (PositionResult& position : structure.envelope)
    {
        position = {CollapseStatus::unbounded, 0};
    }
    EXPECT_EQ(envelopeMeaning(structure),
              std::vector<std::string>{
                  "Moving load: 5 places, at all of them no load makes the structure collapse"});
    testing::internal::CaptureStdout();
    printEnvelope(structure);
    const std::string log = testing::internal::GetCapturedStdout();
    EXPECT_NE(log.find("Moving load: 5 places"), std::string::npos);
    EXPECT_NE(log.find("left out, where no axle meets a block that can move: 1 of 6"), std::string::npos);
    EXPECT_EQ(
        envelopeMeaning(solvedCase()),
        (std::vector<std::string>{"Moving load: 5 places, at 1 of them no load makes the structure collapse",
                                  "Worst place: 1 m along the path, from (1 1), on block 1"}));
    EXPECT_TRUE(envelopeMeaning(LimitAnalysisCase<2>{}).empty());
}

TEST(LoadEnvelope, NamesThePlacesThatAreLeftOut)
{
    LimitAnalysisCase<2> structure = solvedCase();
    testing::internal::CaptureStdout();
    printEnvelope(structure);
    EXPECT_EQ(testing::internal::GetCapturedStdout().find("left out"), std::string::npos);
    structure.loads.placesLeftOut = {-1, -0.5, 2.5};
    testing::internal::CaptureStdout();
    printEnvelope(structure);
    EXPECT_NE(testing::internal::GetCapturedStdout().find("left out, where no axle meets a block that can "
                                                          "move: 3 of 8, -1 to -0.5, 2.5 m along the path"),
              std::string::npos);
}

TEST(LoadEnvelope, IsWrittenAndTakenAwayAgain)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("drystone-envelope-{}", ::getpid());
    std::filesystem::create_directories(folder);
    writeEnvelope(folder, solvedCase(), "arch");
    EXPECT_EQ(contentOfFile(folder / "movingLoad.dat"),
              "# distance[m] x[m] y[m] block[-] alpha[-] status[-]\n0 0 1 0 inf 2\n0.5 0.5 1 0 40 0\n"
              "1 1 1 0 7 0\n1 1 1 1 5 0\n1.5 1.5 1 1 6 0\n2 2 1 1 4.999999995 0\n");
    EXPECT_NE(contentOfFile(folder / "movingLoad.svg").find("worst place 1 m"), std::string::npos);
    writeEnvelope(folder, LimitAnalysisCase<2>{}, "arch");
    EXPECT_TRUE(std::filesystem::is_empty(folder));
    std::filesystem::remove_all(folder);
}

} // namespace
