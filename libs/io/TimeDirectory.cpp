// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writing and reading of states. A state holds one number or list an entry and no more of the dictionary
/// grammar, so that it is read here in one pass: the grammar has no binary lists, and a state of a large wall
/// has a million numbers.
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

/// Reads a state from its text; knows the line it is at.
class StateReader
{
public:
    StateReader(const fs::path& file, std::string_view text) : file_(file), text_(text) {}

    State read()
    {
        State state;
        state.file = file_;
        bool binary = false;
        for (skip(); at_ < text_.size(); skip())
        {
            const std::string name(word());
            skip();
            if (name == "FoamFile")
                binary = header();
            else if (next("List<scalar>"))
                state.arrays[name] = list(binary);
            else
                value(state, name);
            if (name != "FoamFile")
                expect(';');
        }
        return state;
    }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        const auto line =
            1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
        throw FatalIOError(
            what
                + "\n\nThe run cannot continue from this state: remove the time directory to start "
                  "from an earlier one.",
            {file_.string(), "", static_cast<int>(line)});
    }

    void skip()
    {
        while (at_ < text_.size())
        {
            if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
                ++at_;
            else if (text_.substr(at_, 2) == "//")
                at_ = std::min(text_.find('\n', at_), text_.size());
            else if (text_.substr(at_, 2) == "/*")
            {
                const auto end = text_.find("*/", at_ + 2);
                if (end == text_.npos)
                    fail("A comment does not end.");
                at_ = end + 2;
            }
            else
                return;
        }
    }

    bool next(std::string_view token)
    {
        if (text_.substr(at_, token.size()) != token)
            return false;
        at_ += token.size();
        return true;
    }

    void expect(char c)
    {
        skip();
        if (at_ >= text_.size())
            fail(fmt::format("The file ends where '{}' was expected.", c));
        if (text_[at_] != c)
            fail(fmt::format("Expected '{}'.", c));
        ++at_;
    }

    std::string_view word()
    {
        const std::size_t begin = at_;
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) == 0
               && std::string_view(";(){}").find(text_[at_]) == std::string_view::npos)
            ++at_;
        if (at_ == begin)
            fail("Expected the name of an entry.");
        return text_.substr(begin, at_ - begin);
    }

    double number()
    {
        skip();
        double result = 0;
        const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), result);
        if (error != std::errc() || !std::isfinite(result))
            fail("Expected a finite number.");
        at_ = static_cast<std::size_t>(end - text_.data());
        return result;
    }

    std::size_t size()
    {
        skip();
        std::size_t result = 0;
        const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), result);
        if (error != std::errc() || result > text_.size())
            fail("Expected the size of a list.");
        at_ = static_cast<std::size_t>(end - text_.data());
        return result;
    }

    std::vector<double> list(bool binary)
    {
        std::vector<double> values(size());
        expect('(');
        if (binary)
        {
            const std::size_t bytes = values.size() * sizeof(double);
            if (text_.size() - at_ < bytes)
                fail(fmt::format("The file ends within a list of {} numbers.", values.size()));
            if (bytes > 0)
                std::memcpy(values.data(), text_.data() + at_, bytes);
            if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
                fail("A list holds a value that is not a finite number.");
            at_ += bytes;
        }
        else
            for (double& value : values)
                value = number();
        expect(')');
        return values;
    }

    /// `0.5` or `2(0.5 0.6)`: a list is told from a number by its parenthesis.
    void value(State& state, const std::string& name)
    {
        const std::size_t end = text_.find_first_of(";(", at_);
        if (end != text_.npos && text_[end] == '(')
            state.arrays[name] = list(false);
        else
            state.scalars[name] = number();
    }

    /// True when the format is binary.
    bool header()
    {
        const std::size_t end = text_.find('}', at_);
        if (end == text_.npos)
            fail("The header FoamFile does not end.");
        const std::string_view entries = text_.substr(at_, end - at_);
        at_ = end + 1;
        const std::size_t format = entries.find("format");
        const bool binary =
            format != entries.npos
            && entries.substr(format, entries.find(';', format) - format).find("binary") != entries.npos;
        if (binary && entries.find("LSB;label=32;scalar=64") == entries.npos)
            fail("This binary state comes from a machine with another byte order.");
        return binary;
    }

    const fs::path& file_;
    std::string_view text_;
    std::size_t at_ = 0;
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
        throw FatalIOError(
            fmt::format("The state has no entry {}; it was written by another version or application.", name),
            {state.file.string(), "", 0});
    return found->second;
}

