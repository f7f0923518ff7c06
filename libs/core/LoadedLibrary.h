// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A shared library that is loaded where it is first needed instead of as the program starts: in this library
/// because it knows no other.
#pragma once

#include <string>

namespace drystone
{

/// A function of a library, as whichever type it is given to. The caller has to name the right one.
struct LoadedSymbol
{
    void* address;

    template<typename Function>
    operator Function*() const
    {
        return reinterpret_cast<Function*>(address);
    }
};

/// The functions of one library, which stays loaded until the program ends, when this object does not exist
/// any more too: libraries keep memory and threads of their own that outlive their users.
class LoadedLibrary
{
public:
    /// \param name as a linker notes it, `libcairo.so.2`, looked for where shared libraries are
    /// \param folder where it was when this program was built, for machines that keep it in no usual place
    /// \throws FatalError when it is in neither or cannot be loaded, naming what is missing
    LoadedLibrary(const std::string& name, const std::string& folder);

    /// \throws FatalError when the library has no such function: it is an older one
    LoadedSymbol symbol(const std::string& name) const;

private:
    std::string libraryName;
    void* handle;
};

} // namespace drystone
