// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Distributions of some values, numbers or words: a list, one with weights, samples in a file.
#include "core/Error.h"
#include "ensembles/DistributionTypes.h"
#include "quantities/TableFigure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>

namespace drystone
{
namespace
{

/// A number, or a word.
struct Choice
{
    SampleValue value;
};
void read(TokenCursor& cursor, Choice& choice)
{
    if (!cursor.atEnd() && cursor.peek().kind == TokenKind::number)
    {
        double number = 0;
        drystone::read(cursor, number);
        choice.value = valueOf(number);
        return;
    }
    if (!cursor.atEnd() && cursor.isNext('-'))
    {
        double number = 0;
        drystone::read(cursor, number);
        choice.value = valueOf(number);
        return;
    }
    std::string word;
    drystone::read(cursor, word);
    choice.value = valueOf(word);
}

/// Empty, or that one of the values stands for no number: a word as any other, which no entry takes.
std::string faultOf(const std::vector<Choice>& values)
{
    for (const std::string_view none : {"nan", "NaN", "inf", "Inf"})
    {
        const auto isNone = [none](const Choice& choice) { return choice.value.text == none; };
        if (std::any_of(values.begin(), values.end(), isNone))
        {
            return fmt::format("`{}` is not a finite number: give numbers that are, or words.", none);
        }
    }
    return values.empty() ? "The list is empty." : "";
}

/// Empty, or that some values are words and some are numbers, as where one of these is mistyped.
std::string doubtAbout(const std::vector<Choice>& values)
{
    const auto isWord = [](const Choice& choice) { return std::isnan(choice.value.number); };
    const auto word = std::find_if(values.begin(), values.end(), isWord);
    return word == values.end() || std::all_of(values.begin(), values.end(), isWord)
               ? ""
               : fmt::format("`{}` is a word among numbers: samples that have it fail where the entry takes "
                             "numbers alone. Usual are values of one kind.",
                             word->value.text);
}

std::string textOf(const Choice& choice)
{
    return choice.value.text;
}

struct ListSettings
{
    std::vector<Choice> values;
};
void declare(Options& options, ListSettings& settings)
{
    options.required("values", settings.values, "numbers or words, each as likely as the others")
        .example("(0.1 0.2 0.4)");
    options.check("values", [&settings] { return faultOf(settings.values); });
    options.question("values", [&settings] { return doubtAbout(settings.values); });
}

Distribution chosenFrom(const std::vector<Choice>& values, std::vector<double> weights)
{
    Distribution made;
    double sum = 0;
    for (const double weight : weights)
    {
        sum += weight;
    }
    double before = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        made.choices.push_back(values[i].value);
        before += weights[i];
        made.cumulative.push_back(i + 1 == values.size() ? 1 : before / sum);
    }
    made.summary = fmt::format("one of {} values", values.size());
    return made;
}

Distribution makeList(const ListSettings& settings)
{
    return chosenFrom(settings.values, std::vector<double>(settings.values.size(), 1));
}

struct DiscreteSettings
{
    std::vector<Choice> values;
    std::vector<double> weights;
};
void declare(Options& options, DiscreteSettings& settings)
{
    options.required("values", settings.values, "numbers or words").example("(0.5 0.6 0.7)");
    options.check("values", [&settings] { return faultOf(settings.values); });
    options.question("values", [&settings] { return doubtAbout(settings.values); });
    options.required("weights", settings.weights, "of the values; their sum does not matter")
        .above(0)
        .example("(1 2 1)");
    options.check("weights",
                  [&settings]() -> std::string
                  {
                      if (settings.values.size() == settings.weights.size() && !settings.values.empty())
                      {
                          return "";
                      }
                      return fmt::format("There are {} values and {} weights: give one for each.",
                                         settings.values.size(), settings.weights.size());
                  });
}
Distribution makeDiscrete(const DiscreteSettings& settings)
{
    return chosenFrom(settings.values, settings.weights);
}

struct TableSettings
{
    std::string file;
    std::string column;
};
void declare(Options& options, TableSettings& settings)
{
    options
        .required(
            "file", settings.file,
            "a table whose last comment line names the columns; one of its rows is as likely as another")
        .example("\"constant/measuredFriction.dat\"");
    options.required("column", settings.column, "name of the column, with or without its unit").example("mu");
}
Distribution makeTable(const TableSettings& settings, const Dictionary& dictionary)
{
    // system/ensembleDict is in the case directory that the file counts from.
    const std::filesystem::path caseDirectory =
        std::filesystem::path(dictionary.location().file).parent_path().parent_path();
    std::optional<std::vector<double>> column;
    try
    {
        column = readColumn(caseDirectory / settings.file, settings.column);
    }
    catch (const FatalError& error)
    {
        throw FatalIOError(error.what(), dictionary.locationOf("column"));
    }
    if (!column || column->empty())
    {
        throw FatalIOError(fmt::format("There is no table {} with numbers in this case.", settings.file),
                           dictionary.locationOf("file"));
    }
    std::vector<Choice> values;
    for (const double value : *column)
    {
        values.push_back({valueOf(value)});
    }
    return chosenFrom(values, std::vector<double>(values.size(), 1));
}

} // namespace

Model<Distribution> discreteDistribution()
{
    return model<Distribution, DiscreteSettings>("discrete", "some values with weights", makeDiscrete);
}

Model<Distribution> listDistribution()
{
    return model<Distribution, ListSettings>("list", "some values, numbers or words such as records",
                                             makeList);
}

Model<Distribution> tableDistribution()
{
    return model<Distribution, TableSettings>("table", "samples in a file", makeTable);
}

} // namespace drystone
