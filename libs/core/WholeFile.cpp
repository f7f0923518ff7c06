// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Temporary file, then rename.
#include "core/WholeFile.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace drystone
{

namespace
{

[[noreturn]] void refuse(const std::filesystem::path& file, int reason)
{
    throw FatalError(fmt::format(
        "Cannot write {}: {}.\n\nCheck that its folder may be written and that the disk has room.",
        file.string(), std::strerror(reason)));
}

/// Writes a file, with the folders missing on the way, over what is there: a file cut to nothing first would
/// be given to the disk as it is closed. \returns what has failed, 0 for nothing
int written(const std::string& name, const std::filesystem::path& folder, std::string_view content)
{
    const auto open = [&] { return ::open(name.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666); };
    int descriptor = open();
    if (descriptor < 0 && errno == ENOENT && !folder.empty())
    {
        std::error_code failure;
        std::filesystem::create_directories(folder, failure);
        if (failure)
        {
            return failure.value();
        }
        descriptor = open();
    }
    if (descriptor < 0)
    {
        return errno;
    }

    int reason = 0;
    const auto size = static_cast<off_t>(content.size());
    while (!content.empty() && reason == 0)
    {
        const auto bytes = ::write(descriptor, content.data(), content.size());
        if (bytes >= 0)
        {
            content.remove_prefix(static_cast<std::size_t>(bytes));
        }
        else if (errno != EINTR)
        {
            reason = errno;
        }
    }
    if (reason == 0 && ::lseek(descriptor, 0, SEEK_END) > size && ::ftruncate(descriptor, size) != 0)
    {
        reason = errno;
    }
    if (::close(descriptor) != 0 && reason == 0)
    {
        reason = errno;
    }
    if (reason != 0)
    {
        ::unlink(name.c_str());
    }
    return reason;
}

} // namespace

void writeWholeFile(const std::filesystem::path& file, std::string_view content)
{
    const std::string temporary = fmt::format("{}.{}.tmp", file.string(), ::getpid());
    int reason = written(temporary, file.parent_path(), content);
    if (reason == 0 && std::rename(temporary.c_str(), file.c_str()) != 0)
    {
        reason = errno;
        ::unlink(temporary.c_str());
    }
    if (reason != 0)
    {
        refuse(file, reason);
    }
}

void writeFile(const std::filesystem::path& file, std::string_view content)
{
    if (const int reason = written(file.string(), file.parent_path(), content); reason != 0)
    {
        refuse(file, reason);
    }
}

void removeLeftovers(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> leftovers;
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
    {
        const std::filesystem::path name = entry.path().filename();
        const std::string process = name.stem().extension().string(); // `.12979` of `.0.36.12979.tmp`
        const bool isKind = name.extension() == ".tmp" || name.extension() == ".purged";
        pid_t number = 0;
        const bool isNumber =
            process.size() > 1
            && std::from_chars(process.data() + 1, process.data() + process.size(), number).ptr
                   == process.data() + process.size();
        if (isKind && isNumber && ::kill(number, 0) != 0 && errno == ESRCH)
        {
            leftovers.push_back(entry.path());
        }
    }
    for (const std::filesystem::path& leftover : leftovers)
    {
        std::filesystem::remove_all(leftover, failure);
    }
}

std::string contentOfFile(const std::filesystem::path& file)
{
    std::error_code unknown;
    if (std::filesystem::is_directory(file, unknown)) // which opens, and then throws as it is read
    {
        return {};
    }
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::filesystem::path sharedFolder()
{
    std::error_code unknown;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
    const std::filesystem::path folder = program.parent_path().parent_path() / "share" / "drystone";
    return !unknown && std::filesystem::is_directory(folder, unknown) ? folder : std::filesystem::path();
}

void requireWritable(const std::filesystem::path& folder)
{
    std::error_code failure;
    std::filesystem::path existing = std::filesystem::absolute(folder, failure).lexically_normal();
    while (!std::filesystem::exists(existing, failure) && existing.has_relative_path())
    {
        existing = existing.parent_path();
    }
    const int reason = !std::filesystem::is_directory(existing, failure) ? ENOTDIR
                       : ::access(existing.c_str(), W_OK | X_OK) != 0    ? errno
                                                                         : 0;
    if (reason != 0)
    {
        throw FatalError(fmt::format(
            "Cannot write into {}: {}: {}.\n\nChoose another case directory, or repair its permissions.",
            folder.string(), existing.string(), std::strerror(reason)));
    }
}

} // namespace drystone
