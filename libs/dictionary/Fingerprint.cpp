// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of the input in their order, with separators, and numbers as the bytes of their doubles.
#include "dictionary/Fingerprint.h"

#include "dictionary/DictionaryGrammar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// Between two pieces, so that "ab" "c" is not "a" "bc".
constexpr std::string_view separator("\0", 1);

void add(Fingerprint& print, const Dictionary& dictionary, const std::vector<std::string>& leftOut)
{
    const bool isRoot = dictionary.location().entry.empty();
    for (const Entry& entry : dictionary.entries())
    {
        const std::string& key = entry.keyword();
        if ((isRoot && key == "FoamFile") || std::find(leftOut.begin(), leftOut.end(), key) != leftOut.end())
        {
            continue;
        }
        print.add(entry.keywordText());
        print.add(separator);
        if (entry.isDictionary())
        {
            print.add("{");
            add(print, entry.dictionary(), {});
            print.add("}");
            continue;
        }
        for (const Token& token : entry.tokens())
        {
            if (token.kind == TokenKind::number)
            {
                print.add(std::strtod(std::string(token.text).c_str(), nullptr));
            }
            else
            {
                print.add(token.text);
            }
            print.add(separator);
        }
        print.add(";");
    }
}

void add(Fingerprint& print, const Token& token)
{
    const std::array<char, 2> kind{static_cast<char>('a' + static_cast<int>(token.kind)), ' '};
    print.add(std::string_view(kind.data(), kind.size()));
    print.add(token.text);
    print.add(separator);
}

void add(Fingerprint& print, const Statement& statement)
{
    const char kind = static_cast<char>('A' + static_cast<int>(statement.kind));
    print.add(std::string_view(&kind, 1));
    add(print, statement.keyword);
    for (const Token& token : statement.value)
    {
        add(print, token);
    }
    print.add("{");
    for (const Statement& inner : statement.body)
    {
        add(print, inner);
    }
    print.add("}{");
    for (const Statement& inner : statement.otherwise)
    {
        add(print, inner);
    }
    print.add("}");
}

void collectNamedFiles(const Dictionary& dictionary, std::vector<std::string>& names)
{
    for (const Entry& entry : dictionary.entries())
    {
        if (entry.isDictionary())
        {
            collectNamedFiles(entry.dictionary(), names);
        }
        else if (entry.keyword() == "file" && entry.tokens().size() == 1
                 && (entry.tokens().front().kind == TokenKind::string
                     || entry.tokens().front().kind == TokenKind::word))
        {
            names.push_back(entry.as<std::string>());
        }
    }
}

/// 0 where there is no such file.
std::uint64_t fingerprintOfBytes(const fs::path& file)
{
    std::error_code ignored;
    std::ifstream stream;
    if (fs::is_regular_file(file, ignored))
    {
        stream.open(file, std::ios::binary);
    }
    return stream.is_open() ? fingerprint(std::string{std::istreambuf_iterator<char>(stream), {}}) : 0;
}

} // namespace

void Fingerprint::add(std::string_view bytes)
{
    for (const char c : bytes)
    {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    }
}

void Fingerprint::add(double value)
{
    const auto bytes = std::bit_cast<std::array<char, sizeof(double)>>(value + 0.0); // -0 becomes 0
    add(std::string_view(bytes.data(), bytes.size()));
}

std::uint64_t fingerprint(std::string_view bytes)
{
    Fingerprint print;
    print.add(bytes);
    return print.value();
}

std::uint64_t fingerprint(const Dictionary& dictionary, const std::vector<std::string>& leftOut)
{
    Fingerprint print;
    add(print, dictionary, leftOut);
    return print.value();
}

std::uint64_t fingerprintOfTokens(const SourceFile& file)
{
    try
    {
        Fingerprint print;
        for (const Statement& statement : parseStatements(file))
        {
            if (statement.keyword.text != "FoamFile") // the header of a file says nothing of the case
            {
                add(print, statement);
            }
        }
        return print.value();
    }
    catch (const FatalError&)
    {
        return fingerprint(file.text); // whoever reads it reports what is wrong with it
    }
}

std::vector<std::string> filesNamedIn(const Dictionary& dictionary)
{
    std::vector<std::string> names;
    collectNamedFiles(dictionary, names);
    return names;
}

std::vector<InputFile> inputFiles(const fs::path& caseDirectory, const std::vector<std::string>& names)
{
    std::vector<InputFile> result;
    std::vector<std::string> named;
    for (const std::string& name : names)
    {
        const fs::path file = caseDirectory / name;
        std::error_code ignored;
        if (!fs::exists(file, ignored))
        {
            result.push_back({name, 0});
            continue;
        }
        const Dictionary dictionary = Dictionary::readFile(file);
        result.push_back({name, fingerprint(dictionary)});
        collectNamedFiles(dictionary, named);
    }
    std::sort(named.begin(), named.end());
    named.erase(std::unique(named.begin(), named.end()), named.end());
    for (const std::string& name : named)
    {
        result.push_back({name, fingerprintOfBytes(caseDirectory / name)}); // an absolute one stays so
    }
    return result;
}

std::vector<std::string> textsOf(const std::vector<InputFile>& files)
{
    std::vector<std::string> texts;
    for (const InputFile& file : files)
    {
        // What a quoted text cannot hold is in no name that anyone gives a file.
        std::string name = file.name;
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '"' || c == '\\' || c == '\n'; }, '?');
        texts.push_back(fmt::format("{:016x} {}", file.content, name));
    }
    return texts;
}

std::vector<InputFile> inputFilesIn(const std::vector<std::string>& texts)
{
    constexpr std::size_t digits = 16;
    std::vector<InputFile> files;
    for (const std::string& text : texts)
    {
        InputFile file;
        const char* end = text.data() + std::min(digits, text.size());
        const auto [stop, error] = std::from_chars(text.data(), end, file.content, 16);
        if (error == std::errc() && stop == end && text.size() > digits + 1 && text[digits] == ' ')
        {
            file.name = text.substr(digits + 1);
            files.push_back(std::move(file));
        }
    }
    return files;
}

std::vector<InputChange> changesOfInput(const std::vector<InputFile>& before,
                                        const std::vector<InputFile>& now)
{
    std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> contents;
    for (const InputFile& file : before)
    {
        contents[file.name].first = file.content;
    }
    for (const InputFile& file : now)
    {
        contents[file.name].second = file.content;
    }
    std::vector<InputChange> changes;
    for (const auto& [name, content] : contents)
    {
        const auto& [then, today] = content;
        if (then != today)
        {
            changes.push_back({name, name
                                         + (then == 0    ? " is new"
                                            : today == 0 ? " is gone"
                                                         : " has changed")});
        }
    }
    return changes;
}

std::string textOf(const std::vector<InputChange>& changes)
{
    std::string text;
    for (const InputChange& change : changes)
    {
        text += (text.empty() ? "" : ", ") + change.text;
    }
    return text;
}

} // namespace drystone
