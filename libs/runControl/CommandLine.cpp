// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of command lines in OpenFOAM's manner: `-option value`, switches, arguments without a dash.
#include "runControl/CommandLine.h"

#include "core/Error.h"
#include "core/Paragraph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace drystone
{

namespace
{

/// All options of an application in the order of `-help`.
std::vector<CommandLineOption> allOptions(const ApplicationDescription& description)
{
    std::vector<CommandLineOption> options = description.options;
    if (description.kind == ApplicationKind::preProcessor)
    {
        options.push_back({"dict", "FILE", "read this dictionary instead of the one in system/"});
    }
    if (description.kind == ApplicationKind::solver)
    {
        options.push_back({"dry-run", "", "read and check everything, run nothing"});
        options.push_back({"postProcess", "",
                           description.postProcess.empty() ? "refused: tables are written as it runs"
                                                           : description.postProcess});
    }
    options.push_back({"case", "DIR", "the case directory (default: here)"});
    options.push_back({"noFunctionObjects", "", "leave the functions of controlDict out"});
    options.push_back(
        {"parallel", "",
         description.parallel.empty() ? "refused: there is no parallel mode" : description.parallel});
    options.push_back({"version", "", "print name, version and commit, and exit"});
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

bool asksFor(const std::vector<std::string>& arguments, const std::string& option)
{
    return std::any_of(arguments.begin(), arguments.end(),
                       [&](const std::string& argument)
                       { return argument == "-" + option || argument == "--" + option; });
}

[[noreturn]] void failUnknownOption(const std::string& argument, const ApplicationDescription& description,
                                    const std::vector<CommandLineOption>& options)
{
    std::vector<std::string> names;
    for (const CommandLineOption& option : options)
    {
        names.push_back(option.name);
    }
    std::sort(names.begin(), names.end());
    const std::string nearest = nearestWord(withoutDashes(argument), names);
    std::string message = fmt::format("Unknown option {} of {}.", argument, description.name);
    if (!nearest.empty())
    {
        message += fmt::format(" Did you mean -{}?", nearest);
    }
    message += "\n\nValid options:";
    for (const std::string& name : names)
    {
        message += " -" + name;
    }
    throw FatalError(message);
}

/// What the user gave: options with their values (a switch has an empty one), and what has no dash.
struct GivenArguments
{
    std::map<std::string, std::string> options;
    std::vector<std::string> positional;
};

/// The option that an argument names. \throws FatalError when there is none
const CommandLineOption& optionOf(const std::string& argument, const ApplicationDescription& description,
                                  const std::vector<CommandLineOption>& options)
{
    const auto option = std::find_if(options.begin(), options.end(),
                                     [name = withoutDashes(argument)](const CommandLineOption& known)
                                     { return known.name == name; });
    if (option == options.end())
    {
        failUnknownOption(argument, description, options);
    }
    return *option;
}

/// Beside -help and -version options are not carried out, and a wrong one is named all the same.
void refuseUnknownOptions(const std::vector<std::string>& given, const ApplicationDescription& description,
                          const std::vector<CommandLineOption>& options)
{
    for (auto argument = given.begin(); argument != given.end(); ++argument)
    {
        if (looksLikeOption(*argument) && withoutDashes(*argument) != "h"
            && !optionOf(*argument, description, options).argument.empty() && argument + 1 != given.end())
        {
            ++argument; // its value
        }
    }
}

GivenArguments sortArguments(const std::vector<std::string>& given, const ApplicationDescription& description,
                             const std::vector<CommandLineOption>& options)
{
    GivenArguments sorted;
    for (auto argument = given.begin(); argument != given.end(); ++argument)
    {
        if (!looksLikeOption(*argument))
        {
            sorted.positional.push_back(*argument);
            continue;
        }
        const std::string name = withoutDashes(*argument);
        const CommandLineOption& option = optionOf(*argument, description, options);
        const bool isRepeated = sorted.options.contains(name);
        if (option.argument.empty())
        {
            sorted.options[name] = "";
            continue;
        }
        if (argument + 1 == given.end() || (argument + 1)->empty())
        {
            throw FatalError(fmt::format("Option -{0} lacks its value.\n\nWrite -{0} {1}: {2}.", name,
                                         option.argument, option.summary));
        }
        if (isRepeated)
        {
            throw FatalError(
                fmt::format("Option -{0} is given more than once.\n\nGive -{0} once.", option.name));
        }
        ++argument;
        sorted.options[name] = *argument;
    }
    return sorted;
}

void requireArguments(const std::vector<std::string>& positional, const ApplicationDescription& description)
{
    if (positional.size() == description.arguments.size())
    {
        return;
    }
    std::string usage = description.name;
    for (const CommandLineOption& argument : description.arguments)
    {
        usage += " " + argument.name;
    }
    if (positional.size() > description.arguments.size())
    {
        throw FatalError(fmt::format("Unexpected argument {}.\n\nUsage: {} [options]",
                                     positional[description.arguments.size()], usage));
    }
    const CommandLineOption& missing = description.arguments[positional.size()];
    throw FatalError(fmt::format("The argument {} is missing: {}.\n\nUsage: {} [options]", missing.name,
                                 missing.summary, usage));
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
    {
        return (caseDirectory / defaultFile).lexically_normal();
    }
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
    {
        text += " " + argument.name;
    }
    text += " [options]\n\n" + paragraph(description.summary, widthOfHelp);

    constexpr int describedAt = 26;
    const auto describe = [&](const std::string& term, const std::string& what)
    { text += hangingParagraph("  " + term, what, describedAt, widthOfHelp); };
    if (!description.arguments.empty())
    {
        text += "\nArguments:\n";
    }
    for (const CommandLineOption& argument : description.arguments)
    {
        describe(argument.name, argument.summary);
    }
    text += "\nOptions:\n";
    for (const CommandLineOption& option : options)
    {
        describe(fmt::format("-{}{}{}", option.name, option.argument.empty() ? "" : " ", option.argument),
                 option.summary);
    }
    if (!description.examples.empty())
    {
        text += "\nExamples:\n";
    }
    for (const std::string& example : description.examples)
    {
        text += "  " + example + "\n";
    }
    if (!description.tutorial.empty())
    {
        text += fmt::format("\nA tutorial to copy: tutorials/{}\n", description.tutorial);
    }
    for (const DescribedDictionary& dictionary : description.dictionaries)
    {
        text += fmt::format("\n{}:\n{}", dictionary.name, helpText(dictionary.describe()));
    }
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
    {
        result.typed += " " + argument;
    }
    result.help = asksFor(given, "help") || asksFor(given, "h");
    result.version = asksFor(given, "version");
    if (result.help || result.version)
    {
        refuseUnknownOptions(given, description, options);
        return result;
    }

    GivenArguments arguments = sortArguments(given, description, options);
    requireArguments(arguments.positional, description);
    const auto isGiven = [&](const std::string& name) { return arguments.options.contains(name); };
    if (isGiven("parallel") && description.parallel.empty())
    {
        throw FatalError(fmt::format("{} has no parallel mode.\n\nLeave out -parallel: it uses the cores of "
                                     "this machine by itself where that pays.",
                                     description.name));
    }
    result.noFunctionObjects = isGiven("noFunctionObjects");
    result.parallel = isGiven("parallel");
    result.postProcess = isGiven("postProcess");
    result.dryRun = isGiven("dry-run");
    if (isGiven("case"))
    {
        result.caseDirectory = std::filesystem::path(arguments.options["case"]).lexically_normal();
    }
    if (isGiven("dict"))
    {
        result.dict = arguments.options["dict"];
    }
    for (const CommandLineOption& option : description.options)
    {
        if (isGiven(option.name))
        {
            result.options[option.name] = arguments.options[option.name];
        }
    }
    result.arguments = std::move(arguments.positional);
    return result;
}

} // namespace drystone
