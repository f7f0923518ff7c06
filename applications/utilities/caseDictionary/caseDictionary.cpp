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

/// An edit as the command line requests it.
struct RequestedEdit
{
    EntryEdit edit;
    std::string value;
};

std::optional<RequestedEdit> requestedEdit(const CommandLine& commandLine, const std::string& path)
{
    const std::map<std::string, EntryEdit> edits{
        {"set", EntryEdit::set}, {"add", EntryEdit::add}, {"remove", EntryEdit::remove}};
    std::optional<RequestedEdit> requested;
    for (const auto& [option, edit] : edits)
    {
        if (!commandLine.has(option))
        {
            continue;
        }
        if (requested || path.empty())
        {
            throw FatalError("-set, -add and -remove need -entry, which names the entry to be edited.");
        }
        requested = RequestedEdit{edit, *commandLine.get(option)};
    }
    return requested;
}

/// \param entry of the dictionary; null: all of them
void printEntry(const Dictionary& dictionary, const Entry* entry, const CommandLine& commandLine)
{
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
}

int run(const CommandLine& commandLine)
{
    const std::filesystem::path file = commandLine.caseDirectory / commandLine.arguments.front();
    const std::string path = commandLine.get("entry").value_or("");
    const std::optional<RequestedEdit> requested = requestedEdit(commandLine, path);
    if (requested)
    {
        editFile(file, path, requested->edit, requested->value);
        if (requested->edit == EntryEdit::remove)
        {
            return 0;
        }
    }
    const bool asWritten = requested || commandLine.has("disableFunctionEntries");
    const Dictionary dictionary = Dictionary::readFile(file, asWritten ? Expansion::none : Expansion::all);
    printEntry(dictionary, path.empty() ? nullptr : &dictionary.lookupPath(withoutQuotes(path)), commandLine);
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
