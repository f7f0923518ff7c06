// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// F, the unit in which the cost of solvers is stated: one assembly, factorisation and solve of the Schur
/// matrix.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

/// CPU time of one assembly, factorisation and solve of the Schur matrix of a program: the least of several
/// measurements, each of as many as take a tenth of a millisecond [s].
template<int Rows, int Forces>
double unitOfWork(const ConeProgram<Rows, Forces>& program);

} // namespace drystone
