// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads fields back from .vtp files, the inverse of VtkFile.h. VTK's own reader ends the process for some
/// damaged files, which users have.
#pragma once

#include "io/VtkFile.h"

#include <optional>
#include <string>
#include <string_view>

namespace drystone
{

/// A field of the cells of a .vtp file that vtpBytes has formed; a vector of the plane comes back with its z.
/// \param bytes of the file \return nothing where it has none of that name, is damaged there, or is of
/// another program
std::optional<Field> cellField(std::string_view bytes, const std::string& name);

} // namespace drystone
