// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The lane kernel for any processor.
#include "conic/lanes/LaneLoop.h"

namespace drystone
{

void solveLanesWithBaseline(LaneTask& task)
{
    LaneLoop<2>(task).run();
}

} // namespace drystone
