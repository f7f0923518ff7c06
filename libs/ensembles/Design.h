// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which values the variables of an ensemble take in each sample: `design` of system/ensembleDict.
///
///     design { type random;         samples 1000; seed 1; }     // each sample by itself
///     design { type latinHypercube; samples 1000; seed 1; }     // each variable from 1000 equal parts
///     design { type sobol;          samples 1024; seed 1; }     // spread evenly over all variables
///     design { type grid; levels 5; }                           // all combinations
///     design { type table; file "constant/samples.dat"; }
#pragma once

#include "dictionary/Registry.h"
#include "ensembles/CaseEntry.h"
#include "ensembles/Distribution.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

enum class DesignType
{
    random,
    latinHypercube,
    sobol,
    grid,
    table
};

/// The contents of `design`.
struct Design
{
    DesignType type = DesignType::random;
    long samples = 0;         ///< of random, latinHypercube and sobol
    long seed = 1;            ///< of all that is random
    bool sensitivity = false; ///< each sample becomes variables + 2 ones, for Sobol' indices
    int levels = 5;           ///< of a grid: values of a variable that has no list
    int repeats = 1;          ///< of a grid: samples a point
    std::string file;         ///< of a table
    SourceLocation location;
};
const Registry<Design>& designTypes();

/// An entry that is uncertain.
struct EnsembleVariable
{
    CaseEntry place;
    std::optional<Distribution> distribution; ///< needed unless the design is a table
};
void declare(Options& options, EnsembleVariable& variable);

/// `(mu unit 0.3)`: linear correlation of two variables.
struct Correlation
{
    std::string one;
    std::string other;
    double value = 0;
};
void read(TokenCursor& cursor, Correlation& correlation);

/// The values of all samples, each a function of its number alone.
class Sampler
{
public:
    /// \param dictionary system/ensembleDict, for the location in messages
    /// \param caseDirectory that the file of a table counts from
    /// \throws FatalIOError for a correlation that is impossible or of variables without numbers, a table
    /// without a column for each variable, a Sobol' sequence of too many variables
    Sampler(const std::vector<Named<EnsembleVariable>>& variables,
            const std::vector<Correlation>& correlations, const Design& design, const Dictionary& dictionary,
            const std::filesystem::path& caseDirectory);

    long size() const { return count; } ///< samples
    /// The value of each variable. \param sample 0 to size() - 1
    std::vector<SampleValue> at(long sample) const;

private:
    void readTable(const Dictionary& dictionary, const std::filesystem::path& caseDirectory);
    std::vector<double> point(long index, bool isSecond) const;
    std::vector<SampleValue> gridPoint(long sample) const;
    void correlate(std::vector<double>& probabilities) const;

    std::vector<Named<EnsembleVariable>> variables;
    Design design;
    long count = 0;
    std::vector<std::vector<std::uint32_t>> strata; ///< of a Latin hypercube, a permutation a variable
    std::vector<long> levels;                       ///< of a grid, one a variable
    std::vector<std::vector<SampleValue>> rows;     ///< of a table
    Eigen::MatrixXd factor;                         ///< Cholesky factor of correlated normal variables
};

/// A point of the Sobol' sequence (direction numbers of Joe and Kuo 2008), 32 bits.
/// \param dimension 0 to sobolDimensions - 1
std::uint32_t sobolBits(std::uint32_t index, int dimension);
inline constexpr int sobolDimensions = 21;

/// Correlation of two standard normal variables for which two others, functions of them, are correlated by
/// `wanted` (Nataf 1962; Liu and Der Kiureghian 1986). \return nothing where no correlation is enough
std::optional<double> natafCorrelation(const Distribution& first, const Distribution& second, double wanted);

} // namespace drystone
