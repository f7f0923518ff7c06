// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The tree, built from the events of nlohmann's parser, which itself needs no stack.
#include "core/Json.h"

#include "core/LowerCase.h"
#include "core/ShownWord.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <unordered_set>

namespace drystone
{

namespace
{

/// A tree that is deeper could exhaust the stack when it is removed.
constexpr std::size_t deepest = 100;

class TreeBuilder : public nlohmann::json_sax<nlohmann::json>
{
public:
    explicit TreeBuilder(std::string_view whole) : text(whole) {}

    JsonValue root;

    bool null() override { return add({}); }
    bool boolean(bool value) override { return add({value}); }
    bool number_integer(std::int64_t value) override { return add({static_cast<double>(value)}); }
    bool number_unsigned(std::uint64_t value) override { return add({static_cast<double>(value)}); }
    bool number_float(double value, const std::string&) override { return add({value}); }
    bool string(std::string& value) override { return add({std::move(value)}); }
    bool binary(nlohmann::json::binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open({JsonValue::Object{}}); }
    bool start_array(std::size_t) override { return open({JsonValue::List{}}); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(std::string& name) override
    {
        if (!keys.back().insert(name).second)
        {
            throw JsonFault(fmt::format("{} is given twice in {}", shown(name), path()), 0);
        }
        std::get<JsonValue::Object>(parents.back()->content).push_back({std::move(name), {}});
        return true;
    }
    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::json::exception& error) override
    {
        constexpr int outOfRange = 406; // a number, of nlohmann's list of errors
        const auto before = static_cast<std::ptrdiff_t>(std::min(position, text.size()));
        const auto line = 1 + std::count(text.begin(), text.begin() + before, '\n');
        const auto lineBegin =
            std::find(std::make_reverse_iterator(text.begin() + before), text.rend(), '\n');
        throw JsonFault(
            fmt::format("{} (character {} of the line){}",
                        error.id == outOfRange ? "a number is too large" : "the text is no JSON here",
                        text.begin() + before - lineBegin.base(), remedy(before, error.what())),
            static_cast<int>(line));
    }

private:
    /// For what other programs, editors and downloads do most. \param position as far as the text was read
    /// \param fault in the words of the parser
    std::string remedy(std::ptrdiff_t position, std::string_view fault) const
    {
        const auto says = [&fault](std::string_view words) { return fault.find(words) != fault.npos; };
        if (says("unexpected end of input") || says("missing closing quote"))
        {
            return ": it ends before it is complete. Get a whole copy of the file";
        }
        if (says("UTF-8"))
        {
            return ": it is not in UTF-8. Save it in that encoding";
        }
        const auto isOfWord = [](unsigned char letter) { return std::isalpha(letter) != 0; };
        const auto end = std::make_reverse_iterator(text.begin() + position);
        const auto begin = std::find_if_not(end, text.rend(), isOfWord).base();
        const std::string word = lowerCase(std::string(begin, std::find_if_not(begin, text.end(), isOfWord)));
        return word == "nan" || word == "inf" || word == "infinity"
                   ? ": NaN and Infinity are no numbers. The program that wrote them could not compute what "
                     "was to stand there"
                   : "";
    }

    /// Of the object that is open, by the keys that lead to it.
    std::string path() const
    {
        std::string names;
        for (std::size_t i = 0; i + 1 < parents.size(); ++i)
        {
            const auto* object = std::get_if<JsonValue::Object>(&parents[i]->content);
            const std::string name =
                object != nullptr
                    ? shown(object->back().key)
                    : fmt::format("{}", std::get<JsonValue::List>(parents[i]->content).size() - 1);
            names += (names.empty() ? "" : "/") + name;
        }
        return names.empty() ? "the outermost object" : names;
    }

    JsonValue& place(JsonValue value)
    {
        if (parents.empty())
        {
            return root = std::move(value);
        }
        if (auto* list = std::get_if<JsonValue::List>(&parents.back()->content))
        {
            return list->emplace_back(std::move(value));
        }
        return std::get<JsonValue::Object>(parents.back()->content).back().value = std::move(value);
    }
    bool add(JsonValue value)
    {
        place(std::move(value));
        return true;
    }
    bool open(JsonValue value)
    {
        if (parents.size() >= deepest)
        {
            throw JsonFault("lists and objects are nested deeper than 100 levels", 1);
        }
        // A parent's list does not grow while one of its elements is open, so that pointers stay valid.
        parents.push_back(&place(std::move(value)));
        keys.emplace_back();
        return true;
    }
    bool close()
    {
        parents.pop_back();
        keys.pop_back();
        return true;
    }

    std::string_view text;
    std::vector<JsonValue*> parents;
    std::vector<std::unordered_set<std::string>> keys; ///< of each parent that is an object
};

} // namespace

const JsonValue* JsonValue::find(std::string_view key) const
{
    if (const Object* object = asObject())
    {
        for (const auto& [name, value] : *object)
        {
            if (name == key)
            {
                return &value;
            }
        }
    }
    return nullptr;
}

JsonValue parseJson(std::string_view text)
{
    TreeBuilder builder(text);
    nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
    return std::move(builder.root);
}

std::string jsonText(std::string_view text)
{
    constexpr int oneLine = -1;
    constexpr bool escapesBeyondAscii = false;
    return nlohmann::json(text).dump(oneLine, ' ', escapesBeyondAscii,
                                     nlohmann::json::error_handler_t::replace);
}

} // namespace drystone
