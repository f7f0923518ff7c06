// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The dense kernel for any processor.
#include "linear/DenseKernelText.h"

namespace drystone
{

void updateWithBaseline(const DenseUpdate& task, double* work)
{
    KernelText<2, 2, 4>::update(task, work);
}

} // namespace drystone
