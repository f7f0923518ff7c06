// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declared settings: one function per model says which keys it takes, and from that one declaration come
/// reading, checking, messages, -help and the annotated dictionaries in etc/.
///
///     struct RunningBond
///     {
///         std::array<double, 2> unit{0.4, 0.2};
///         double thickness = 1;
///         std::vector<Opening> openings;      // Opening has a `declare` of its own
///     };
///     void declare(Options& options, RunningBond& bond)
///     {
///         options.required("unit", bond.unit, "length of a full block, height of a course")
///             .unit("m").above(0).example("(0.4 0.175)");
///         options.optional("thickness", bond.thickness, "out of plane").unit("m").above(0);
///         options.optional("openings", bond.openings, "doors and windows");
///         options.check("openings", [&bond] { return overlap(bond.openings) ? "Two openings overlap." : "";
///         });
///     }
///     const auto bond = readOptions<RunningBond>(dictionary.subDict("texture"));
///
/// The values that fields are initialised with are the defaults. Fields can be
/// - numbers, integers, switches, words, vectors (arrays, Eigen's), lists and pairs of these;
/// - enumerations with a `namesOf(Enumeration)` beside them that returns {{"name", value} ...};
/// - structures with a `declare`: a sub-dictionary;
/// - std::vector of such: a list of dictionaries, `( { ... } { ... } )`;
/// - std::vector<Named<...>> of such: a sub-dictionary in which users name the entries, `{ left { ... } }`;
///   with NamePattern for std::string, names may be quoted regular expressions;
/// - std::optional of any of these: empty when the key is absent;
/// and, with a Registry (dictionary/Registry.h) before the doc, what the models of the registry make: `{ type
/// ...;
/// ... }`.
#pragma once

#include "dictionary/Dictionary.h"
#include "dictionary/DictionaryPattern.h"

#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

class Options;
template<class Made>
struct Registry;

/// What there is to know of a declared key.
struct OptionDescription
{
    enum class Form
    {
        value,             ///< key value;
        dictionary,        ///< key { ... }
        dictionaryList,    ///< key ( { ... } { ... } );
        namedDictionaries, ///< key { name { ... } name { ... } }
        ownNames,          ///< name { ... }: the dictionary itself has users' names as keys
        elsewhere          ///< read by someone else
    };
    enum class Presence
    {
        required,
        hasDefault, ///< defaultText is what is taken
        mayBeAbsent
    };
    /// A model that may be chosen by `type`.
    struct Alternative
    {
        std::string name;
        std::string summary;
        std::vector<OptionDescription> members;
    };

    std::string key;
    std::string doc;
    Form form = Form::value;
    Presence presence = Presence::required;
    std::string type;  ///< number, integer, switch, word, vector of 2, list of ...
    std::string unit;  ///< m, kg/m3, ...; empty when it has none
    std::string range; ///< above 0, from 0 to 1; empty when all is allowed
    std::string usual; ///< from 300 to 8000; empty when no value is questioned
    std::string defaultText;
    std::string exampleText;
    bool given = false;                     ///< annotated dictionaries give it although it may be absent
    std::vector<std::string> words;         ///< the allowed ones; empty when all are
    std::vector<OptionDescription> members; ///< of a sub-dictionary
    std::vector<Alternative> alternatives;  ///< models of a sub-dictionary that has a `type`
};

/// A name that may be a quoted regular expression, for choosing blocks, joints or supports.
struct NamePattern
{
    std::string text;
    std::function<bool(const std::string&)> matches; ///< the whole of a name
};
void read(TokenCursor& cursor, NamePattern& value);

/// One declared key.
class Option
{
public:
    /// Unit that values are in, as m, m/s2, kg/m3, N, rad, -. A dimension set before the value is checked
    /// against it.
    Option& unit(std::string unitName);
    // Bounds, of every number when there are several.
    Option& above(double limit);
    Option& atLeast(double limit);
    Option& below(double limit);
    Option& atMost(double limit);
    /// `inf` is allowed (a double).
    Option& orInfinite();
    /// Values that need no question. Another one is taken as it is, with a warning: it may be in another
    /// unit. \param note closes the warning, a sentence without its point: what the value may have been meant
    /// as
    Option& usual(double from, double to, std::string note = {});
    /// The words that are allowed. (Enumerations know theirs.)
    Option& oneOf(std::vector<std::string> allowedWords);
    /// What annotated dictionaries show when there is no default; of a dictionary of dictionaries, the name
    /// that a user might give.
    Option& example(std::string text);

