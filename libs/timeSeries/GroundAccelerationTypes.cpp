// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What constant/groundMotion can say: the list of acceleration types, and the settings of each.
#include "timeSeries/GroundAccelerationTypes.h"

#include "core/ByteOrderMark.h"
#include "core/NamedFile.h"
#include "timeSeries/DescribedAcceleration.h"
#include "timeSeries/RecordMotion.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace drystone
{

namespace
{

/// A history that needs no files.
template<class Acceleration>
AccelerationMaker ready(Acceleration acceleration, std::string summary)
{
    const auto shared = std::make_shared<const Acceleration>(std::move(acceleration));
    return [shared, summary = std::move(summary)](const std::filesystem::path&) {
        return DescribedAcceleration{shared, summary};
    };
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
    const std::filesystem::path file = caseDirectory / settings.file;
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
            requireFile(caseDirectory / settings.file, location);
        }
        return accelerationOfTable(settings, location, caseDirectory);
    };
}

AccelerationMaker makeRecord(const RecordMotion& settings, const Dictionary& dictionary)
{
    return [settings, location = dictionary.locationOf("file")](const std::filesystem::path& caseDirectory)
    {
        requireFile(caseDirectory / settings.file, location);
        return recordedAcceleration(settings, caseDirectory);
    };
}

} // namespace

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
