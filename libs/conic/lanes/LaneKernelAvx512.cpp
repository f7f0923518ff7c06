// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The lane kernel for processors with AVX-512 (x86-64-v4), which it alone is compiled for.
#include "conic/lanes/LaneLoop.h"

#if defined(__x86_64__)
namespace drystone
{

void solveLanesWithAvx512(LaneTask& task)
{
    LaneLoop<8>(task).run();
}

} // namespace drystone
#endif
