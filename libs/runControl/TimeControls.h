// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What system/controlDict says about the time of a run: where it starts and ends, its steps, what is written
/// and when, and the names of time directories.
#pragma once

#include "dictionary/Options.h"
#include "runControl/OutputControl.h"
#include "runControl/PictureFormats.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

enum class StartFrom
{
    startTime,  ///< the time of the entry startTime
    firstTime,  ///< the earliest time directory
    latestTime, ///< the latest time directory
};

enum class StopAt
{
    endTime,    ///< the time of the entry endTime
    writeNow,   ///< after one more step, writing the state
    noWriteNow, ///< after one more step
    nextWrite   ///< the next time the state is written
};

/// How the numbers of a state are written. Both give back the same bits: ascii with as many digits as that
/// takes (writePrecision does not shorten a state), a plain dictionary; binary as the machine has them, half
/// the size, in OpenFOAM's notation of binary lists.
enum class WriteFormat
{
    ascii,
    binary,
};

enum class TimeFormat
{
    general,   ///< 0.05, 1e-05
    fixed,     ///< 0.050000
    scientific ///< 5.000000e-02
};

inline std::array<std::pair<std::string_view, StartFrom>, 3> namesOf(StartFrom)
{
    return {{{"startTime", StartFrom::startTime},
             {"firstTime", StartFrom::firstTime},
             {"latestTime", StartFrom::latestTime}}};
}
inline std::array<std::pair<std::string_view, StopAt>, 4> namesOf(StopAt)
{
    return {{{"endTime", StopAt::endTime},
             {"writeNow", StopAt::writeNow},
             {"noWriteNow", StopAt::noWriteNow},
             {"nextWrite", StopAt::nextWrite}}};
}
inline std::array<std::pair<std::string_view, WriteFormat>, 2> namesOf(WriteFormat)
{
    return {{{"ascii", WriteFormat::ascii}, {"binary", WriteFormat::binary}}};
}
inline std::array<std::pair<std::string_view, TimeFormat>, 3> namesOf(TimeFormat)
{
    return {{{"general", TimeFormat::general},
             {"fixed", TimeFormat::fixed},
             {"scientific", TimeFormat::scientific}}};
}

/// system/controlDict without its functions.
struct TimeControls
{
    std::string application;
    StartFrom startFrom = StartFrom::latestTime;
    double startTime = 0; ///< [s]
    StopAt stopAt = StopAt::endTime;
    double endTime = 1;   ///< [s]
    double deltaT = 0.01; ///< [s]
    OutputSettings output;
    int logFrequency = 1; ///< every so many steps have their lines in the log
    int purgeWrite = 0;   ///< number of time directories to keep; 0 keeps all
    WriteFormat writeFormat = WriteFormat::ascii;
    int writePrecision = 6;
    TimeFormat timeFormat = TimeFormat::general;
    int timePrecision = 6;
    PictureFormats pictureFormats{PictureFormat::svg};
    bool runTimeModifiable = true;
    bool adjustTimeStep = false;
};

void declare(Options& options, TimeControls& controls);

/// The same for applications that step through time: they require deltaT, and endTime unless stopAt says
/// otherwise, for which the others have defaults.
struct SteppedTimeControls : TimeControls
{
    std::optional<double> givenEndTime; ///< [s]
};
void declare(Options& options, SteppedTimeControls& controls);

/// Whether an application can do without system/controlDict, or without deltaT and endTime in it.
enum class ControlDict
{
    required,
    optional
};

/// The controls in a dictionary. \param needed whether deltaT and endTime are \throws FatalIOError for what
/// is wrong with them
TimeControls readTimeControls(const Dictionary& dictionary, ControlDict needed);

/// Keys of controlDict that are not as they were, and of which a run takes notice only when it is started.
std::vector<std::string> changesForNextStart(const Dictionary& before, const Dictionary& now);

/// Of an endTime before the time at which a run starts.
inline constexpr const char* endsBeforeStart =
    "endTime lies before startTime.\n\nA run goes forward in time: give a later endTime.";

/// As many digits as a double has.
inline constexpr int largestTimePrecision = 17;

/// The name of a time directory, as OpenFOAM names it: `0.05`, `1e-05`.
std::string timeName(double value, TimeFormat format = TimeFormat::general, int precision = 6);

} // namespace drystone
