// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the list of a series, ParaView's JSON with one frame per line, so that it can be appended to:
///
///     {
///       "file-series-version" : "1.0",
///       "application" : "contactDynamics",
///       "files" : [
///         { "name" : "blocks_000000.vtp", "time" : 0 },
///         { "name" : "blocks_000001.vtp", "time" : 0.02 }
///       ]
///     }
#include "io/VtkSeries.h"

#include "core/Error.h"
#include "core/Json.h"
#include "core/Log.h"
#include "core/WholeFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <unistd.h>

namespace drystone
{

namespace
{

constexpr std::string_view listTail = "\n  ]\n}\n";

/// ParaView reads the version and the files.
std::string headOfList(const std::string& application)
{
    return fmt::format("{{\n  \"file-series-version\" : \"1.0\",\n{}  \"files\" : [\n",
                       application.empty() ? "" : fmt::format("  \"application\" : \"{}\",\n", application));
}

std::string listLine(std::string_view file, double time)
{
    return fmt::format("    {{ \"name\" : \"{}\", \"time\" : {} }}", file, time);
}

/// Times that differ by no more than the rounding of some thousand additions.
bool sameTime(double a, double b)
{
    return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b));
}

[[noreturn]] void refuseList(const std::filesystem::path& listFile, const std::string& what, int line)
{
    throw FatalIOError("This is not a list of frames and their times: " + what
                           + ".\n\nTo start a new series, remove the file.",
                       {listFile.string(), "", line});
}

JsonValue jsonOf(const std::filesystem::path& listFile, const std::string& text)
{
    try
    {
        return parseJson(text);
    }
    catch (const JsonFault& fault)
    {
        refuseList(listFile, fault.what(), fault.line);
    }
}

/// An entry of the list; nothing where it has no time, or no name of a file in the folder.
std::optional<SeriesFrame> frameOf(const JsonValue& entry)
{
    const JsonValue* name = entry.find("name");
    const JsonValue* time = entry.find("time");
    const bool isNamed = name != nullptr && name->asText() != nullptr;
    const bool isTimed = isNamed && time != nullptr && time->asNumber() != nullptr;
    if (!isTimed || name->asText()->find('/') != std::string::npos)
    {
        return std::nullopt;
    }
    return SeriesFrame{*name->asText(), *time->asNumber()};
}

} // namespace

Series readSeries(const std::filesystem::path& folder, const std::string& name)
{
    const std::filesystem::path listFile = folder / (name + ".vtp.series");
    Series listed;
    std::error_code error;
    if (std::filesystem::exists(listFile, error) && !std::filesystem::is_regular_file(listFile, error))
    {
        throw FatalIOError(
            "This is no file, and the list of frames and their times is wanted here. Remove it.",
            {listFile.string(), "", 0});
    }
    std::ifstream list(listFile, std::ios::binary);
    if (!list.is_open())
    {
        return listed;
    }
    const JsonValue series = jsonOf(listFile, {std::istreambuf_iterator<char>(list), {}});
    const JsonValue* application = series.find("application");
    if (application != nullptr && application->asText() != nullptr)
    {
        listed.application = *application->asText();
    }
    const JsonValue* files = series.find("files");
    if (files == nullptr || files->asList() == nullptr)
    {
        refuseList(listFile, "it has no array \"files\"", 0);
    }
    for (const JsonValue& entry : *files->asList())
    {
        const std::optional<SeriesFrame> known = frameOf(entry);
        if (!known)
        {
            refuseList(
                listFile,
                fmt::format("entry {} of \"files\" has no \"name\" of a file beside the list with a \"time\"",
                            &entry - &files->asList()->front()),
                0);
        }
        // A frame that was removed to save space is skipped, and so is a name that no file can have.
        std::error_code unknown;
        if (std::filesystem::exists(folder / known->file, unknown))
        {
            listed.frames.push_back(*known);
        }
    }
    std::stable_sort(listed.frames.begin(), listed.frames.end(),
                     [](const SeriesFrame& a, const SeriesFrame& b) { return a.time < b.time; });
    return listed;
}

