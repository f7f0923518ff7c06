// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the files that the runs of a study read.
#include "ensembles/StudyInput.h"

#include "core/Error.h"
#include "core/WholeFile.h"
#include "dictionary/Dictionary.h"
#include "dictionary/FilesInMemory.h"
#include "ensembles/ApplicationRun.h"
#include "ensembles/CaseCopy.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include <sys/stat.h>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// The first of the lines: of no form that a file has.
constexpr const char* howCompared = "input of dictionaries by tokens\n";

/// Whether editors and users leave such files as copies: nothing reads them.
bool isCopy(const fs::path& file)
{
    constexpr std::array<std::string_view, 9> endings{".orig", ".bak",  ".swp", ".swo", ".old",
                                                      ".rej",  ".save", ".tmp", ".copy"};
    const std::string name = file.filename().string();
    return name.ends_with("~") || name.starts_with("#")
           || std::any_of(endings.begin(), endings.end(),
                          [&](std::string_view ending) { return name.ends_with(ending); });
}

/// The files that a dictionary was read from: all its entries with values share them.
const SourceText* sourceOf(const Dictionary& dictionary)
{
    const SourceText* text = nullptr;
    for (const Entry& entry : dictionary.entries())
    {
        text = text ? text : entry.isDictionary() ? sourceOf(entry.dictionary()) : entry.sourceText().get();
    }
    return text;
}

/// What of a dictionary counts.
enum class ComparedBy
{
    tokens,
    bytes ///< where scripts may read it in their own way
};

/// Collects files, each once, with what is in them.
class InputFiles
{
public:
    InputFiles(const fs::path& directory, ComparedBy what)
        : caseDirectory(directory.lexically_normal()), comparedBy(what)
    {
    }

    /// \return its text when it is new
    std::optional<std::string> add(const fs::path& file)
    {
        std::error_code none;
        const std::string name = nameOf(file);
        if (contents.contains(name) || !fs::is_regular_file(file, none))
        {
            return {};
        }
        std::string text = contentOfFile(file);
        contents[name] = fingerprint(text);
        return text;
    }

    /// A dictionary with the files that it includes, and those that its entries `file` name.
    void addDictionary(const fs::path& file)
    {
        try
        {
            const Dictionary dictionary = Dictionary::readFile(file);
            if (const SourceText* text = sourceOf(dictionary))
            {
                for (const SourceFile& source : text->files)
                {
                    add(source.name);
                    compareByTokens(source.name);
                }
            }
            for (const std::string& named : filesNamedIn(dictionary))
            {
                add(caseDirectory / named); // an absolute one stays so
                data.insert(nameOf(caseDirectory / named));
            }
        }
        catch (const FatalIOError&)
        {
            // Whoever reads it reports what is wrong with it; as bytes it counts all the same.
        }
    }

    std::vector<InputFile> files() const
    {
        std::vector<InputFile> result;
        for (const auto& [name, content] : contents)
        {
            const auto tokens = data.contains(name) ? tokenContents.end() : tokenContents.find(name);
            result.push_back({name, tokens == tokenContents.end() ? content : tokens->second});
        }
        return result;
    }

private:
    /// Relative to the case, however its directory was given.
    std::string nameOf(const fs::path& file) const
    {
        const fs::path normal = file.lexically_normal();
        const fs::path relative = normal.lexically_relative(caseDirectory);
        const fs::path ofEtc = normal.lexically_relative(etcDirectory().lexically_normal());
        return !ofEtc.empty() && *ofEtc.begin() != ".." ? "<etc>/" + ofEtc.string()
               : relative.empty()                       ? normal.string()
                                                        : relative.string();
    }

    void compareByTokens(const fs::path& file)
    {
        const std::string name = nameOf(file);
        if (comparedBy == ComparedBy::tokens && contents.contains(name) && !tokenContents.contains(name))
        {
            tokenContents[name] = fingerprintOfTokens({name, contentOfFile(file)});
        }
    }

    fs::path caseDirectory;
    ComparedBy comparedBy;
    std::map<std::string, std::uint64_t> contents;      ///< fingerprints by name, of the bytes
    std::map<std::string, std::uint64_t> tokenContents; ///< of dictionaries
    std::set<std::string> data;                         ///< that dictionaries name
};

/// Whether a text has the name as a word of its own, or at the end of a path.
bool mentions(const std::string& text, const std::string& name)
{
    const auto isOfName = [](char c)
    { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.'; };
    for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1))
    {
        const std::size_t end = at + name.size();
        if ((at == 0 || !isOfName(text[at - 1])) && (end == text.size() || !isOfName(text[end])))
        {
            return true;
        }
    }
    return false;
}

/// The scripts of a case, and what they mention of it.
void addScripts(InputFiles& files, const fs::path& caseDirectory, const fs::path& directory,
                const StudyRuns& runs)
{
    std::vector<std::string> texts;
    for (const std::string& application : runs.applications)
    {
        if (isScript(application))
        {
            if (std::optional<std::string> text = files.add(directory / application))
            {
                texts.push_back(std::move(*text));
            }
        }
    }
    std::vector<fs::path> others = texts.empty() ? std::vector<fs::path>() : filesOfCase(caseDirectory);
    for (std::size_t i = 0; i < texts.size(); ++i) // grows: a script may run another one
    {
        for (const fs::path& file : others)
        {
            if (!isCopy(file) && mentions(texts[i], file.filename().string()))
            {
                if (std::optional<std::string> text = files.add(file))
                {
                    texts.push_back(std::move(*text));
                }
            }
        }
    }
}

