// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a dictionary can say of a record, and the record prepared as it says.
#include "timeSeries/RecordMotion.h"

#include <fmt/format.h>

#include <stdexcept>

namespace drystone
{

namespace
{

/// The record as it stands in its file.
Record recordIn(const std::filesystem::path& file, const RecordMotion& motion)
{
    const std::string unit = motion.unit ? motion.unit->text : "";
    if (motion.format == RecordFormat::PEER_AT2)
    {
        return readPeerRecord(file, unit);
    }
    CsvLayout layout;
    layout.timeStep = motion.timeStep;
    layout.unit = unit;
    layout.timeColumn = motion.timeColumn.value_or(0);
    layout.accelerationColumn = motion.accelerationColumn;
    return readCsvRecord(file, layout);
}

/// What the log says of a record. \param record as it moves the ground \param values in its file
/// \param scale that it was multiplied with \param ownPeak its PGA in the file [m/s2]
std::string recordText(const RecordMotion& motion, const Record& record, std::size_t values, double scale,
                       double ownPeak)
{
    const RecordFigures f = figures(record);
    const double factor = accelerationUnit(record.unit);
    std::string text =
        typeLine("record") + fmt::format("    file        {} ({} values)\n", motion.file, values);
    if (!record.title.empty())
    {
        text += fmt::format("    title       {}\n", record.title);
    }
    text += record.unitIsAssumed
                ? "    unit        m/s2, assumed: neither the file nor `unit` says it\n"
                : fmt::format("    unit        {} (1 {} = {:.6g} m/s2)\n", record.unit, record.unit, factor);
    text +=
        fmt::format("    scale       {:.6g}, of a PGA of {:.6g} {}\n", scale, ownPeak / factor, record.unit);
    text += fmt::format("    PGV         {:.6g} m/s\n    PGD         {:.6g} m\n", f.peakVelocity,
                        f.peakDisplacement);
    text += fmt::format("    significant {:.6g} s (5% to 95% of the Arias intensity, {:.6g} m/s)\n",
                        f.significantDuration, f.ariasIntensity);
    return text;
}

DescribedAcceleration preparedRecord(const RecordMotion& motion, const std::filesystem::path& file)
{
    Record record = recordIn(file, motion);
    const std::size_t count = record.times.size();
    const double ownPeak = figures(record).peakAcceleration;
    record = baselineCorrected(std::move(record), motion.baseline);
    double scale = motion.scale;
    if (motion.peakAcceleration)
    {
        record = scaledToPeak(std::move(record), *motion.peakAcceleration);
        scale = ownPeak > 0 ? *motion.peakAcceleration / ownPeak : 0;
    }
    else
    {
        record = scaled(std::move(record), scale);
    }
    record = padded(record, motion.padding[0], motion.padding[1]);
    const double shift = motion.start - record.times.front();
    for (double& time : record.times)
    {
        time += shift;
    }

    DescribedAcceleration described;
    described.valueUnit = accelerationUnit(record.unit);
    described.unitIsAssumed = record.unitIsAssumed && !record.unitIsQuestioned;
    described.summary = recordText(motion, record, count, scale, ownPeak);
    described.acceleration = tabulatedAcceleration(std::move(record.times), std::move(record.accelerations),
                                                   motion.interpolation, OutOfBounds::zero);
    return described;
}

} // namespace

/// A column is named by its position or by its title.
void read(TokenCursor& cursor, Column& column)
{
    if (!cursor.atEnd() && cursor.peek().kind == TokenKind::number)
    {
        int position = 0;
        read(cursor, position);
        column = position;
        return;
    }
    std::string title;
    read(cursor, title);
    column = title;
}

void read(TokenCursor& cursor, UnitName& name)
{
    if (cursor.atEnd())
    {
        cursor.failExpected("the name of a unit");
    }
    while (!cursor.atEnd())
    { // m / s2 are three tokens
        name.text += cursor.take().text;
    }
}

namespace
{

void declareChecks(Options& options, const RecordMotion& settings)
{
    options.check("peakAcceleration",
                  [&settings]
                  {
                      if (settings.peakAcceleration && settings.scale != 1)
                      {
                          return "Both scale and peakAcceleration are given; remove one of them.";
                      }
                      return "";
                  });
    const auto ofCsvOnly = [&settings](bool isGiven, std::string_view key)
    {
        return isGiven && settings.format == RecordFormat::PEER_AT2 ? fmt::format(
                   "A record in the format PEER_AT2 has its interval in its header, and no columns: "
                   "remove {}, or write `format csv;`.",
                   key)
                                                                    : std::string();
    };
    options.check("timeStep", [=, &settings] { return ofCsvOnly(settings.timeStep > 0, "timeStep"); });
    options.check("timeColumn",
                  [=, &settings] { return ofCsvOnly(settings.timeColumn.has_value(), "timeColumn"); });
    options.check("accelerationColumn", [=, &settings]
                  { return ofCsvOnly(settings.accelerationColumn.has_value(), "accelerationColumn"); });
    options.check(
        "unit",
        [&settings]() -> std::string
        {
            if (!settings.unit || accelerationUnit(settings.unit->text) > 0)
            {
                return "";
            }
            return fmt::format(
                "'{}' is not a unit of acceleration that Drystone knows.\n\nDeclare the unit as {}.",
                settings.unit->text, accelerationUnits);
        });
}

} // namespace

void declare(Options& options, RecordMotion& settings)
{
    options.required("file", settings.file, "the record, relative to the case directory")
        .example("\"constant/record.AT2\"");
    options.optional("format", settings.format, "how the file is laid out");
    options.optional("unit", settings.unit,
                     fmt::format("of the values: {}; where neither this nor the file says it, a csv file is "
                                 "in m/s2",
                                 accelerationUnits));
    options.optional(
        "timeColumn", settings.timeColumn,
        "of a csv file: its position counted from 0, or its title; the first one when absent; in "
        "seconds, or in the unit of its title, as in `time [ms]`");
    options.optional("accelerationColumn", settings.accelerationColumn,
                     "of a csv file: its position counted from 0, or its title; absent: the second one, with "
                     "timeStep the only one");
    options
        .optional("timeStep", settings.timeStep, "of a csv file without a column of times; 0 when it has one")
        .unit("s")
        .atLeast(0);
    options.optional("baseline", settings.baseline, "drift to be taken away, fitted by least squares");
    options.optional("scale", settings.scale, "factor on the accelerations");
    options.optional("peakAcceleration", settings.peakAcceleration, "scale to this peak instead")
        .unit("m/s2")
        .above(0)
        .usual(0, strongestGround);
    options.optional("padding", settings.padding, "stillness added before and after").unit("s").atLeast(0);
    options.optional("start", settings.start, "when the padded record begins").unit("s");
    options.optional("interpolation", settings.interpolation, "between the values");
    declareChecks(options, settings);
}

DescribedAcceleration recordedAcceleration(const RecordMotion& motion,
                                           const std::filesystem::path& caseDirectory)
{
    const std::filesystem::path file = caseDirectory / motion.file;
    try
    {
        return preparedRecord(motion, file);
    }
    catch (const std::domain_error& error) // what was requested cannot be done with this record
    {
        throw FatalIOError(fmt::format("The record cannot be used as its dictionary says: {}.", error.what()),
                           {file.string(), "", 0});
    }
}

} // namespace drystone
