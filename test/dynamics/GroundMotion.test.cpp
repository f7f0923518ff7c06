// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Motions of the ground: their dictionaries, histories and plausibility.
#include "effects/GroundMotion.h"

#include "../ReportOf.h"
#include "core/Error.h"
#include "dynamics/GroundMotionPlausibility.h"
#include "effects/RecordPlausibility.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include <unistd.h>

using namespace drystone;
using testing::HasSubstr;

namespace
{

class GroundMotionTest : public testing::Test
{
protected:
    std::filesystem::path file =
        std::filesystem::temp_directory_path() / fmt::format("drystone_motion_{}.csv", getpid());

    void SetUp() override { std::ofstream(file) << "time [s],north [gal]\n0,0\n1,200\n2,-100\n3,0\n"; }
    void TearDown() override { std::filesystem::remove(file); }

    RecordMotion record() const
    {
        RecordMotion motion;
        motion.file = file.string();
        motion.format = RecordFormat::csv;
        return motion;
    }
};

} // namespace

TEST(GroundMotion, AddsItsComponents)
{
    GroundMotion motion;
    motion.components.push_back({{std::make_shared<ConstantAcceleration>(3), ""}, {1, 0, 0}});
    motion.components.push_back({{std::make_shared<RectangularPulse>(PulseShape{2, 0.5, 1}), ""}, {0, 1, 0}});
    EXPECT_EQ(groundAcceleration(motion, 1), Eigen::Vector3d(3, 2, 0));
    EXPECT_EQ(meanGroundAcceleration(motion, 0.75, 1.25), Eigen::Vector3d(3, 1, 0));
    EXPECT_EQ(groundAcceleration({}, 1), Eigen::Vector3d::Zero());
}

TEST(GroundMotion, SummaryNamesDirectionPeakAndDuration)
{
    GroundMotion motion;
    EXPECT_EQ(summary(motion, 9.81), "Ground motion: none\n");
    motion.components.push_back(
        {{std::make_shared<RectangularPulse>(PulseShape{-4.905, 0.5, 1}), ""}, {0, 1, 0}});
    EXPECT_THAT(summary(motion, 9.81),
                testing::AllOf(HasSubstr("along (0 1 0)"), HasSubstr("4.905 m/s2 = 0.5 g\n"),
                               HasSubstr("0.5 s, from 1 s to 1.5 s")));
    motion.components = {{{std::make_shared<ConstantAcceleration>(3), ""}, {1, 0, 0}}};
    EXPECT_THAT(summary(motion, 9.81), HasSubstr("unlimited"));
    EXPECT_THAT(summary(motion, 0), HasSubstr("PGA         3 m/s2\n"));
}

TEST_F(GroundMotionTest, RowsThatARecordLacksAreQuestionedAndStillnessIsNot)
{
    // Waves of 1 m/s2 at 100 Hz for 0.4 s, with what is requested in place of the rows from 0.1 to 0.3 s.
    const auto doubtsWithMiddle = [this](int leftOut, bool isStill)
    {
        std::ofstream rows(file);
        rows << "time [s],a [m/s2]\n";
        for (int i = 0; i <= 40; ++i)
        {
            const bool isMiddle = i > 10 && i <= 10 + leftOut;
            if (!isMiddle)
            {
                const bool isBeside = isStill && (i == 10 || i == 11 + leftOut);
                rows << fmt::format("{},{}\n", 0.01 * i, isBeside ? 0.0 : std::sin(2.5 * i + 0.3));
            }
        }
        rows.close();
        RecordMotion motion = record();
        const GroundMotion::Component component{recordedAcceleration(motion, ""), {1, 0, 0}};
        std::string text;
        for (const Doubt& doubt : doubtsAboutRecord(component, {}))
        {
            text += doubt.text + "\n";
        }
        return text;
    };
    EXPECT_THAT(
        doubtsWithMiddle(20, false),
        HasSubstr("no value between 0.1 and 0.31 s of the motion, 21 times its usual interval of 0.01 s"));
    EXPECT_THAT(doubtsWithMiddle(20, true), testing::Not(HasSubstr("no value")));
    EXPECT_THAT(doubtsWithMiddle(8, false), testing::Not(HasSubstr("no value"))); // digitised by hand
    EXPECT_THAT(doubtsWithMiddle(0, false), testing::Not(HasSubstr("no value")));
}

