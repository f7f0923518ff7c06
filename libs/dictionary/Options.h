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
/// - enumerations with a `namesOf(Enumeration)` in their namespace that returns {{"name", value} ...};
/// - structures with a `declare`: a sub-dictionary;
/// - std::vector of such: a list of dictionaries, `( { ... } { ... } )`;
/// - std::vector<Named<...>> of such: a sub-dictionary in which users name the entries, `{ left { ... } }`;
///   with NamePattern for std::string, names may be quoted regular expressions;
/// - std::optional of any of these: empty when the key is absent;
/// and, with a Registry (dictionary/Registry.h) before the doc, what the models of the registry make: `{ type
/// ...;
/// ... }`.
#pragma once

#include "dictionary/Option.h"
#include "dictionary/OptionValue.h"

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

template<class Made>
struct Registry;

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

/// The keys of one dictionary, declared, then read.
class Options
{
public:
    // Those of a deque of options are long: where they are compiled once, a declaration takes half the time.
    Options();
    ~Options();
    Options(const Options&) = delete;
    Options& operator=(const Options&) = delete;

    /// A key that must be given.
    template<class Value>
    Option& required(std::string_view key, Value& field, std::string_view doc)
    {
        return add(OptionDescription::Presence::required, key, field, doc);
    }
    /// A key that may be left out: the field then keeps its value, which is the default.
    template<class Value>
    Option& optional(std::string_view key, Value& field, std::string_view doc)
    {
        return add(OptionDescription::Presence::hasDefault, key, field, doc);
    }
    /// A model chosen by `type` in a sub-dictionary that must be given. The field is a Made, a std::optional
    /// of one, a std::vector (a list of dictionaries) or a std::vector<Named<Made>> (users' names).
    template<class Field, class Made>
    Option& required(std::string_view key, Field& field, const Registry<Made>& registry, std::string_view doc)
    {
        return addModel(OptionDescription::Presence::required, key, field, registry, doc);
    }
    /// The same, when it may be left out.
    template<class Field, class Made>
    Option& optional(std::string_view key, Field& field, const Registry<Made>& registry, std::string_view doc)
    {
        return addModel(OptionDescription::Presence::mayBeAbsent, key, field, registry, doc);
    }
    /// Every other entry of this dictionary is a sub-dictionary with a user's name.
    template<class Named>
    void each(std::vector<Named>& field, std::string_view doc)
    {
        using Model = typename detail::IsNamedVector<std::vector<Named>>::Inner;
        static_assert(Declared<Model>);
        Option& option = addOwnNames(doc);
        option.describeMembers = describeMembersOf<Model>;
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
    void each(std::vector<Named>& field, const Registry<Made>& registry, std::string_view doc)
    {
        Option& option = addOwnNames(doc);
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
    void check(std::string_view key, std::function<std::string()> fault);
    /// What is allowed and improbable, as gravity that points upwards: a warning, when all has been read.
    /// \param doubt what is unusual and what would be usual; empty when nothing is
    void question(std::string_view key, std::function<std::string()> doubt);

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

    Option& add(OptionDescription::Presence presence, std::string_view key, std::string_view doc);
    Option& addOwnNames(std::string_view doc);
    void refuseUnknownKeys(const Dictionary& dictionary) const;
    const Option* ownNamesOption() const;
    /// Names of the models that an option chooses from; empty when it is none.
    static std::vector<std::string> typesOf(const Option& option);
    bool isDeclared(const std::string& key) const;

    template<class Value>
    Option& add(OptionDescription::Presence presence, std::string_view key, Value& field,
                std::string_view doc)
    {
        Option& option = add(presence, key, doc);
        bind(option, field);
        return option;
    }

    template<class Value>
    static void bind(Option& option, Value& field)
    {
        if constexpr (detail::IsOptional<Value>::value)
        {
            bindOptional(option, field);
        }
        else if constexpr (Declared<Value>)
        {
            bindDictionary(option, field);
        }
        else if constexpr (detail::IsNamedVector<Value>::value)
        {
            bindNamedDictionaries(option, field);
        }
        else if constexpr (isListOfDeclared<Value>())
        {
            bindDictionaryList(option, field);
        }
        else
        {
            bindPlain(option, field);
        }
    }

    /// To a field of its own, which becomes the value once it has been read.
    template<class Inner>
    static void bindOptional(Option& option, std::optional<Inner>& field)
    {
        auto inner = std::make_shared<Inner>(detail::blank<Inner>());
        bind(option, *inner);
        option.about.allowAbsence();
        option.about.defaultText.clear();
        option.readValue =
            [inner, &field, readInner = option.readValue](const Entry& entry, const Option& self)
        {
            *inner = detail::blank<Inner>();
            readInner(entry, self);
            field = std::move(*inner);
        };
    }

    template<Declared Value>
    static void bindDictionary(Option& option, Value& field)
    {
        describeAs(option, OptionDescription::Form::dictionary, "dictionary");
        option.describeMembers = describeMembersOf<Value>;
        option.readValue = [&field](const Entry& entry, const Option&)
        { readOptions(entry.dictionary(), field); };
    }

    template<class Value>
    static void bindNamedDictionaries(Option& option, Value& field)
    {
        using Model = typename detail::IsNamedVector<Value>::Inner;
        static_assert(Declared<Model>, "the structure needs a `declare`");
        describeAs(option, OptionDescription::Form::namedDictionaries, "dictionary of dictionaries");
        option.describeMembers = describeMembersOf<Model>;
        option.readValue = [&field](const Entry& entry, const Option&) {
            readNamed(entry, field,
                      [](const Dictionary& dictionary) { return readOptions<Model>(dictionary); });
        };
    }

    template<Declared Model>
    static void bindDictionaryList(Option& option, std::vector<Model>& field)
    {
        describeAs(option, OptionDescription::Form::dictionaryList, "list of dictionaries");
        option.describeMembers = describeMembersOf<Model>;
        option.readValue = [&field](const Entry& entry, const Option&)
        {
            field.clear();
            for (const Dictionary& dictionary : entry.as<std::vector<Dictionary>>())
            {
                field.push_back(readOptions<Model>(dictionary));
            }
        };
    }

    template<class Value>
    static void bindPlain(Option& option, Value& field)
    {
        option.about.type = detail::typeNameOf<Value>();
        if (option.about.presence == OptionDescription::Presence::hasDefault)
        {
            option.about.defaultText = detail::textOf(field);
        }
        if constexpr (detail::NamedEnumeration<Value>)
        {
            for (const auto& [name, value] : namesOf(Value{}))
            {
                option.about.words.emplace_back(name);
            }
        }
        option.readValue = [&field](const Entry& entry, const Option& self)
        {
            readPlain(entry, self, field);
            detail::visitNumbers(field, [&](double number) { self.checkNumber(number, entry); });
            detail::visitWords(field, [&](const std::string& word) { self.checkWord(word, entry); });
        };
    }

    template<class Model>
    static void describeMembersOf(OptionDescription& about)
    {
        about.members = describeOptions<Model>();
    }

    /// A value that is no dictionary, with the dimensions before it.
    template<class Value>
    static void readPlain(const Entry& entry, const Option& option, Value& field)
    {
        entry.markUsed();
        TokenCursor cursor(entry);
        option.readUnit(cursor);
        if constexpr (std::is_same_v<Value, double>)
        {
            option.readNumber(cursor, field);
        }
        else
        {
            read(cursor, field);
        }
        cursor.expectEnd();
    }

    /// What is left out is then absent: a dictionary has no default of its own.
    static void describeAs(Option& option, OptionDescription::Form form, std::string_view type);

    /// `key { name { ... } name { ... } }`, each inner dictionary read by `readOne`.
    template<class Field, class ReadOne>
    static void readNamed(const Entry& entry, Field& field, const ReadOne& readOne)
    {
        field.clear();
        for (const Entry& inner : entry.dictionary().entries())
        {
            if (!inner.isDictionary() && inner.isUsed()) // a value that others refer to as a macro
            {
                continue;
            }
            typename Field::value_type::first_type name;
            detail::assignName(name, inner);
            field.emplace_back(std::move(name), readOne(inner.dictionary()));
        }
    }

    template<class Value>
    static constexpr bool isListOfDeclared()
    {
        if constexpr (detail::IsVector<Value>::value)
        {
            return Declared<typename detail::IsVector<Value>::Inner>;
        }
        else
        {
            return false;
        }
    }

    template<class Field, class Made>
    Option& addModel(OptionDescription::Presence presence, std::string_view key, Field& field,
                     const Registry<Made>& registry, std::string_view doc)
    {
        using Form = OptionDescription::Form;
        Option& option = add(presence, key, doc);
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
                {
                    field.push_back(registry.select(dictionary));
                }
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
