// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Scopes from the innermost outwards; a keyword with points in it comes before a path of that name.
#include "dictionary/MacroNames.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// a.b.c in a dictionary, whose keywords may have points themselves.
const Entry* dotted(const Dictionary& dictionary, std::string_view name)
{
    if (const Entry* entry = dictionary.findExact(name))
    {
        return entry;
    }
    for (std::size_t point = name.find('.'); point != std::string_view::npos;
         point = name.find('.', point + 1))
    {
        const Entry* entry = dictionary.find(name.substr(0, point));
        if (entry && entry->isDictionary())
        {
            if (const Entry* inner = dotted(entry->dictionary(), name.substr(point + 1)))
            {
                entry->markUsed();
                return inner;
            }
        }
    }
    return dictionary.find(name);
}

/// /a/b, ../a/b or ./a/b.
const Entry* byPath(std::string_view name, std::vector<Dictionary*> visible)
{
    if (name.front() == '/')
    {
        visible.resize(1);
        name.remove_prefix(1);
    }
    while (name.starts_with("../") || name.starts_with("./"))
    {
        if (name.starts_with("./"))
        {
            name.remove_prefix(2);
            continue;
        }
        if (visible.size() == 1)
        {
            return nullptr;
        }
        visible.pop_back();
        name.remove_prefix(3);
    }
    return visible.back()->findPath(name);
}

/// .a or ..a.b, whose points but the first each lead one level up: in that scope alone.
const Entry* fromScope(std::string_view name, std::vector<Dictionary*> visible)
{
    name.remove_prefix(1);
    while (name.starts_with('.'))
    {
        if (visible.size() == 1)
        {
            return nullptr;
        }
        visible.pop_back();
        name.remove_prefix(1);
    }
    return dotted(*visible.back(), name);
}

} // namespace

const Entry* lookUp(std::string_view name, std::vector<Dictionary*> visible)
{
    if (name.find('/') != std::string_view::npos)
    {
        return byPath(name, std::move(visible));
    }
    if (name.starts_with(':') || name.starts_with('^'))
    {
        visible.resize(1);
        name.remove_prefix(1);
    }
    if (name.starts_with('.'))
    {
        return fromScope(name, std::move(visible));
    }
    for (auto scope = visible.rbegin(); scope != visible.rend(); ++scope)
    {
        if (const Entry* entry = dotted(**scope, name))
        {
            return entry;
        }
    }
    return nullptr;
}

std::pair<std::string, std::optional<std::string>> withFallback(const std::string& name)
{
    const std::size_t separator = name.find(":-");
    if (separator == std::string::npos)
    {
        return {name, std::nullopt};
    }
    return {name.substr(0, separator), name.substr(separator + 2)};
}

void failUndefined(const std::vector<Dictionary*>& scopes, const std::string& name,
                   const SourceLocation& location)
{
    std::vector<std::string> visible;
    for (const Dictionary* scope : scopes)
    {
        for (const std::string& keyword : scope->keywords())
        {
            visible.push_back(keyword);
        }
    }
    std::string message = fmt::format("There is no entry {} for the macro ${} to stand for.", name, name);
    const std::string nearest = nearestWord(name, visible);
    if (!nearest.empty())
    {
        message += fmt::format(" Did you mean ${}?", nearest);
    }
    message += " An entry has to be given before it is used.";
    throw FatalIOError(message, location);
}

} // namespace drystone
