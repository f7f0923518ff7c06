// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// JSON text as a tree of values: in core because files of several libraries are JSON, and one of them only
/// is to see the library that parses it.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace drystone
{

struct JsonMember;

/// A value: null, a switch, a number, a text, a list or an object, whose members keep their order.
struct JsonValue
{
    using List = std::vector<JsonValue>;
    using Object = std::vector<JsonMember>;

    std::variant<std::monostate, bool, double, std::string, List, Object> content;

    bool isNull() const { return std::holds_alternative<std::monostate>(content); }
    /// nullptr where the value is of another kind.
    const bool* asSwitch() const { return std::get_if<bool>(&content); }
    const double* asNumber() const { return std::get_if<double>(&content); }
    const std::string* asText() const { return std::get_if<std::string>(&content); }
    const List* asList() const { return std::get_if<List>(&content); }
    const Object* asObject() const { return std::get_if<Object>(&content); }
    /// The first member of this name; nullptr where there is none, or the value is no object. Takes time of
    /// the order of the members.
    const JsonValue* find(std::string_view key) const;
};

/// A member of an object.
struct JsonMember
{
    std::string key;
    JsonValue value;
};

/// What keeps a text from being JSON: `the text is no JSON here`.
struct JsonFault : std::runtime_error
{
    JsonFault(const std::string& fault, int lineOfFault) : std::runtime_error(fault), line(lineOfFault) {}
    int line; ///< from 1; 0 when no line is to blame
};

/// The tree of a text. Memory is of the order of the text's size, whatever it says. \throws JsonFault for
/// text that is not JSON, has a number beyond the range of a double, nests deeper than 100 levels, or has
/// a key twice in an object, of which readers take different ones
JsonValue parseJson(std::string_view text);

/// A text as JSON writes it, within quotes; what is not UTF-8 in it becomes U+FFFD.
std::string jsonText(std::string_view text);

} // namespace drystone
