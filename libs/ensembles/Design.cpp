// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The designs of ensembles.
#include "ensembles/Design.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

struct SampledSettings
{
    Design design;
};
void declare(Options& options, SampledSettings& settings)
{
    options.required("samples", settings.design.samples, "how many").atLeast(1).atMost(1e9).example("1000");
    options.optional("seed", settings.design.seed, "of the random numbers").atLeast(0);
    options.optional("sensitivity", settings.design.sensitivity,
                     "each sample is computed with its own values, with those of a second one, and with one "
                     "variable after the other from the second: variables + 2 runs, for the statistic "
                     "sensitivity");
}
struct GridSettings
{
    Design design;
};
void declare(Options& options, GridSettings& settings)
{
    options
        .optional("levels", settings.design.levels,
                  "values of a variable without a list: the middles of parts of equal probability")
        .atLeast(1)
        .atMost(100000);
    options.optional("repeats", settings.design.repeats, "samples a point, for variables that are seeds")
        .atLeast(1)
        .atMost(1000000);
    options.optional("seed", settings.design.seed, "of variables that are seeds").atLeast(0);
}
struct DesignTableSettings
{
    Design design;
};
void declare(Options& options, DesignTableSettings& settings)
{
    options
        .required(
            "file", settings.design.file,
            "a row a sample, with blanks, commas or semicolons between its values; the last comment line, or "
            "without one the first line, names the columns, those of the variables among them")
        .example("\"constant/samples.dat\"");
}

/// \param type that the settings are of
template<class Settings>
Model<Design> designModel(const std::string& name, const std::string& summary, DesignType type)
{
    return model<Design, Settings>(name, summary,
                                   [type](const Settings& settings, const Dictionary& dictionary)
                                   {
                                       Design design = settings.design;
                                       design.type = type;
                                       design.location = dictionary.location();
                                       return design;
                                   });
}

} // namespace

const Registry<Design>& designTypes()
{
    static const Registry<Design> registry{
        "design",
        {designModel<SampledSettings>("random", "independent samples; more of them extend the earlier ones",
                                      DesignType::random),
         designModel<SampledSettings>(
             "latinHypercube", "of as many equal parts of each variable as there are samples, each once",
             DesignType::latinHypercube),
         designModel<SampledSettings>(
             "sobol", "a Sobol' sequence with a random shift; more samples extend the earlier ones",
             DesignType::sobol),
         designModel<GridSettings>("grid", "all combinations of the values of all variables, the last first",
                                   DesignType::grid),
         designModel<DesignTableSettings>("table", "the samples of a file", DesignType::table)}};
    return registry;
}

void declare(Options& options, EnsembleVariable& variable)
{
    declare(options, variable.place);
    options.optional("distribution", variable.distribution, distributionTypes(),
                     "of its values; not needed where the design is a table");
}

void read(TokenCursor& cursor, Correlation& correlation)
{
    cursor.expect('(', "`(`");
    read(cursor, correlation.one);
    read(cursor, correlation.other);
    read(cursor, correlation.value);
    cursor.expect(')', "`)`");
}

} // namespace drystone