const std::vector<double>& stateArray(const State& state, const std::string& name, std::size_t size)
{
    const auto found = state.arrays.find(name);
    if (found == state.arrays.end())
        throw FatalIOError(
            fmt::format("The state has no list {}; it was written by another version or application.", name),
            {state.file.string(), "", 0});
    if (found->second.size() != size)
        throw FatalIOError(
            fmt::format("The list {} of the state has {} values where this case needs {}. Did the "
                        "blocks change since it was written?",
                        name, found->second.size(), size),
            {state.file.string(), "", 0});
    return found->second;
}

std::string stateText(const State& state, WriteFormat format)
{
    const auto check = [](const std::string& name, double value)
    {
        if (!std::isfinite(value))
            throw FatalError(fmt::format("{} of the state to be written is not a finite number.", name));
    };
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out,
                   "FoamFile\n{{\n    version     2.0;\n    format      {};\n{}    class       dictionary;\n"
                   "    object      state;\n}}\n\n",
                   format == WriteFormat::ascii ? "ascii" : "binary",
                   format == WriteFormat::ascii ? "" : "    arch        \"LSB;label=32;scalar=64\";\n");
    // fmt gives the fewest digits that read back as the same number: never more than 17.
    for (const auto& [name, value] : state.scalars)
    {
        check(name, value);
        fmt::format_to(out, "{} {};\n", name, value);
    }
    for (const auto& [name, values] : state.arrays)
    {
        for (const double value : values)
            check(name, value);
        if (format == WriteFormat::binary)
        {
            fmt::format_to(out, "\n{} List<scalar> {}(", name, values.size());
            text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
        }
        else
        {
            fmt::format_to(out, "\n{} {}\n(\n", name, values.size());
            for (const double value : values)
                fmt::format_to(out, "{}\n", value);
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
        return writeWholeFile(stateFile(caseDirectory, timeName), text);

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
    if (fs::is_regular_file(file, error)) // a pipe would let us wait for ever
        stream.open(file, std::ios::binary);
    if (!stream.is_open())
        throw FatalError(fmt::format(
            "Cannot read the state {}: there is no such file, or it may not be read.", file.string()));
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    return StateReader(file, text).read();
}

StateWriter::StateWriter(fs::path caseDirectory, WriteFormat format, int purgeWrite)
    : caseDirectory_(std::move(caseDirectory)),
      format_(format),
      purgeWrite_(static_cast<std::size_t>(std::max(0, purgeWrite)))
{
}

void StateWriter::write(const std::string& timeName, const State& state)
{
    std::error_code failure;
    const bool isNew = !fs::exists(caseDirectory_ / timeName, failure);
    writeState(caseDirectory_, timeName, state, format_);
    if (isNew)
        written_.push_back(timeName);
    while (purgeWrite_ > 0 && written_.size() > purgeWrite_)
    {
        // Out of sight first: a run that is killed now leaves no time directory without its state.
        const fs::path doomed = caseDirectory_ / fmt::format(".{}.{}.purged", written_.front(), ::getpid());
        fs::rename(caseDirectory_ / written_.front(), doomed, failure);
        fs::remove_all(failure ? caseDirectory_ / written_.front() : doomed, failure);
        written_.pop_front();
    }
}

} // namespace drystone