VtkSeries::VtkSeries(std::filesystem::path seriesFolder, std::string seriesName, double startTime,
                     std::string application)
    : folder(std::move(seriesFolder)), name(std::move(seriesName)), listHead(headOfList(application))
{
    Series there = readSeries(folder, name);
    frames = std::move(there.frames);
    if (!there.application.empty() && !application.empty() && there.application != application)
    {
        replaced = frames.empty() ? "" : there.application;
        return; // with all frames stale
    }
    const auto later = std::find_if(frames.begin(), frames.end(),
                                    [&](const SeriesFrame& frame)
                                    { return frame.time > startTime && !sameTime(frame.time, startTime); });
    staleFrom = static_cast<std::size_t>(later - frames.begin());
}

void VtkSeries::begin()
{
    if (!replaced.empty())
    {
        info("{}: the frames of {} that were there are removed", listFile().filename().string(), replaced);
        replaced.clear();
    }
    cutFrom(staleFrom);
    staleFrom = frames.size();
}

bool VtkSeries::hasFrameAt(double time) const
{
    return std::any_of(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(staleFrom),
                       [time](const SeriesFrame& frame) { return sameTime(frame.time, time); });
}

std::filesystem::path VtkSeries::listFile() const
{
    return folder / (name + ".vtp.series");
}

std::vector<double> VtkSeries::times() const
{
    std::vector<double> result;
    for (std::size_t i = 0; i < staleFrom; ++i)
    {
        result.push_back(frames[i].time);
    }
    return result;
}

void VtkSeries::cutFrom(std::size_t first)
{
    if (first >= frames.size())
    {
        return;
    }
    const std::vector<SeriesFrame> removed(frames.begin() + static_cast<std::ptrdiff_t>(first), frames.end());
    frames.resize(first);
    // First the list, then the files, so that the list never names a file that does not exist.
    writeList();
    for (const SeriesFrame& frame : removed)
    {
        std::error_code ignored; // a file that cannot be removed is overwritten or left over, but not listed
        std::filesystem::remove(folder / frame.file, ignored);
    }
}

template<int Dim>
void VtkSeries::write(double time, const PolyData<Dim>& data)
{
    if (!std::isfinite(time))
    {
        throw FatalError(
            fmt::format("The time of a frame of {} is not a finite number.", listFile().string()));
    }
    const std::string bytes = vtpBytes(data); // before anything is changed: it may throw
    begin();

    const auto first = std::find_if(frames.begin(), frames.end(),
                                    [&](const SeriesFrame& frame)
                                    { return frame.time > time || sameTime(frame.time, time); });
    cutFrom(static_cast<std::size_t>(first - frames.begin()));

    // Numbered from the last frame, not from the count, since frames may have been removed by hand.
    std::size_t number = 0;
    if (!frames.empty())
    {
        const std::string& last = frames.back().file;
        const std::size_t digits = name.size() + 1;
        if (last.size() > digits)
        {
            std::from_chars(last.data() + digits, last.data() + last.size(), number);
        }
        ++number;
    }
    const SeriesFrame frame{fmt::format("{}_{:06}.vtp", name, number), time};
    writeWholeFile(folder / frame.file, bytes);
    frames.push_back(frame);
    staleFrom = frames.size();
    appendToList(frame);
}

template void VtkSeries::write(double time, const PolyData<2>& data);
template void VtkSeries::write(double time, const PolyData<3>& data);

void VtkSeries::writeList()
{
    std::string text = listHead;
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        text += (i == 0 ? "" : ",\n") + listLine(frames[i].file, frames[i].time);
    }
    text += listTail;
    writeWholeFile(listFile(), text);
    listSize = text.size();
}

/// Replaces the end of the list by one more line and the end, in one system call of some hundred bytes.
/// Writing the whole list for every frame would cost as much as the frame itself (a rename over an existing
/// file makes the file system allocate immediately), and more with each frame.
void VtkSeries::appendToList(const SeriesFrame& frame)
{
    std::error_code unknown;
    if (listSize == 0 || frames.size() < 2 || std::filesystem::file_size(listFile(), unknown) != listSize
        || unknown)
    {
        return writeList();
    }
    const std::string text = ",\n" + listLine(frame.file, frame.time) + std::string(listTail);
    const std::size_t at = listSize - listTail.size();
    const int descriptor = ::open(listFile().c_str(), O_WRONLY | O_CLOEXEC);
    const auto written =
        descriptor < 0 ? -1 : ::pwrite(descriptor, text.data(), text.size(), static_cast<off_t>(at));
    if (descriptor >= 0)
    {
        ::close(descriptor);
    }
    if (written != static_cast<ssize_t>(text.size()))
    {
        return writeList(); // which reports the error, or repairs the list
    }
    listSize = at + text.size();
}

} // namespace drystone
