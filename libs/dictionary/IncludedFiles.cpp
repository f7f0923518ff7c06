// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Replaces `<case>`, `<etc>` and macros in names; refuses loops, and includes too many or too deep.
#include "dictionary/IncludedFiles.h"

#include "core/WholeFile.h"
#include "dictionary/DictionaryScanner.h"
#include "dictionary/FilesInMemory.h"
#include "dictionary/MacroExpansion.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace drystone
{
namespace
{

/// Files that one dictionary may include, directly or not.
constexpr std::size_t mostFiles = 10'000;
/// Files that may be inside each other.
constexpr std::size_t deepestInclude = 50;

std::string contentOf(const std::filesystem::path& file, const SourceLocation& whence)
{
    if (const FilesInMemory* files = FilesInMemory::current())
    {
        if (const std::string* text = files->textOf(file))
        {
            return *text;
        }
    }
    const auto fail = [&](const std::string& message) -> FatalIOError {
        return FatalIOError(message, whence.file.empty() ? SourceLocation{file.string(), "", 0} : whence);
    };
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status))
    {
        throw fail(fmt::format("The file {} does not exist.\n\nCheck its name, and whether this is the case "
                               "directory: another one is named with -case DIR.",
                               file.string()));
    }
    if (std::filesystem::is_directory(status))
    {
        throw fail(fmt::format("{} is a directory, but a file is wanted here.", file.string()));
    }
    if (!std::filesystem::is_regular_file(status))
    {
        throw fail(fmt::format("{} is not an ordinary file.", file.string()));
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
    {
        throw fail(fmt::format("The file {} cannot be opened. Do you have the permission to read it?",
                               file.string()));
    }
    std::string text;
    text.resize(std::filesystem::file_size(file));
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (stream.bad())
    {
        throw fail(fmt::format("The file {} cannot be read.", file.string()));
    }
    return text;
}

/// The name of a file with the directory for which `<case>` and the like stand at its beginning.
std::string withDirectories(const DictionaryReading& reading, std::string_view written)
{
    std::string name(written);
    const auto replaceStart = [&name](std::string_view start, const std::filesystem::path& by)
    {
        if (name.starts_with(start))
        {
            name = (by / name.substr(std::min(name.size(), start.size()))).string();
        }
    };
    replaceStart("<case>/", reading.caseDirectory);
    replaceStart("<system>/", reading.caseDirectory / "system");
    replaceStart("<constant>/", reading.caseDirectory / "constant");
    replaceStart("<etc>/", etcDirectory());
    return name;
}

/// Refuses a file that is being read already, and more open ones than there may be.
void refuseLoop(const DictionaryReading& reading, const std::filesystem::path& path,
                const SourceLocation& location)
{
    if (reading.openFiles.size() >= deepestInclude)
    {
        throw FatalIOError(fmt::format("Files include each other more than {} deep.", deepestInclude),
                           location);
    }
    std::error_code error;
    const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
    for (const std::filesystem::path& open : reading.openFiles)
    {
        if (std::filesystem::weakly_canonical(open, error) == real)
        {
            throw FatalIOError(
                fmt::format("The files include each other in a loop: {} is being read already. "
                            "Remove one of the #include.",
                            path.string()),
                location);
        }
    }
}

} // namespace

std::filesystem::path caseOf(const std::filesystem::path& file)
{
    std::filesystem::path directory = file.parent_path();
    for (int level = 0; level < 4 && !directory.empty(); ++level)
    {
        const std::filesystem::path name = directory.filename();
        if (name == "system" || name == "constant")
        {
            return directory.parent_path().empty() ? "." : directory.parent_path();
        }
        directory = directory.parent_path();
    }
    return file.parent_path().empty() ? "." : file.parent_path();
}

bool isInclude(const Token& directive)
{
    return directive.text == "#include" || directive.text == "#includeIfPresent"
           || directive.text == "#sinclude" || directive.text == "#includeEtc"
           || directive.text == "#sincludeEtc";
}

std::optional<std::filesystem::path> included(const DictionaryReading& reading, const Token& directive,
                                              const Token& argument)
{
    const SourceLocation location = locationOf(reading, directive);
    const std::string name = substituted(reading, withDirectories(reading, argument.text), location);
    if (name.empty())
    {
        failArgument(reading, directive, "the name of a file: #include \"name\"");
    }
    std::filesystem::path path = name;
    const bool isEtc = directive.text.ends_with("Etc");
    if (path.is_relative())
    {
        path = (isEtc ? etcDirectory() : reading.openFiles.back().parent_path()) / path;
    }
    path = path.lexically_normal();
    std::error_code error;
    if (std::filesystem::exists(path, error))
    {
        refuseLoop(reading, path, location);
        return path;
    }
    if (directive.text == "#includeIfPresent" || directive.text.starts_with("#sinclude"))
    {
        return std::nullopt;
    }
    throw FatalIOError(fmt::format("The file {} that is to be included does not exist.{}", path.string(),
                                   isEtc ? "" : " Its name counts from the file that includes it."),
                       location);
}

const SourceFile& load(DictionaryReading& reading, const std::filesystem::path& path,
                       const SourceLocation& whence)
{
    if (++reading.filesRead > mostFiles)
    {
        throw FatalIOError(fmt::format("More than {} files are included.", mostFiles), whence);
    }
    reading.source->files.push_back(
        {path.lexically_normal().string(), withLineFeeds(contentOf(path, whence))});
    return reading.source->files.back();
}

std::filesystem::path etcDirectory()
{
    if (const char* directory = std::getenv("DRYSTONE_ETC"))
    {
        return directory;
    }
    // An installed application has it next to its folder.
    std::error_code unknown;
    const std::filesystem::path installed = sharedFolder() / "etc";
    return std::filesystem::is_directory(installed, unknown) ? installed : DRYSTONE_ETC_DIRECTORY;
}

} // namespace drystone
