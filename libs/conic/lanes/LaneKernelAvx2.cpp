// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The lane kernel for processors with AVX2 and FMA (x86-64-v3), which it alone is compiled for.
#include "conic/lanes/LaneLoop.h"

#if defined(__x86_64__)
namespace drystone
{

void solveLanesWithAvx2(LaneTask& task)
{
    LaneLoop<4>(task).run();
}

} // namespace drystone
#endif
