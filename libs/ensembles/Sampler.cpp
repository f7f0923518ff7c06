// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Probabilities from random bits, strata or Sobol' points, correlated through a Cholesky factor.
#include "ensembles/Sampler.h"

#include "dictionary/NamesIn.h"
#include "ensembles/NatafCorrelation.h"
#include "ensembles/Philox.h"
#include "ensembles/SampleTable.h"
#include "ensembles/SobolSequence.h"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace drystone
{
namespace
{

/// Whether it has numbers, and not always the same one.
bool varies(const Distribution& distribution)
{
    const std::vector<SampleValue>& choices = distribution.choices;
    return !distribution.isSeed
           && std::none_of(choices.begin(), choices.end(),
                           [](const SampleValue& choice) { return std::isnan(choice.number); })
           && (choices.empty()
               || std::any_of(choices.begin(), choices.end(),
                              [&](const SampleValue& choice)
                              { return choice.number != choices.front().number; }));
}

/// The correlation that two normal variables must have, so that the variables have the one that the user
/// states.
double correlationOfNormals(const Correlation& correlation, const Distribution& one,
                            const Distribution& other, const SourceLocation& place)
{
    const std::optional<double> rho = natafCorrelation(one, other, correlation.value);
    if (!rho)
    {
        throw FatalIOError(fmt::format("With these distributions {} and {} cannot have the correlation "
                                       "{:g}: give one nearer to 0.",
                                       correlation.one, correlation.other, correlation.value),
                           place);
    }
    return *rho;
}

} // namespace

Sampler::Sampler(const std::vector<Named<EnsembleVariable>>& allVariables,
                 const std::vector<Correlation>& correlations, const Design& wantedDesign,
                 const Dictionary& dictionary, const std::filesystem::path& caseDirectory)
    : variables(allVariables), design(wantedDesign)
{
    if (design.type == DesignType::table)
    {
        rows = readSampleTable(design, variables, caseDirectory);
    }
    else
    {
        requireDistributions(dictionary);
    }
    countSamples();
    stratify();
    if (!correlations.empty())
    {
        chooseFactor(correlations, dictionary.locationOf("correlations"));
        stratifyCorrelated();
    }
}

void Sampler::requireDistributions(const Dictionary& dictionary) const
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

void Sampler::countSamples()
{
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
        count = design.samples * (design.sensitivity ? static_cast<long>(variables.size()) + 2 : 1);
        break;
    }
}

/// The permutations of a Latin hypercube; the others have none.
void Sampler::stratify()
{
    const auto size = static_cast<long>(variables.size());
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
}

/// The parts of correlated variables: in each sample that which has the place of its correlated value among
/// those of all samples, so that each part is taken once (Iman & Conover 1982).
void Sampler::stratifyCorrelated()
{
    if (design.type != DesignType::latinHypercube)
    {
        return;
    }
    std::vector<std::vector<double>> correlated;
    for (long sample = 0; sample < design.samples; ++sample)
    {
        correlated.push_back(point(sample));
        correlate(correlated.back());
    }
    std::vector<std::uint32_t> order(correlated.size());
    for (std::size_t k = 0; k < variables.size(); ++k)
    {
        if (isUncorrelated(k))
        {
            continue;
        }
        std::iota(order.begin(), order.end(), 0);
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t a, std::uint32_t b)
                  { return std::pair(correlated[a][k], a) < std::pair(correlated[b][k], b); });
        for (std::uint32_t place = 0; place < order.size(); ++place)
        {
            strata[k][order[place]] = place;
        }
    }
}

/// Whether a variable keeps its probabilities to the last bit.
bool Sampler::isUncorrelated(std::size_t variable) const
{
    const auto k = static_cast<Eigen::Index>(variable);
    return factor.row(k).head(k).isZero(0);
}

/// The index of a variable by its name.
Eigen::Index Sampler::variableOf(const std::string& wanted, const SourceLocation& place) const
{
    const std::vector<std::string> names = namesIn(variables);
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end())
    {
        throw FatalIOError(unknownWordMessage("variable", wanted, names), place);
    }
    return found - names.begin();
}

