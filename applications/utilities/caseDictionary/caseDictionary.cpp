// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// caseDictionary: prints entries of a dictionary, or edits one and leaves the rest of the file unchanged.
#include "dictionary/Dictionary.h"
#include "dictionary/DictionaryEdit.h"
#include "dictionary/GivenEntry.h"
#include "runControl/Application.h"

#include <fmt/format.h>
#include <map>
#include <optional>

using namespace drystone;

namespace
{

int run(const CommandLine& commandLine)
{
    const std::filesystem::path file = commandLine.caseDirectory / commandLine.arguments.front();
    const std::string path = commandLine.get("entry").value_or("");
    const std::map<std::string, EntryEdit> edits{
        {"set", EntryEdit::set}, {"add", EntryEdit::add}, {"remove", EntryEdit::remove}};
    std::optional<EntryEdit> edit;
    std::string value;
    for (const auto& [option, itsEdit] : edits)
    {
        if (!commandLine.has(option))
        {
            continue;
        }
        if (edit || path.empty())
        {
            throw FatalError("-set, -add and -remove need -entry, which names the entry to be edited.");
        }
        edit = itsEdit;
        value = *commandLine.get(option);
    }
    if (edit)
    {
        editFile(file, path, *edit, value);
    }
    if (edit == EntryEdit::remove)
    {
        return 0;
    }

    const bool asWritten = edit || commandLine.has("disableFunctionEntries");
    const Dictionary dictionary = Dictionary::readFile(file, asWritten ? Expansion::none : Expansion::all);
    const Entry* entry = path.empty() ? nullptr : &dictionary.lookupPath(withoutQuotes(path));
    if (commandLine.has("keywords"))
    {
        for (const Entry& inner : (entry ? entry->dictionary() : dictionary).entries())
        {
            fmt::print("{}\n", inner.keywordText());
        }
    }
    else if (!entry)
    {
        fmt::print("{}", toText(dictionary));
    }
    else if (!commandLine.has("value"))
    {
        fmt::print("{}", toText(*entry));
    }
    else if (entry->isDictionary())
    {
        fmt::print("{{\n{}}}\n", toText(entry->dictionary(), 4));
    }
    else
    {
        fmt::print("{}\n", entry->valueText());
    }
    return 0;
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "caseDictionary";
    description.summary =
        "Prints the contents of a dictionary, macros and directives expanded, or edits one entry of it "
        "and keeps comments and layout.";
    description.output = Output::answer;
    description.arguments = {{"DICTIONARY", "", "the file, relative to the case directory"}};
    description.options = {
        {"entry", "a/b", "the entry (default: all)"},
        {"value", "", "print only the value"},
        {"keywords", "", "print only the keywords"},
        {"expand", "", "print with macros and directives expanded (the default)"},
        {"disableFunctionEntries", "", "print macros and directives as they are written"},
        {"set", "VALUE", "give the entry this value; a missing entry is added"},
        {"add", "VALUE", "add the entry with this value; an existing one is left unchanged"},
        {"remove", "", "remove the entry"},
    };
    description.examples = {"caseDictionary system/controlDict -entry endTime -value",
                            "caseDictionary constant/contactProperties -entry friction/mu -set 0.6"};
    return runApplication(argc, argv, description, run);
}
