// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The designs of ensembles.
#include "ensembles/Design.h"

#include "ensembles/Philox.h"
#include "quantities/TableFigure.h"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

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
            "a row a sample; the last comment line names the columns, those of the variables among them")
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

/// Primitive polynomials and first direction numbers (Joe and Kuo, new-joe-kuo-6, dimensions 2 to 21).
struct SobolDimension
{
    int degree;
    std::uint32_t polynomial; ///< inner coefficients
    std::array<std::uint32_t, 7> first;
};
constexpr std::array<SobolDimension, sobolDimensions - 1> sobolTable{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
}};

using DirectionNumbers = std::array<std::uint32_t, 32>;

std::array<DirectionNumbers, sobolDimensions> makeDirections()
{
    std::array<DirectionNumbers, sobolDimensions> all{};
    for (int bit = 0; bit < 32; ++bit)
    {
        all[0][static_cast<std::size_t>(bit)] = 1u << (31 - bit);
    }
    for (std::size_t dimension = 1; dimension < sobolDimensions; ++dimension)
    {
        const SobolDimension& made = sobolTable[dimension - 1];
        const auto degree = static_cast<std::size_t>(made.degree);
        DirectionNumbers& numbers = all[dimension];
        for (std::size_t bit = 0; bit < 32; ++bit)
        {
            if (bit < degree)
            {
                numbers[bit] = made.first[bit] << (31 - bit);
                continue;
            }
            numbers[bit] = numbers[bit - degree] ^ (numbers[bit - degree] >> made.degree);
            for (std::size_t k = 1; k < degree; ++k)
            {
                if ((made.polynomial >> (degree - 1 - k)) & 1u)
                {
                    numbers[bit] ^= numbers[bit - k];
                }
            }
        }
    }
    return all;
}

/// Coefficients of a function of a standard normal variable in normalised Hermite polynomials.
std::vector<double> hermiteCoefficients(const Distribution& distribution)
{
    // The trapezium rule converges faster than any power for a smooth function times the normal density.
    constexpr int points = 4001;
    constexpr double end = 8.2;
    constexpr std::size_t terms = 60;
    std::vector<double> coefficients(terms, 0.0);
    const double step = 2 * end / (points - 1);
    for (int i = 0; i < points; ++i)
    {
        const double z = -end + step * i;
        const double probability = std::clamp(normalProbability(z), 1e-16, 1 - 0x1p-53);
        const double weight = step * std::exp(-z * z / 2) / std::sqrt(2 * M_PI);
        const double value = weight * valueAt(distribution, probability).number;
        double before = 0;
        double polynomial = 1; // h(n+1) sqrt(n+1) = z h(n) - sqrt(n) h(n-1)
        for (std::size_t n = 0; n < terms; ++n)
        {
            coefficients[n] += value * polynomial;
            const double next = (z * polynomial - std::sqrt(static_cast<double>(n)) * before)
                                / std::sqrt(static_cast<double>(n + 1));
            before = polynomial;
            polynomial = next;
        }
    }
    return coefficients;
}

