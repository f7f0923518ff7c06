// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The list of a series is ParaView's JSON, one frame a line:
///
///     {
///       "file-series-version" : "1.0",
///       "files" : [
///         { "name" : "blocks_000000.vtp", "time" : 0 },
///         { "name" : "blocks_000001.vtp", "time" : 0.02 }
///       ]
///     }
#include "io/VtkSeries.h"

#include "core/Error.h"
#include "core/WholeFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <optional>
#include <string_view>
#include <unistd.h>

namespace drystone
{

namespace
{

constexpr std::string_view listHead = "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n";
constexpr std::string_view listTail = "\n  ]\n}\n";

std::string listLine(std::string_view file, double time)
{
    return fmt::format("    {{ \"name\" : \"{}\", \"time\" : {} }}", file, time);
}

/// What stands between two texts, or nothing when they are not both there.
std::optional<std::string_view> between(std::string_view line, std::string_view before,
                                        std::string_view after)
{
    const auto start = line.find(before);
    if (start == line.npos)
        return {};
    line.remove_prefix(start + before.size());
    const auto end = line.find(after);
    if (end == line.npos)
        return {};
    return line.substr(0, end);
}

/// Times that differ by no more than the rounding of some thousand additions.
bool sameTime(double a, double b)
{
    return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b));
}

} // namespace

VtkSeries::VtkSeries(std::filesystem::path folder, std::string name, double startTime)
    : folder_(std::move(folder)), name_(std::move(name)), frames_(readList())
{
    const auto later = std::find_if(frames_.begin(), frames_.end(),
                                    [&](const Frame& frame)
                                    { return frame.time > startTime && !sameTime(frame.time, startTime); });
    cutFrom(static_cast<std::size_t>(later - frames_.begin()));
}

std::filesystem::path VtkSeries::listFile() const
{
    return folder_ / (name_ + ".vtp.series");
}

std::vector<double> VtkSeries::times() const
{
    std::vector<double> result;
    for (const Frame& frame : frames_)
        result.push_back(frame.time);
    return result;
}

std::vector<VtkSeries::Frame> VtkSeries::readList() const
{
    std::vector<Frame> frames;
    std::ifstream file(listFile());
    std::string line;
    for (int number = 1; std::getline(file, line); ++number)
    {
        if (line.find("\"name\"") == line.npos)
            continue;
        const auto name = between(line, "\"name\" : \"", "\"");
        const auto time = between(line, "\"time\" : ", " }");
        double value = 0;
        if (!name || !time || name->find('/') != name->npos
            || std::from_chars(time->data(), time->data() + time->size(), value).ec != std::errc()
            || !std::isfinite(value))
            throw FatalIOError(
                "This line does not name a frame and its time in the way that Drystone writes them. "
                "To start a new series, remove the file.",
                {listFile().string(), "", number});
        // A frame that somebody removed to save room is not missed, nor one that no file can have the name
        // of.
        std::error_code unknown;
        if (std::filesystem::exists(folder_ / *name, unknown))
            frames.push_back({std::string(*name), value});
    }
    std::stable_sort(frames.begin(), frames.end(),
                     [](const Frame& a, const Frame& b) { return a.time < b.time; });
    return frames;
}

void VtkSeries::cutFrom(std::size_t first)
{
    if (first >= frames_.size())
        return;
    const std::vector<Frame> removed(frames_.begin() + static_cast<std::ptrdiff_t>(first), frames_.end());
    frames_.resize(first);
    // First the list, then the files: the list never names what is not there.
    writeList();
    for (const Frame& frame : removed)
    {
        std::error_code ignored; // a file that cannot be removed is overwritten or left over, but not listed
        std::filesystem::remove(folder_ / frame.file, ignored);
    }
}

void VtkSeries::write(double time, const PolyData& data)
{
    if (!std::isfinite(time))
        throw FatalError(
            fmt::format("The time of a frame of {} is not a finite number.", listFile().string()));
    const std::string bytes = vtpBytes(data); // before anything is touched: it may refuse

    const auto first =
        std::find_if(frames_.begin(), frames_.end(),
                     [&](const Frame& frame) { return frame.time > time || sameTime(frame.time, time); });
    cutFrom(static_cast<std::size_t>(first - frames_.begin()));

    // Numbered on from the last frame, which need not be the count: frames may have been removed by hand.
    std::size_t number = 0;
    if (!frames_.empty())
    {
        const std::string& last = frames_.back().file;
        const std::size_t digits = name_.size() + 1;
        if (last.size() > digits)
            std::from_chars(last.data() + digits, last.data() + last.size(), number);
        ++number;
    }
    const Frame frame{fmt::format("{}_{:06}.vtp", name_, number), time};
    writeWholeFile(folder_ / frame.file, bytes);
    frames_.push_back(frame);
    appendToList(frame);
}

void VtkSeries::writeList()
{
    std::string text(listHead);
    for (std::size_t i = 0; i < frames_.size(); ++i)
        text += (i == 0 ? "" : ",\n") + listLine(frames_[i].file, frames_[i].time);
    text += listTail;
    writeWholeFile(listFile(), text);
    listSize_ = text.size();
}

/// Replaces the tail of the list by one more line and the tail, in one system call of some hundred bytes.
/// Writing the list anew for every frame would cost as much as the frame does (a rename over an existing file
/// makes the file system allocate at once), and more with each frame.
void VtkSeries::appendToList(const Frame& frame)
{
    std::error_code unknown;
    if (listSize_ == 0 || frames_.size() < 2 || std::filesystem::file_size(listFile(), unknown) != listSize_
        || unknown)
        return writeList();
    const std::string text = ",\n" + listLine(frame.file, frame.time) + std::string(listTail);
    const std::size_t at = listSize_ - listTail.size();
    const int descriptor = ::open(listFile().c_str(), O_WRONLY | O_CLOEXEC);
    const auto written =
        descriptor < 0 ? -1 : ::pwrite(descriptor, text.data(), text.size(), static_cast<off_t>(at));
    if (descriptor >= 0)
        ::close(descriptor);
    if (written != static_cast<ssize_t>(text.size()))
        return writeList(); // which says what is wrong, or mends it
    listSize_ = at + text.size();
}

} // namespace drystone