/// What applications read from the folders of a case.
void addFolders(InputFiles& files, const fs::path& caseDirectory, const fs::path& directory,
                const StudyRuns& runs)
{
    const bool writesBlocks = !runs.applications.empty() && runs.applications.front() == "blockTexture";
    constexpr std::array<std::string_view, 4> studies{"accuracyCost", "ensemble", "incrementalDynamics",
                                                      "parameterSearch"};
    const auto isOfOthers = [&](const fs::path& name)
    {
        return std::any_of(studies.begin(), studies.end(),
                           [&](std::string_view study)
                           {
                               return name == "system/" + std::string(study) + "Dict" && !hasScript(runs)
                                      && std::find(runs.applications.begin(), runs.applications.end(), study)
                                             == runs.applications.end();
                           });
    };
    for (const CaseFolder& folder : caseFolders())
    {
        std::error_code none;
        if (!fs::is_directory(directory / folder.name, none))
        {
            continue;
        }
        for (const fs::path& file : filesOfCase(directory / folder.name))
        {
            const fs::path name = file.lexically_relative(directory);
            const bool isBlocks = name.string().starts_with("constant/assembly/");
            if (isCopy(file) || (isBlocks && writesBlocks) || isOfOthers(name)
                || file.lexically_relative(caseDirectory) == runs.dictionary)
            {
                continue;
            }
            files.add(file);
            const std::string known = name.filename().string();
            if (!isBlocks && known != "state"
                && std::find(folder.files.begin(), folder.files.end(), known) != folder.files.end())
            {
                files.addDictionary(file);
            }
        }
    }
}

/// The lines of a text with input, without `input`.
std::vector<std::string> linesIn(const std::string& text, const std::string& mark)
{
    const std::string start = mark + "input ";
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
    {
        if (line.starts_with(start))
        {
            lines.push_back(line.substr(start.size()));
        }
    }
    return lines;
}

} // namespace

bool hasScript(const StudyRuns& runs)
{
    return std::any_of(runs.applications.begin(), runs.applications.end(), isScript);
}

std::vector<InputFile> inputOfQuestions(const fs::path& caseDirectory, const std::string& study)
{
    const std::string name = "system/" + study + "Dict";
    return {{name, fingerprint(Dictionary::readFile(caseDirectory / name), {"jobs"})}};
}

std::vector<InputFile> inputOfStudy(const fs::path& caseDirectory, const StudyRuns& runs)
{
    const fs::path base = (caseDirectory / "").lexically_normal();
    InputFiles files(base, hasScript(runs) ? ComparedBy::bytes : ComparedBy::tokens);
    for (const std::string& name : runs.cases)
    {
        const fs::path directory = (base / name).lexically_normal();
        addFolders(files, base, directory, runs);
        addScripts(files, base, directory, runs);
    }
    for (const std::string& name : runs.data)
    {
        files.add(base / name); // an absolute one stays so
    }
    return files.files();
}

std::string inputLines(const std::vector<InputFile>& files, const std::string& mark)
{
    std::string text = mark + howCompared;
    for (const std::string& line : textsOf(files))
    {
        text += mark + "input " + line + "\n";
    }
    return text;
}

std::string editedCaseText(const std::string& change, const std::string& begun, const std::string& kept,
                           const std::string& study)
{
    return fmt::format(
        "The case is not what it was when {} begun: {}. {} of before are kept. Restore what was "
        "there to continue, or remove postProcessing/{} to start again.",
        begun, change, kept, study);
}

InputWatch::InputWatch(fs::path watchedCase, StudyRuns runsOfStudy, std::string lines,
                       std::string markOfLines)
    : caseDirectory(std::move(watchedCase)),
      runs(std::move(runsOfStudy)),
      before(std::move(lines)),
      mark(std::move(markOfLines)),
      files(inputOfStudy(caseDirectory, runs))
{
}

/// When and how often they were written, as far as the file system knows.
std::string InputWatch::touches() const
{
    std::string text;
    const auto add = [&text](const fs::path& path)
    {
        struct stat status = {};
        if (::stat(path.c_str(), &status) == 0)
        {
            text += fmt::format("{} {} {} {}\n", status.st_mtim.tv_sec, status.st_mtim.tv_nsec,
                                status.st_size, status.st_ino);
        }
        else
        {
            text += "none\n";
        }
    };
    for (const InputFile& file : files)
    {
        add(caseDirectory / file.name);
    }
    for (const std::string& directory : runs.cases)
    {
        for (const CaseFolder& folder : caseFolders()) // where files may come and go
        {
            add(caseDirectory / directory / folder.name);
        }
    }
    return text;
}

std::string InputWatch::change()
{
    std::string now = touches();
    if (now == known)
    {
        return "";
    }
    const FilesOnDisk disk; // a sample's own entries are in memory
    std::vector<InputFile> read = inputOfStudy(caseDirectory, runs);
    std::string changes = changedInput(before, inputLines(read, mark), mark);
    if (changes.empty())
    {
        known = std::move(now);
    }
    files = std::move(read);
    return changes;
}

bool hasInputLines(const std::string& text, const std::string& mark)
{
    return text.starts_with(mark + howCompared);
}

std::vector<std::string> namesOfInput(const std::string& text, const std::string& mark)
{
    std::vector<std::string> names;
    for (const InputFile& file : inputFilesIn(linesIn(text, mark)))
    {
        names.push_back(file.name);
    }
    return names;
}

std::string changedInput(const std::string& before, const std::string& now, const std::string& mark)
{
    return textOf(changesOfInput(inputFilesIn(linesIn(before, mark)), inputFilesIn(linesIn(now, mark))));
}

} // namespace drystone
