// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes and reads states. A state consists of entries with one number or one list, a subset of the
/// dictionary grammar, and is read here in one pass: the grammar has no binary lists, and the state of a
/// large wall has a million numbers.
#include "io/TimeDirectory.h"

#include "core/Error.h"
#include "core/WholeFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

static_assert(std::endian::native == std::endian::little, "the header of a binary state says LSB");

/// Reads a state from its text and keeps track of the line.
class StateReader
{
public:
    StateReader(const fs::path& path, std::string_view content) : file(path), text(content) {}

    State read()
    {
        State state;
        state.file = file;
        bool binary = false;
        for (skip(); at < text.size(); skip())
        {
            const std::string name(word());
            skip();
            if (name == "FoamFile")
            {
                binary = header();
            }
            else if (next("List<scalar>"))
            {
                state.arrays[name] = list(binary);
            }
            else
            {
                value(state, name);
            }
            if (name != "FoamFile")
            {
                expect(';');
            }
        }
        return state;
    }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        throw FatalIOError(
            what
                + "\n\nThe run cannot continue from this state: remove the time directory to start "
                  "from an earlier one.",
            {file.string(), "", static_cast<int>(line)});
    }

    void skip()
    {
        while (at < text.size())
        {
            if (std::isspace(static_cast<unsigned char>(text[at])) != 0)
            {
                ++at;
            }
            else if (text.substr(at, 2) == "//")
            {
                at = std::min(text.find('\n', at), text.size());
            }
            else if (text.substr(at, 2) == "/*")
            {
                const auto end = text.find("*/", at + 2);
                if (end == text.npos)
                {
                    fail("A comment does not end.");
                }
                at = end + 2;
            }
            else
            {
                return;
            }
        }
    }

    bool next(std::string_view token)
    {
        if (text.substr(at, token.size()) != token)
        {
            return false;
        }
        at += token.size();
        return true;
    }

    void expect(char c)
    {
        skip();
        if (at >= text.size())
        {
            fail(fmt::format("The file ends where '{}' was expected.", c));
        }
        if (text[at] != c)
        {
            fail(fmt::format("Expected '{}'.", c));
        }
        ++at;
    }

    std::string_view word()
    {
        const std::size_t begin = at;
        while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) == 0
               && std::string_view(";(){}").find(text[at]) == std::string_view::npos)
        {
            ++at;
        }
        if (at == begin)
        {
            fail("Expected the name of an entry.");
        }
        return text.substr(begin, at - begin);
    }

    double number()
    {
        skip();
        double result = 0;
        const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), result);
        if (error != std::errc() || !std::isfinite(result))
        {
            fail("Expected a finite number.");
        }
        at = static_cast<std::size_t>(end - text.data());
        return result;
    }

    std::size_t size()
    {
        skip();
        std::size_t result = 0;
        const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), result);
        if (error != std::errc() || result > text.size())
        {
            fail("Expected the size of a list.");
        }
        at = static_cast<std::size_t>(end - text.data());
        return result;
    }

    std::vector<double> list(bool binary)
    {
        std::vector<double> values(size());
        expect('(');
        if (binary)
        {
            const std::size_t bytes = values.size() * sizeof(double);
            if (text.size() - at < bytes)
            {
                fail(fmt::format("The file ends within a list of {} numbers.", values.size()));
            }
            if (bytes > 0)
            {
                std::memcpy(values.data(), text.data() + at, bytes);
            }
            if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
            {
                fail("A list holds a value that is not a finite number.");
            }
            at += bytes;
        }
        else
        {
            for (double& value : values)
            {
                value = number();
            }
        }
        expect(')');
        return values;
    }

    /// Whether `2("one" "two")` is next.
    bool textsAreNext() const
    {
        const std::size_t parenthesis = text.find('(', at);
        const std::size_t first = text.find_first_not_of(" \t\r\n", parenthesis + 1);
        return first != text.npos && text[first] == '"';
    }

    std::vector<std::string> texts()
    {
        std::vector<std::string> result(size());
        expect('(');
        for (std::string& one : result)
        {
            expect('"');
            const std::size_t end = std::min(text.find_first_of("\"\\\n", at), text.size());
            one = text.substr(at, end - at);
            at = end;
            if (!next("\""))
            {
                fail("A text does not end on its line.");
            }
        }
        expect(')');
        return result;
    }

    /// `0.5`, `2(0.5 0.6)` or `2("one" "two")`: a list is distinguished from a number by its parenthesis.
    void value(State& state, const std::string& name)
    {
        const std::size_t end = text.find_first_of(";(", at);
        if (end != text.npos && text[end] == '(')
        {
            if (textsAreNext())
            {
                state.texts[name] = texts();
            }
            else
            {
                state.arrays[name] = list(false);
            }
        }
        else
        {
            state.scalars[name] = number();
        }
    }

    /// True when the format is binary.
    bool header()
    {
        const std::size_t end = text.find('}', at);
        if (end == text.npos)
        {
            fail("The header FoamFile does not end.");
        }
        const std::string_view entries = text.substr(at, end - at);
        at = end + 1;
        const std::size_t entry = entries.find("format");
        const bool binary =
            entry != entries.npos
            && entries.substr(entry, entries.find(';', entry) - entry).find("binary") != entries.npos;
        if (binary && entries.find("LSB;label=32;scalar=64") == entries.npos)
        {
            fail("This binary state comes from a machine with another byte order.");
        }
        return binary;
    }

    const fs::path& file;
    std::string_view text;
    std::size_t at = 0;
};

