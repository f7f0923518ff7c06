// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Parses the statements to find the names, and replaces these alone: all else in the text stays.
#include "dictionary/CopiedIncludes.h"

#include "dictionary/DictionaryGrammar.h"
#include "dictionary/IncludedFiles.h"

namespace drystone
{
namespace
{

/// From where a name leads to its file.
enum class NamedFrom
{
    folderOfFile, ///< an include
    caseDirectory ///< a drawing, solids, a record: an entry `file`
};

/// Calls use(name, from) for the name of every file that statements include, or that their entries `file`
/// name, in the order of the text. Names with folders stand between quotes.
template<class Use>
void forNamesOfFiles(const std::vector<Statement>& statements, const Use& use)
{
    for (const Statement& statement : statements)
    {
        const Token* before = &statement.keyword;
        for (const Token& token : statement.value)
        {
            const bool isOfEntry = before == &statement.keyword && before->text == "file";
            if (token.kind == TokenKind::string && (isInclude(*before) || isOfEntry))
            {
                use(token.text, isOfEntry ? NamedFrom::caseDirectory : NamedFrom::folderOfFile);
            }
            before = &token;
        }
        forNamesOfFiles(statement.body, use);
        forNamesOfFiles(statement.otherwise, use);
    }
}

} // namespace

std::string withFilesFromOutside(const std::string& text, const std::filesystem::path& file,
                                 const std::filesystem::path& caseDirectory)
{
    namespace fs = std::filesystem;
    if (text.find("..") == std::string::npos)
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
        forNamesOfFiles(parseStatements(source),
                        [&](std::string_view name, NamedFrom from)
                        {
                            const fs::path& start = from == NamedFrom::folderOfFile ? folder : ofCase;
                            const fs::path path = (start / name).lexically_normal();
                            if (name.starts_with("..")
                                && path.lexically_relative(ofCase).string().starts_with(".."))
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
