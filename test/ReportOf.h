// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a user reads of a fault, for tests of messages.
#pragma once

#include "core/Error.h"

#include <string>

namespace drystone
{

/// The report of the FatalError with which `run` ends, or `no error`.
template<class Run>
std::string reportOf(const Run& run)
{
    try
    {
        run();
    }
    catch (const FatalError& error)
    {
        return error.report();
    }
    return "no error";
}

} // namespace drystone
