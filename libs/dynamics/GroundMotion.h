// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How the ground moves in a case: constant/groundMotion.
///
///     direction (1 0 0);
///     acceleration { type halfSine; amplitude 4.8; duration 0.5; }
///
/// or, to move along several directions at once,
///
///     components
///     {
///         horizontal { direction (1 0 0); acceleration { type record; file constant/north.AT2; } }
///         vertical   { direction (0 1 0); acceleration { type record; file constant/up.AT2; } }
///     }
#pragma once

#include "core/Registry.h"
#include "dynamics/GroundAcceleration.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace drystone
{

/// Accelerations of the ground along some directions, each with its own history. A run is seen from the
/// moving ground: each block feels -m a, and displacements and velocities are relative to the ground.
struct GroundMotion
{
    struct Component
    {
        Eigen::Vector3d direction = Eigen::Vector3d::UnitX(); ///< of unit length
        std::shared_ptr<const GroundAcceleration> acceleration;
        std::string summary;  ///< what it is, for the log: a line a property, each beginning with four blanks
        double valueUnit = 0; ///< of the values in the file of a record [m/s2]; 0 of other types
    };
    std::vector<Component> components; ///< empty: the ground is still
};

/// Acceleration of the ground at a time [m/s2]; at a jump, after it.
Eigen::Vector3d groundAcceleration(const GroundMotion& motion, double time);

/// Mean acceleration of the ground over a step [m/s2]: exact, however the kinks of the motion lie in the
/// step. The momentum a step takes from the ground is -m times this times the length of the step.
Eigen::Vector3d meanGroundAcceleration(const GroundMotion& motion, double from, double to);

/// The largest peak among the components [m/s2]; 0 for a ground at rest.
double peakAcceleration(const GroundMotion& motion);

/// What the log says of the motion: for each component direction, type, peak acceleration [m/s2 and g],
/// duration and, for a record, its file, title, unit and scale. Ends with a line end. `Ground motion: none`
/// for a ground at rest.
std::string summary(const GroundMotion& motion);

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
    std::optional<UnitName> unit;             ///< absent: the file says it
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
/// \throws FatalIOError as the readers; when the record is zero throughout and a peak is asked for; when it
/// has too few
///         values for its interpolation or baseline
GroundMotion::Component recordComponent(const RecordMotion& record,
                                        const std::filesystem::path& caseDirectory);

/// What a dictionary's `acceleration` makes once it is known where the case is. Leaves the direction alone.
/// \throws FatalIOError for what is wrong with files
using AccelerationMaker = std::function<GroundMotion::Component(const std::filesystem::path& caseDirectory)>;

/// All types of ground acceleration: constant, rectangularPulse, halfSine, sine, table, record.
const Registry<AccelerationMaker>& groundAccelerationTypes();

/// One direction of motion.
struct GroundComponentSettings
{
    std::array<double, 3> direction{1, 0, 0}; ///< of any length but zero
    AccelerationMaker acceleration;
};
void declare(Options& options, GroundComponentSettings& settings);

/// constant/groundMotion as it is written: one direction, or several under `components`.
struct GroundMotionSettings
{
    std::optional<std::array<double, 3>> direction; ///< of any length but zero
    AccelerationMaker acceleration;
    std::vector<Named<GroundComponentSettings>> components;
};
void declare(Options& options, GroundMotionSettings& settings);

/// The motion that constant/groundMotion describes, with its records read.
/// \throws FatalIOError for what is wrong with the dictionary or with a file it names
GroundMotion readGroundMotion(const Dictionary& dictionary, const std::filesystem::path& caseDirectory);

} // namespace drystone