bool hasNumbers(const Distribution& distribution)
{
    return !distribution.isSeed
           && std::none_of(distribution.choices.begin(), distribution.choices.end(),
                           [](const SampleValue& choice) { return std::isnan(choice.number); });
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

std::uint32_t sobolBits(std::uint32_t index, int dimension)
{
    static const auto directions = makeDirections();
    std::uint32_t bits = 0;
    for (std::size_t bit = 0; index != 0; ++bit, index >>= 1)
    {
        if (index & 1u)
        {
            bits ^= directions[static_cast<std::size_t>(dimension)][bit];
        }
    }
    return bits;
}

std::optional<double> natafCorrelation(const Distribution& first, const Distribution& second, double wanted)
{
    const std::vector<double> a = hermiteCoefficients(first);
    const std::vector<double> b = hermiteCoefficients(second);
    double varianceA = 0;
    double varianceB = 0;
    for (std::size_t n = 1; n < a.size(); ++n)
    {
        varianceA += a[n] * a[n];
        varianceB += b[n] * b[n];
    }
    // Mehler's formula: the correlation is a power series of that of the normal variables.
    const auto correlation = [&](double rho)
    {
        double sum = 0;
        double power = 1;
        for (std::size_t n = 1; n < a.size(); ++n)
        {
            power *= rho;
            sum += a[n] * b[n] * power;
        }
        return sum / std::sqrt(varianceA * varianceB);
    };
    double low = -0.9999;
    double high = 0.9999;
    if (!(correlation(low) <= wanted && wanted <= correlation(high)))
    {
        return {};
    }
    while (high - low > 1e-13)
    {
        const double middle = (low + high) / 2;
        (correlation(middle) > wanted ? high : low) = middle;
    }
    return (low + high) / 2;
}

Sampler::Sampler(const std::vector<Named<EnsembleVariable>>& allVariables,
                 const std::vector<Correlation>& correlations, const Design& wantedDesign,
                 const Dictionary& dictionary, const std::filesystem::path& caseDirectory)
    : variables(allVariables), design(wantedDesign)
{
    const auto size = static_cast<long>(variables.size());
    if (design.type == DesignType::table)
    {
        readTable(dictionary, caseDirectory);
    }
    else
    {
        for (const auto& [name, variable] : variables)
        {
            if (!variable.distribution)
            {
                throw FatalIOError(fmt::format("The variable {} has no distribution: give one. Only with "
                                               "`design {{ type table; }}` does it need none.",
                                               name),
                                   dictionary.subDict("variables").locationOf(name));
            }
        }
    }
    switch (design.type)
    {
    case DesignType::table:
        count = static_cast<long>(rows.size());
        break;
    case DesignType::grid:
        count = design.repeats;
        for (const auto& [name, variable] : variables)
        {
            const Distribution& distribution = *variable.distribution;
            levels.push_back(distribution.isSeed            ? 1
                             : distribution.choices.empty() ? design.levels
                                                            : static_cast<long>(distribution.choices.size()));
            count *= levels.back();
            if (count > 1000000000)
            {
                throw FatalIOError("The grid has more than a thousand million points: take fewer levels.",
                                   design.location);
            }
        }
        break;
    case DesignType::random:
    case DesignType::latinHypercube:
    case DesignType::sobol:
        count = design.samples * (design.sensitivity ? size + 2 : 1);
        break;
    }
    const long dimensions = design.sensitivity ? 2 * size : size;
    if (design.type == DesignType::sobol && dimensions > sobolDimensions)
    {
        throw FatalIOError(fmt::format("The Sobol' sequence has {} dimensions here, and {} are needed{}: "
                                       "take `type latinHypercube;` or `type random;`.",
                                       sobolDimensions, dimensions,
                                       design.sensitivity ? ", two a variable" : ", one a variable"),
                           design.location);
    }
    if (design.type == DesignType::latinHypercube)
    {
        for (long k = 0; k < dimensions; ++k)
        {
            strata.push_back(permutation(static_cast<std::uint64_t>(design.seed),
                                         static_cast<std::uint32_t>(k),
                                         static_cast<std::uint32_t>(design.samples)));
        }
    }
    if (correlations.empty())
    {
        return;
    }
    const SourceLocation place = dictionary.locationOf("correlations");
    if (design.type == DesignType::grid || design.type == DesignType::table || design.sensitivity)
    {
        throw FatalIOError(
            "Correlations are for samples that are drawn, without sensitivity: remove them, or "
            "take `type random;`, latinHypercube or sobol.",
            place);
    }
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
    const auto indexOf = [&](const std::string& wanted)
    {
        std::vector<std::string> names;
        for (const auto& [name, variable] : variables)
        {
            names.push_back(name);
        }
        const auto found = std::find(names.begin(), names.end(), wanted);
        if (found == names.end())
        {
            throw FatalIOError(unknownWordMessage("variable", wanted, names), place);
        }
        return found - names.begin();
    };
    for (const Correlation& correlation : correlations)
    {
        const auto i = indexOf(correlation.one);
        const auto j = indexOf(correlation.other);
        const Distribution& one = *variables[static_cast<std::size_t>(i)].second.distribution;
        const Distribution& other = *variables[static_cast<std::size_t>(j)].second.distribution;
        if (i == j || !hasNumbers(one) || !hasNumbers(other))
        {
            throw FatalIOError(fmt::format("{} and {} cannot be correlated: two different variables with "
                                           "numbers can.",
                                           correlation.one, correlation.other),
                               place);
        }
        const std::optional<double> rho = natafCorrelation(one, other, correlation.value);
        if (!rho)
        {
            throw FatalIOError(fmt::format("With these distributions {} and {} cannot have the correlation "
                                           "{:g}: give one nearer to 0.",
                                           correlation.one, correlation.other, correlation.value),
                               place);
        }
        matrix(i, j) = matrix(j, i) = *rho;
    }
    const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
    if (cholesky.info() != Eigen::Success)
    {
        throw FatalIOError("No variables have all these correlations at once: their matrix is not positive "
                           "definite.",
                           place);
    }
    factor = cholesky.matrixL();
}

void Sampler::readTable(const Dictionary&, const std::filesystem::path& caseDirectory)
{
    const std::filesystem::path file = caseDirectory / design.file;
    std::ifstream stream(file);
    if (!stream)
    {
        throw FatalIOError(fmt::format("There is no table {} in this case.", design.file), design.location);
    }
    std::vector<std::string> columns;
    std::vector<std::size_t> places;
    int number = 0;
    for (std::string line; std::getline(stream, line);)
    {
        ++number;
        std::istringstream words(line.starts_with("#") ? line.substr(1) : line);
        std::vector<std::string> cells;
        for (std::string word; words >> word;)
        {
            cells.push_back(word);
        }
        if (line.starts_with("#"))
        {
            if (places.empty()) // comments between rows are no headings
            {
                columns = cells;
            }
            continue;
        }
        if (cells.empty())
        {
            continue;
        }
        if (places.empty())
        {
            for (const auto& [name, variable] : variables)
            {
                const auto found = std::find_if(columns.begin(), columns.end(),
                                                [&wanted = name](const std::string& column)
                                                { return isColumn(column, wanted); });
                if (found == columns.end())
                {
                    throw FatalIOError(fmt::format("{} has no column {}.\n\nIts columns: {}", design.file,
                                                   name, fmt::join(columns, " ")),
                                       design.location);
                }
                places.push_back(static_cast<std::size_t>(found - columns.begin()));
            }
        }
        if (cells.size() != columns.size())
        {
            throw FatalIOError(
                fmt::format("A row has {} values, and there are {} columns.", cells.size(), columns.size()),
                {file.string(), "", number});
        }
        std::vector<SampleValue> row;
        for (const std::size_t place : places)
        {
            char* end = nullptr;
            const double value = std::strtod(cells[place].c_str(), &end);
            row.push_back(*end == 0 ? SampleValue{cells[place], value} : valueOf(cells[place]));
        }
        rows.push_back(std::move(row));
    }
    if (rows.empty())
    {
        throw FatalIOError(fmt::format("The table {} has no rows.", design.file), design.location);
    }
}

std::vector<double> Sampler::point(long index, bool isSecond) const
{
    const std::size_t size = variables.size();
    std::vector<double> probabilities(size);
    for (std::size_t k = 0; k < size; ++k)
    {
        const auto dimension = static_cast<std::uint32_t>(isSecond ? size + k : k);
        const auto number = static_cast<std::uint64_t>(index);
        const auto seed = static_cast<std::uint64_t>(design.seed);
        switch (design.type)
        {
        case DesignType::random:
            probabilities[k] = uniform(seed, Stream::sample, dimension, number);
            break;
        case DesignType::latinHypercube:
            probabilities[k] = (strata[dimension][static_cast<std::size_t>(index)]
                                + uniform(seed, Stream::sample, dimension, number))
                               / static_cast<double>(design.samples);
            break;
        case DesignType::sobol:
        {
            const auto shift = static_cast<std::uint32_t>(randomBits(seed, Stream::shift, dimension, 0));
            const std::uint32_t bits =
                sobolBits(static_cast<std::uint32_t>(index), static_cast<int>(dimension)) ^ shift;
            probabilities[k] = (bits + 0.5) * 0x1p-32;
            break;
        }
        case DesignType::grid:
        case DesignType::table:
            break;
        }
        probabilities[k] = std::clamp(probabilities[k], 0x1p-60, 1 - 0x1p-53);
    }
    return probabilities;
}

void Sampler::correlate(std::vector<double>& probabilities) const
{
    Eigen::VectorXd normal(static_cast<Eigen::Index>(probabilities.size()));
    for (Eigen::Index k = 0; k < normal.size(); ++k)
    {
        normal[k] = normalQuantile(probabilities[static_cast<std::size_t>(k)]);
    }
    for (Eigen::Index k = 0; k < normal.size(); ++k)
    {
        // Variables without correlations keep their probabilities to the last bit.
        if (factor.row(k).head(k).isZero(0))
        {
            continue;
        }
        const double value = factor.row(k).head(k + 1).dot(normal.head(k + 1));
        probabilities[static_cast<std::size_t>(k)] =
            std::clamp(normalProbability(value), 0x1p-60, 1 - 0x1p-53);
    }
}

std::vector<SampleValue> Sampler::gridPoint(long sample) const
{
    std::vector<SampleValue> values(variables.size());
    long rest = sample / design.repeats;
    for (std::size_t k = variables.size(); k-- > 0;)
    {
        const Distribution& distribution = *variables[k].second.distribution;
        const long level = rest % levels[k];
        rest /= levels[k];
        if (!distribution.choices.empty())
        {
            values[k] = distribution.choices[static_cast<std::size_t>(level)];
        }
        else if (distribution.isSeed)
        {
            const std::uint64_t bits =
                randomBits(static_cast<std::uint64_t>(design.seed), Stream::seed,
                           static_cast<std::uint32_t>(k), static_cast<std::uint64_t>(sample));
            values[k] = valueOf(static_cast<double>(1 + bits % 2147483647u));
        }
        else
        {
            values[k] =
                valueAt(distribution, (static_cast<double>(level) + 0.5) / static_cast<double>(levels[k]));
        }
    }
    return values;
}

std::vector<SampleValue> Sampler::at(long sample) const
{
    if (design.type == DesignType::table)
    {
        return rows[static_cast<std::size_t>(sample)];
    }
    if (design.type == DesignType::grid)
    {
        return gridPoint(sample);
    }
    std::vector<double> probabilities;
    if (design.sensitivity)
    {
        // Saltelli et al. 2010: A, B, and A with one variable after the other from B.
        const auto runs = static_cast<long>(variables.size()) + 2;
        const long role = sample % runs;
        probabilities = point(sample / runs, role == 1);
        if (role > 1)
        {
            const auto k = static_cast<std::size_t>(role - 2);
            probabilities[k] = point(sample / runs, true)[k];
        }
    }
    else
    {
        probabilities = point(sample, false);
    }
    if (factor.size() > 0)
    {
        correlate(probabilities);
    }
    std::vector<SampleValue> values;
    for (std::size_t k = 0; k < variables.size(); ++k)
    {
        const Distribution& distribution = *variables[k].second.distribution;
        values.push_back(distribution.isSeed ? valueOf(1 + std::floor(probabilities[k] * 2147483647))
                                             : valueAt(distribution, probabilities[k]));
    }
    return values;
}

} // namespace drystone
