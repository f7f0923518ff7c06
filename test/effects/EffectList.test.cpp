// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a new effect takes: a made-up one, which no library knows, is read, checked, computed, accounted for,
/// saved and logged, by its two files (GroundSpring.h) and a line in the list.
#include "../ReportOf.h"
#include "../dynamics/Scenes.h"
#include "GroundSpring.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include <unistd.h>

using namespace drystone;
using namespace drystone::scenes;
using testing::HasSubstr;

namespace
{

std::vector<EffectType<2>> extendedList()
{
    std::vector<EffectType<2>> types = effectTypes<2>();
    types.push_back(groundSpringType());
    return types;
}

/// A block of 1 m x 1 m in the air above the ground.
Assembly<2> blockInTheAir()
{
    Assembly<2> assembly = ground(-5, 5);
    assembly.blocks.push_back(rectangle(0, 3, 1, 1));
    return assembly;
}

/// Without gravity, as constant/contactProperties says.
DynamicCase<2> sceneWith(const std::string& contactProperties, double theta = 0.5)
{
    DynamicCase<2> scene = sceneOf(blockInTheAir(), {.theta = theta, .gravity = {0, 0}});
    CaseEffects<2> read(extendedList());
    readOptions(Dictionary::readString(contactProperties, "constant/contactProperties"), read);
    read.contact.locations =
        EntryLocations(Dictionary::readString(contactProperties, "constant/contactProperties"));
    scene.effects =
        makeEffects(read, {scene, read.contact, {}, scene.displacements(), theta, SolverType::automatic});
    scene.effectNames = effectNames(read);
    return scene;
}

std::string report(const std::string& contactProperties)
{
    return reportOf([&] { sceneWith(contactProperties); });
}

} // namespace

// The trapezoidal rule turns the phase by 2 atan(w dt/2) a step; backward Euler by atan(w dt), and divides
// the amplitude by sqrt(1 + (w dt)^2).
TEST(EffectList, AMadeUpSpringSwingsWithThePeriodOfItsMassAndStiffness)
{
    constexpr double timeStep = 1e-3;
    constexpr double velocity = 0.1;
    for (const double theta : {0.5, 1.0})
    {
        const DynamicCase<2> scene = sceneWith("groundSpring { block 1; stiffness 1e5; }", theta);
        const double frequency = std::sqrt(1e5 / scene.mass[0]);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        motion.state.velocity << velocity, 0, 0;
        motion.energy.kinetic = motion.energy.opening = 0.5 * scene.mass[0] * velocity * velocity;
        const double turn =
            theta == 0.5 ? 2 * std::atan(0.5 * frequency * timeStep) : std::atan(frequency * timeStep);
        const double decay = theta == 0.5 ? 1 : 1 / std::sqrt(1 + std::pow(frequency * timeStep, 2));
        const int steps = static_cast<int>(2 * std::numbers::pi / turn); // about one period, 0.84 s
        EXPECT_NEAR(steps * timeStep, 2 * std::numbers::pi / frequency, 2 * timeStep);
        for (int step = 1; step <= steps; ++step)
        {
            ASSERT_TRUE(advance(scene, motion, timeStep)) << "step " << step;
            const double amplitude = velocity / frequency * std::pow(decay, step);
            ASSERT_NEAR(motion.state.placements[1].translation.x(), amplitude * std::sin(step * turn),
                        1e-11 * velocity / frequency)
                << "theta " << theta << " step " << step;
        }
        EXPECT_LT(relativeImbalance(motion.energy), 1e-11);
        EXPECT_EQ(motion.effectStates.back().numbers, std::vector<double>{1.0 * steps});
        const double lost = motion.energy.algorithmicLoss;
        EXPECT_NEAR(lost, (1 - std::pow(decay, 2 * steps)) * motion.energy.opening,
                    1e-10 * motion.energy.opening);
    }
}

TEST(EffectList, AMadeUpSpringIsNamedSavedAndWritten)
{
    const DynamicCase<2> scene =
        sceneWith("groundSpring { block 1; stiffness 1e5; } damping { massProportional 1; }");
    EXPECT_THAT(scene.effectNames.simulated, testing::ElementsAre("damping", "groundSpring"));
    ASSERT_EQ(scene.effects.size(), 2u);
    const Effect<2>& spring = *scene.effects.back();
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    ASSERT_TRUE(advance(scene, motion, 0.01));
    ASSERT_TRUE(advance(scene, motion, 0.01));
    EffectArrays saved;
    spring.save(motion.effectStates.back(), saved);
    EffectState again;
    spring.restore(saved, again);
    EXPECT_EQ(again.numbers, std::vector<double>{2});
    EXPECT_EQ(spring.startText(scene, again), "Spring: 100000 N/m at block 1");
    ASSERT_EQ(spring.blockFields(again).size(), 1u);
    EXPECT_EQ(spring.blockFields(again)[0].name, "stepsOnSpring");
}

TEST(EffectList, FaultsOfAMadeUpSpringAreToldWithTheirPlace)
{
    EXPECT_EQ(report("groundSpring { block 1; stiffness 1e5; }"), "no error");
    EXPECT_THAT(report("\ngroundSpring { block 1; stiffness -1; }"),
                testing::AllOf(HasSubstr("groundSpring/stiffness"), HasSubstr("line 2.")));
    EXPECT_THAT(report("groundSpring\n{\n    block 0;\n    stiffness 1;\n}"),
                testing::AllOf(HasSubstr("no free block 0"), HasSubstr("groundSpring/block at line 3.")));
    EXPECT_THAT(report("groundSprung { block 1; stiffness 1e5; }"), HasSubstr("groundSpring"));
    // Drystone's own list does not know it.
    CaseEffects<2> read;
    EXPECT_THROW(readOptions(Dictionary::readString("groundSpring { block 1; stiffness 1; }"), read),
                 FatalIOError);
}

TEST(EffectList, ACaseOnDiskIsReadWithAnExtendedList)
{
    const std::filesystem::path directory =
        std::filesystem::temp_directory_path() / fmt::format("drystone_effectList_{}", getpid());
    std::filesystem::create_directories(directory / "constant");
    std::ofstream(directory / "constant/contactProperties")
        << "friction { type Coulomb; mu 0.5; }\ngroundSpring { block 1; stiffness 2; }\n";
    const CaseEffects<2> read = readCaseEffects(directory, extendedList());
    EXPECT_EQ(read.contact.friction->mu, 0.5);
    EXPECT_TRUE(read.declared.back().isGiven(read.contact));
    EXPECT_EQ(read.contact.locations.of("groundSpring/stiffness").line, 2);
    EXPECT_EQ(read.contact.locations.of("joints/3-7").line, read.contact.locations.of("").line);
    EXPECT_THROW(readCaseEffects<2>(directory), FatalIOError);
    std::filesystem::remove_all(directory);
}

TEST(EffectList, WhatIsAbsentIsNotInTheList)
{
    const Structure<2> structure;
    const auto effectsOf = [&structure](const std::string& text)
    {
        CaseEffects<2> read;
        readOptions(Dictionary::readString(text, "constant/contactProperties"), read);
        return makeEffects(read, {structure, read.contact, {}});
    };
    EXPECT_TRUE(effectsOf("friction { type Coulomb; mu 0.6; }").empty());
    EXPECT_TRUE(effectsOf("damping { massProportional 0; }").empty());
    EXPECT_EQ(effectsOf("damping { massProportional 1; } elasticity { normal 1e8; tangential 1e8; }").size(),
              2u);
}
