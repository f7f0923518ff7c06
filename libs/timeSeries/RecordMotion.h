// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Ground acceleration by an accelerogram from a file: the type `record`.
#pragma once

#include "dictionary/Options.h"
#include "timeSeries/DescribedAcceleration.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace drystone
{

/// How the file of a record is laid out.
enum class RecordFormat
{
    PEER_AT2,
    csv
};

/// Names in dictionaries.
constexpr std::array<std::pair<std::string_view, RecordFormat>, 2> namesOf(RecordFormat)
{
    return {{{"PEER_AT2", RecordFormat::PEER_AT2}, {"csv", RecordFormat::csv}}};
}

/// Name of a unit, which may hold a slash without quotes: `unit m/s2;`.
struct UnitName
{
    std::string text;
};
void read(TokenCursor& cursor, UnitName& name);

/// Settings of the acceleration type `record`. The record is read, freed of its baseline, scaled, padded and
/// moved in time, in this order.
struct RecordMotion
{
    std::string file; ///< absolute, or relative to the case directory
    RecordFormat format = RecordFormat::PEER_AT2;
    std::optional<UnitName> unit;             ///< absent: the file says it, or it is m/s2 of a csv file
    std::optional<Column> timeColumn;         ///< of a csv file; absent: the first
    std::optional<Column> accelerationColumn; ///< of a csv file; absent: the one after the times
    double timeStep = 0;                      ///< of a csv file without times [s]; 0: it has times
    Baseline baseline = Baseline::none;       ///< what is taken away
    double scale = 1;                         ///< factor
    std::optional<double> peakAcceleration;   ///< scale to this instead [m/s2]
    std::array<double, 2> padding{0, 0};      ///< stillness added before and after [s]
    double start = 0;                         ///< when the padded record begins [s]
    Interpolation interpolation = Interpolation::linear;
};
void declare(Options& options, RecordMotion& settings);

/// The acceleration of a record, zero outside it, and what the log says of it.
/// \throws FatalIOError as the readers; when the record is zero throughout and a peak is requested; when it
/// has too few values for its interpolation or baseline
DescribedAcceleration recordedAcceleration(const RecordMotion& record,
                                           const std::filesystem::path& caseDirectory);

} // namespace drystone