fs::path stateFile(const fs::path& caseDirectory, const std::string& timeName)
{
    return caseDirectory / timeName / "state";
}

} // namespace

double stateScalar(const State& state, const std::string& name)
{
    const auto found = state.scalars.find(name);
    if (found == state.scalars.end())
    {
        throw FatalIOError(
            fmt::format("The state has no entry {}; it was written by another version or application.", name),
            {state.file.string(), "", 0});
    }
    return found->second;
}

const std::vector<double>& stateArray(const State& state, const std::string& name, std::size_t size)
{
    const auto found = state.arrays.find(name);
    if (found == state.arrays.end())
    {
        throw FatalIOError(
            fmt::format("The state has no list {}; it was written by another version or application.", name),
            {state.file.string(), "", 0});
    }
    if (found->second.size() != size)
    {
        throw FatalIOError(
            fmt::format("The list {} of the state has {} values where this case needs {}. Did the "
                        "blocks change since it was written?",
                        name, found->second.size(), size),
            {state.file.string(), "", 0});
    }
    return found->second;
}

std::string stateText(const State& state, WriteFormat format)
{
    const auto check = [](const std::string& name, double value)
    {
        if (!std::isfinite(value))
        {
            throw FatalError(fmt::format("{} of the state to be written is not a finite number.", name));
        }
    };
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
        check(name, value);
        fmt::format_to(out, "{} {};\n", name, value);
    }
    for (const auto& [name, texts] : state.texts)
    {
        fmt::format_to(out, "\n{} {}\n(\n", name, texts.size());
        for (const std::string& line : texts)
        {
            if (line.find_first_of("\"\\\n") != std::string::npos)
                throw FatalError(fmt::format("{} of the state to be written cannot be put between quotes: {}",
                                             name, line));
            fmt::format_to(out, "\"{}\"\n", line);
        }
        text += ");\n";
    }
    for (const auto& [name, values] : state.arrays)
    {
        for (const double value : values)
        {
            check(name, value);
        }
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
                fmt::format_to(out, "{}\n", value);
            }
        }
        text += ");\n";
    }
    return text;
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
    writeWholeFile(stateFile(caseDirectory, temporary), text);
    fs::rename(caseDirectory / temporary, caseDirectory / timeName, failure);
    if (failure)
    {
        const std::string reason = failure.message();
        fs::remove_all(caseDirectory / temporary, failure);
        throw FatalError(fmt::format("Cannot make the time directory {}: {}.",
                                     (caseDirectory / timeName).string(), reason));
    }
}

State readState(const fs::path& file)
{
    std::error_code error;
    std::ifstream stream;
    if (fs::is_regular_file(file, error)) // reading from a pipe could block for ever
    {
        stream.open(file, std::ios::binary);
    }
    if (!stream.is_open())
    {
        throw FatalError(fmt::format(
            "Cannot read the state {}: there is no such file, or it may not be read.", file.string()));
    }
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    return StateReader(file, text).read();
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
    const bool isNew = !fs::exists(caseDirectory / timeName, failure);
    writeState(caseDirectory, timeName, state, format);
    if (isNew)
    {
        written.push_back(timeName);
    }
    while (purgeWrite > 0 && written.size() > purgeWrite)
    {
        // Renamed first, so that a run that is killed here leaves no time directory without its state.
        const fs::path renamed = caseDirectory / fmt::format(".{}.{}.purged", written.front(), ::getpid());
        fs::rename(caseDirectory / written.front(), renamed, failure);
        fs::remove_all(failure ? caseDirectory / written.front() : renamed, failure);
        written.pop_front();
    }
}

} // namespace drystone