/// The Cholesky factor of the correlations that the normal variables must have (Nataf's model), so that the
/// variables have those that the user states.
void Sampler::chooseFactor(const std::vector<Correlation>& correlations, const SourceLocation& place)
{
    const auto size = static_cast<Eigen::Index>(variables.size());
    if (design.type == DesignType::grid || design.type == DesignType::table || design.sensitivity)
    {
        throw FatalIOError(
            "Correlations are for samples that are drawn, without sensitivity: remove them, or "
            "take `type random;`, latinHypercube or sobol.",
            place);
    }
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
    std::set<std::pair<Eigen::Index, Eigen::Index>> pairs;
    for (const Correlation& correlation : correlations)
    {
        const Eigen::Index i = variableOf(correlation.one, place);
        const Eigen::Index j = variableOf(correlation.other, place);
        const Distribution& one = *variables[static_cast<std::size_t>(i)].second.distribution;
        const Distribution& other = *variables[static_cast<std::size_t>(j)].second.distribution;
        if (i == j || !varies(one) || !varies(other))
        {
            throw FatalIOError(fmt::format("{} and {} cannot be correlated: two different variables with "
                                           "numbers, more than one each, can.",
                                           correlation.one, correlation.other),
                               place);
        }
        if (!pairs.insert(std::minmax(i, j)).second)
        {
            throw FatalIOError(fmt::format("There are two correlations of {} and {}: remove one.",
                                           correlation.one, correlation.other),
                               place);
        }
        matrix(i, j) = matrix(j, i) = correlationOfNormals(correlation, one, other, place);
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

/// The probabilities of a point, one a variable, before they are correlated. \param index of the point, not
/// of the sample
std::vector<double> Sampler::point(long index, Matrix matrix) const
{
    const std::size_t size = variables.size();
    std::vector<double> probabilities(size);
    for (std::size_t k = 0; k < size; ++k)
    {
        const auto dimension = static_cast<std::uint32_t>(matrix == Matrix::b ? size + k : k);
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
        if (isUncorrelated(static_cast<std::size_t>(k)))
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
        // A, B, and A with one variable after the other from B.
        const auto runs = static_cast<long>(variables.size()) + 2;
        const long role = sample % runs;
        probabilities = point(sample / runs, role == 1 ? Matrix::b : Matrix::a);
        if (role > 1)
        {
            const auto k = static_cast<std::size_t>(role - 2);
            probabilities[k] = point(sample / runs, Matrix::b)[k];
        }
    }
    else
    {
        probabilities = point(sample);
    }
    if (factor.size() > 0 && design.type != DesignType::latinHypercube) // whose parts are correlated
    {
        correlate(probabilities);
    }
    return valuesAt(probabilities);
}

std::vector<SampleValue> Sampler::valuesAt(const std::vector<double>& probabilities) const
{
    std::vector<SampleValue> values;
    for (std::size_t k = 0; k < variables.size(); ++k)
    {
        const Distribution& distribution = *variables[k].second.distribution;
        values.push_back(distribution.isSeed ? valueOf(1 + std::floor(probabilities[k] * 2147483647))
                                             : valueAt(distribution, probabilities[k]));
    }
    return values;
}

/// The first variable in equal parts, the others by multiples of an irrational number each: powers of the
/// root of x^(d+1) = x + 1 (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
std::vector<std::vector<SampleValue>> Sampler::spread(int number) const
{
    std::vector<std::vector<SampleValue>> values;
    double root = 1;
    for (int pass = 0; pass < 50; ++pass)
    {
        root = std::pow(1 + root, 1.0 / static_cast<double>(variables.size()));
    }
    for (int index = 0; index < number; ++index)
    {
        const double part = (index + 0.5) / number;
        if (design.type == DesignType::table)
        {
            values.push_back(rows[static_cast<std::size_t>(part * static_cast<double>(rows.size()))]);
            continue;
        }
        std::vector<double> probabilities{part};
        for (double step = 1 / root; probabilities.size() < variables.size(); step /= root)
        {
            probabilities.push_back(std::fmod(0.5 + index * step, 1.0));
        }
        values.push_back(valuesAt(probabilities));
    }
    return values;
}

} // namespace drystone
