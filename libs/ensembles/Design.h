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

#include <optional>
#include <string>

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

} // namespace drystone