    const OptionDescription& description() const { return about; }

private:
    friend class Options;
    void readEntry(const Entry& entry) const;
    void checkNumber(double number, const Entry& entry) const;
    void questionNumber(double number, const Entry& entry) const;
    void checkWord(const std::string& word, const Entry& entry) const;

    OptionDescription about;
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool lowestAllowed = true;
    bool highestAllowed = true;
    bool infiniteAllowed = false;
    double usuallyFrom = -std::numeric_limits<double>::infinity();
    double usuallyTo = std::numeric_limits<double>::infinity();
    std::string usualNote;
    std::function<void(const Entry&, const Option&)> readValue;
    std::function<void(OptionDescription&)> describeMembers;
};

template<class Model>
concept Declared = requires(Options& options, Model& model)
{
    declare(options, model);
};

/// \throws FatalIOError for an unknown, missing, mistyped or out-of-range entry, before anything is computed
template<Declared Model>
void readOptions(const Dictionary& dictionary, Model& model);
template<Declared Model>
Model readOptions(const Dictionary& dictionary);
template<Declared Model>
std::vector<OptionDescription> describeOptions();

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

void assignName(std::string& name, const Entry& entry);
void assignName(NamePattern& name, const Entry& entry);

// Text of a value as a dictionary has it.
std::string textOf(double value);
std::string textOf(int value);
std::string textOf(long value);
std::string textOf(bool value);
std::string textOf(const std::string& value);
template<class Value>
std::string textOf(const Value& value)
{
    if constexpr (NamedEnumeration<Value>)
    {
        for (const auto& [name, named] : namesOf(Value{}))
        {
            if (named == value)
                return std::string(name);
        }
        return {};
    }
    else if constexpr (requires {
                           value.begin();
                           value.end();
                       })
    {
        std::string text = "(";
        for (const auto& element : value)
            text.append(text.size() > 1 ? " " : "").append(textOf(element)); // + trips GCC 12's -Wrestrict
        return text + ")";
    }
    else if constexpr (FixedVector<Value>)
    {
        std::string text = "(";
        for (int i = 0; i < int(Value::SizeAtCompileTime); ++i)
            text.append(i > 0 ? " " : "").append(textOf(value.data()[i]));
        return text + ")";
    }
    else if constexpr (requires {
                           value.first;
                           value.second;
                       })
        return std::string("(")
            .append(textOf(value.first))
            .append(" ")
            .append(textOf(value.second))
            .append(")");
    else
        return {};
}

template<class Value>
std::string typeNameOf()
{
    if constexpr (std::is_same_v<Value, double>)
        return "number";
    else if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, long>)
        return "integer";
    else if constexpr (std::is_same_v<Value, bool>)
        return "switch";
    else if constexpr (std::is_same_v<Value, Dictionary>)
        return "dictionary";
    else if constexpr (FixedVector<Value>)
        return "vector of " + std::to_string(int(Value::SizeAtCompileTime));
    else if constexpr (IsVector<Value>::value)
        return "list, each: " + typeNameOf<typename IsVector<Value>::Inner>();
    else if constexpr (requires {
                           std::tuple_size<Value>::value;
                           typename Value::value_type;
                       })
        return "vector of " + std::to_string(std::tuple_size<Value>::value);
    else if constexpr (requires(Value value) {
                           value.first;
                           value.second;
                       })
        return "pair (" + typeNameOf<typename Value::first_type>() + " "
               + typeNameOf<typename Value::second_type>() + ")";
    else
        return "word";
}

