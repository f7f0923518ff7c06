// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Looks up and changes entries of the dictionaries of a case.
#include "ensembles/CaseEntry.h"

#include "core/WholeFile.h"
#include "dictionary/DictionaryEdit.h"
#include "dictionary/Expression.h"
#include "quantities/TableFigure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace drystone
{

namespace fs = std::filesystem;

void declare(Options& options, CaseEntry& entry)
{
    options.required("file", entry.file, "dictionary of the case that has the entry")
        .example("\"system/blockTextureDict\"");
    options.required("entry", entry.entry, "keywords with slashes between").example("\"texture/thickness\"");
    options.check("file",
                  [&entry]
                  {
                      return isInsideCase(entry.file)
                                 ? ""
                                 : "Entries are changed in copies of the case: give a path within the case "
                                   "directory, relative to it.";
                  });
}

Entry lookUp(const fs::path& caseDirectory, const CaseEntry& entry, const Dictionary& own)
{
    std::error_code unknown; // a name that no file can have is not a file
    const fs::path file = (caseDirectory / entry.file).lexically_normal();
    if (!fs::is_regular_file(file, unknown))
    {
        throw FatalIOError(
            fmt::format("There is no file {} in this case: name one of its dictionaries.", entry.file),
            own.locationOf("file"));
    }
    const Dictionary dictionary = Dictionary::readFile(file);
    try
    {
        return dictionary.lookupPath(entry.entry);
    }
    catch (const FatalIOError& error)
    {
        throw FatalIOError(fmt::format("The entry {} of {} cannot be varied: it has to be there.\n{}",
                                       entry.entry, entry.file, error.what()),
                           own.locationOf("entry"));
    }
}

void setEntry(const fs::path& caseDirectory, const CaseEntry& entry, const std::string& value)
{
    const fs::path file = caseDirectory / entry.file;
    writeWholeFile(file, withEntrySet(contentOfFile(file), entry.file, entry.entry, value));
}

std::string faultOfName(const std::string& name)
{
    const auto isLetter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const bool isIdentifier =
        !name.empty() && isLetter(name.front())
        && std::all_of(name.begin(), name.end(),
                       [&](char c)
                       { return isLetter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; });
    if (!isIdentifier)
    {
        return fmt::format(
            "The name {} is to be used in arithmetic: letters, digits and _ only, and a letter first.", name);
    }
    try
    {
        evaluateExpression(name, {});
        return fmt::format("The name {} already has a meaning in arithmetic: choose another one.", name);
    }
    catch (const std::invalid_argument&)
    {
        return {}; // an unknown name is what is needed
    }
}

std::string faultOfNextName(const std::string& name, std::set<std::string>& names)
{
    if (std::string fault = faultOfName(name); !fault.empty())
    {
        return fault;
    }
    return names.insert(name).second
               ? ""
               : fmt::format("Two variables or results have the name {}: choose another one.", name);
}

std::string faultOfNextEntry(const CaseEntry& entry, std::set<std::string>& places)
{
    const std::string place = fs::path(entry.file).lexically_normal().string() + ":" + entry.entry;
    return places.insert(place).second
               ? ""
               : fmt::format("Two variables set {} of {}: remove one of them.", entry.entry, entry.file);
}

} // namespace drystone
