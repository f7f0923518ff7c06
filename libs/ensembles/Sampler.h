// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The values of the variables of an ensemble in each of its samples, by its design.
#pragma once

#include "ensembles/Design.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace drystone
{

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
    /// Values spread evenly over the variables' ranges, each by itself, that depend on neither the design nor
    /// the number of samples; of a table some of its rows.
    std::vector<std::vector<SampleValue>> spread(int count) const;

private:
    /// The two independent sets of points of a sensitivity analysis (Saltelli et al. 2010); others have A.
    enum class Matrix
    {
        a,
        b
    };

    void requireDistributions(const Dictionary& dictionary) const;
    void countSamples();
    void stratify();
    Eigen::Index variableOf(const std::string& wanted, const SourceLocation& place) const;
    void chooseFactor(const std::vector<Correlation>& correlations, const SourceLocation& place);
    void stratifyCorrelated();
    bool isUncorrelated(std::size_t variable) const;
    std::vector<double> point(long index, Matrix matrix = Matrix::a) const;
    std::vector<SampleValue> gridPoint(long sample) const;
    std::vector<SampleValue> valuesAt(const std::vector<double>& probabilities) const;
    void correlate(std::vector<double>& probabilities) const;

    std::vector<Named<EnsembleVariable>> variables;
    Design design;
    long count = 0;
    std::vector<std::vector<std::uint32_t>> strata; ///< of a Latin hypercube, a permutation a variable
    std::vector<long> levels;                       ///< of a grid, one a variable
    std::vector<std::vector<SampleValue>> rows;     ///< of a table
    Eigen::MatrixXd factor;                         ///< Cholesky factor of correlated normal variables
};

} // namespace drystone
