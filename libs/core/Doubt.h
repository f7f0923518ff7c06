// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Input that can be computed and may not be what was meant, which any library may question.
#pragma once

#include "core/Error.h"

#include <string>
#include <vector>

namespace drystone
{

/// A doubt about the input: what is improbable and what is usual, and where it stands.
struct Doubt
{
    std::string text;
    SourceLocation place;
};

/// Prints them as warnings, each once in a run.
void question(const std::vector<Doubt>& doubts);

} // namespace drystone
