// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Series of .vtp files that ParaView plays as an animation, valid at any moment of a run.
#pragma once

#include "io/VtkFile.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// A frame of a series.
struct SeriesFrame
{
    std::string file; ///< its name, in the folder of the list
    double time;      ///< [s], of a mechanism its part from 0 to 1
};

/// What a list says.
struct Series
{
    std::string application;         ///< that wrote it; empty where it does not say
    std::vector<SeriesFrame> frames; ///< that are there, by time
};

/// What `<folder>/<name>.vtp.series` lists; nothing without a list. \throws FatalIOError for a file that is
/// no such list
Series readSeries(const std::filesystem::path& folder, const std::string& name);

/// Writes `<folder>/<name>.vtp.series`, the list of frames and their times, and `<folder>/<name>_000000.vtp`
/// and so on, one file per frame. The list names complete files only, at any moment, because ParaView may
/// open a running case.
///
/// One object writes one series; no second object may be used on the same series at the same time.
class VtkSeries
{
public:
    /// Reads what there is of the series, to be written from startTime on. Frames of an earlier run up to
    /// startTime are kept, so that a restarted run continues its animation; later ones are removed by
    /// `begin`, and so are all that another application has written, which the log then says.
    ///
    /// \param application that writes it; empty: the list does not say
    /// \throws FatalError when the list there was not written by Drystone
    VtkSeries(std::filesystem::path seriesFolder, std::string seriesName, double startTime,
              std::string application = {});

    /// Removes the frames after startTime, which `write` does too. \throws FatalError when the list cannot be
    /// written
    void begin();

    /// Whether a frame of this time is there, up to startTime or since written [s].
    bool hasFrameAt(double time) const;

    /// Adds a frame at a time [s]. Frames of this time or later, if present, are replaced by it.
    /// \throws FatalError as vtpBytes and writeWholeFile; the list is then unchanged
    template<int Dim>
    void write(double time, const PolyData<Dim>& data);

    /// Times of the frames that are kept and those written, ascending [s].
    std::vector<double> times() const;

    /// The list itself: `<folder>/<name>.vtp.series`.
    std::filesystem::path listFile() const;

private:
    void cutFrom(std::size_t first);
    void writeList();
    void appendToList(const SeriesFrame& frame);

    std::filesystem::path folder;
    std::string name;
    std::string listHead; ///< up to the first frame
    std::string replaced; ///< application whose frames are in the way; empty: none
    std::vector<SeriesFrame> frames;
    /// The first frame after startTime, until these are removed; then the number of frames.
    std::size_t staleFrom = 0;
    std::size_t listSize = 0; ///< bytes of the list file as we wrote it; 0 when it is not known
};

} // namespace drystone
