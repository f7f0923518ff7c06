// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One declared key of a dictionary, what a program says of it: its doc, unit, range, default and words.
#pragma once

#include "dictionary/Dictionary.h"

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

class Options;

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

    OptionDescription();
    ~OptionDescription();
    OptionDescription(const OptionDescription&);
    OptionDescription(OptionDescription&&) noexcept;
    OptionDescription& operator=(const OptionDescription&);
    OptionDescription& operator=(OptionDescription&&) noexcept;

    /// A key that need not be given has no default to be shown.
    void allowAbsence();
    /// ` [m]`, as messages and texts add it; nothing where the key has no unit.
    std::string unitText() const;
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
    Option& unit(std::string_view unitName);
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
    Option& usual(double from, double to, std::string_view note = {});
    /// The words that are allowed. (Enumerations know theirs.)
    Option& oneOf(std::vector<std::string> allowedWords);
    /// What annotated dictionaries show when there is no default; of a dictionary of dictionaries, the name
    /// that a user might give.
    Option& example(std::string_view text);

    const OptionDescription& description() const { return about; }

private:
    friend class Options;
    void readEntry(const Entry& entry) const;
    void readUnit(TokenCursor& cursor) const;
    void readNumber(TokenCursor& cursor, double& number) const;
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

} // namespace drystone
