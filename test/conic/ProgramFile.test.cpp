// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Programs written and read: the same bit for bit, and faults reported with file and line.
#include "conic/ProgramFile.h"
#include "conic/InteriorPoint.h"
#include "core/Error.h"

#include "Towers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <random>

namespace drystone
{
namespace
{

using testing::HasSubstr;

std::filesystem::path fileNamed(const std::string& name)
{
    return std::filesystem::path(testing::TempDir()) / ("drystoneProgram." + name);
}

template<class Values>
void expectSameBits(const Values& one, const Values& other)
{
    ASSERT_EQ(one.size(), other.size());
    for (decltype(one.size()) i = 0; i < one.size(); ++i)
    {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(one.data()[i]), std::bit_cast<std::uint64_t>(other.data()[i]))
            << one.data()[i] << " and " << other.data()[i];
    }
}

template<class Program>
void expectRoundTrip(const Program& program, const std::string& name)
{
    const auto file = fileNamed(name);
    writeProgram(file, program);
    const AnyConeProgram any = readProgram(file);
    ASSERT_TRUE(std::holds_alternative<Program>(any));
    const Program& back = std::get<Program>(any);
    EXPECT_EQ(back.bodies, program.bodies);
    ASSERT_EQ(back.contacts.size(), program.contacts.size());
    for (std::size_t point = 0; point < program.contacts.size(); ++point)
    {
        EXPECT_EQ(back.contacts[point].first, program.contacts[point].first);
        EXPECT_EQ(back.contacts[point].second, program.contacts[point].second);
        expectSameBits(back.contacts[point].onFirst, program.contacts[point].onFirst);
        expectSameBits(back.contacts[point].onSecond, program.contacts[point].onSecond);
    }
    expectSameBits(back.friction, program.friction);
    expectSameBits(back.load, program.load);
    expectSameBits(back.liveLoad, program.liveLoad);
    expectSameBits(back.gap, program.gap);
    ASSERT_EQ(back.inertia.size(), program.inertia.size());
    for (std::size_t body = 0; body < program.inertia.size(); ++body)
    {
        expectSameBits(back.inertia[body], program.inertia[body]);
    }
    ASSERT_EQ(back.strength.size(), program.strength.size());
    for (std::size_t point = 0; point < program.strength.size(); ++point)
    {
        EXPECT_EQ(back.strength[point].cohesion, program.strength[point].cohesion);
        EXPECT_EQ(back.strength[point].tension, program.strength[point].tension);
        EXPECT_EQ(back.strength[point].crushing, program.strength[point].crushing);
    }
    std::filesystem::remove(file);
}

/// A program in which every number has all its digits, and some are on the edge of what a double can be.
template<class Program>
Program scrambled(Program program)
{
    std::mt19937 random(9);
    std::normal_distribution<double> normal;
    for (auto& columns : program.contacts)
    {
        for (auto* part : {&columns.onFirst, &columns.onSecond})
        {
            for (double& entry : part->reshaped())
            {
                entry += normal(random);
            }
        }
        const auto components = columns.onFirst.cols();
        columns.onSecond.topRows(components) = -columns.onFirst.topRows(components);
    }
    for (double& entry : program.load)
    {
        entry *= std::exp(20 * normal(random));
    }
    program.load[0] = -0.0;
    program.load[1] = std::numeric_limits<double>::denorm_min();
    program.load[2] = std::numeric_limits<double>::max();
    return program;
}

TEST(ProgramFile, WhatIsWrittenIsReadBackBitForBit)
{
    expectRoundTrip(scrambled(planeLimitAnalysis(evenTower(3))), "plane");
    expectRoundTrip(scrambled(spaceLimitAnalysis(evenTower(3))), "space");
    expectRoundTrip(scrambled(planeStep(evenTower(3), 0.1)), "planeStep");
    expectRoundTrip(scrambled(spaceStep(evenTower(3), 0.1)), "spaceStep");
    PlaneConeProgram strong = planeLimitAnalysis(evenTower(2));
    strong.strength.assign(strong.contacts.size(), {0.1, 0.05, 1.0 / 3});
    strong.strength[0].crushing = std::numeric_limits<double>::infinity();
    expectRoundTrip(strong, "strength");
    expectRoundTrip(PlaneConeProgram{}, "nothing");
}

TEST(ProgramFile, TheSolutionIsTheSameToo)
{
    const SpaceConeProgram program = spaceLimitAnalysis(evenTower(4));
    const auto file = fileNamed("solved");
    writeProgram(file, program);
    const auto back = std::get<SpaceConeProgram>(readProgram(file));
    EXPECT_EQ(solveInteriorPoint(program).multiplier, solveInteriorPoint(back).multiplier);
    std::filesystem::remove(file);
}

/// What is said of the file of a tower of two with some text replaced.
struct Fault
{
    std::string message;
    int line = 0;
};
Fault faultAfter(const std::string& old, const std::string& replacement)
{
    std::string text = programText(planeStep(evenTower(2), 0.1));
    const auto place = text.find(old);
    EXPECT_NE(place, std::string::npos) << old;
    text.replace(place, old.size(), replacement);
    const auto file = fileNamed("faulty");
    std::ofstream(file) << text;
    Fault fault;
    try
    {
        readProgram(file);
    }
    catch (const FatalIOError& error)
    {
        EXPECT_THAT(error.location().file, HasSubstr("drystoneProgram.faulty"));
        fault = {error.what(), error.location().line};
    }
    std::filesystem::remove(file);
    return fault;
}

/// A replacement in that file, and what is to be said of it.
struct FaultCase
{
    std::string old;
    std::string replacement;
    std::string message;
    std::string lineOf = ""; ///< text in the line that is named; empty: not looked at
};

TEST(ProgramFile, FaultsAreReportedWithTheirLine)
{
    const std::vector<FaultCase> cases{
        {"dimensions      2", "dimensions      4", "dimensions 4 is neither 2 nor 3", "dimensions"},
        {"(1 0 (", "(1 2 (", "Contact point 2: there is no body 2", "(1 0 ("},
        {"(1 0 (", "(1 1 (", "cannot touch itself"},
        {"(1 0 (", "(-1 -1 (", "both of its bodies are -1"},
        {"(1 0 (", "(1 0 (7 ", "7 and 6 numbers, where 3 x 2"},
        {"(1 0 (0 -1 ", "(1 0 (0 -2 ", "Contact point 2: what it does to its two bodies must be opposite"},
        {"0.65", "-0.65", "friction -0.65 of contact point 0 is below 0", "friction"},
        {"bodies          2", "bodies          3", "load has 6 elements, but there are 9", "load"},
        {"gap ", "liveLoad 6(0 0 0 0 0 0);\ngap ", "live load is zero"},
        {"gap ", "gaps ", "Unknown key gaps. Did you mean gap?", "gap"},
        {"load ", "laod ", "load"},
        {"(250000 0 0", "(250000 1 0", "inertia of body 0 is not symmetric", "(250000 0 0"},
        {"(250000 0 0", "(-250000 0 0", "not symmetric and positive definite"},
    };
    const std::string text = programText(planeStep(evenTower(2), 0.1));
    for (const FaultCase& one : cases)
    {
        SCOPED_TRACE(one.old + " becomes " + one.replacement);
        const Fault fault = faultAfter(one.old, one.replacement);
        EXPECT_THAT(fault.message, HasSubstr(one.message));
        if (!one.lineOf.empty())
        {
            const auto place = static_cast<std::ptrdiff_t>(text.find(one.lineOf));
            EXPECT_EQ(fault.line, 1 + std::count(text.begin(), text.begin() + place, '\n'));
        }
    }
}

TEST(ProgramFile, IsWrittenWhenTheSolverIsAskedTo)
{
    const auto file = fileNamed("observed");
    std::filesystem::remove(file);
    const PlaneConeProgram program = planeStep(evenTower(3), 0.4);
    SolverChoice choice;
    choice.observer = programWriter(WriteProgram::unsolved, [&file] { return file; });
    solveConeProgram(program, choice);
    EXPECT_FALSE(std::filesystem::exists(file));
    choice.solver = SolverType::interiorPoint;
    choice.maximumIterations = 1;
    solveConeProgram(program, choice);
    EXPECT_TRUE(std::filesystem::exists(file));
    std::filesystem::remove(file);
    choice.observer = programWriter(WriteProgram::always, [&file] { return file; });
    choice.maximumIterations = 200;
    EXPECT_EQ(solveConeProgram(program, choice).status, SolveStatus::optimal);
    EXPECT_EQ(std::get<PlaneConeProgram>(readProgram(file)).points(), program.points());
    std::filesystem::remove(file);
    EXPECT_FALSE(programWriter(WriteProgram::never, [&file] { return file; }));
}

} // namespace
} // namespace drystone