/// Every number in a value.
template<class Value, class Visit>
void visitNumbers(const Value& value, const Visit& visit)
{
    if constexpr (std::is_same_v<Value, bool>)
        return;
    else if constexpr (std::is_arithmetic_v<Value>)
        visit(static_cast<double>(value));
    else if constexpr (FixedVector<Value>)
    {
        for (int i = 0; i < int(Value::SizeAtCompileTime); ++i)
            visit(value.data()[i]);
    }
    else if constexpr (std::is_same_v<Value, std::string>)
        return;
    else if constexpr (requires {
                           value.begin();
                           value.end();
                       })
    {
        for (const auto& element : value)
            visitNumbers(element, visit);
    }
    else if constexpr (requires {
                           value.first;
                           value.second;
                       })
    {
        visitNumbers(value.first, visit);
        visitNumbers(value.second, visit);
    }
}
} // namespace detail

/// The keys of one dictionary, declared, then read.
class Options
{
public:
    /// A key that must be given.
    template<class Value>
    Option& required(std::string key, Value& field, std::string doc)
    {
        return add(OptionDescription::Presence::required, std::move(key), field, std::move(doc));
    }
    /// A key that may be left out: the field then keeps its value, which is the default.
    template<class Value>
    Option& optional(std::string key, Value& field, std::string doc)
    {
        return add(OptionDescription::Presence::hasDefault, std::move(key), field, std::move(doc));
    }
    /// A model chosen by `type` in a sub-dictionary that must be given. The field is a Made, a std::optional
    /// of one, a std::vector (a list of dictionaries) or a std::vector<Named<Made>> (users' names).
    template<class Field, class Made>
    Option& required(std::string key, Field& field, const Registry<Made>& registry, std::string doc)
    {
        return addModel(OptionDescription::Presence::required, std::move(key), field, registry,
                        std::move(doc));
    }
    /// The same, when it may be left out.
    template<class Field, class Made>
    Option& optional(std::string key, Field& field, const Registry<Made>& registry, std::string doc)
    {
        return addModel(OptionDescription::Presence::mayBeAbsent, std::move(key), field, registry,
                        std::move(doc));
    }
    /// Every other entry of this dictionary is a sub-dictionary with a user's name.
    template<class Named>
    void each(std::vector<Named>& field, std::string doc)
    {
        using Model = typename detail::IsNamedVector<std::vector<Named>>::Inner;
        static_assert(Declared<Model>);
        Option& option = addOwnNames(std::move(doc));
        option.describeMembers = [](OptionDescription& about) { about.members = describeOptions<Model>(); };
        option.readValue = [&field](const Entry& entry, const Option&)
        {
            Named named{};
            detail::assignName(named.first, entry);
            readOptions(entry.dictionary(), named.second);
            field.push_back(std::move(named));
        };
    }
    /// The same for models chosen by `type`.
    template<class Named, class Made>
    void each(std::vector<Named>& field, const Registry<Made>& registry, std::string doc)
    {
        Option& option = addOwnNames(std::move(doc));
        option.describeMembers = [&registry](OptionDescription& about)
        { about.alternatives = registry.describe(); };
        option.readValue = [&field, &registry](const Entry& entry, const Option&)
        {
            std::string name;
            detail::assignName(name, entry);
            field.emplace_back(std::move(name), registry.select(entry.dictionary()));
        };
    }
    /// Keys that someone else reads, as another application's sub-dictionary: not unknown here.
    void readElsewhere(const std::vector<std::string>& keys, const std::string& doc = {});
    /// A rule between fields, checked when all have been read.
    /// \param key whose place the message points at
    /// \param fault what is wrong and how to repair it; empty when nothing is
    void check(std::string key, std::function<std::string()> fault);
    /// What is allowed and improbable, as gravity that points upwards: a warning, when all has been read.
    /// \param doubt what is unusual and what would be usual; empty when nothing is
    void question(std::string key, std::function<std::string()> doubt);

    /// Find unknown keys, read every option, check every rule.
    /// \throws FatalIOError
    void readFrom(const Dictionary& dictionary) const;

    std::vector<OptionDescription> descriptions() const;

private:
    struct Rule
    {
        std::string key;
        std::function<std::string()> fault;
    };

