// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "core/Error.h"
#include "dynamics/GroundMotion.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
        motion.file = file;
        motion.format = RecordFormat::csv;
        return motion;
    }
};

} // namespace

TEST(GroundMotion, AddsItsComponents)
{
    GroundMotion motion;
    motion.components.push_back({{1, 0, 0}, std::make_shared<ConstantAcceleration>(3), ""});
    motion.components.push_back({{0, 1, 0}, std::make_shared<RectangularPulse>(PulseShape{2, 0.5, 1}), ""});
    EXPECT_EQ(groundAcceleration(motion, 1), Eigen::Vector3d(3, 2, 0));
    EXPECT_EQ(meanGroundAcceleration(motion, 0.75, 1.25), Eigen::Vector3d(3, 1, 0));
    EXPECT_EQ(groundAcceleration({}, 1), Eigen::Vector3d::Zero());
}

TEST(GroundMotion, SummaryNamesDirectionPeakAndDuration)
{
    GroundMotion motion;
    EXPECT_EQ(summary(motion), "Ground motion: none\n");
    motion.components.push_back(
        {{0, 1, 0}, std::make_shared<RectangularPulse>(PulseShape{-9.80665, 0.5, 1}), ""});
    EXPECT_THAT(summary(motion), testing::AllOf(HasSubstr("along (0 1 0)"), HasSubstr("9.80665 m/s2 = 1 g"),
                                                HasSubstr("0.5 s, from 1 s to 1.5 s")));
    motion.components = {{{1, 0, 0}, std::make_shared<ConstantAcceleration>(3), ""}};
    EXPECT_THAT(summary(motion), HasSubstr("unlimited"));
}

TEST_F(GroundMotionTest, RecordIsScaledPaddedAndMoved)
{
    RecordMotion motion = record();
    motion.scale = 2;
    motion.start = 10;
    motion.paddingBefore = 1;
    const auto component = recordComponent(motion);
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
    const auto component = recordComponent(motion);
    EXPECT_DOUBLE_EQ(component.acceleration->peak(), 5);
    EXPECT_DOUBLE_EQ(component.acceleration->at(2), -5 * 1.25 / 1.75);
}

TEST_F(GroundMotionTest, RecordEchoesItsPeakDurationAndUnit)
{
    GroundMotion motion;
    motion.components.push_back(recordComponent(record()));
    const std::string text = summary(motion);
    EXPECT_THAT(text, HasSubstr("1 gal = 0.01 m/s2"));
    EXPECT_THAT(text, HasSubstr("PGA         2 m/s2"));
    EXPECT_THAT(text, HasSubstr("from a PGA of 200 gal"));
    EXPECT_THAT(text, HasSubstr("duration    3 s"));
    EXPECT_THAT(text, HasSubstr(file.string()));
}

TEST_F(GroundMotionTest, RecordThatCannotBeTreatedAsAskedIsNamed)
{
    std::ofstream(file) << "time [s],north [gal]\n0,0\n1,0\n";
    RecordMotion motion = record();
    motion.peakAcceleration = 5;
    EXPECT_THROW(recordComponent(motion), FatalIOError);
    motion = record();
    motion.baseline = Baseline::quadratic;
    EXPECT_THROW(recordComponent(motion), FatalIOError);
    motion = record();
    motion.interpolation = Interpolation::akima;
    EXPECT_THROW(recordComponent(motion), FatalIOError);
    motion = record();
    motion.paddingAfter = -1;
    EXPECT_THROW(recordComponent(motion), FatalIOError);
}
