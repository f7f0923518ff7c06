// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes and reads states: dictionaries of one number or one list an entry, in text or with binary lists.
#include "io/TimeDirectory.h"

#include "core/Error.h"
#include "core/WholeFile.h"
#include "dictionary/Dictionary.h"
#include "dictionary/Fingerprint.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string_view>
#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

fs::path stateFile(const fs::path& caseDirectory, const std::string& timeName)
{
    return caseDirectory / timeName / "state";
}

/// A number with the fewest digits that read back as the same, at most 17. Most numbers of a state are whole,
/// indices and zeros: they need no search for digits.
void addLine(std::string& text, double value)
{
    constexpr double largestInt = 1e9;
    std::array<char, 32> line;
    char* end = nullptr;
    if (std::abs(value) < largestInt && value == std::trunc(value) && !(value == 0 && std::signbit(value)))
    {
        end = std::to_chars(line.data(), line.data() + line.size(), static_cast<int>(value)).ptr;
    }
    else
    {
        end = fmt::format_to(line.data(), FMT_COMPILE("{}"), value);
    }
    *end++ = '\n';
    text.append(line.data(), end);
}

/// The last line of a state: the fingerprint of what is before it.
constexpr std::string_view checksumKey = "checksum";
std::string checksumLine(std::string_view text)
{
    return fmt::format("\n{} \"{:016x}\";\n", checksumKey, fingerprint(text));
}

/// That the file is what was written. States of older versions, and those that were edited on purpose, have
/// no checksum.
void refuseDamage(const fs::path& file)
{
    const std::string text = contentOfFile(file);
    const std::size_t line = text.rfind(fmt::format("\n{} \"", checksumKey));
    if (line == std::string::npos
        || text.substr(line) == checksumLine(std::string_view(text).substr(0, line)))
    {
        return;
    }
    throw FatalIOError(
        "The state is not as it was written: its checksum does not fit. Where it was edited on "
        "purpose remove the entry checksum; else the file is damaged.",
        {file.string(), "",
         static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(line), '\n'))
             + 2});
}

/// A state that is no longer kept, for the next one to be written over.
constexpr std::string_view purgedState = ".purgedState";

/// Whether a directory holds a state and nothing else.
bool holdsStateAlone(const fs::path& directory)
{
    std::error_code failure;
    fs::directory_iterator entry(directory, failure);
    if (failure || entry == fs::directory_iterator() || entry->path().filename() != "state")
    {
        return false;
    }
    entry.increment(failure);
    return !failure && entry == fs::directory_iterator();
}

/// That a state lacks an entry. \param kind of entry
[[noreturn]] void failWithout(const State& state, std::string_view kind, const std::string& name)
{
    const bool isEmpty = state.scalars.empty() && state.arrays.empty() && state.texts.empty();
    throw FatalIOError(
        (isEmpty ? std::string("The state holds nothing")
                 : fmt::format("The state has no {} {}; it was written by another version or application",
                               kind, name))
            + ".\n\nThe run cannot continue from it: remove the time directory to start from an earlier one.",
        {state.file.string(), "", 1});
}

void checkFinite(const std::string& name, double value)
{
    if (!std::isfinite(value))
    {
        throw FatalError(fmt::format("{} of the state to be written is not a finite number.", name));
    }
}

void addTexts(std::string& text, const std::string& name, const std::vector<std::string>& lines)
{
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "\n{} {}\n(\n", name, lines.size());
    for (const std::string& line : lines)
    {
        if (line.find_first_of("\"\\\n") != std::string::npos)
        {
            throw FatalError(
                fmt::format("{} of the state to be written cannot be put between quotes: {}", name, line));
        }
        fmt::format_to(out, "\"{}\"\n", line);
    }
    text += ");\n";
}

void addValues(std::string& text, const std::string& name, const std::vector<double>& values,
               WriteFormat format)
{
    for (const double value : values)
    {
        checkFinite(name, value);
    }
    const auto out = std::back_inserter(text);
    if (format == WriteFormat::binary)
    {
        fmt::format_to(out, "\n{} List<scalar> {}(", name, values.size());
        text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
    }
    else
    {
        fmt::format_to(out, "\n{} {}\n(\n", name, values.size());
        for (const double value : values)
        {
            addLine(text, value);
        }
    }
    text += ");\n";
}

} // namespace

double stateScalar(const State& state, const std::string& name)
{
    const auto found = state.scalars.find(name);
    if (found == state.scalars.end())
    {
        failWithout(state, "entry", name);
    }
    return found->second;
}

const std::vector<double>& stateArray(const State& state, const std::string& name, std::size_t size)
{
    const auto found = state.arrays.find(name);
    if (found == state.arrays.end())
    {
        failWithout(state, "list", name);
    }
    if (found->second.size() != size)
    {
        throw FatalIOError(
            fmt::format("The list {} of the state has {} values where this case needs {}. Did the "
                        "blocks change since it was written?",
                        name, found->second.size(), size),
            {state.file.string(), "", 1});
    }
    return found->second;
}

std::string stateText(const State& state, WriteFormat format)
{
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out,
                   "FoamFile\n{{\n    version     2.0;\n    format      {};\n{}    class       dictionary;\n"
                   "    object      state;\n}}\n\n",
                   format == WriteFormat::ascii ? "ascii" : "binary",
                   format == WriteFormat::ascii ? "" : "    arch        \"LSB;label=32;scalar=64\";\n");
    // fmt writes the fewest digits that read back as the same number: at most 17.
    for (const auto& [name, value] : state.scalars)
    {
        checkFinite(name, value);
        fmt::format_to(out, "{} {};\n", name, value);
    }
    for (const auto& [name, texts] : state.texts)
    {
        addTexts(text, name, texts);
    }
    for (const auto& [name, values] : state.arrays)
    {
        addValues(text, name, values, format);
    }
    return text + checksumLine(text);
}