TEST(GroundMotion, AnEndBeforeThatOfTheMotionIsQuestionedWhereThereIsAMotion)
{
    const auto doubts = [](const GroundMotion& motion, double startTime, double endTime)
    {
        TimeControls controls;
        controls.startTime = startTime;
        controls.endTime = endTime;
        return doubtsAboutTimes(motion, controls, {});
    };
    GroundMotion still;
    EXPECT_TRUE(doubts(still, -1, -0.95).empty());
    GroundMotion constant;
    constant.components.push_back({{std::make_shared<ConstantAcceleration>(3), ""}, {1, 0, 0}});
    EXPECT_TRUE(doubts(constant, -1, -0.95).empty());
    GroundMotion pulse;
    pulse.components.push_back({{std::make_shared<RectangularPulse>(PulseShape{2, 0.5, -1}), ""}, {0, 1, 0}});
    EXPECT_TRUE(doubts(pulse, -1, -0.5).empty());
    ASSERT_EQ(doubts(pulse, -1, -0.6).size(), 1u);
    EXPECT_THAT(doubts(pulse, -1, -0.6).front().text, HasSubstr("lasts until -0.5 s"));
}

TEST(GroundMotion, StepsCoarserThanAPulseOfATableAreQuestionedAsThoseOfARectangularPulse)
{
    const auto doubts = [](std::shared_ptr<const GroundAcceleration> history, double deltaT, bool adjust)
    {
        GroundMotion motion;
        motion.components.push_back({{std::move(history), ""}, {1, 0, 0}});
        TimeControls controls;
        controls.endTime = 1;
        controls.deltaT = deltaT;
        controls.adjustTimeStep = adjust;
        return doubtsAboutTimes(motion, controls, {});
    };
    const auto table = []
    {
        return std::shared_ptr<const GroundAcceleration>(
            tabulatedAcceleration({0, 0.021, 0.021, 0.031, 0.031, 0.4}, {0, 0, 5, 5, 0, 0},
                                  Interpolation::linear, OutOfBounds::zero));
    };
    const auto pulse = std::make_shared<RectangularPulse>(PulseShape{5, 0.01, 0.021});
    ASSERT_EQ(doubts(pulse, 0.05, false).size(), 1u);
    ASSERT_EQ(doubts(table(), 0.05, false).size(), 1u);
    EXPECT_EQ(doubts(table(), 0.05, false).front().text, doubts(pulse, 0.05, false).front().text);
    EXPECT_TRUE(doubts(table(), 0.05, true).empty());
    EXPECT_TRUE(doubts(table(), 0.002, false).empty());
}

TEST_F(GroundMotionTest, RecordIsScaledPaddedAndMoved)
{
    RecordMotion motion = record();
    motion.scale = 2;
    motion.start = 10;
    motion.padding[0] = 1;
    const auto component = recordedAcceleration(motion, "");
    EXPECT_EQ(component.acceleration->at(10.5), 0);
    EXPECT_DOUBLE_EQ(component.acceleration->at(12), 4);
    EXPECT_DOUBLE_EQ(component.acceleration->at(13), -2);
    EXPECT_EQ(component.acceleration->at(20), 0);
    EXPECT_DOUBLE_EQ(component.acceleration->end(), 14);
}

TEST_F(GroundMotionTest, RecordIsScaledToAPeakAfterItsBaselineIsTaken)
{
    RecordMotion motion = record();
    motion.peakAcceleration = 5;
    motion.baseline = Baseline::constant; // mean 0.25 m/s2 of the four values
    const auto component = recordedAcceleration(motion, "");
    EXPECT_DOUBLE_EQ(component.acceleration->peak(), 5);
    EXPECT_DOUBLE_EQ(component.acceleration->at(2), -5 * 1.25 / 1.75);
}

