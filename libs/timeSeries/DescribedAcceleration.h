// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a type of ground acceleration makes: a history and what the log says of it.
#pragma once

#include "timeSeries/GroundAcceleration.h"

#include <memory>
#include <string>

namespace drystone
{

/// A history, and what it is.
struct DescribedAcceleration
{
    std::shared_ptr<const GroundAcceleration> acceleration;
    std::string summary;        ///< for the log: a line a property, each beginning with four blanks
    double valueUnit = 0;       ///< of the values in the file of a record [m/s2]; 0 of other types
    bool unitIsAssumed = false; ///< neither the file of a record nor its settings say it
};

/// Of pulses that make small blocks rock; the largest that earthquakes were measured with [m/s2].
inline constexpr double strongestGround = 40;

/// The first line of a summary.
std::string typeLine(const std::string& type);

} // namespace drystone