    Option& add(OptionDescription::Presence presence, std::string key, std::string doc);
    Option& addOwnNames(std::string doc);
    void refuseUnknownKeys(const Dictionary& dictionary) const;
    const Option* ownNamesOption() const;
    /// Names of the models that an option chooses from; empty when it is none.
    static std::vector<std::string> typesOf(const Option& option);
    bool isDeclared(const std::string& key) const;

    template<class Value>
    Option& add(OptionDescription::Presence presence, std::string key, Value& field, std::string doc)
    {
        Option& option = add(presence, std::move(key), std::move(doc));
        bind(option, field);
        return option;
    }

    template<class Value>
    static void bind(Option& option, Value& field)
    {
        using Form = OptionDescription::Form;
        if constexpr (detail::IsOptional<Value>::value)
        {
            using Inner = typename detail::IsOptional<Value>::Inner;
            // Bound to a field of its own, which becomes the value once it has been read.
            auto inner = std::make_shared<Inner>();
            bind(option, *inner);
            if (option.about.presence == OptionDescription::Presence::hasDefault)
                option.about.presence = OptionDescription::Presence::mayBeAbsent;
            option.about.defaultText.clear();
            option.readValue =
                [inner, &field, readInner = option.readValue](const Entry& entry, const Option& self)
            {
                *inner = Inner{};
                readInner(entry, self);
                field = std::move(*inner);
            };
        }
        else if constexpr (Declared<Value>)
        {
            option.about.form = Form::dictionary;
            option.about.type = "dictionary";
            if (option.about.presence == OptionDescription::Presence::hasDefault)
                option.about.presence = OptionDescription::Presence::mayBeAbsent;
            option.describeMembers = [](OptionDescription& about)
            { about.members = describeOptions<Value>(); };
            option.readValue = [&field](const Entry& entry, const Option&)
            { readOptions(entry.dictionary(), field); };
        }
        else if constexpr (detail::IsNamedVector<Value>::value)
        {
            using Model = typename detail::IsNamedVector<Value>::Inner;
            static_assert(Declared<Model>, "the structure needs a `declare`");
            option.about.form = Form::namedDictionaries;
            option.about.type = "dictionary of dictionaries";
            if (option.about.presence == OptionDescription::Presence::hasDefault)
                option.about.presence = OptionDescription::Presence::mayBeAbsent;
            option.describeMembers = [](OptionDescription& about)
            { about.members = describeOptions<Model>(); };
            option.readValue = [&field](const Entry& entry, const Option&) {
                readNamed(entry, field,
                          [](const Dictionary& dictionary) { return readOptions<Model>(dictionary); });
            };
        }
        else if constexpr (isListOfDeclared<Value>())
        {
            using Model = typename detail::IsVector<Value>::Inner;
            option.about.form = Form::dictionaryList;
            option.about.type = "list of dictionaries";
            if (option.about.presence == OptionDescription::Presence::hasDefault)
                option.about.presence = OptionDescription::Presence::mayBeAbsent;
            option.describeMembers = [](OptionDescription& about)
            { about.members = describeOptions<Model>(); };
            option.readValue = [&field](const Entry& entry, const Option&)
            {
                field.clear();
                for (const Dictionary& dictionary : entry.as<std::vector<Dictionary>>())
                    field.push_back(readOptions<Model>(dictionary));
            };
        }
        else
        {
            option.about.type = detail::typeNameOf<Value>();
            if (option.about.presence == OptionDescription::Presence::hasDefault)
                option.about.defaultText = detail::textOf(field);
            if constexpr (detail::NamedEnumeration<Value>)
            {
                for (const auto& [name, value] : namesOf(Value{}))
                    option.about.words.emplace_back(name);
            }
            option.readValue = [&field](const Entry& entry, const Option& self)
            {
                entry.markUsed();
                TokenCursor cursor(entry);
                if (!self.about.unit.empty())
                    readDimensions(cursor, self.about.unit);
                if constexpr (std::is_same_v<Value, double>)
                {
                    if (self.infiniteAllowed)
                    {
                        PossiblyInfinite value;
                        read(cursor, value);
                        field = value.value;
                    }
                    else
                        read(cursor, field);
                }
                else
                    read(cursor, field);
                cursor.expectEnd();
            };
            const auto check = [](const Value& value, const Option& self, const Entry& entry)
            {
                detail::visitNumbers(value, [&](double number) { self.checkNumber(number, entry); });
                if constexpr (std::is_same_v<Value, std::string>)
                    self.checkWord(value, entry);
                else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
                {
                    for (const std::string& word : value)
                        self.checkWord(word, entry);
                }
            };
            option.readValue =
                [&field, check, readPlain = option.readValue](const Entry& entry, const Option& self)
            {
                readPlain(entry, self);
                check(field, self, entry);
            };
        }
    }

