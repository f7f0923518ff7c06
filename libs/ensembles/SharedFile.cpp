// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// By the calls of the system, as a stream reports neither why it fails nor how much it has written.
#include "ensembles/SharedFile.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>

namespace drystone
{

void refuseToWrite(const std::filesystem::path& file)
{
    throw FatalError(fmt::format("Cannot write {}: {}.", file.string(), std::strerror(errno)));
}

int openFile(const std::filesystem::path& file, int flags)
{
    const int descriptor = ::open(file.c_str(), flags | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
    {
        refuseToWrite(file);
    }
    return descriptor;
}

void writeAll(int descriptor, std::string_view text, const std::filesystem::path& file)
{
    while (!text.empty())
    {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno != EINTR)
        {
            refuseToWrite(file);
        }
        text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
}

} // namespace drystone
