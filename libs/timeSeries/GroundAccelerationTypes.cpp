// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What constant/groundMotion can say: the list of acceleration types, and the settings of each.
#include "timeSeries/GroundAccelerationTypes.h"

#include "core/ByteOrderMark.h"
#include "core/NamedFile.h"
#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace drystone
{

namespace
{

/// Of pulses that make small blocks rock; the largest that earthquakes were measured with [m/s2].
constexpr double strongestGround = 40;

/// A history that needs no files.
template<class Acceleration>
AccelerationMaker ready(Acceleration acceleration, std::string summary)
{
    const auto shared = std::make_shared<const Acceleration>(std::move(acceleration));
    return [shared, summary = std::move(summary)](const std::filesystem::path&) {
        return DescribedAcceleration{shared, summary};
    };
}

std::string typeLine(const std::string& type)
{
    return fmt::format("    type        {}\n", type);
}

struct ConstantSettings
{
    double value = 0;
};

void declare(Options& options, ConstantSettings& settings)
{
    options.required("value", settings.value, "acceleration of the ground at all times")
        .unit("m/s2")
        .usual(-strongestGround, strongestGround)
        .example("3.0");
}

AccelerationMaker makeConstant(const ConstantSettings& settings)
{
    return ready(ConstantAcceleration(settings.value), typeLine("constant"));
}

void declarePulse(Options& options, PulseShape& pulse)
{
    options.required("amplitude", pulse.amplitude, "largest acceleration; negative to begin the other way")
        .unit("m/s2")
        .usual(-strongestGround, strongestGround)
        .example("3.5");
    options.required("duration", pulse.duration, "of the whole pulse").unit("s").above(0).example("0.5");
    options.optional("start", pulse.start, "when the pulse begins").unit("s");
}

struct RectangularPulseSettings
{
    PulseShape pulse;
};

void declare(Options& options, RectangularPulseSettings& settings)
{
    declarePulse(options, settings.pulse);
}

AccelerationMaker makeRectangularPulse(const RectangularPulseSettings& settings)
{
    return ready(RectangularPulse(settings.pulse), typeLine("rectangularPulse"));
}

struct HalfSineSettings
{
    PulseShape pulse;
};

void declare(Options& options, HalfSineSettings& settings)
{
    declarePulse(options, settings.pulse);
}

AccelerationMaker makeHalfSine(const HalfSineSettings& settings)
{
    return ready(SinePulse(settings.pulse, 1), typeLine("halfSine"));
}

struct SineSettings
{
    PulseShape pulse;
    double cycles = 1;
};

void declare(Options& options, SineSettings& settings)
{
    declarePulse(options, settings.pulse);
    options.optional("cycles", settings.cycles, "whole waves within the duration").above(0);
}

AccelerationMaker makeSine(const SineSettings& settings)
{
    return ready(SinePulse(settings.pulse, 2 * settings.cycles), typeLine("sine"));
}

struct TableSettings
{
    std::vector<std::pair<double, double>> values;
    std::string file;
    Interpolation interpolation = Interpolation::linear;
    OutOfBounds outOfBounds = OutOfBounds::clamp;
};

void declare(Options& options, TableSettings& settings)
{
    options
        .optional("values", settings.values,
                  "times [s] and accelerations [m/s2]; a time that stands twice is a jump")
        .example("((0 0) (0.1 3) (0.5 0))");
    options.optional("file", settings.file,
                     "instead of values: a file with such a list or with two columns, relative to the case");
    options.optional("interpolation", settings.interpolation, "between the points");
    options.optional("outOfBounds", settings.outOfBounds, "before the first and after the last time");
    options.check("values",
                  [&settings]
                  {
                      if (!settings.values.empty() && !settings.file.empty())
                      {
                          return "Both values and file are given; remove one of them.";
                      }
                      return settings.values.empty() && settings.file.empty()
                                 ? "A table needs either values or a file with them."
                                 : "";
                  });
}

std::filesystem::path inCase(const std::filesystem::path& file, const std::filesystem::path& caseDirectory)
{
    return file.is_absolute() ? file : caseDirectory / file;
}

struct TableFile
{
    std::vector<std::pair<double, double>> values; ///< [s], [m/s2]
    std::string unit = "m/s2";                     ///< of the accelerations in the file
};

/// A list `((t a) (t a))`, or else two columns, whose titles may say the unit.
TableFile readTable(const std::filesystem::path& file)
{
    std::error_code error;
    std::ostringstream content;
    if (std::filesystem::is_regular_file(file, error)) // else readCsvRecord says what is wrong
    {
        std::ifstream stream(file, std::ios::binary);
        if (stream)
        {
            content << stream.rdbuf();
        }
    }
    const std::string text(withoutByteOrderMark(content.view()));
    const auto begin = text.find_first_not_of(" \t\r\n");
    const bool list = begin != std::string::npos && text.find('(', begin) != std::string::npos;
    if (list)
    {
        return {Dictionary::readString("values " + text + "\n;", file.string(), Expansion::none)
                    .get<std::vector<std::pair<double, double>>>("values")};
    }
    const Record record = readCsvRecord(file, {0, 1, 0, ""});
    TableFile table{{}, record.unit};
    for (std::size_t i = 0; i < record.times.size(); ++i)
    {
        table.values.emplace_back(record.times[i], record.accelerations[i]);
    }
    return table;
}

DescribedAcceleration accelerationOfTable(const TableSettings& settings, const SourceLocation& location,
                                          const std::filesystem::path& caseDirectory)
{
    const bool fromFile = !settings.file.empty();
    const std::filesystem::path file = inCase(settings.file, caseDirectory);
    const TableFile table = fromFile ? readTable(file) : TableFile{settings.values};
    std::vector<double> times;
    std::vector<double> accelerations;
    for (const auto& [time, acceleration] : table.values)
    {
        times.push_back(time);
        accelerations.push_back(acceleration);
    }
    DescribedAcceleration described;
    described.summary =
        typeLine("table") + (fromFile ? fmt::format("    file        {}\n", settings.file) : "");
    if (const double factor = accelerationUnit(table.unit); factor != 1)
    {
        described.summary +=
            fmt::format("    unit        {} (1 {} = {:.6g} m/s2)\n", table.unit, table.unit, factor);
    }
    try
    {
        described.acceleration = tabulatedAcceleration(std::move(times), std::move(accelerations),
                                                       settings.interpolation, settings.outOfBounds);
    }
    catch (const std::domain_error& error)
    {
        throw FatalIOError(std::string("Not a table of accelerations: ") + error.what() + ".",
                           fromFile ? SourceLocation{file.string(), "", 0} : location);
    }
    return described;
}

AccelerationMaker makeTable(const TableSettings& settings, const Dictionary& dictionary)
{
    const SourceLocation location = dictionary.locationOf(settings.file.empty() ? "values" : "file");
    // values are wrong or right without the case's folder: say so at once
    if (settings.file.empty())
    {
        accelerationOfTable(settings, location, "");
    }
    return [settings, location](const std::filesystem::path& caseDirectory)
    {
        if (!settings.file.empty())
        {
            requireFile(inCase(settings.file, caseDirectory), location);
        }
        return accelerationOfTable(settings, location, caseDirectory);
    };
}

AccelerationMaker makeRecord(const RecordMotion& settings, const Dictionary& dictionary)
{
    return [settings, location = dictionary.locationOf("file")](const std::filesystem::path& caseDirectory)
    {
        requireFile(inCase(settings.file, caseDirectory), location);
        return recordedAcceleration(settings, caseDirectory);
    };
}

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
    const std::filesystem::path file = inCase(motion.file, caseDirectory);
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

const Registry<AccelerationMaker>& groundAccelerationTypes()
{
    static const Registry<AccelerationMaker> registry{
        "ground acceleration",
        {model<AccelerationMaker, ConstantSettings>("constant", "the same at all times", makeConstant),
         model<AccelerationMaker, RectangularPulseSettings>("rectangularPulse", "an amplitude for a time",
                                                            makeRectangularPulse),
         model<AccelerationMaker, HalfSineSettings>("halfSine", "half a wave", makeHalfSine),
         model<AccelerationMaker, SineSettings>("sine", "one or more whole waves", makeSine),
         model<AccelerationMaker, TableSettings>("table", "points in time", makeTable),
         model<AccelerationMaker, RecordMotion>("record", "an accelerogram from a file", makeRecord)}};
    return registry;
}

} // namespace drystone
