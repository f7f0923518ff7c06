// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Doubts become warnings.
#include "core/Doubt.h"

namespace drystone
{

void question(const std::vector<Doubt>& doubts)
{
    for (const Doubt& doubt : doubts)
    {
        printWarningOnce(doubt.text, doubt.place);
    }
}

} // namespace drystone