TEST_F(GroundMotionTest, RecordEchoesItsPeakDurationAndUnit)
{
    GroundMotion motion;
    motion.components.push_back({recordedAcceleration(record(), ""), Eigen::Vector3d::UnitX()});
    const std::string text = summary(motion, 9.81);
    EXPECT_THAT(text, HasSubstr("1 gal = 0.01 m/s2"));
    EXPECT_THAT(text, HasSubstr("PGA         2 m/s2"));
    EXPECT_THAT(text, HasSubstr("of a PGA of 200 gal"));
    EXPECT_THAT(text, HasSubstr("duration    3 s"));
    EXPECT_THAT(text, HasSubstr(file.string()));
}

TEST_F(GroundMotionTest, RecordWithoutUnitSaysThatItIsTakenAsSI)
{
    std::ofstream(file) << "time,north\n0,0\n1,2\n2,-1\n3,0\n";
    GroundMotion motion;
    motion.components.push_back({recordedAcceleration(record(), ""), Eigen::Vector3d::UnitX()});
    EXPECT_THAT(summary(motion, 9.81),
                testing::AllOf(HasSubstr("unit        m/s2, assumed"), HasSubstr("PGA         2 m/s2")));
}

TEST_F(GroundMotionTest, RecordThatCannotBeTreatedAsAskedIsNamed)
{
    std::ofstream(file) << "time [s],north [gal]\n0,0\n1,0\n";
    RecordMotion motion = record();
    motion.peakAcceleration = 5;
    EXPECT_THROW(recordedAcceleration(motion, ""), FatalIOError);
    motion = record();
    motion.baseline = Baseline::quadratic;
    EXPECT_THROW(recordedAcceleration(motion, ""), FatalIOError);
    motion = record();
    motion.interpolation = Interpolation::akima;
    EXPECT_THROW(recordedAcceleration(motion, ""), FatalIOError);
    motion = record();
    motion.padding[1] = -1;
    EXPECT_THROW(recordedAcceleration(motion, ""), FatalIOError);
}

namespace
{

GroundMotion motionOf(const std::string& text, const std::filesystem::path& caseDirectory = "")
{
    return readGroundMotion(Dictionary::readString(text, "constant/groundMotion"), caseDirectory, 2);
}

std::string refusalOf(const std::string& text, const std::filesystem::path& caseDirectory = "")
{
    return reportOf([&] { motionOf(text, caseDirectory); });
}

} // namespace

TEST(GroundMotionDictionary, ReadsEachTypeOfAcceleration)
{
    const auto at = [](const std::string& acceleration, double time)
    {
        return groundAcceleration(motionOf("direction (2 0 0); acceleration { " + acceleration + " }"), time)
            .x();
    };
    EXPECT_EQ(at("type constant; value 3.0;", 7), 3);
    EXPECT_EQ(at("type constant; value [0 1 -2 0 0 0 0] 3.0;", 7), 3);
    EXPECT_EQ(at("type rectangularPulse; amplitude 2; duration 0.5;", 0.4), 2);
    EXPECT_EQ(at("type rectangularPulse; amplitude 2; duration 0.5; start 1;", 0.4), 0);
    EXPECT_NEAR(at("type halfSine; amplitude -2; duration 0.5;", 0.25), -2, 1e-15);
    EXPECT_NEAR(at("type sine; amplitude 2; duration 0.5;", 0.375), -2, 1e-15);
    EXPECT_NEAR(at("type sine; amplitude 2; duration 0.5; cycles 10;", 0.0125), 2, 1e-14);
    EXPECT_EQ(at("type table; values ((0 0) (1 4));", 0.25), 1);
    EXPECT_EQ(at("type table; values ((0 0) (1 4));", 2), 4);
    EXPECT_EQ(at("type table; values ((0 0) (1 4)); outOfBounds zero;", 2), 0);
}

