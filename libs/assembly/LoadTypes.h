// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the types of loads share with the reading of constant/loads.
#pragma once

#include "assembly/Loads.h"
#include "geometry/PointText.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace drystone
{

/// `(0 -1000 0)`, in space `(0 0 -1000)`.
template<int Dim>
std::string downwards(std::string_view size)
{
    return Dim == 2 ? fmt::format("(0 -{} 0)", size) : fmt::format("(0 0 -{})", size);
}

/// What is wrong with the value of a force; empty: nothing.
template<int Dim>
std::string faultOfForce(const Vector<Dim>& value)
{
    if (value.isZero(0))
    {
        return fmt::format("A force cannot be (0 0 0). Write for instance `value {};`.",
                           downwards<Dim>("1000"));
    }
    return std::isnormal(value.squaredNorm())
               ? ""
               : fmt::format("A force of {:.6g} N cannot be computed with. Write for instance `value {};`.",
                             value.stableNorm(), downwards<Dim>("1000"));
}

/// `type supportMovement;`
template<int Dim>
struct SupportMovementSettings
{
    std::string support;
    Vector<Dim> direction = -Vector<Dim>::Unit(Dim - 1);
};

template<int Dim>
void declare(Options& options, SupportMovementSettings<Dim>& settings);

/// The loads that can be part of others: of a sum, of combined cases.
template<int Dim>
const Registry<LoadMaker<Dim>>& singleLoadTypes();

/// Refuses loads of `cases` and of sums, anywhere in constant/loads, that can only be the live load.
/// \throws FatalIOError
template<int Dim>
void requireParts(const Dictionary& loads);

} // namespace drystone
