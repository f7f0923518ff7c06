// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of command lines: OpenFOAM's `-option value`, given to CLI11 as the `--option=value` it knows.
#include "core/CommandLine.h"

#include "core/CaseLock.h"
#include "core/Error.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace drystone
{

namespace
{

/// All options of an application in the order of `-help`.
std::vector<CommandLineOption> allOptions(const ApplicationDescription& description)
{
    std::vector<CommandLineOption> options = description.options;
    if (description.kind == ApplicationKind::preProcessor)
        options.push_back({"dict", "FILE", "read this dictionary instead of the one in system/"});
    if (description.kind == ApplicationKind::solver)
    {
        options.push_back({"dry-run", "", "read and check everything, run nothing"});
        options.push_back({"postProcess", "", "run the function objects on the results that are there"});
    }
    options.push_back({"case", "DIR", "the case directory (default: here)"});
    options.push_back({"noFunctionObjects", "", "leave the functions of controlDict out"});
    options.push_back({"parallel", "", "refused: there is no parallel mode"});
    options.push_back({"help", "", "print this and exit"});
    return options;
}

/// `-0.5` and `-` are arguments, `-case` and `--case` are options.
bool looksLikeOption(const std::string& argument)
{
    return argument.size() > 1 && argument[0] == '-'
           && (argument[1] == '-' || std::isalpha(static_cast<unsigned char>(argument[1])));
}

std::string withoutDashes(const std::string& argument)
{
    return argument.substr(argument.starts_with("--") ? 2 : 1);
}

bool asksForHelp(const std::vector<std::string>& arguments)
{
    return std::any_of(arguments.begin(), arguments.end(),
                       [](const std::string& argument)
                       { return argument == "-help" || argument == "--help" || argument == "-h"; });
}

[[noreturn]] void failUnknownOption(const std::string& argument, const ApplicationDescription& description,
                                    const std::vector<CommandLineOption>& options)
{
    std::vector<std::string> names;
    for (const CommandLineOption& option : options)
        names.push_back(option.name);
    std::sort(names.begin(), names.end());
    const std::string nearest = nearestWord(withoutDashes(argument), names);
    std::string message = fmt::format("Unknown option {} of {}.", argument, description.name);
    if (!nearest.empty())
        message += fmt::format(" Did you mean -{}?", nearest);
    message += "\n\nValid options:";
    for (const std::string& name : names)
        message += " -" + name;
    throw FatalError(message);
}

/// The arguments as CLI11 takes them. It would read `-case` as `-c -a -s -e`, and a value that begins with a
/// dash as an option; so an option becomes `--name`, one with a value `--name=value` in a single argument,
/// and what has no dash goes after `--`.
std::vector<std::string> translate(const std::vector<std::string>& given,
                                   const ApplicationDescription& description,
                                   const std::vector<CommandLineOption>& options)
{
    std::vector<std::string> translated;
    std::vector<std::string> positional;
    for (auto argument = given.begin(); argument != given.end(); ++argument)
    {
        if (!looksLikeOption(*argument))
        {
            positional.push_back(*argument);
            continue;
        }
        const std::string name = withoutDashes(*argument);
        const auto option = std::find_if(options.begin(), options.end(),
                                         [&](const CommandLineOption& known) { return known.name == name; });
        if (option == options.end())
            failUnknownOption(*argument, description, options);
        if (option->argument.empty())
        {
            translated.push_back("--" + name);
            continue;
        }
        if (argument + 1 == given.end() || (argument + 1)->empty())
            throw FatalError(fmt::format("Option -{0} lacks its value.\n\nWrite -{0} {1}: {2}.", name,
                                         option->argument, option->summary));
        ++argument;
        translated.push_back("--" + name + "=" + *argument);
    }
    if (positional.size() != description.arguments.size())
    {
        std::string usage = description.name;
        for (const CommandLineOption& argument : description.arguments)
            usage += " " + argument.name;
        if (positional.size() > description.arguments.size())
            throw FatalError(fmt::format("Unexpected argument {}.\n\nUsage: {} [options]",
                                         positional[description.arguments.size()], usage));
        const CommandLineOption& missing = description.arguments[positional.size()];
        throw FatalError(fmt::format("The argument {} is missing: {}.\n\nUsage: {} [options]", missing.name,
                                     missing.summary, usage));
    }
    if (!positional.empty())
    {
        translated.emplace_back("--");
        translated.insert(translated.end(), positional.begin(), positional.end());
    }
    return translated;
}

} // namespace

std::optional<std::string> CommandLine::get(const std::string& option) const
{
    const auto found = options.find(option);
    return found == options.end() ? std::nullopt : std::optional(found->second);
}

std::filesystem::path CommandLine::dictionaryFile(const std::filesystem::path& defaultFile) const
{
    if (!dict)
        return (caseDirectory / defaultFile).lexically_normal();
    std::error_code ignored;
    return dict->is_absolute() || std::filesystem::exists(*dict, ignored)
               ? *dict
               : (caseDirectory / *dict).lexically_normal();
}

std::string helpText(const ApplicationDescription& description)
{
    const std::vector<CommandLineOption> options = allOptions(description);
    std::string text = "\nUsage: " + description.name;
    for (const CommandLineOption& argument : description.arguments)
        text += " " + argument.name;
    text += " [options]\n\n" + description.summary + "\n";

    constexpr int width = 24;
    if (!description.arguments.empty())
        text += "\nArguments:\n";
    for (const CommandLineOption& argument : description.arguments)
        text += fmt::format("  {:<{}}{}\n", argument.name, width, argument.summary);
    text += "\nOptions:\n";
    for (const CommandLineOption& option : options)
    {
        const std::string form =
            fmt::format("-{}{}{}", option.name, option.argument.empty() ? "" : " ", option.argument);
        text += fmt::format("  {:<{}}{}\n", form, width, option.summary);
    }
    if (description.details)
        text += "\n" + description.details();
    return text;
}

CommandLine readCommandLine(int argc, const char* const* argv, const ApplicationDescription& description)
{
    const std::vector<CommandLineOption> options = allOptions(description);
    const std::vector<std::string> given(argv + std::min(argc, 1), argv + argc);

    CommandLine result;
    result.application = description.name;
    result.typed = description.name;
    for (const std::string& argument : given)
        result.typed += " " + argument;
    if (asksForHelp(given))
    {
        result.help = true;
        return result;
    }

    CLI::App parser(description.summary, description.name);
    parser.set_help_flag();
    std::map<std::string, std::string> values;
    for (const CommandLineOption& option : options)
    {
        if (option.argument.empty())
            parser.add_flag("--" + option.name);
        else
            parser.add_option("--" + option.name, values[option.name])->type_name(option.argument);
    }
    std::vector<std::string> positional;
    parser.add_option("arguments", positional);

    // CLI11 takes the arguments from the last to the first.
    std::vector<std::string> arguments = translate(given, description, options);
    std::reverse(arguments.begin(), arguments.end());
    try
    {
        parser.parse(std::move(arguments));
    }
    catch (const CLI::ParseError&)
    {
        // What can be wrong after the translation is that an option with a value stands there twice.
        for (const CommandLineOption& option : options)
            if (std::count_if(given.begin(), given.end(),
                              [&](const std::string& argument)
                              { return looksLikeOption(argument) && withoutDashes(argument) == option.name; })
                > 1)
                throw FatalError(
                    fmt::format("Option -{0} is given more than once.\n\nGive -{0} once.", option.name));
        throw FatalError("The command line cannot be read.\n\n" + helpText(description));
    }

    if (parser.count("--parallel") > 0)
        throw FatalError(fmt::format("{} has no parallel mode.\n\nLeave out -parallel: it uses the cores of "
                                     "this machine by itself where that pays.",
                                     description.name));
    const auto isGiven = [&](const std::string& name)
    {
        return std::any_of(options.begin(), options.end(),
                           [&](const CommandLineOption& option) { return option.name == name; })
               && parser.count("--" + name) > 0;
    };
    result.noFunctionObjects = isGiven("noFunctionObjects");
    result.postProcess = description.kind == ApplicationKind::solver && isGiven("postProcess");
    result.dryRun = description.kind == ApplicationKind::solver && isGiven("dry-run");
    if (isGiven("case"))
        result.caseDirectory = std::filesystem::path(values["case"]).lexically_normal();
    if (description.kind == ApplicationKind::preProcessor && isGiven("dict"))
        result.dict = values["dict"];
    for (const CommandLineOption& option : description.options)
        if (isGiven(option.name))
            result.options[option.name] = option.argument.empty() ? "" : values[option.name];
    result.arguments = std::move(positional);
    return result;
}

namespace
{

int runCommandLine(int argc, const char* const* argv, const ApplicationDescription& description,
                   const std::function<int(const CommandLine&)>& program)
{
    const CommandLine commandLine = readCommandLine(argc, argv, description);
    if (commandLine.help)
    {
        fmt::print("{}", helpText(description));
        return 0;
    }
    std::error_code ignored;
    if (!std::filesystem::is_directory(commandLine.caseDirectory, ignored))
        throw FatalError(fmt::format("There is no case directory {}.\n\nName one with -case DIR, or run "
                                     "{} inside of one.",
                                     commandLine.caseDirectory.string(), description.name));
    std::optional<CaseLock> lock;
    if (description.kind != ApplicationKind::utility && !commandLine.dryRun)
        lock.emplace(commandLine.caseDirectory, description.name);
    return program(commandLine);
}

} // namespace

void keepFreedMemory()
{
#ifdef __GLIBC__
    constexpr int kept = 1 << 28;          // bytes on top of the heap
    constexpr int largestOnHeap = 1 << 25; // bytes of one array; more is not taken
    mallopt(M_TRIM_THRESHOLD, kept);
    mallopt(M_MMAP_THRESHOLD, largestOnHeap);
#endif
}

int runApplication(int argc, const char* const* argv, const ApplicationDescription& description,
                   const std::function<int(const CommandLine&)>& program)
{
    keepFreedMemory();
    return runGuarded(
        [&]
        {
            const int status = runCommandLine(argc, argv, description, program);
            // A log on a full disk: what was printed last may be the answer.
            if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
                throw FatalError("Standard output cannot be written: what was printed is lost, in part or in "
                                 "whole. Check that the disk has room.");
            return status;
        });
}

} // namespace drystone
