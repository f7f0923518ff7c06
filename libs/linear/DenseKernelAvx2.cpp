// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The dense kernel for processors with AVX2 and FMA (x86-64-v3), which it alone is compiled for.
#include "linear/DenseKernelText.h"

#if defined(__x86_64__)
namespace drystone
{

void updateWithAvx2(const DenseUpdate& task, double* work)
{
    KernelText<4, 3, 4>::update(task, work);
}

} // namespace drystone
#endif
