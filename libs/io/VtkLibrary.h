// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What VTK itself writes. Applications that step through time or solve do not link it: loading its libraries
/// takes longer than the limit analysis of a wall, and its writer longer than a step (vtpBytes writes the
/// same data directly).
#pragma once

#include "assembly/Assembly.h"
#include "io/VtkFile.h"

#include <filesystem>
#include <string>

namespace drystone
{

/// The bytes of a .vtp file as VTK's XML writer forms them, of the same data as vtpBytes.
/// \throws FatalError as vtpBytes, and when VTK fails
template<int Dim>
std::string vtpBytesOfVtk(const PolyData<Dim>& data);

/// The structure as built, as `VTK/assembly.vtp`.
template<int Dim>
void writeAssembly(const std::filesystem::path& file, const Assembly<Dim>& assembly);

} // namespace drystone
