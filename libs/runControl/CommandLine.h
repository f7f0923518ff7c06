// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The command line of an application: its options and arguments, and what -help says of them.
#pragma once

#include "dictionary/Options.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// Decides which options an application has in addition to `-case -help -version -parallel
/// -noFunctionObjects`.
enum class ApplicationKind
{
    preProcessor, ///< also `-dict FILE`
    solver,       ///< also `-postProcess` and `-dry-run`
    utility       ///< none
};

/// An option of an application's own, or an argument without a dash.
struct CommandLineOption
{
    std::string name;     ///< without the dash: `allChecks`
    std::string argument; ///< what follows, in capitals: `NAME`; empty for a switch, which nothing follows
    std::string summary;  ///< half a line
};

/// Who reads what an application prints.
enum class Output
{
    log,   ///< people: it begins with the banner
    answer ///< scripts too: nothing but what was requested
};

/// A dictionary that an application reads, as -help describes it: `{"constant/g",
/// describeOptions<Gravity<2>>}`.
struct DescribedDictionary
{
    std::string name; ///< its file in the case directory, and what makes it special: `constant/g in space`
    std::function<std::vector<OptionDescription>()> describe; ///< called by -help alone
};

/// What an application says of itself.
struct ApplicationDescription
{
    std::string name;
    std::string summary; ///< a sentence or two: what it reads, does and writes
    ApplicationKind kind = ApplicationKind::utility;
    Output output = Output::log;
    std::vector<CommandLineOption> options; ///< its own
    /// What `-parallel` is for, half a line; empty where it is refused.
    std::string parallel;
    /// What `-postProcess` of a solver is for, half a line; empty where it is refused.
    std::string postProcess = "run the function objects on the results that are there";
    /// Options of its own with which several processes may be at work in one case, as with `-parallel`.
    std::vector<std::string> sharing;
    /// The arguments without a dash, all required, in their order; `name` is in capitals, `argument` unused.
    std::vector<CommandLineOption> arguments;
    /// Lines of a shell that show it at work, each with what it does after a `#`.
    std::vector<std::string> examples;
    /// The tutorial to copy for a first case of one's own, as `limitAnalysis/masonryPanels`; empty for none.
    std::string tutorial;
    std::vector<DescribedDictionary> dictionaries; ///< those it reads: they close -help
};

/// What the user requested.
struct CommandLine
{
    std::string application;
    std::string typed;                         ///< the whole line, for the banner
    std::filesystem::path caseDirectory = "."; ///< as the user wrote it, made free of `.` and `..`
    bool help = false;
    bool version = false; ///< print name, version and commit
    bool noFunctionObjects = false;
    bool postProcess = false;
    bool parallel = false;
    bool dryRun = false;                       ///< read and check everything, run nothing
    std::optional<std::filesystem::path> dict; ///< instead of the dictionary in system/; see `dictionaryFile`
    std::map<std::string, std::string> options; ///< those of the application's own that were given; a switch
                                                ///< has an empty text
    std::vector<std::string> arguments;         ///< those without a dash

    bool has(const std::string& option) const { return options.contains(option); }
    /// \return the text that follows the option, or nothing when the option was not given
    std::optional<std::string> get(const std::string& option) const;
    /// The file of `-dict`, which is relative to the case directory unless it exists from where we are, or
    /// else `defaultFile` of the case directory.
    std::filesystem::path dictionaryFile(const std::filesystem::path& defaultFile) const;
};

/// Reads the command line, all of it with `-help` and `-version` too.
/// \throws FatalError for an unknown option (naming the nearest), a missing or repeated one, and for
/// `-parallel` where the application has no parallel mode
CommandLine readCommandLine(int argc, const char* const* argv, const ApplicationDescription& description);

/// What `-help` prints: no line is longer than 80 characters.
std::string helpText(const ApplicationDescription& description);

} // namespace drystone
