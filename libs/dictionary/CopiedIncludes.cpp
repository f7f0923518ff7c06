// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Parses the statements to find the names, and replaces these alone: all else in the text stays.
#include "dictionary/CopiedIncludes.h"

#include "dictionary/DictionaryGrammar.h"
#include "dictionary/IncludedFiles.h"

namespace drystone
{
namespace
{

/// Calls use(name) for the name of every file that statements include, in the order of the text.
template<class Use>
void forIncludedNames(const std::vector<Statement>& statements, const Use& use)
{
    for (const Statement& statement : statements)
    {
        const Token* before = &statement.keyword;
        for (const Token& token : statement.value)
        {
            if (isInclude(*before) && token.kind == TokenKind::string)
            {
                use(token.text);
            }
            before = &token;
        }
        forIncludedNames(statement.body, use);
        forIncludedNames(statement.otherwise, use);
    }
}

} // namespace

std::string withIncludesFromOutside(const std::string& text, const std::filesystem::path& file,
                                    const std::filesystem::path& caseDirectory)
{
    namespace fs = std::filesystem;
    if (text.find("include") == std::string::npos || text.find("..") == std::string::npos)
    {
        return text;
    }
    const SourceFile source{file.string(), text};
    std::string result = text;
    try
    {
        const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
        const fs::path ofCase = (fs::absolute(caseDirectory) / "").lexically_normal().parent_path();
        std::size_t grown = 0;
        forIncludedNames(
            parseStatements(source),
            [&](std::string_view name)
            {
                const fs::path path = (folder / name).lexically_normal();
                if (name.starts_with("..") && path.lexically_relative(ofCase).string().starts_with(".."))
                {
                    const auto place = static_cast<std::size_t>(name.data() - source.text.data());
                    result.replace(place + grown, name.size(), path.string());
                    grown += path.string().size() - name.size();
                }
            });
    }
    catch (const FatalError&)
    {
        return text;
    }
    return result;
}

} // namespace drystone
