// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What accuracyCost compares a figure with: `reference { type ...; }`.
#pragma once

#include "dictionary/Registry.h"
#include "ensembles/RunSettings.h"

#include <cmath>
#include <string>

namespace drystone
{

/// The value that a figure is compared with.
struct Reference
{
    double value = 0;
    double uncertainty = 0; ///< estimated error of the reference itself
    std::string text;       ///< where it comes from, for the page
};

/// The error of a reference itself, relative to it.
inline double relativeUncertainty(const Reference& reference)
{
    return reference.uncertainty / std::abs(reference.value);
}

/// The contents of `reference { type ...; }`.
struct ReferencePlan : RunSettingsOf<PerhapsOneOf> ///< of the finest run; absent: the value of the case
{
    enum class Kind
    {
        Housner,
        value,
        finest
    };
    Kind kind = Kind::finest;
    double value = 0;
    std::string source;
    int phases = 20;
    SourceLocation location;
};
const Registry<ReferencePlan>& referenceTypes();

} // namespace drystone
