// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How errors and warnings are worded and printed.
#include "core/Error.h"

#include "core/LowerCase.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <mutex>
#include <new>
#include <numeric>
#include <unordered_set>

namespace drystone
{

namespace
{

void printReport(const std::string& report)
{
    std::fflush(stdout);
    std::fputs(report.c_str(), stderr);
    std::fflush(stderr);
}

/// Restricted Damerau-Levenshtein distance: letters inserted, removed, changed, or swapped with a neighbour.
std::size_t editDistance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> beforeLast(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> current(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            current[j] = std::min({last[j] + 1, current[j - 1] + 1, changed});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
            {
                current[j] = std::min(current[j], beforeLast[j - 2] + 1);
            }
        }
        std::swap(beforeLast, last);
        std::swap(last, current);
    }
    return last[b.size()];
}

/// The longest word that is compared: longer ones are nobody's misspelling and the distance is quadratic.
constexpr std::size_t longestComparedWord = 200;

} // namespace

FatalError::FatalError(const std::string& message, int exitStatusOfProgram)
    : std::runtime_error(message), status(exitStatusOfProgram)
{
}

FatalIOError::FatalIOError(const std::string& message, SourceLocation where, int exitStatusOfProgram)
    : FatalError(message, exitStatusOfProgram), place(std::move(where))
{
}

std::string FatalError::report() const
{
    return std::string("--> DRYSTONE FATAL ERROR:\n") + what() + "\n\nDRYSTONE exiting\n";
}

std::string FatalIOError::report() const
{
    return std::string("--> DRYSTONE FATAL IO ERROR:\n") + what() + "\n\n" + describe(place)
           + "\n\nDRYSTONE exiting\n";
}

std::string describe(const SourceLocation& location)
{
    std::string text = "file: " + location.file;
    if (!location.entry.empty())
    {
        text += "/" + location.entry;
    }
    if (location.line > 0)
    {
        text += " at line " + std::to_string(location.line);
    }
    return text + ".";
}

void printWarning(std::string_view message)
{
    printReport("--> DRYSTONE Warning :\n" + std::string(message) + "\n\n");
}

void printWarning(std::string_view message, const SourceLocation& location)
{
    printReport("--> DRYSTONE Warning :\n" + std::string(message) + "\n\n" + describe(location) + "\n\n");
}

void printWarningOnce(std::string_view message, const SourceLocation& location)
{
    static std::mutex guard;
    static std::unordered_set<std::size_t> printed;
    const std::size_t identity = std::hash<std::string>{}(std::string(message) + '\0' + describe(location));
    {
        const std::lock_guard lock(guard);
        if (!printed.insert(identity).second)
        {
            return;
        }
    }
    printWarning(message, location);
}

int runGuarded(const std::function<int()>& program)
{
    try
    {
        return program();
    }
    catch (const FatalError& error)
    {
        printReport(error.report());
        return error.exitStatus();
    }
    catch (const std::bad_alloc&)
    {
        printReport(FatalError("There is not enough memory for this case. Make it smaller, or run it on a "
                               "machine with more memory.")
                        .report());
    }
    catch (const std::filesystem::filesystem_error& error)
    {
        std::string paths;
        if (!error.path1().empty())
        {
            paths += "\n\npath: " + error.path1().string();
        }
        if (!error.path2().empty())
        {
            paths += "\npath: " + error.path2().string();
        }
        printReport(FatalError("The file system refused: " + error.code().message() + "." + paths).report());
    }
    catch (const std::exception& error)
    {
        printReport(FatalError(error.what()).report());
    }
    catch (...)
    {
        printReport(FatalError("An error of an unknown kind ended the program.").report());
    }
    return 1;
}

std::string nearestWord(std::string_view word, const std::vector<std::string>& candidates)
{
    if (word.empty() || word.size() > longestComparedWord)
    {
        return {};
    }
    const std::string wanted = lowerCase(word);
    // A third of the letters may be wrong; a single letter always may.
    std::size_t best = std::max<std::size_t>(1, wanted.size() / 3) + 1;
    std::string nearest;
    for (const std::string& candidate : candidates)
    {
        if (candidate.empty() || candidate.size() > longestComparedWord)
        {
            continue;
        }
        const std::string offered = lowerCase(candidate);
        std::size_t distance = editDistance(wanted, offered);
        // A word cut short or drawn out: density for densityOfBlocks.
        if (wanted.size() >= 4 && offered.size() >= 4
            && (offered.starts_with(wanted) || wanted.starts_with(offered)))
        {
            distance = std::min<std::size_t>(distance, 2);
        }
        // Nothing of the word would be left.
        if (distance >= std::min(wanted.size(), offered.size()) && distance > 0)
        {
            continue;
        }
        if (distance < best)
        {
            best = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

namespace
{

/// Without the quotation marks of a text processor, which are letters to us.
std::string withoutPrintedQuotes(std::string word)
{
    for (const std::string_view mark :
         {"\u201c", "\u201d", "\u201e", "\u2018", "\u2019", "\u201a", "\u00ab", "\u00bb"})
    {
        for (auto place = word.find(mark); place != std::string::npos; place = word.find(mark))
        {
            word.erase(place, mark.size());
        }
    }
    return word;
}

/// Of a regular noun: `keys`, `quantities`.
std::string pluralOf(std::string_view noun)
{
    const bool isAfterConsonant =
        noun.size() > 1 && std::string_view("aeiou").find(noun[noun.size() - 2]) == std::string_view::npos;
    std::string plural(noun);
    if (noun.ends_with('y') && isAfterConsonant)
    {
        plural.pop_back();
        plural.append("ie");
    }
    plural.push_back('s');
    return plural;
}

} // namespace

std::string unknownWordMessage(std::string_view family, std::string_view word,
                               std::vector<std::string> validWords)
{
    std::sort(validWords.begin(), validWords.end());
    // A key may be in the plural itself: pictureFormats.
    const std::string_view one = family.ends_with('s') ? family.substr(0, family.size() - 1) : family;
    std::string message = "Unknown " + std::string(one) + " " + std::string(word) + ".";
    const std::string nearest = nearestWord(withoutPrintedQuotes(std::string(word)), validWords);
    if (!nearest.empty())
    {
        message += " Did you mean " + nearest + "?";
    }
    message += "\n\nValid " + pluralOf(one) + ":";
    if (validWords.empty())
    {
        message += " none";
    }
    for (const std::string& valid : validWords)
    {
        message += " " + valid;
    }
    return message;
}

} // namespace drystone
