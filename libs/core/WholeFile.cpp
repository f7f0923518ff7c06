// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Temporary file, then rename.
#include "core/WholeFile.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

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

} // namespace

void writeWholeFile(const std::filesystem::path& file, std::string_view content)
{
    const std::string temporary = fmt::format("{}.{}.tmp", file.string(), ::getpid());
    const auto open = [&]
    { return ::open(temporary.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666); };
    int descriptor = open();
    if (descriptor < 0 && errno == ENOENT && file.has_parent_path())
    {
        std::error_code failure;
        std::filesystem::create_directories(file.parent_path(), failure);
        if (failure)
        {
            refuse(file, failure.value());
        }
        descriptor = open();
    }
    if (descriptor < 0)
    {
        refuse(file, errno);
    }

    int reason = 0;
    while (!content.empty() && reason == 0)
    {
        const auto written = ::write(descriptor, content.data(), content.size());
        if (written >= 0)
        {
            content.remove_prefix(static_cast<std::size_t>(written));
        }
        else if (errno != EINTR)
        {
            reason = errno;
        }
    }
    if (::close(descriptor) != 0 && reason == 0)
    {
        reason = errno;
    }
    if (reason == 0 && std::rename(temporary.c_str(), file.c_str()) != 0)
    {
        reason = errno;
    }
    if (reason != 0)
    {
        ::unlink(temporary.c_str());
        refuse(file, reason);
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
