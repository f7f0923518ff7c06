// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Checks each list that it reads, with its place; writes the fewest digits that read back the same.
#include "conic/ProgramFile.h"

#include "core/WholeFile.h"
#include "dictionary/Dictionary.h"
#include "dictionary/Options.h"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace drystone
{
namespace
{

/// One contact point as the file has it, its numbers not yet counted.
struct ContactEntry
{
    int first = -1;
    int second = -1;
    std::vector<double> onFirst;
    std::vector<double> onSecond;
};

void read(TokenCursor& cursor, ContactEntry& contact)
{
    cursor.expect('(', "`(` of a contact point");
    drystone::read(cursor, contact.first);
    drystone::read(cursor, contact.second);
    drystone::read(cursor, contact.onFirst);
    drystone::read(cursor, contact.onSecond);
    cursor.expect(')', "`)` of a contact point");
}

/// Likewise a strength: `read` must be in the namespace of its type.
struct StrengthEntry
{
    Strength strength;
};

void read(TokenCursor& cursor, StrengthEntry& entry)
{
    Strength& strength = entry.strength;
    PossiblyInfinite crushing;
    cursor.expect('(', "`(` of a strength");
    drystone::read(cursor, strength.cohesion);
    drystone::read(cursor, strength.tension);
    drystone::read(cursor, crushing);
    cursor.expect(')', "`)` of a strength");
    strength.crushing = crushing.value;
}

/// A list with one element for each of `count` things. \throws FatalIOError for another length
template<class Value>
std::vector<Value> readList(const Dictionary& dictionary, const std::string& key, std::size_t count,
                            const std::string& of)
{
    std::vector<Value> values = dictionary.get<std::vector<Value>>(key);
    if (values.size() != count)
    {
        throw FatalIOError(
            fmt::format("{} has {} elements, but there are {}: {}.", key, values.size(), count, of),
            dictionary.locationOf(key));
    }
    return values;
}

Eigen::VectorXd readVector(const Dictionary& dictionary, const std::string& key, std::size_t count,
                           const std::string& of)
{
    const auto values = readList<double>(dictionary, key, count, of);
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Matrix whose numbers come row by row.
template<int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> matrixOf(const std::vector<double>& numbers, const std::string& what,
                                              const SourceLocation& place)
{
    if (numbers.size() != Rows * Columns)
    {
        throw FatalIOError(fmt::format("{} has {} numbers instead of {} x {} = {}.", what, numbers.size(),
                                       Rows, Columns, Rows * Columns),
                           place);
    }
    using RowByRow = Eigen::Matrix<double, Rows, Columns, Columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
    return Eigen::Map<const RowByRow>(numbers.data());
}

/// Where each element of a list begins, for messages.
std::vector<SourceLocation> placesOf(const Entry& entry)
{
    std::vector<SourceLocation> places;
    int depth = 0;
    for (const Token& token : entry.tokens())
    {
        if (token.is('('))
        {
            ++depth;
            if (depth == 2)
            {
                places.push_back(entry.locationOf(token));
            }
        }
        depth -= token.is(')') ? 1 : 0;
    }
    return places;
}

SourceLocation placeOf(const Entry& entry, std::size_t element)
{
    const std::vector<SourceLocation> places = placesOf(entry);
    return element < places.size() ? places[element] : entry.location(); // N{value} has no places
}

void refuseUnknownKeys(const Dictionary& dictionary)
{
    const std::vector<std::string> known{"dimensions", "bodies",   "contacts", "friction", "strength",
                                         "load",       "liveLoad", "inertia",  "gap",      "compliance"};
    for (const Entry& entry : dictionary.entries())
    {
        if (!entry.isUsed() && entry.keyword() != "FoamFile")
        {
            throw FatalIOError(unknownWordMessage("key", entry.keyword(), known), entry.location());
        }
    }
}

/// The columns of all contact points.
template<int Rows, int Forces>
std::vector<ConeColumns<Rows, Forces>> readContacts(const Dictionary& dictionary, int bodies)
{
    std::vector<ConeColumns<Rows, Forces>> read;
    const Entry& contacts = dictionary.lookup("contacts");
    const auto entries = contacts.as<std::vector<ContactEntry>>();
    for (std::size_t point = 0; point < entries.size(); ++point)
    {
        const ContactEntry& entry = entries[point];
        const auto fail = [&](const std::string& message) {
            throw FatalIOError(fmt::format("Contact point {}: {}", point, message), placeOf(contacts, point));
        };
        for (const int body : {entry.first, entry.second})
        {
            if (body < -1 || body >= bodies)
            {
                fail(fmt::format("there is no body {}: they are numbered from 0 to {}, and -1 does not move.",
                                 body, bodies - 1));
            }
        }
        if (entry.first == entry.second && entry.first >= 0)
        {
            fail(fmt::format("body {} cannot touch itself.", entry.first));
        }
        if (entry.first < 0 && entry.second < 0)
        {
            fail("both of its bodies are -1, which do not move: it carries nothing. Remove it.");
        }
        if (entry.onFirst.size() != Rows * Forces || entry.onSecond.size() != Rows * Forces)
        {
            fail(fmt::format("{} and {} numbers, where {} x {} are needed for each of the two bodies.",
                             entry.onFirst.size(), entry.onSecond.size(), Rows, Forces));
        }
        read.push_back({entry.first, entry.second,
                        matrixOf<Rows, Forces>(entry.onFirst, "", contacts.location()),
                        matrixOf<Rows, Forces>(entry.onSecond, "", contacts.location())});
        if (!hasOppositeForces(read.back()))
        {
            fail(fmt::format(
                "what it does to its two bodies must be opposite in the first {} rows, the forces.", Forces));
        }
    }
    return read;
}

std::vector<double> readFriction(const Dictionary& dictionary, std::size_t points)
{
    const auto friction = readList<double>(dictionary, "friction", points, "one for each contact point");
    for (std::size_t point = 0; point < points; ++point)
    {
        if (friction[point] < 0)
        {
            throw FatalIOError(
                fmt::format("friction {} of contact point {} is below 0.", friction[point], point),
                dictionary.locationOf("friction"));
        }
    }
    return friction;
}

/// \param friction of each contact point
std::vector<Strength> readStrength(const Dictionary& dictionary, const std::vector<double>& friction)
{
    std::vector<Strength> strengths;
    for (const StrengthEntry& entry :
         readList<StrengthEntry>(dictionary, "strength", friction.size(), "one for each contact point"))
    {
        strengths.push_back(entry.strength);
    }
    for (std::size_t point = 0; point < friction.size(); ++point)
    {
        const Strength& strength = strengths[point];
        // mu tension may be rounded one way here and another way where it was computed.
        if (!(strength.tension >= 0) || !(strength.crushing > 0)
            || !(strength.cohesion >= friction[point] * strength.tension * (1 - 1e-12)))
        {
            throw FatalIOError(
                fmt::format("strength ({} {} {}) of contact point {}: tension must be at least 0, "
                            "cohesion at least mu tension, and crushing above 0.",
                            strength.cohesion, strength.tension, strength.crushing, point),
                placeOf(dictionary.lookup("strength"), point));
        }
    }
    return strengths;
}

template<int Rows>
std::vector<Eigen::Matrix<double, Rows, Rows>> readInertia(const Dictionary& dictionary, int bodies)
{
    std::vector<Eigen::Matrix<double, Rows, Rows>> inertias;
    const Entry& inertia = dictionary.lookup("inertia");
    const auto blocks = readList<std::vector<double>>(dictionary, "inertia", static_cast<std::size_t>(bodies),
                                                      "one for each body");
    const std::vector<SourceLocation> places = placesOf(inertia);
    for (std::size_t body = 0; body < blocks.size(); ++body)
    {
        const SourceLocation place = body < places.size() ? places[body] : inertia.location();
        const auto block = matrixOf<Rows, Rows>(blocks[body], fmt::format("inertia of body {}", body), place);
        const double asymmetry = (block - block.transpose()).cwiseAbs().maxCoeff();
        if (asymmetry > 1e-12 * block.cwiseAbs().maxCoeff() || block.llt().info() != Eigen::Success)
        {
            throw FatalIOError(
                fmt::format("inertia of body {} is not symmetric and positive definite.", body), place);
        }
        inertias.push_back(block);
    }
    return inertias;
}

template<int Rows, int Forces>
ConeProgram<Rows, Forces> readProgramOf(const Dictionary& dictionary)
{
    ConeProgram<Rows, Forces> program;
    program.bodies = dictionary.get<int>("bodies");
    if (program.bodies < 0)
    {
        throw FatalIOError(fmt::format("bodies {} is below 0.", program.bodies),
                           dictionary.locationOf("bodies"));
    }
    program.contacts = readContacts<Rows, Forces>(dictionary, program.bodies);
    const std::size_t points = program.contacts.size();
    const std::size_t rows = Rows * static_cast<std::size_t>(program.bodies);
    const std::string ofRows = fmt::format("{} for each of {} bodies", Rows, program.bodies);
    const std::string ofForces = fmt::format("{} for each of {} contact points", Forces, points);
    program.friction = readFriction(dictionary, points);
    if (dictionary.found("strength"))
    {
        program.strength = readStrength(dictionary, program.friction);
    }
    program.load = readVector(dictionary, "load", rows, ofRows);
    if (dictionary.found("liveLoad"))
    {
        program.liveLoad = readVector(dictionary, "liveLoad", rows, ofRows);
        if (program.liveLoad.isZero(0) && rows > 0)
        {
            throw FatalIOError("This live load is zero, whatever its multiplier. Leave it out, or give one.",
                               dictionary.locationOf("liveLoad"));
        }
    }
    if (dictionary.found("inertia"))
    {
        program.inertia = readInertia<Rows>(dictionary, program.bodies);
    }
    if (dictionary.found("gap"))
    {
        program.gap = readVector(dictionary, "gap", Forces * points, ofForces);
    }
    if (dictionary.found("compliance"))
    {
        program.compliance = readVector(dictionary, "compliance", Forces * points, ofForces);
        if (program.compliance.size() > 0 && program.compliance.minCoeff() < 0)
        {
            throw FatalIOError("A compliance is at least 0.", dictionary.locationOf("compliance"));
        }
    }
    refuseUnknownKeys(dictionary);
    return program;
}

void appendNumbers(std::string& text, const double* begin, Eigen::Index count)
{
    const char* separator = "";
    for (Eigen::Index i = 0; i < count; ++i)
    {
        fmt::format_to(std::back_inserter(text), "{}{}", separator, begin[i]);
        separator = " ";
    }
}

/// `(a b c d)`, row by row.
template<int Rows, int Columns>
void appendMatrix(std::string& text, const Eigen::Matrix<double, Rows, Columns>& matrix)
{
    const Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor> rowByRow = matrix;
    text += '(';
    appendNumbers(text, rowByRow.data(), rowByRow.size());
    text += ')';
}

/// `key N (a b ...);`, `perLine` numbers on each line.
void appendVector(std::string& text, const char* key, const double* begin, Eigen::Index count,
                  Eigen::Index perLine)
{
    fmt::format_to(std::back_inserter(text), "{:<16}{}\n(\n", key, count);
    for (Eigen::Index i = 0; i < count; i += perLine)
    {
        text += "    ";
        appendNumbers(text, begin + i, std::min(perLine, count - i));
        text += '\n';
    }
    text += ");\n";
}

} // namespace

template<int Rows, int Forces>
std::string programText(const ConeProgram<Rows, Forces>& program)
{
    std::string text = headerText("coneProgram");
    const auto out = std::back_inserter(text);
    text += "// minimise 1/2 r'Mbar^-1 r + g'c - alpha subject to r + A c = f + alpha L, |c_t| <= mu c_n at "
            "every point:\n// libs/conic/ProgramFile.h says what stands where. solveProgram solves it.\n\n";
    fmt::format_to(out, "{:<16}{};\n{:<16}{};\n", "dimensions", Forces, "bodies", program.bodies);
    fmt::format_to(out, "{:<16}{}\n(\n", "contacts", program.points());
    for (const auto& columns : program.contacts)
    {
        fmt::format_to(out, "    ({} {} ", columns.first, columns.second);
        appendMatrix(text, columns.onFirst);
        text += ' ';
        appendMatrix(text, columns.onSecond);
        text += ")\n";
    }
    text += ");\n";
    appendVector(text, "friction", program.friction.data(), program.points(), 10);
    if (program.hasStrength())
    {
        fmt::format_to(out, "{:<16}{}\n(\n", "strength", program.strength.size());
        for (const Strength& strength : program.strength)
        {
            fmt::format_to(out, "    ({} {} {})\n", strength.cohesion, strength.tension, strength.crushing);
        }
        text += ");\n";
    }
    appendVector(text, "load", program.load.data(), program.load.size(), Rows);
    if (program.hasMultiplier())
    {
        appendVector(text, "liveLoad", program.liveLoad.data(), program.liveLoad.size(), Rows);
    }
    if (program.hasInertia())
    {
        fmt::format_to(out, "{:<16}{}\n(\n", "inertia", program.inertia.size());
        for (const auto& block : program.inertia)
        {
            text += "    ";
            appendMatrix(text, block);
            text += '\n';
        }
        text += ");\n";
    }
    if (program.gap.size() > 0)
    {
        appendVector(text, "gap", program.gap.data(), program.gap.size(), Forces);
    }
    if (program.hasCompliance())
    {
        appendVector(text, "compliance", program.compliance.data(), program.compliance.size(), Forces);
    }
    return text;
}

template<int Rows, int Forces>
void writeProgram(const std::filesystem::path& file, const ConeProgram<Rows, Forces>& program)
{
    writeWholeFile(file, programText(program));
}

AnyConeProgram readProgram(const std::filesystem::path& file)
{
    const Dictionary dictionary = Dictionary::readFile(file);
    const int dimensions = dictionary.get<int>("dimensions");
    if (dimensions == 2)
    {
        return readProgramOf<3, 2>(dictionary);
    }
    if (dimensions == 3)
    {
        return readProgramOf<6, 3>(dictionary);
    }
    throw FatalIOError(fmt::format("dimensions {} is neither 2 nor 3.", dimensions),
                       dictionary.locationOf("dimensions"));
}

SolveObserver programWriter(WriteProgram when, std::function<std::filesystem::path()> file)
{
    if (when == WriteProgram::never)
    {
        return {};
    }
    return [when, file = std::move(file)](const auto& program, const ConeSolution& solution)
    {
        if (when == WriteProgram::always || solution.status == SolveStatus::notConverged)
        {
            writeProgram(file(), program);
        }
    };
}

template std::string programText(const PlaneConeProgram&);
template std::string programText(const SpaceConeProgram&);
template void writeProgram(const std::filesystem::path&, const PlaneConeProgram&);
template void writeProgram(const std::filesystem::path&, const SpaceConeProgram&);

} // namespace drystone