TEST(GroundMotionDictionary, ReadsSeveralDirections)
{
    const GroundMotion motion =
        motionOf("components { along { direction (3 4); acceleration { type constant; value 5; } "
                 "} up { direction (0 1 0); acceleration { type constant; value 1; } } }");
    EXPECT_TRUE(groundAcceleration(motion, 0).isApprox(Eigen::Vector3d(3, 5, 0)));
}

TEST(GroundMotionDictionary, ADirectionMayHaveAnyLength)
{
    const GroundMotion motion = motionOf("direction (-1e300 0 0); acceleration { type constant; value 2; }");
    EXPECT_EQ(groundAcceleration(motion, 0), Eigen::Vector3d(-2, 0, 0));
}

TEST(GroundMotionDictionary, SaysWhatIsWrongAndWhere)
{
    EXPECT_THAT(refusalOf("direction (1 0 0);\nacceleration { type constnt; value 3; }"),
                testing::AllOf(
                    HasSubstr("Unknown ground acceleration type constnt"), HasSubstr("Did you mean constant"),
                    HasSubstr("constant halfSine record rectangularPulse sine table"), HasSubstr("line 2")));
    EXPECT_THAT(refusalOf("direction (1 0 0);"), HasSubstr("both direction and acceleration"));
    EXPECT_THAT(refusalOf(""), HasSubstr("direction and acceleration"));
    EXPECT_THAT(refusalOf("direction (0 0 0); acceleration { type constant; value 3; }"),
                testing::AllOf(HasSubstr("no length"), HasSubstr("`direction (1 0 0);`")));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type constant; value 3; duration 1; }"),
                HasSubstr("duration"));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type constant; }"), HasSubstr("value"));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type constant; value [0 1 0 0 0 0 0] 3; }"),
                HasSubstr("[0 1"));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type halfSine; amplitude 3; duration -1; }"),
                HasSubstr("duration"));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type constant; value nan; }"), HasSubstr("nan"));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type table; values ((1 0) (0 1)); }"),
                testing::AllOf(HasSubstr("must increase"), HasSubstr("line 1")));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type table; }"),
                HasSubstr("either values or a file"));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type table; file nowhere; }", "/tmp"),
                HasSubstr("/tmp/nowhere"));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type record; file nowhere; }", "/tmp"),
                HasSubstr("/tmp/nowhere"));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type record; file x; unit m/s; }"),
                HasSubstr("'m/s'"));
    EXPECT_THAT(
        refusalOf("direction (1 0 0); acceleration { type record; file x; scale 2; peakAcceleration 3; }"),
        HasSubstr("remove one"));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type record; file x; format AT2; }"),
                HasSubstr("PEER_AT2"));
    // What only files of another format have.
    for (const std::string key : {"timeStep 0.02;", "timeColumn time;", "accelerationColumn 0;"})
    {
        EXPECT_THAT(
            refusalOf("direction (1 0 0); acceleration { type record; file x; format PEER_AT2; " + key
                      + " }"),
            testing::AllOf(HasSubstr("remove " + key.substr(0, key.find(' '))), HasSubstr("`format csv;`")));
    }
}

TEST_F(GroundMotionTest, DictionaryReadsARecordRelativeToTheCase)
{
    const std::string start =
        "direction (1 0 0); acceleration { type record; file " + file.filename().string() + "; format csv; ";
    const auto folder = file.parent_path();
    EXPECT_DOUBLE_EQ(groundAcceleration(motionOf(start + "}", folder), 1).x(), 2);
    EXPECT_DOUBLE_EQ(
        groundAcceleration(motionOf(start + "timeColumn 0; accelerationColumn north; }", folder), 1).x(), 2);
    EXPECT_DOUBLE_EQ(groundAcceleration(motionOf(start + "unit cm/s2; scale 0.5; }", folder), 1).x(), 1);
    EXPECT_DOUBLE_EQ(groundAcceleration(motionOf(start + "padding (1 0); baseline none; }", folder), 2).x(),
                     2);
    EXPECT_THAT(refusalOf(start + "unit g; }", folder), HasSubstr("says it is in gal"));
    EXPECT_THAT(refusalOf(start + "accelerationColumn south; }", folder), HasSubstr("south"));
}

