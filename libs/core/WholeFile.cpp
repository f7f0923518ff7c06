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
#include <optional>
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

/// The file that is to be replaced; none where there is none, or no ordinary one.
std::optional<struct stat> replacedFile(const std::filesystem::path& file)
{
    struct stat status = {};
    const bool isFile = ::stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode);
    return isFile ? std::optional(status) : std::nullopt;
}

/// To take the name of a file needs the permission of its folder alone: who protects the file protects what
/// is in it.
void refuseProtected(const std::filesystem::path& file)
{
    if (::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0)
    {
        const int reason = errno;
        if (reason != EACCES && reason != EPERM)
        {
            refuse(file, reason);
        }
        throw FatalError(
            fmt::format("Cannot write {}: it is write-protected ({}).\n\nPermit writing it (chmod "
                        "u+w), or work in a copy of your own.",
                        file.string(), std::strerror(reason)));
    }
}

/// Gives a new file owner, group and mode of the one that it is to replace. An owner or a group that this
/// user cannot give it is not kept, and another group gets no more than everybody.
/// \returns what has failed, 0 for nothing
int keepPermissions(int descriptor, const struct stat& replaced)
{
    struct stat status = {};
    if (::fstat(descriptor, &status) != 0)
    {
        return errno;
    }
    mode_t mode = replaced.st_mode & 0777;
    if (status.st_uid != replaced.st_uid && ::fchown(descriptor, replaced.st_uid, replaced.st_gid) == 0)
    {
        status.st_gid = replaced.st_gid;
    }
    if (status.st_gid != replaced.st_gid
        && ::fchown(descriptor, static_cast<uid_t>(-1), replaced.st_gid) != 0)
    {
        mode &= ~static_cast<mode_t>(S_IRWXG) | ((mode & S_IRWXO) << 3);
    }
    return ::fchmod(descriptor, mode) == 0 ? 0 : errno;
}

/// Writes a file, with the folders missing on the way, over what is there: a file cut to nothing first would
/// be given to the disk as it is closed. \returns what has failed, 0 for nothing
int written(const std::string& name, const std::filesystem::path& folder, std::string_view content,
            const std::optional<struct stat>& replaced = std::nullopt)
{
    const mode_t mode = replaced ? S_IRUSR | S_IWUSR : 0666; // private until it has its permissions
    const auto open = [&] { return ::open(name.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, mode); };
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
    if (reason == 0 && replaced)
    {
        reason = keepPermissions(descriptor, *replaced);
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
    const std::optional<struct stat> replaced = replacedFile(file);
    if (replaced)
    {
        refuseProtected(file);
    }
    const std::string temporary = fmt::format("{}.{}.tmp", file.string(), ::getpid());
    int reason = written(temporary, file.parent_path(), content, replaced);
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
