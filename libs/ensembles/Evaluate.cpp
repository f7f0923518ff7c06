// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads parameter files, answers with result files.
#include "ensembles/Evaluate.h"

#include "core/Log.h"
#include "core/Paragraph.h"
#include "core/WholeFile.h"
#include "dictionary/NamesIn.h"
#include "ensembles/Ensemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <new>
#include <sstream>

#include <sys/time.h>
#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

SampleValue valueOfText(std::string text)
{
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    {
        return valueOf(text.substr(1, text.size() - 2));
    }
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    const bool isNumber = !text.empty() && end == text.c_str() + text.size() && std::isfinite(number);
    return isNumber ? SampleValue{std::move(text), number} : valueOf(text);
}

bool isCount(const std::string& word)
{
    return !word.empty()
           && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// A second value would hide the first one.
void takeValue(const std::string& name, const std::string& text, const SourceLocation& place,
               std::map<std::string, SampleValue>& values)
{
    if (!values.try_emplace(name, valueOfText(text)).second)
    {
        throw FatalIOError(fmt::format("There are two values of {}: remove one.", name), place);
    }
}

/// The words of a line that is not empty.
struct ParameterLine
{
    std::vector<std::string> words;
    int number = 0; ///< in the file, from 1
};

/// What stands first in a line of two words.
enum class FirstWord
{
    name,
    value
};

/// Lines with two words each, a name and its value.
void takePairs(const std::vector<ParameterLine>& lines, std::size_t begin, std::size_t count, FirstWord first,
               const fs::path& file, std::map<std::string, SampleValue>& values)
{
    for (std::size_t i = begin; i < begin + count; ++i)
    {
        if (i >= lines.size() || lines[i].words.size() < 2)
        {
            const int number = i < lines.size() ? lines[i].number : lines.back().number + 1;
            throw FatalIOError(fmt::format("{} variables are announced, and there are {}.", count, i - begin),
                               {file.string(), "", number});
        }
        const auto& [words, number] = lines[i];
        const SourceLocation place{file.string(), "", number};
        if (words.size() > 2)
        {
            throw FatalIOError(fmt::format("A variable has one value here, and its name: remove `{}`.",
                                           fmt::join(words.begin() + 2, words.end(), " ")),
                               place);
        }
        const std::size_t name = first == FirstWord::name ? 0 : 1;
        takeValue(words[name], words[1 - name], place, values);
    }
}

} // namespace

std::map<std::string, SampleValue> readParameters(const fs::path& file)
{
    std::ifstream stream(file);
    if (!stream)
    {
        throw FatalIOError("The file of the parameters cannot be read.", {file.string(), "", 0});
    }
    std::vector<ParameterLine> lines;
    int number = 0;
    for (std::string line; std::getline(stream, line);)
    {
        ++number;
        if (std::vector<std::string> words = wordsOf(line); !words.empty())
        {
            lines.push_back({std::move(words), number});
        }
    }
    std::map<std::string, SampleValue> values;
    const bool isAprepro = !lines.empty() && lines.front().words.front().starts_with("{");
    if (isAprepro)
    {
        for (const auto& [words, at] : lines)
        {
            if (words.size() == 5 && words[0] == "{" && words[2] == "=" && !words[1].starts_with("DAKOTA_")
                && !words[1].starts_with("ASV_") && !words[1].starts_with("DVV_")
                && !words[1].starts_with("AC_"))
            {
                takeValue(words[1], words[3], {file.string(), "", at}, values);
            }
        }
        return values;
    }
    if (!lines.empty() && isCount(lines.front().words.front()))
    {
        const std::vector<std::string>& words = lines.front().words;
        const auto count = static_cast<std::size_t>(std::stoul(words.front().substr(0, 9)));
        const bool isDakota = words.size() == 2 && words[1] == "variables";
        if (isDakota || words.size() == 1)
        {
            takePairs(lines, 1, count, isDakota ? FirstWord::value : FirstWord::name, file, values);
            return values;
        }
    }
    throw FatalIOError(
        "This is no file of parameters: Dakota's begins with `2 variables` or `{ DAKOTA_VARS = 2 }`, "
        "quoFEM's with their number alone.",
        {file.string(), "", 1});
}

namespace
{

/// The values of the variables of an ensemble, in their order.
std::vector<SampleValue> givenValues(const Ensemble& ensemble, const fs::path& parameters)
{
    std::map<std::string, SampleValue> given = readParameters(parameters);
    std::vector<SampleValue> values;
    for (const auto& [name, variable] : ensemble.settings.variables)
    {
        const auto found = given.find(name);
        if (found == given.end())
        {
            std::vector<std::string> names;
            for (const auto& [other, value] : given)
            {
                names.push_back(other);
            }
            throw FatalIOError(
                fmt::format("The variable {} of system/ensembleDict is not among the parameters: {}.", name,
                            fmt::join(names, " ")),
                {parameters.string(), "", 0});
        }
        values.push_back(found->second);
        given.erase(found);
    }
    if (!given.empty())
    {
        throw FatalIOError(
            unknownWordMessage("variable", given.begin()->first, namesIn(ensemble.settings.variables)),
            {parameters.string(), "", 0});
    }
    return values;
}

/// Ends this process when a sample takes longer.
void limitTime(double seconds)
{
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(std::ceil(seconds));
    ::setitimer(ITIMER_REAL, &timer, nullptr);
}

SampleOutcome runWithinMemory(SampleRunner& runner, const std::vector<SampleValue>& values)
{
    try
    {
        return runner.run(values);
    }
    catch (const std::bad_alloc&)
    {
        return {SampleStatus::outOfMemory, {}, "out of memory"};
    }
}

} // namespace

int evaluateSample(const fs::path& caseDirectory, const fs::path& parameters, const fs::path& results)
{
    const Ensemble ensemble = readEnsemble(caseDirectory, {});
    const std::vector<SampleValue> values = givenValues(ensemble, parameters);
    // What stands there if this process does not come to its end.
    writeWholeFile(results, "FAIL\n");
    if (const auto& limit = ensemble.settings.failures.maximumTime)
    {
        limitTime(*limit);
    }
    SampleRunner runner(ensemble, ensembleWork(caseDirectory) / fmt::format("case.evaluate.{}", ::getpid()));
    const SampleOutcome outcome = runWithinMemory(runner, values);
    if (outcome.status != SampleStatus::done)
    {
        info("FAIL: {}{}", textOf(outcome.status), outcome.message.empty() ? "" : ": " + outcome.message);
        return 0;
    }
    std::string line;
    for (const double result : outcome.results)
    {
        line += fmt::format("{}{}", line.empty() ? "" : " ", result);
    }
    writeWholeFile(results, line + "\n");
    info("Results: {}", line);
    return 0;
}

} // namespace drystone
