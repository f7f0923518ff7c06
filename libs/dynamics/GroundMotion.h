// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How the ground moves in a case: constant/groundMotion.
#pragma once

#include "dynamics/GroundAcceleration.h"

#include <Eigen/Core>

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
        std::string summary; ///< what it is, for the log: a line a property, each beginning with four blanks
    };
    std::vector<Component> components; ///< empty: the ground is still
};

/// How the file of a record is laid out.
enum class RecordFormat
{
    PEER_AT2,
    csv
};

/// A record as the dictionary asks for it. It is read, freed of its baseline, scaled, padded and moved in
/// time, in this order.
struct RecordMotion
{
    std::filesystem::path file; ///< absolute, or relative to where the application runs
    RecordFormat format = RecordFormat::PEER_AT2;
    std::string unit;                   ///< empty: the file says it
    CsvLayout columns;                  ///< for csv; its `unit` is not used
    Baseline baseline = Baseline::none; ///< what is taken away
    double scale = 1;                   ///< factor
    double peakAcceleration = 0;        ///< when positive, scale to this instead [m/s2]
    double paddingBefore = 0;           ///< stillness added [s]
    double paddingAfter = 0;            ///< stillness added [s]
    double start = 0;                   ///< when the record begins [s]
    Interpolation interpolation = Interpolation::linear;
};

/// The acceleration of a record, zero outside it, and what the log says of it.
/// \throws FatalIOError as the readers; when the record is zero throughout and a peak is asked for; when it
/// has too few values
///         for its interpolation or baseline
GroundMotion::Component recordComponent(const RecordMotion& record);

/// Acceleration of the ground at a time [m/s2]; at a jump, after it.
Eigen::Vector3d groundAcceleration(const GroundMotion& motion, double time);

/// Mean acceleration of the ground over a step [m/s2]: exact, however the kinks of the motion lie in the
/// step. The momentum a step takes from the ground is -m times this times the length of the step.
Eigen::Vector3d meanGroundAcceleration(const GroundMotion& motion, double from, double to);

/// What the log says of the motion: for each component direction, type, peak acceleration [m/s2 and g],
/// duration and, for a record, its file, title, unit and scale. Ends with a line end. `Ground motion: none`
/// for a ground at rest.
std::string summary(const GroundMotion& motion);

} // namespace drystone
