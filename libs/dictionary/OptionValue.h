// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What declared settings require of the type of a field: its name, its text as a dictionary has it, its
/// numbers.
#pragma once

#include "dictionary/Option.h"

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace drystone
{

namespace detail
{
template<class Value>
struct IsOptional : std::false_type
{
};
template<class Value>
struct IsOptional<std::optional<Value>> : std::true_type
{
    using Inner = Value;
};
template<class Value>
struct IsVector : std::false_type
{
};
template<class Value>
struct IsVector<std::vector<Value>> : std::true_type
{
    using Inner = Value;
};
/// A vector of pairs of a user's name and something.
template<class Value>
struct IsNamedVector : std::false_type
{
};
template<class Value>
struct IsNamedVector<std::vector<std::pair<std::string, Value>>> : std::true_type
{
    using Inner = Value;
};
template<class Value>
struct IsNamedVector<std::vector<std::pair<NamePattern, Value>>> : std::true_type
{
    using Inner = Value;
};

/// A value of nothing but zeros, which those of Eigen are not by themselves.
template<class Value>
Value blank()
{
    if constexpr (FixedVector<Value>)
    {
        return Value::Zero();
    }
    else
    {
        return Value{};
    }
}

void assignName(std::string& name, const Entry& entry);
void assignName(NamePattern& name, const Entry& entry);

// Text of a value as a dictionary has it.
std::string textOf(double value);
std::string textOf(int value);
std::string textOf(long value);
std::string textOf(bool value);
std::string textOf(const std::string& value);

template<class Value>
concept Iterable = requires(const Value& value)
{
    value.begin();
    value.end();
};
template<class Value>
concept PairLike = requires(const Value& value)
{
    value.first;
    value.second;
};
template<class Value>
concept FixedArray = requires
{
    std::tuple_size<Value>::value;
    typename Value::value_type;
};

template<class Value>
std::string textOf(const Value& value)
{
    if constexpr (NamedEnumeration<Value>)
    {
        for (const auto& [name, named] : namesOf(Value{}))
        {
            if (named == value)
            {
                return std::string(name);
            }
        }
        return {};
    }
    else if constexpr (Iterable<Value>)
    {
        std::string text = "(";
        for (const auto& element : value)
        {
            text.append(text.size() > 1 ? " " : "").append(textOf(element)); // + trips GCC 12's -Wrestrict
        }
        return text + ")";
    }
    else if constexpr (FixedVector<Value>)
    {
        std::string text = "(";
        for (int i = 0; i < int(Value::SizeAtCompileTime); ++i)
        {
            text.append(i > 0 ? " " : "").append(textOf(value.data()[i]));
        }
        return text + ")";
    }
    else if constexpr (PairLike<Value>)
    {
        return std::string("(")
            .append(textOf(value.first))
            .append(" ")
            .append(textOf(value.second))
            .append(")");
    }
    else
    {
        return {};
    }
}

template<class Value>
std::string typeNameOf()
{
    if constexpr (std::is_same_v<Value, double>)
    {
        return "number";
    }
    else if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, long>)
    {
        return "integer";
    }
    else if constexpr (std::is_same_v<Value, bool>)
    {
        return "switch";
    }
    else if constexpr (std::is_same_v<Value, Dictionary>)
    {
        return "dictionary";
    }
    else if constexpr (FixedVector<Value>)
    {
        return "vector of " + std::to_string(int(Value::SizeAtCompileTime));
    }
    else if constexpr (IsVector<Value>::value)
    {
        return "list, each: " + typeNameOf<typename IsVector<Value>::Inner>();
    }
    else if constexpr (FixedArray<Value>)
    {
        return "vector of " + std::to_string(std::tuple_size<Value>::value);
    }
    else if constexpr (PairLike<Value>)
    {
        return "pair (" + typeNameOf<typename Value::first_type>() + " "
               + typeNameOf<typename Value::second_type>() + ")";
    }
    else
    {
        return "word";
    }
}

/// Every number in a value.
template<class Value, class Visit>
void visitNumbers(const Value& value, const Visit& visit)
{
    if constexpr (std::is_same_v<Value, bool> || std::is_same_v<Value, std::string>)
    {
        return;
    }
    else if constexpr (std::is_arithmetic_v<Value>)
    {
        visit(static_cast<double>(value));
    }
    else if constexpr (FixedVector<Value>)
    {
        for (int i = 0; i < int(Value::SizeAtCompileTime); ++i)
        {
            visit(value.data()[i]);
        }
    }
    else if constexpr (Iterable<Value>)
    {
        for (const auto& element : value)
        {
            visitNumbers(element, visit);
        }
    }
    else if constexpr (PairLike<Value>)
    {
        visitNumbers(value.first, visit);
        visitNumbers(value.second, visit);
    }
}

/// A word, or every one of a list of words.
template<class Value, class Visit>
void visitWords(const Value& value, const Visit& visit)
{
    if constexpr (std::is_same_v<Value, std::string>)
    {
        visit(value);
    }
    else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
    {
        for (const std::string& word : value)
        {
            visit(word);
        }
    }
}
} // namespace detail

} // namespace drystone
