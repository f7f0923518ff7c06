// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Loads libraries by dlopen.
#include "core/LoadedLibrary.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <dlfcn.h>

namespace drystone
{

LoadedLibrary::LoadedLibrary(const std::string& name, const std::string& folder)
    : libraryName(name), handle(::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL))
{
    if (handle != nullptr)
    {
        return;
    }
    const std::string reason = ::dlerror(); // of the first, whose message names what is missing
    handle = ::dlopen((folder + "/" + name).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr)
    {
        throw FatalError(fmt::format("The library {} cannot be loaded: {}.", name, reason));
    }
}

LoadedSymbol LoadedLibrary::symbol(const std::string& name) const
{
    void* address = ::dlsym(handle, name.c_str());
    if (address == nullptr)
    {
        throw FatalError(fmt::format("The library {} on this machine has no function {}: it is too old.",
                                     libraryName, name));
    }
    return {address};
}

} // namespace drystone
