// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Walks a dictionary along the declarations of its keys.
#include "report/InputTable.h"

#include <algorithm>

namespace drystone
{

namespace
{

using Rows = std::vector<std::vector<std::string>>;

const OptionDescription* findOption(const std::vector<OptionDescription>& options, const std::string& key)
{
    const auto found = std::find_if(options.begin(), options.end(),
                                    [&](const OptionDescription& option) { return option.key == key; });
    return found == options.end() ? nullptr : &*found;
}

/// What describes the keys of a sub-dictionary: its members, or those of the model that its `type` chooses.
std::vector<OptionDescription> membersOf(const OptionDescription* option, const Dictionary& dictionary)
{
    if (!option)
    {
        return {};
    }
    std::vector<OptionDescription> members = option->members;
    const Entry* type = dictionary.find("type");
    for (const OptionDescription::Alternative& alternative : option->alternatives)
    {
        if (type && type->valueText() == alternative.name)
        {
            members.insert(members.end(), alternative.members.begin(), alternative.members.end());
        }
    }
    return members;
}

/// A value that fills a page, such as a table of accelerations, is cut.
std::string shortened(std::string text)
{
    constexpr std::size_t longest = 160;
    return text.size() <= longest ? text : text.substr(0, longest) + " ...";
}

void addRows(Rows& rows, const Dictionary& dictionary, const std::vector<OptionDescription>& options,
             const std::string& before)
{
    for (const Entry& entry : dictionary.entries())
    {
        if (entry.keyword() == "FoamFile")
        {
            continue;
        }
        const OptionDescription* option = findOption(options, entry.keyword());
        if (!entry.isDictionary())
        {
            rows.push_back({before + entry.keywordText(), shortened(entry.valueText()),
                            option ? option->unit : "", option ? option->doc : ""});
            continue;
        }
        const std::string inside = before + entry.keywordText() + "/";
        const bool hasNames = option && option->form == OptionDescription::Form::namedDictionaries;
        if (!hasNames)
        {
            addRows(rows, entry.dictionary(), membersOf(option, entry.dictionary()), inside);
            continue;
        }
        for (const Entry& named : entry.dictionary().entries())
        {
            if (named.isDictionary())
            {
                addRows(rows, named.dictionary(), membersOf(option, named.dictionary()),
                        inside + named.keywordText() + "/");
            }
        }
    }
}

} // namespace

std::vector<std::vector<std::string>> inputRows(const Dictionary& dictionary,
                                                const std::vector<OptionDescription>& options)
{
    Rows rows;
    addRows(rows, dictionary, options, "");
    return rows;
}

} // namespace drystone
