// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/GroundMotion.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <stdexcept>

namespace drystone
{

namespace
{

GroundMotion::Component preparedRecord(const RecordMotion& motion)
{
    CsvLayout columns = motion.columns;
    columns.unit = motion.unit;
    Record record = motion.format == RecordFormat::PEER_AT2 ? readPeerRecord(motion.file, motion.unit)
                                                            : readCsvRecord(motion.file, columns);
    const std::size_t count = record.times.size();
    const double ownPeak = figures(record).peakAcceleration;
    record = baselineCorrected(std::move(record), motion.baseline);
    record = motion.peakAcceleration > 0 ? scaledToPeak(std::move(record), motion.peakAcceleration)
                                         : scaled(std::move(record), motion.scale);
    record = padded(record, motion.paddingBefore, motion.paddingAfter);
    const double shift = motion.start - record.times.front();
    for (double& time : record.times)
        time += shift;

    const RecordFigures f = figures(record);
    GroundMotion::Component component;
    component.summary =
        fmt::format("    record      {} ({} values)\n", motion.file.string(), count)
        + (record.title.empty() ? "" : fmt::format("    title       {}\n", record.title))
        + fmt::format("    unit        {} (1 {} = {:.6g} m/s2)\n", record.unit, record.unit,
                      accelerationUnit(record.unit))
        + fmt::format("    scale       {:.6g}, from a PGA of {:.6g} {}\n",
                      motion.peakAcceleration > 0 ? f.peakAcceleration / ownPeak : motion.scale,
                      ownPeak / accelerationUnit(record.unit), record.unit)
        + fmt::format("    PGV         {:.6g} m/s\n    PGD         {:.6g} m\n", f.peakVelocity,
                      f.peakDisplacement)
        + fmt::format("    significant {:.6g} s (5% to 95% of the Arias intensity, {:.6g} m/s)\n",
                      f.significantDuration, f.ariasIntensity);
    component.acceleration = tabulatedAcceleration(std::move(record.times), std::move(record.accelerations),
                                                   motion.interpolation, OutOfBounds::zero);
    return component;
}

} // namespace

GroundMotion::Component recordComponent(const RecordMotion& motion)
{
    try
    {
        return preparedRecord(motion);
    }
    catch (const std::domain_error& error) // what was asked for cannot be done with this record
    {
        throw FatalIOError(error.what(), {motion.file.string(), "", 0});
    }
}

Eigen::Vector3d groundAcceleration(const GroundMotion& motion, double time)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const GroundMotion::Component& component : motion.components)
        sum += component.acceleration->at(time) * component.direction;
    return sum;
}

Eigen::Vector3d meanGroundAcceleration(const GroundMotion& motion, double from, double to)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const GroundMotion::Component& component : motion.components)
        sum += component.acceleration->mean(from, to) * component.direction;
    return sum;
}

std::string summary(const GroundMotion& motion)
{
    if (motion.components.empty())
        return "Ground motion: none\n";
    std::string text;
    for (const GroundMotion::Component& component : motion.components)
    {
        const Eigen::Vector3d& d = component.direction;
        const GroundAcceleration& history = *component.acceleration;
        text += fmt::format("Ground motion along ({:.6g} {:.6g} {:.6g})\n", d.x(), d.y(), d.z());
        text += component.summary;
        text += fmt::format("    PGA         {:.6g} m/s2 = {:.6g} g\n", history.peak(),
                            history.peak() / standardGravity);
        const std::vector<double> kinks = history.kinks();
        if (kinks.empty())
            text += "    duration    unlimited\n";
        else
            text += fmt::format("    duration    {:.6g} s, from {:.6g} s to {:.6g} s\n",
                                kinks.back() - kinks.front(), kinks.front(), kinks.back());
    }
    return text;
}

} // namespace drystone