TEST_F(GroundMotionTest, DictionaryReadsATableFromAListOrColumns)
{
    const std::string text =
        "direction (1 0 0); acceleration { type table; file \"" + file.string() + "\"; }";
    std::ofstream(file) << "// drawn by hand\n3\n(\n(0 0)\n(1 4)\n(2 0)\n)\n";
    EXPECT_EQ(groundAcceleration(motionOf(text), 0.5).x(), 2);
    std::ofstream(file) << "0 0\n1 4\n2 0\n";
    EXPECT_EQ(groundAcceleration(motionOf(text), 0.5).x(), 2);
    std::ofstream(file) << "(\n(0 0)\n(1 x)\n)\n";
    EXPECT_THAT(refusalOf(text), testing::AllOf(HasSubstr(file.string()), HasSubstr("line 3")));
    std::ofstream(file) << "0 0\n1 x\n";
    EXPECT_THAT(refusalOf(text), testing::AllOf(HasSubstr(file.string()), HasSubstr("line 2")));
    std::ofstream(file) << "((0 0)(2 1)(1 1))";
    EXPECT_THAT(refusalOf(text), testing::AllOf(HasSubstr(file.string()), HasSubstr("must increase")));
    EXPECT_THAT(refusalOf("direction (1 0 0); acceleration { type table; file \"/dev/null\"; }"),
                testing::AllOf(HasSubstr("/dev/null"), HasSubstr("not an ordinary file")));
}

TEST(GroundMotionDictionary, EveryTypeDescribesItsKeys)
{
    for (const auto& alternative : groundAccelerationTypes().describe())
    {
        EXPECT_FALSE(alternative.summary.empty());
        EXPECT_FALSE(alternative.members.empty()) << alternative.name;
    }
    const std::string text =
        annotatedDictionary("groundMotion", "How the ground moves.", describeOptions<GroundMotionSettings>());
    EXPECT_THAT(text, testing::AllOf(HasSubstr("rectangularPulse"), HasSubstr("peakAcceleration")));
}

// What is out of the plane would move nothing, or be a part of the motion less.
TEST(GroundMotionFile, ADirectionOutOfThePlaneIsRefusedThere)
{
    for (const std::string direction : {"(0 0 1)", "(1 0 1)"})
    {
        const std::string ofOne = "direction " + direction + "; acceleration { type constant; value 1; }";
        for (const std::string& text : {ofOne, "components { up { " + ofOne + " } }"})
        {
            const Dictionary dictionary = Dictionary::readString(text, "constant/groundMotion");
            EXPECT_EQ(readGroundMotion(dictionary, ".", 3).components.size(), 1u);
            EXPECT_THAT(
                [&] { readGroundMotion(dictionary, ".", 2); },
                testing::ThrowsMessage<FatalError>(HasSubstr("third component of direction must be 0")));
        }
    }
}

// Upwards in the plane, level in space if a zero were added.
TEST(GroundMotionFile, ADirectionOfTwoNumbersIsRefusedInSpace)
{
    const std::string ofOne = "direction (0 1); acceleration { type constant; value 1; }";
    for (const std::string& text : {ofOne, "components { east { " + ofOne + " } }"})
    {
        const Dictionary dictionary = Dictionary::readString(text, "constant/groundMotion");
        EXPECT_EQ(readGroundMotion(dictionary, ".", 2).components[0].direction, Eigen::Vector3d(0, 1, 0));
        EXPECT_THAT([&] { readGroundMotion(dictionary, ".", 3); },
                    testing::ThrowsMessage<FatalError>(HasSubstr("Give x, y and z (up)")));
    }
}
