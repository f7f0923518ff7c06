// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declared options as text for users: the annotated dictionaries in etc/ and what -help lists. Both follow
/// from the declaration alone, which is why they are in its library.
#include "core/Paragraph.h"
#include "dictionary/Options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace drystone
{

using Form = OptionDescription::Form;
using Presence = OptionDescription::Presence;

namespace
{

/// A value to show where a key has no default.
std::string exampleOf(const OptionDescription& option)
{
    if (!option.exampleText.empty())
    {
        return option.exampleText;
    }
    if (!option.words.empty())
    {
        return option.words.front();
    }
    if (option.type == "number" || option.type == "integer")
    {
        return "1";
    }
    if (option.type == "switch")
    {
        return "on";
    }
    if (option.type == "word")
    {
        return "name";
    }
    if (option.type.starts_with("vector of 2"))
    {
        return "(1 0)";
    }
    if (option.type.starts_with("vector of 3"))
    {
        return "(1 0 0)";
    }
    return "()";
}

std::string sentence(const OptionDescription& option)
{
    std::string text = option.doc + option.unitText();
    if (!option.range.empty())
    {
        text += ", " + option.range;
    }
    if (!option.usual.empty())
    {
        text += ", usually " + option.usual;
    }
    if (!option.words.empty())
    {
        text += fmt::format("; one of {}", fmt::join(option.words, " "));
    }
    if (option.form == Form::value)
    {
        text += option.presence == Presence::required     ? "; required"
                : option.presence == Presence::hasDefault ? fmt::format("; default {}", option.defaultText)
                                                          : "; may be absent";
    }
    else if (option.form != Form::ownNames)
    {
        text += option.presence == Presence::required ? "; required" : "; may be absent";
    }
    return text;
}

using Lines = std::vector<std::string>;

void append(Lines& lines, const Lines& added, const std::string& before)
{
    for (const std::string& line : added)
    {
        lines.push_back(line.empty() ? line : before + line);
    }
}

/// \param shown models that were listed with their keys, as `family/name`
Lines membersText(const std::vector<OptionDescription>& options, std::set<std::string>& shown);

/// `{ ... }` with the keys of a sub-dictionary or of one of its models.
Lines bodyText(const std::vector<OptionDescription>& members,
               const OptionDescription::Alternative* alternative, std::set<std::string>& shown)
{
    Lines lines{"{"};
    if (alternative)
    {
        lines.push_back("    // " + alternative->summary);
        lines.push_back(fmt::format("    {:<15} {};", "type", alternative->name));
    }
    append(lines, membersText(alternative ? alternative->members : members, shown), "    ");
    lines.emplace_back("}");
    return lines;
}

Lines bracketed(const OptionDescription& option, const OptionDescription::Alternative* alternative,
                std::set<std::string>& shown)
{
    const Lines body = bodyText(option.members, alternative, shown);
    Lines lines;
    switch (option.form)
    {
    case Form::dictionaryList:
        lines.push_back(option.key);
        lines.emplace_back("(");
        append(lines, body, "    ");
        lines.emplace_back(");");
        return lines;
    case Form::namedDictionaries:
        lines.push_back(option.key);
        lines.emplace_back("{");
        lines.push_back("    " + (option.exampleText.empty() ? std::string("name") : option.exampleText));
        append(lines, body, "    ");
        lines.emplace_back("}");
        return lines;
    case Form::ownNames:
        lines.emplace_back("name");
        break;
    default:
        lines.push_back(option.key);
    }
    append(lines, body, "");
    return lines;
}

/// The alternatives of an option: those that have not been shown above with what they have inside, the others
/// by name.
void appendAlternatives(Lines& lines, const OptionDescription& option, const std::string& before,
                        std::set<std::string>& shown)
{
    // Those that are listed here are so for what they have inside, too.
    std::vector<const OptionDescription::Alternative*> listed;
    std::vector<std::string> asAbove;
    for (const OptionDescription::Alternative& alternative : option.alternatives)
    {
        if (shown.insert(option.type + "/" + alternative.name).second || listed.empty())
        {
            listed.push_back(&alternative);
        }
        else
        {
            asAbove.push_back(alternative.name);
        }
    }
    for (const OptionDescription::Alternative* alternative : listed)
    {
        const bool isFirst = alternative == listed.front();
        if (!isFirst)
        {
            lines.emplace_back("// or");
        }
        append(lines, bracketed(option, alternative, shown), isFirst ? before : "// ");
    }
    if (!asAbove.empty())
    {
        lines.push_back(fmt::format("// or with type {}, as above", fmt::join(asAbove, " ")));
    }
}

Lines membersText(const std::vector<OptionDescription>& options, std::set<std::string>& shown)
{
    Lines lines;
    for (const OptionDescription& option : options)
    {
        if (option.form == Form::elsewhere)
        {
            continue;
        }
        if (!lines.empty() && option.form != Form::value)
        {
            lines.emplace_back("");
        }
        lines.push_back("// " + sentence(option));
        // What may be absent is shown, but commented out.
        const std::string before = option.presence == Presence::mayBeAbsent && !option.given ? "// " : "";
        if (option.form == Form::value)
        {
            const std::string value =
                option.presence == Presence::hasDefault ? option.defaultText : exampleOf(option);
            lines.push_back(fmt::format("{}{:<15} {};", before, option.key, value));
            continue;
        }
        if (option.alternatives.empty())
        {
            append(lines, bracketed(option, nullptr, shown), before);
            continue;
        }
        appendAlternatives(lines, option, before, shown);
    }
    return lines;
}

} // namespace

std::string annotatedDictionary(std::string_view name, std::string_view doc,
                                const std::vector<OptionDescription>& options)
{
    std::string text;
    while (!doc.empty())
    {
        const std::size_t end = std::min(doc.find('\n'), doc.size());
        text += fmt::format("// {}\n", doc.substr(0, end));
        doc.remove_prefix(std::min(end + 1, doc.size()));
    }
    text += headerText(name) + "\n";
    std::set<std::string> shown;
    for (const std::string& line : membersText(options, shown))
    {
        text += line + "\n";
    }
    return text;
}

namespace
{

/// Where -help describes: the line of a key ends where its description begins.
constexpr int describedAt = 25;

std::string helpLine(int indentation, const std::string& name, const std::string& description)
{
    return hangingParagraph(std::string(static_cast<std::size_t>(indentation), ' ') + name, description,
                            describedAt, widthOfHelp);
}

/// \param shown likewise
std::string helpText(const std::vector<OptionDescription>& options, int indentation,
                     std::set<std::string>& shown)
{
    std::string text;
    for (const OptionDescription& option : options)
    {
        if (option.form == Form::elsewhere)
        {
            continue;
        }
        text +=
            helpLine(indentation, option.form == Form::ownNames ? "<name>" : option.key, sentence(option));
        int inner = indentation + 4;
        if (option.form == Form::namedDictionaries)
        {
            text += helpLine(inner, "<name>", "");
            inner += 4;
        }
        text += helpText(option.members, inner, shown);
        std::vector<std::string> asAbove;
        for (const OptionDescription::Alternative& alternative : option.alternatives)
        {
            if (!shown.insert(option.type + "/" + alternative.name).second)
            {
                asAbove.push_back(alternative.name);
                continue;
            }
            text += helpLine(inner, "type " + alternative.name, alternative.summary);
            text += helpText(alternative.members, inner + 4, shown);
        }
        if (!asAbove.empty())
        {
            text += helpLine(inner, "type", fmt::format("{}: as above", fmt::join(asAbove, " ")));
        }
    }
    return text;
}

} // namespace

std::string helpText(const std::vector<OptionDescription>& options, int indentation)
{
    std::set<std::string> shown;
    return helpText(options, indentation, shown);
}

} // namespace drystone
