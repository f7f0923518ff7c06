// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Dictionaries: what a case's input files say, entry by entry, each with its file and line.
///
///     const Dictionary dictionary = Dictionary::readFile("system/blockTextureDict");
///     const Dictionary& texture = dictionary.subDict("texture");
///     const auto unit = texture.get<std::array<double, 2>>("unit");
///     const double thickness = texture.getOrDefault<double>("thickness", 1);
///
/// The grammar is that of OpenFOAM. Settings of models are better declared with dictionary/Options.h, which
/// also finds misspelt keys; this header is for data files and for what Options.h is made of.
#pragma once

#include "core/Error.h"
#include "dictionary/SourceText.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace drystone
{

class Dictionary;
class Entry;

/// Whether macros, directives and arithmetic are carried out while a dictionary is read.
enum class Expansion
{
    all, ///< as an application sees the dictionary
    none ///< as it is written: `$a` and `#calc` stay tokens, `#include` stays an entry named #include
};

/// A key of which a user may give any number, with what belongs to it.
template<class Value>
using Named = std::pair<std::string, Value>;

/// Reads the tokens of one entry from left to right; `read` below is overloaded for what can be read.
class TokenCursor
{
public:
    /// \param entry must outlive the cursor
    explicit TokenCursor(const Entry& entry);

    bool atEnd() const { return next == last; }
    std::size_t remaining() const { return static_cast<std::size_t>(last - next); }
    /// \throws FatalIOError at the end
    const Token& peek() const;
    const Token& take();
    bool isNext(char punctuation) const { return next != last && next->is(punctuation); }
    /// \throws FatalIOError when something else is next
    void expect(char punctuation, std::string_view what);
    /// What is wrong with the next token: "<what> was expected but `courses` found", with its line.
    [[noreturn]] void fail(const std::string& message) const;
    [[noreturn]] void failExpected(std::string_view what) const;
    /// \throws FatalIOError unless everything was read; mentions a missing `;`
    void expectEnd() const;

    /// Start of a list: `(` or `N(`, or `N{`, after `List<vector>` if that is there.
    struct ListStart
    {
        long count = -1;      ///< announced; -1 when not
        bool uniform = false; ///< N{value}
    };
    ListStart openList();
    /// \param found values read; must agree with what was announced
    void closeList(const ListStart& start, std::size_t found);

    const Entry& entry() const { return *owner; }

private:
    const Entry* owner;
    const Token* next;
    const Token* last;
};

/// \defgroup reading Reading of values: each takes what it needs from the cursor.
/// \throws FatalIOError with the line when the tokens do not say such a value
/// @{
void read(TokenCursor& cursor, double& value); ///< finite; infinity and NaN are refused
void read(TokenCursor& cursor, int& value);
void read(TokenCursor& cursor, long& value);
void read(TokenCursor& cursor, bool& value);        ///< on off yes no true false (y n t f)
void read(TokenCursor& cursor, std::string& value); ///< a word or a "string"
void read(TokenCursor& cursor, Dictionary& value);  ///< `{ ... }`, or `name { ... }` in a list
/// @}

/// A double that may be `inf` or `-inf`, for limits that may be absent.
struct PossiblyInfinite
{
    double value = 0;
};
void read(TokenCursor& cursor, PossiblyInfinite& value);

/// Whether a vector of three numbers may be given by two.
enum class ThirdComponent
{
    optional, ///< 0 where it is absent: a direction that a plane structure reads as well
    required  ///< a place in space, where (x y) may be one of the plane that was not thought over
};

/// Numbers of a vector, `( x y )`. A vector of two takes three as long as the third is 0 (out of the plane).
void readComponents(TokenCursor& cursor, double* components, std::size_t count,
                    ThirdComponent third = ThirdComponent::optional);

namespace detail
{
/// Eigen's fixed vectors of doubles, without Eigen.
template<class Value>
concept FixedVector = requires(Value& value)
{
    {
        Value::SizeAtCompileTime
        } -> std::convertible_to<int>;
    requires int(Value::SizeAtCompileTime) > 0;
    {
        value.data()
        } -> std::same_as<double*>;
};

/// Enumerations with names: a function `namesOf(Enumeration)` in its namespace returns {{"name", value} ...}.
template<class Value>
concept NamedEnumeration = std::is_enum_v<Value> && requires(Value value)
{
    namesOf(value);
};

[[noreturn]] void failUnknownWord(const TokenCursor& cursor, const std::string& word,
                                  const std::vector<std::string>& validWords);
} // namespace detail

template<std::size_t Count>
void read(TokenCursor& cursor, std::array<double, Count>& value)
{
    readComponents(cursor, value.data(), Count);
}

template<detail::FixedVector Value>
void read(TokenCursor& cursor, Value& value)
{
    readComponents(cursor, value.data(), static_cast<std::size_t>(Value::SizeAtCompileTime),
                   ThirdComponent::required);
}

template<detail::NamedEnumeration Enumeration>
void read(TokenCursor& cursor, Enumeration& value)
{
    const TokenCursor before = cursor;
    std::string word;
    read(cursor, word);
    std::vector<std::string> names;
    for (const auto& [name, named] : namesOf(Enumeration{}))
    {
        if (word == name)
        {
            value = named;
            return;
        }
        names.emplace_back(name);
    }
    detail::failUnknownWord(before, word, names);
}

template<class Value>
void read(TokenCursor& cursor, std::vector<Value>& values);
void read(TokenCursor& cursor, std::vector<double>& values);

/// `(first second)`, as in a table of times and values; a name and a dictionary are `name { ... }`.
template<class First, class Second>
void read(TokenCursor& cursor, std::pair<First, Second>& value)
{
    if constexpr (std::is_same_v<Second, Dictionary>)
    {
        read(cursor, value.first);
        read(cursor, value.second);
    }
    else
    {
        cursor.expect('(', "`(`");
        read(cursor, value.first);
        read(cursor, value.second);
        cursor.expect(')', "`)`");
    }
}

/// The values of a list whose start has been read, and its end.
template<class Value>
void readItems(TokenCursor& cursor, const TokenCursor::ListStart& start, std::vector<Value>& values)
{
    values.clear();
    if (start.uniform)
    {
        Value value{};
        read(cursor, value);
        values.assign(static_cast<std::size_t>(start.count), value);
        cursor.closeList(start, values.size());
        return;
    }
    if (start.count > 0)
    {
        values.reserve(std::min(static_cast<std::size_t>(start.count), cursor.remaining()));
    }
    while (!cursor.isNext(')'))
    {
        if (cursor.atEnd())
        {
            cursor.failExpected("`)`");
        }
        Value value{};
        read(cursor, value);
        values.push_back(std::move(value));
    }
    cursor.closeList(start, values.size());
}

/// `( a b c )`, `3( a b c )` or `3{a}`.
template<class Value>
void read(TokenCursor& cursor, std::vector<Value>& values)
{
    const TokenCursor::ListStart start = cursor.openList();
    readItems(cursor, start, values);
}

/// Likewise, and in a binary file `List<scalar> 3(` followed by the bytes of the numbers and `)`.
void read(TokenCursor& cursor, std::vector<double>& values);

/// Exponents of mass, length, time, temperature, amount, current, luminous intensity: `[1 -3 0 0 0 0 0]`.
using Dimensions = std::array<double, 7>;

/// Dimensions of a unit as it is written in the documentation: `m`, `m/s2`, `kg/m3`, `N`, `N/m3`, `Nm`,
/// `rad`, `-`. \throws std::invalid_argument for a unit that is not known
Dimensions dimensionsOf(std::string_view unit);
/// `[1 -3 0 0 0 0 0]`
std::string toText(const Dimensions& dimensions);

/// Take a dimension set (after the entry's own name repeated, if that is there as OpenFOAM used to write), if
/// there is one, and check it. Without a dimension set the value is taken to be in `unit`.
/// \throws FatalIOError when the dimensions are not those of the unit
void readDimensions(TokenCursor& cursor, std::string_view unit);

/// A key with its value: tokens, or a sub-dictionary.
class Entry
{
public:
    Entry(std::string entryKeyword, std::vector<Token> entryTokens, std::shared_ptr<SourceText> entrySource,
          SourceLocation entryLocation);
    Entry(std::string entryKeyword, Dictionary entryDictionary, SourceLocation entryLocation);
    ~Entry();
    Entry(const Entry&);
    Entry(Entry&&) noexcept;
    Entry& operator=(const Entry&);
    Entry& operator=(Entry&&) noexcept;

    const std::string& keyword() const { return key; }
    bool isPattern() const { return keyIsPattern; } ///< the keyword is a quoted regular expression
    void setPattern(bool pattern) { keyIsPattern = pattern; }
    bool isDictionary() const { return !body.empty(); }
    /// \throws FatalIOError when the entry is not a dictionary
    const Dictionary& dictionary() const;
    Dictionary& dictionary();
    const std::vector<Token>& tokens() const { return value; }
    /// File, path of the entry and line of its keyword.
    const SourceLocation& location() const { return where; }
    /// File, path of the entry and line of one of its tokens.
    SourceLocation locationOf(const Token& token) const;
    /// The keyword as it would be written: patterns between quotes.
    std::string keywordText() const;
    /// The value as it would be written, without `;`: one blank between tokens but none inside brackets.
    std::string valueText() const;

    /// Keeps the text that the tokens view.
    const std::shared_ptr<SourceText>& sourceText() const { return source; }

    /// Whether anything has read the entry, a macro included.
    bool isUsed() const { return used; }
    void markUsed() const { used = true; }

    /// The whole value.
    /// \throws FatalIOError when the entry says no such value, or more
    template<class Value>
    Value as() const
    {
        markUsed();
        TokenCursor cursor(*this);
        Value result{};
        using drystone::read; // and those in the namespace of the value's type
        read(cursor, result);
        cursor.expectEnd();
        return result;
    }

private:
    friend class Dictionary;
    std::string key;
    bool keyIsPattern = false;
    mutable bool used = false;
    std::vector<Token> value;
    std::shared_ptr<SourceText> source;
    std::vector<Dictionary> body; ///< the sub-dictionary, or nothing
    SourceLocation where;
};

/// An ordered collection of entries.
class Dictionary
{
public:
    // Compiled once, since everything that reads a dictionary would have a copy of each.
    Dictionary();
    /// \param dictionaryLocation file, path of the dictionary inside it and line of its `{`
    explicit Dictionary(SourceLocation dictionaryLocation);
    ~Dictionary();
    Dictionary(const Dictionary&);
    Dictionary(Dictionary&&) noexcept;
    Dictionary& operator=(const Dictionary&);
    Dictionary& operator=(Dictionary&&) noexcept;

    /// \throws FatalIOError for whatever is wrong with the file
    static Dictionary readFile(const std::filesystem::path& file, Expansion expansion = Expansion::all);
    /// As `readFile`; an empty dictionary when there is no such file.
    static Dictionary readFileIfPresent(const std::filesystem::path& file,
                                        Expansion expansion = Expansion::all);
    /// \param name stands for the file in messages
    static Dictionary readString(std::string_view text, const std::string& name = "text",
                                 Expansion expansion = Expansion::all);

    const SourceLocation& location() const { return where; }
    const std::vector<Entry>& entries() const { return content; }
    bool empty() const { return content.empty(); }
    std::vector<std::string> keywords() const;

    /// The entry of a key: the one of exactly this name, or else the last whose pattern matches the name.
    /// \return nullptr when there is none. Valid until the dictionary changes
    const Entry* find(std::string_view key) const;
    /// As `find`, but patterns are left aside.
    const Entry* findExact(std::string_view key) const;
    Entry* findExact(std::string_view key);
    bool found(std::string_view key) const { return find(key) != nullptr; }
    /// As `find`. \throws FatalIOError with the nearest keys when there is none
    const Entry& lookup(std::string_view key) const;
    /// The sub-dictionary of a key, nullptr when there is none.
    /// \throws FatalIOError when the entry is not a dictionary
    const Dictionary* findDict(std::string_view key) const;
    /// \throws FatalIOError when there is none
    const Dictionary& subDict(std::string_view key) const;
    /// The entry of `a/b/c`. \return nullptr when there is none
    const Entry* findPath(std::string_view path) const;
    /// The entry of `a/b/c` or `a.b.c`. \throws FatalIOError with the nearest keys when there is none
    const Entry& lookupPath(std::string_view path) const;

    template<class Value>
    Value get(std::string_view key) const
    {
        return lookup(key).as<Value>();
    }
    template<class Value>
    Value getOrDefault(std::string_view key, Value defaultValue) const
    {
        const Entry* entry = find(key);
        return entry ? entry->as<Value>() : std::move(defaultValue);
    }

    /// Where to point a user: the entry of this key, or the dictionary if there is none.
    SourceLocation locationOf(std::string_view key) const;

    /// Add an entry. One of the same name is replaced in its place; two dictionaries are merged.
    void merge(Entry entry);
    /// Merge all entries of another dictionary.
    void merge(const Dictionary& other);
    /// Add an entry given as text, `set("endTime", "2")`, replacing one of the same name.
    /// Messages about it point at where this dictionary begins.
    /// \throws FatalIOError when the text is not a value
    void set(const std::string& key, std::string_view value);
    bool remove(std::string_view key);
    void clear();

private:
    void rebuildIndex();
    SourceLocation where;
    std::vector<Entry> content;
    std::unordered_map<std::string, std::size_t> index; ///< of `content` by keyword
    /// Patterns in the order of appearance: place in `content`, and match.
    std::vector<std::pair<std::size_t, std::function<bool(const std::string&)>>> patterns;
};

/// Levels of sub-dictionaries, lists and brackets that a file may nest.
inline constexpr int deepestNesting = 100;

/// The dictionary as text that reads back as the same dictionary, comments and macros gone.
std::string toText(const Dictionary& dictionary, int indentation = 0);
std::string toText(const Entry& entry, int indentation = 0);

/// The `FoamFile` header for a file that is written.
/// \param object name of the file
std::string headerText(std::string_view object, std::string_view location = {},
                       std::string_view className = "dictionary");

/// Directory that `#includeEtc` looks in: $DRYSTONE_ETC, or etc/ of the source.
std::filesystem::path etcDirectory();

} // namespace drystone
