// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The dense kernel for processors with AVX-512 (x86-64-v4), which it alone is compiled for.
#include "linear/DenseKernelText.h"

#if defined(__x86_64__)
namespace drystone
{

void updateWithAvx512(const DenseUpdate& task, double* work)
{
    KernelText<8, 3, 8>::update(task, work);
}

} // namespace drystone
#endif
