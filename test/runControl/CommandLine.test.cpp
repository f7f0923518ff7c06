// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Command lines as users write them.
#include "runControl/Application.h"

#include "core/Error.h"
#include "core/Signals.h"

#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

namespace drystone
{

namespace
{

using testing::HasSubstr;

ApplicationDescription describe(ApplicationKind kind)
{
    ApplicationDescription description;
    description.name = "dryApplication";
    description.summary = "Does it dryly.";
    description.kind = kind;
    description.options = {{"allChecks", "", "check everything"}, {"set", "VALUE", "the new value"}};
    return description;
}

CommandLine readLine(std::vector<const char*> arguments, const ApplicationDescription& description)
{
    arguments.insert(arguments.begin(), "dryApplication");
    return readCommandLine(static_cast<int>(arguments.size()), arguments.data(), description);
}

std::string failureOf(const std::vector<const char*>& arguments, const ApplicationDescription& description)
{
    try
    {
        readLine(arguments, description);
    }
    catch (const FatalError& error)
    {
        EXPECT_EQ(error.exitStatus(), 1);
        return error.what();
    }
    return "no failure";
}

TEST(CommandLine, IsTheCaseHereWithNothingGiven)
{
    const CommandLine line = readLine({}, describe(ApplicationKind::solver));
    EXPECT_EQ(line.application, "dryApplication");
    EXPECT_EQ(line.caseDirectory, ".");
    EXPECT_FALSE(line.help || line.noFunctionObjects || line.postProcess || line.dryRun);
    EXPECT_FALSE(line.has("allChecks"));
}

TEST(CommandLine, TakesLongOptionsWithOneDash)
{
    const CommandLine line =
        readLine({"-case", "walls/./one", "-dry-run", "-postProcess", "-noFunctionObjects", "-allChecks"},
                 describe(ApplicationKind::solver));
    EXPECT_EQ(line.caseDirectory, "walls/one");
    EXPECT_TRUE(line.dryRun);
    EXPECT_TRUE(line.postProcess);
    EXPECT_TRUE(line.noFunctionObjects);
    EXPECT_TRUE(line.has("allChecks"));
    EXPECT_EQ(line.get("set"), std::nullopt);
}

TEST(CommandLine, TakesTwoDashesToo)
{
    EXPECT_EQ(readLine({"--case", "a"}, describe(ApplicationKind::solver)).caseDirectory, "a");
}

TEST(CommandLine, TakesValuesThatLookLikeOptions)
{
    const ApplicationDescription description = describe(ApplicationKind::utility);
    for (const char* value : {"-5", "-0.5e-3", "-case", "--", "-", "(0 -9.81 0)", "\"a b\"", "a=b", "[1 -3]"})
    {
        EXPECT_EQ(readLine({"-set", value}, description).get("set"), value);
    }
}

TEST(CommandLine, TakesTheArgumentsThatAreDeclared)
{
    ApplicationDescription description = describe(ApplicationKind::utility);
    description.arguments = {{"DICTIONARY", "", "the file"}};
    EXPECT_THAT(readLine({"-allChecks", "system/controlDict", "-set", "-1"}, description).arguments,
                testing::ElementsAre("system/controlDict"));
    EXPECT_THAT(readLine({"-5"}, description).arguments, testing::ElementsAre("-5"));
    EXPECT_THAT(failureOf({}, description), HasSubstr("The argument DICTIONARY is missing: the file."));
    EXPECT_THAT(failureOf({"a", "b"}, description), HasSubstr("Unexpected argument b."));
}

TEST(CommandLine, NamesTheNearestOfAnUnknownOption)
{
    const std::string failure = failureOf({"-dryrun"}, describe(ApplicationKind::solver));
    EXPECT_THAT(failure, HasSubstr("Unknown option -dryrun of dryApplication. Did you mean -dry-run?"));
    EXPECT_THAT(failure, HasSubstr("Valid options: -allChecks -case -dry-run -help"));
    EXPECT_THAT(failureOf({"-quxxyzzy"}, describe(ApplicationKind::solver)),
                HasSubstr("Unknown option -quxxyzzy of dryApplication.\n\nValid options:"));
}

TEST(CommandLine, HasTheOptionsOfItsKindOnly)
{
    const ApplicationDescription preProcessor = describe(ApplicationKind::preProcessor);
    EXPECT_EQ(readLine({"-dict", "x"}, preProcessor).dict, "x");
    EXPECT_THAT(failureOf({"-dry-run"}, preProcessor), HasSubstr("Unknown option -dry-run"));
    EXPECT_THAT(failureOf({"-dict", "x"}, describe(ApplicationKind::solver)),
                HasSubstr("Unknown option -dict"));
}

TEST(CommandLine, RefusesAValueThatIsMissingOrGivenTwice)
{
    const ApplicationDescription description = describe(ApplicationKind::solver);
    EXPECT_THAT(failureOf({"-case"}, description), HasSubstr("Option -case lacks its value."));
    EXPECT_THAT(failureOf({"-case", ""}, description), HasSubstr("Option -case lacks its value."));
    EXPECT_THAT(failureOf({"-case", "a", "-case", "b"}, description),
                HasSubstr("Option -case is given more"));
    EXPECT_THAT(failureOf({"stray"}, description), HasSubstr("Unexpected argument stray."));
}

TEST(CommandLine, RefusesParallelMode)
{
    EXPECT_THAT(failureOf({"-parallel"}, describe(ApplicationKind::solver)),
                HasSubstr("dryApplication has no parallel mode."));
}

TEST(CommandLine, PutsHelpBeforeEverythingElseButUnknownOptions)
{
    const ApplicationDescription description = describe(ApplicationKind::solver);
    EXPECT_TRUE(readLine({"-help"}, description).help);
    EXPECT_TRUE(readLine({"-h"}, description).help);
    EXPECT_TRUE(readLine({"-set", "-nonsense", "-help", "-case"}, description).help);
    EXPECT_TRUE(readLine({"-case", "--help"}, description).help);
    EXPECT_THAT(failureOf({"-help", "-nonsense"}, description), HasSubstr("Unknown option -nonsense"));
    EXPECT_THAT(failureOf({"-nonsense", "-version"}, description), HasSubstr("Unknown option -nonsense"));
    const std::string text = helpText(description);
    for (const char* part : {"Usage: dryApplication [options]", "Does it dryly.", "-case DIR", "-set VALUE",
                             "-allChecks", "-postProcess", "-dry-run", "-noFunctionObjects"})
    {
        EXPECT_THAT(text, HasSubstr(part));
    }
}

TEST(CommandLine, HelpSaysWhereAnOptionIsRefused)
{
    ApplicationDescription description = describe(ApplicationKind::solver);
    EXPECT_THAT(helpText(description), testing::ContainsRegex("-postProcess +run the function objects"));
    description.postProcess.clear();
    EXPECT_THAT(helpText(description), testing::ContainsRegex("-postProcess +refused: "));
}

TEST(CommandLine, PrintsHelpWithinEightyColumns)
{
    ApplicationDescription description = describe(ApplicationKind::solver);
    description.summary = std::string(40, 'a') + " " + std::string(60, 'b');
    description.options.push_back({"long", "", std::string(50, 'c') + " " + std::string(30, 'd')});
    description.examples = {"dryApplication -case wall"};
    description.tutorial = "limitAnalysis/arch";
    const std::string text = helpText(description);
    EXPECT_THAT(text, HasSubstr("\nExamples:\n  dryApplication -case wall\n"));
    EXPECT_THAT(text, HasSubstr("tutorials/limitAnalysis/arch"));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
    {
        EXPECT_LE(line.size(), 80U) << line;
    }
}

TEST(CommandLine, ReadsVersionBeforeEverythingElse)
{
    const ApplicationDescription description = describe(ApplicationKind::solver);
    EXPECT_TRUE(readLine({"-version"}, description).version);
    EXPECT_TRUE(readLine({"-case", "nowhere", "--version", "stray"}, description).version);
    EXPECT_FALSE(readLine({}, description).version);
}

TEST(CommandLine, FindsADictionaryHereOrInTheCase)
{
    CommandLine line = readLine({"-case", "walls"}, describe(ApplicationKind::preProcessor));
    EXPECT_EQ(line.dictionaryFile("system/blockTextureDict"), "walls/system/blockTextureDict");
    line.dict = "system/other";
    EXPECT_EQ(line.dictionaryFile("system/blockTextureDict"), "walls/system/other");
    line.dict = "/dev/null";
    EXPECT_EQ(line.dictionaryFile("system/blockTextureDict"), "/dev/null");
}

TEST(Application, EndsWithTheStatusOfItsProgramOrOfItsError)
{
    const ApplicationDescription description = describe(ApplicationKind::solver);
    const auto run =
        [&](std::vector<const char*> arguments, const std::function<int(const CommandLine&)>& program)
    {
        arguments.insert(arguments.begin(), "dryApplication");
        return runApplication(static_cast<int>(arguments.size()), arguments.data(), description, program);
    };
    const auto never = [](const CommandLine&) -> int
    {
        ADD_FAILURE() << "the program is not to be run";
        return 0;
    };
    EXPECT_EQ(run({}, [](const CommandLine&) { return 3; }), 3);
    EXPECT_EQ(run({}, [](const CommandLine&) -> int { throw FatalError("stalled", 2); }), 2);
    testing::internal::CaptureStdout();
    EXPECT_EQ(run({"-help"}, never), 0);
    EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("Usage: dryApplication"));
    testing::internal::CaptureStderr();
    EXPECT_EQ(run({"-case", "no/such/case"}, never), 1);
    EXPECT_THAT(
        testing::internal::GetCapturedStderr(),
        testing::AllOf(HasSubstr("--> DRYSTONE FATAL ERROR:\nThere is no case directory no/such/case."),
                       HasSubstr("DRYSTONE exiting")));
}

TEST(StopOrEnd, ARunThatASignalHasStoppedDoesNotClaimToHaveEnded)
{
    const auto printed = []
    {
        testing::internal::CaptureStdout();
        printStopOrEnd("Started again, it continues.");
        return testing::internal::GetCapturedStdout();
    };
    EXPECT_EQ(printed(), "End\n\n");
    catchStopSignals();
    std::raise(SIGTERM);
    EXPECT_EQ(printed(),
              "Stopped by a signal; what was computed so far is kept. Started again, it continues.\n\n");
    forgetStopSignal();
}

} // namespace

} // namespace drystone