void writeState(const fs::path& caseDirectory, const std::string& timeName, const State& state,
                WriteFormat format)
{
    const std::string text = stateText(state, format);
    std::error_code failure;
    if (fs::exists(caseDirectory / timeName, failure))
    {
        return writeWholeFile(stateFile(caseDirectory, timeName), text);
    }

    const std::string temporary = fmt::format(".{}.{}.tmp", timeName, ::getpid());
    fs::rename(caseDirectory / purgedState, caseDirectory / temporary, failure); // if there is one
    try
    {
        writeFile(stateFile(caseDirectory, temporary), text); // the directory takes its name when it is whole
    }
    catch (...) // a full disk, say
    {
        fs::remove_all(caseDirectory / temporary, failure);
        throw;
    }
    fs::rename(caseDirectory / temporary, caseDirectory / timeName, failure);
    if (failure)
    {
        const std::string reason = failure.message();
        fs::remove_all(caseDirectory / temporary, failure);
        throw FatalError(fmt::format("Cannot make the time directory {}: {}.",
                                     (caseDirectory / timeName).string(), reason));
    }
}

namespace
{

/// The grammar's keywords may hold brackets, which would not read back as they are written.
void requireName(const Entry& entry)
{
    const bool isName = std::all_of(
        entry.keyword().begin(), entry.keyword().end(),
        [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) || letter == '_'; });
    if (!isName)
    {
        throw FatalIOError(
            fmt::format("{} is no name of an entry of a state: the file is damaged.", entry.keyword()),
            entry.location());
    }
}

std::vector<std::string> textsIn(const Entry& entry, std::ptrdiff_t count)
{
    auto listed = entry.as<std::vector<std::string>>();
    if (static_cast<std::size_t>(count) != listed.size())
    {
        throw FatalIOError("A list of texts holds something that is not between quotes.", entry.location());
    }
    return listed;
}

/// A number, a list of numbers or one of texts, as its tokens say.
void readEntry(const Entry& entry, State& state)
{
    requireName(entry);
    const std::vector<Token>& value = entry.tokens();
    const bool isList = !value.empty()
                        && (value.front().kind != TokenKind::number
                            || (value.size() > 1 && (value[1].is('(') || value[1].is('{'))));
    const auto texts = std::count_if(value.begin(), value.end(),
                                     [](const Token& token) { return token.kind == TokenKind::string; });
    if (!isList)
    {
        state.scalars[entry.keyword()] = entry.as<double>();
    }
    else if (texts > 0)
    {
        state.texts[entry.keyword()] = textsIn(entry, texts);
    }
    else
    {
        state.arrays[entry.keyword()] = entry.as<std::vector<double>>();
    }
}

} // namespace

State readState(const fs::path& file)
{
    State state;
    state.file = file;
    state.isEdited = true;
    try
    {
        const Dictionary dictionary = Dictionary::readFile(file, Expansion::none);
        for (const Entry& entry : dictionary.entries())
        {
            if (entry.keyword() == checksumKey)
            {
                state.isEdited = false;
            }
            else if (entry.keyword() != "FoamFile")
            {
                readEntry(entry, state);
            }
        }
        refuseDamage(file); // after all that has a line of its own
    }
    catch (const FatalIOError& error)
    {
        throw FatalIOError(
            std::string(error.what())
                + "\n\nThe run cannot continue from this state: remove the time directory to start "
                  "from an earlier one.",
            error.location());
    }
    return state;
}

StateWriter::StateWriter(fs::path directory, WriteFormat writeFormat, int statesToKeep)
    : caseDirectory(std::move(directory)),
      format(writeFormat),
      purgeWrite(static_cast<std::size_t>(std::max(0, statesToKeep)))
{
}

void StateWriter::write(const std::string& timeName, const State& state)
{
    std::error_code failure;
    const fs::path directory = caseDirectory / timeName;
    const bool isOwn = !fs::exists(directory, failure) || holdsStateAlone(directory);
    writeState(caseDirectory, timeName, state, format);
    const bool isCounted = !written.empty() && written.back() == timeName;
    if (isOwn && !isCounted)
    {
        written.push_back(timeName);
    }
    while (purgeWrite > 0 && written.size() > purgeWrite)
    {
        purge(written.front());
        written.pop_front();
    }
}

void StateWriter::purge(const std::string& timeName)
{
    std::error_code failure;
    const fs::path directory = caseDirectory / timeName;
    if (holdsStateAlone(directory))
    {
        fs::rename(directory, caseDirectory / purgedState, failure);
        if (!failure)
        {
            return;
        }
    }
    // Renamed first, so that a run that is killed here leaves no time directory without its state.
    const fs::path renamed = caseDirectory / fmt::format(".{}.{}.purged", timeName, ::getpid());
    fs::rename(directory, renamed, failure);
    fs::remove_all(failure ? directory : renamed, failure);
}

StateWriter::~StateWriter()
{
    std::error_code ignored;
    if (purgeWrite > 0 && !written.empty())
    {
        fs::remove_all(caseDirectory / purgedState, ignored);
    }
}

} // namespace drystone
