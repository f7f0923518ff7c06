// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the messages in the standard error of applications, and changes the names of files in them.
#include "ensembles/CopyMessages.h"

#include "core/Error.h"

#include <cctype>
#include <string_view>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

void replaceAll(std::string& message, const std::string& text, const std::string& other)
{
    for (auto at = message.find(text); at != std::string::npos; at = message.find(text, at + other.size()))
    {
        message.replace(at, text.size(), other);
    }
}

/// Values of varied entries differ from run to run, and their warnings with them.
std::string withoutNumbers(std::string text)
{
    const auto isOfNumber = [](unsigned char letter)
    { return std::isdigit(letter) != 0 || letter == '.' || letter == '-' || letter == '+'; };
    std::erase_if(text, isOfNumber);
    return text;
}

} // namespace

std::string faultOfCopy(std::string message, const fs::path& copy)
{
    for (const std::string& text :
         {copy.string() + "/", std::string("    --> DRYSTONE FATAL IO ERROR:\n"),
          std::string("    --> DRYSTONE FATAL ERROR:\n"), std::string("\n    DRYSTONE exiting")})
    {
        replaceAll(message, text, "");
    }
    return message;
}

std::vector<std::string> warningsOfCopy(const std::string& errors, const fs::path& copy,
                                        const fs::path& caseDirectory)
{
    constexpr std::string_view beginning = "--> DRYSTONE ";
    constexpr std::string_view kind = "Warning :\n";
    std::vector<std::string> warnings;
    for (auto at = errors.find(beginning); at != std::string::npos;)
    {
        const auto begin = at + beginning.size();
        at = errors.find(beginning, begin);
        std::string message = errors.substr(begin, at == std::string::npos ? at : at - begin);
        if (message.rfind(kind, 0) == 0)
        {
            message.erase(0, kind.size());
            message.erase(message.find_last_not_of('\n') + 1);
            const std::string folder = (caseDirectory / "").lexically_normal().string();
            replaceAll(message, copy.string() + "/", folder == "./" ? "" : folder);
            warnings.push_back(std::move(message));
        }
    }
    return warnings;
}

void WarningsOfCopies::print(const std::vector<std::string>& warnings)
{
    constexpr std::string_view mark = "\n\nfile: "; // as describe(SourceLocation) has it
    for (const std::string& warning : warnings)
    {
        if (!printed.insert(withoutNumbers(warning)).second)
        {
            continue;
        }
        const auto place = warning.rfind(mark);
        if (place == std::string::npos)
        {
            printWarning(warning);
            continue;
        }
        std::string file = warning.substr(place + mark.size());
        file.pop_back(); // the full stop
        printWarningOnce(warning.substr(0, place), {file, "", 0});
    }
}

} // namespace drystone
