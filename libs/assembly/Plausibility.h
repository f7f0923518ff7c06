// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Questions about an assembly that is correct and may not be what was meant.
#pragma once

#include "assembly/Assembly.h"
#include "core/Error.h"

#include <string>

namespace drystone
{

/// What is improbable of the sizes of blocks, as lengths in millimetres: the mean size of the free blocks, or
/// in the plane the largest or least thickness, and what is usual [m]. Empty when nothing is.
template<int Dim>
std::string doubtAboutSizes(const Assembly<Dim>& assembly);

/// Prints it as a warning that points at a place, once in a run.
template<int Dim>
void questionSizes(const Assembly<Dim>& assembly, const SourceLocation& place);

} // namespace drystone