    /// `key { name { ... } name { ... } }`, each inner dictionary read by `readOne`.
    template<class Field, class ReadOne>
    static void readNamed(const Entry& entry, Field& field, const ReadOne& readOne)
    {
        field.clear();
        for (const Entry& inner : entry.dictionary().entries())
        {
            if (!inner.isDictionary() && inner.isUsed()) // a value that others refer to as a macro
                continue;
            typename Field::value_type::first_type name;
            detail::assignName(name, inner);
            field.emplace_back(std::move(name), readOne(inner.dictionary()));
        }
    }

    template<class Value>
    static constexpr bool isListOfDeclared()
    {
        if constexpr (detail::IsVector<Value>::value)
            return Declared<typename detail::IsVector<Value>::Inner>;
        else
            return false;
    }

    template<class Field, class Made>
    Option& addModel(OptionDescription::Presence presence, std::string key, Field& field,
                     const Registry<Made>& registry, std::string doc)
    {
        using Form = OptionDescription::Form;
        Option& option = add(presence, std::move(key), std::move(doc));
        option.describeMembers = [&registry](OptionDescription& about)
        { about.alternatives = registry.describe(); };
        option.about.type = registry.family + " type";
        if constexpr (detail::IsNamedVector<Field>::value)
        {
            option.about.form = Form::namedDictionaries;
            option.readValue = [&field, &registry](const Entry& entry, const Option&)
            {
                readNamed(entry, field,
                          [&registry](const Dictionary& dictionary) { return registry.select(dictionary); });
            };
        }
        else if constexpr (detail::IsVector<Field>::value && !std::is_same_v<Field, Made>)
        {
            option.about.form = Form::dictionaryList;
            option.readValue = [&field, &registry](const Entry& entry, const Option&)
            {
                field.clear();
                for (const Dictionary& dictionary : entry.as<std::vector<Dictionary>>())
                    field.push_back(registry.select(dictionary));
            };
        }
        else
        {
            option.about.form = Form::dictionary;
            option.readValue = [&field, &registry](const Entry& entry, const Option&)
            { field = registry.select(entry.dictionary()); };
        }
        return option;
    }

    std::deque<Option> options;
    std::vector<Rule> rules;
    std::vector<Rule> questions;
};

template<Declared Model>
void readOptions(const Dictionary& dictionary, Model& model)
{
    Options options;
    declare(options, model);
    options.readFrom(dictionary);
}

template<Declared Model>
Model readOptions(const Dictionary& dictionary)
{
    Model model{};
    readOptions(dictionary, model);
    return model;
}

template<Declared Model>
std::vector<OptionDescription> describeOptions()
{
    Model model{};
    Options options;
    declare(options, model);
    return options.descriptions();
}

/// A whole example dictionary, each key with its doc, unit, range and default, that reads back as it stands.
/// What may be absent is commented out. \param name of the file, for its header \param doc what the file is
/// for, as a comment on top; may have several lines
std::string annotatedDictionary(std::string_view name, std::string_view doc,
                                const std::vector<OptionDescription>& options);

/// The keys as -help lists them: one a line, sub-dictionaries indented.
std::string helpText(const std::vector<OptionDescription>& options, int indentation = 4);

} // namespace drystone
