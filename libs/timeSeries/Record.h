// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Accelerograms measured by instruments: reading them, repairing them, and the figures by which they are
/// known.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace drystone
{

/// The acceleration called "1 g" in a record [m/s2]. It is the unit of measure (ISO 80000-3), not the gravity
/// of a case, which is in constant/g.
inline constexpr double standardGravity = 9.80665;

/// An acceleration history at given instants. Between two instants it is understood to be linear.
struct Record
{
    std::filesystem::path file;        ///< where it was read
    std::string title;                 ///< what the file says of itself: event, station, component
    std::string unit;                  ///< of the values in the file, one of accelerationUnits
    bool unitIsAssumed = false;        ///< neither the file nor the user says it
    bool unitIsQuestioned = false;     ///< which was warned of, for the title of the column may say another
    std::vector<double> times;         ///< strictly increasing [s]
    std::vector<double> accelerations; ///< one a time [m/s2]
};

/// Those of the values in a record.
inline constexpr std::string_view accelerationUnits = "g, m/s2, cm/s2, gal, mm/s2, ft/s2 or in/s2";

/// How many [m/s2] one of this unit is. Knows accelerationUnits in any case and in the spellings that headers
/// use: `CM/SEC/SEC`, `cm/s^2`, `M/SEC**2`, `GALS`, ... \return 0 when the unit is not known, or is not one
/// of acceleration
double accelerationUnit(const std::string& unit);

/// Read a file in the AT2 format of the PEER strong motion database, old or new. The header is everything up
/// to the line that gives NPTS and DT, as `NPTS= 4000, DT= .01000 SEC` or `4000 0.0100 NPTS, DT`; the unit is
/// looked for in the header. The values follow in rows of any length. Line ends may be LF, CR LF, CR CR LF or
/// CR. \param unit  as declared by the user; empty: the header must say it. Where both are given they must
/// agree. \throws FatalIOError with file and line: unreadable or binary file, no NPTS or DT, either not
/// positive, a token that
///         is not a number, a number that is not finite, fewer or more values than NPTS, unit unknown or
///         contradictory
Record readPeerRecord(const std::filesystem::path& file, const std::string& unit = "");

/// Where the numbers of a table of text are: a column's position, counted from 0, or its title in the first
/// row.
using Column = std::variant<int, std::string>;

/// What to read from a CSV file.
struct CsvLayout
{
    Column timeColumn = 0;
    std::optional<Column> accelerationColumn = {}; ///< none: the second one, with `timeStep` the only one
    /// Interval of equally spaced values, for a file without a column of times [s]; 0: times are in
    /// `timeColumn`, in the unit of its title, as in `time [ms]`, else in seconds
    double timeStep = 0;
    std::string unit; ///< empty: that of the column's title, as in `acceleration [g]`, else m/s2
};

/// Read columns separated by commas, semicolons, tabs or blanks. Lines that begin with # or % and empty lines
/// are skipped; a first row that is not numeric gives the titles. With semicolons, numbers may have a decimal
/// comma. \throws FatalIOError as readPeerRecord, and when a column is missing or times do not increase
Record readCsvRecord(const std::filesystem::path& file, const CsvLayout& layout);

/// The acceleration at a time, linear between the instants and zero outside the record [m/s2].
double acceleration(const Record& record, double time);

/// Multiply all accelerations by a factor.
Record scaled(Record record, double factor);

/// Multiply all accelerations so that the largest absolute value is this one [m/s2].
/// \throws std::domain_error when the record is zero throughout
Record scaledToPeak(Record record, double peak);

/// Stillness before and after [s]. The record then begins at its old first time, with zeros; a first or last
/// value other than zero is reached over one time step, which is added to the stillness.
Record padded(const Record& record, double before, double after);

/// The record at equal intervals, from its first time to the last interval that fits [s].
Record resampled(const Record& record, double timeStep);

/// Shape of the drift that an instrument adds to the acceleration.
enum class Baseline
{
    none,
    constant,
    linear,
    quadratic
};

/// Names in dictionaries.
constexpr std::array<std::pair<std::string_view, Baseline>, 4> namesOf(Baseline)
{
    return {{{"none", Baseline::none},
             {"constant", Baseline::constant},
             {"linear", Baseline::linear},
             {"quadratic", Baseline::quadratic}}};
}

/// Take away the polynomial in time that fits the accelerations best (least squares).
/// \throws std::domain_error when the record has fewer values than the polynomial has coefficients
Record baselineCorrected(Record record, Baseline baseline);

/// The figures by which a record is known. All are of the piecewise linear motion and not only of its sample
/// points.
struct RecordFigures
{
    double peakAcceleration = 0;    ///< largest absolute value [m/s2]
    double peakVelocity = 0;        ///< of a ground at rest at the first time [m/s]
    double peakDisplacement = 0;    ///< likewise [m]
    double duration = 0;            ///< from the first time to the last [s]
    double significantDuration = 0; ///< in which the Arias intensity grows from 5% to 95% [s]
    double ariasIntensity = 0;      ///< pi/(2 g) times the integral of the acceleration squared [m/s]
};

RecordFigures figures(const Record& record);

} // namespace drystone
