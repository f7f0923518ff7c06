// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// F by CHOLMOD: a unit of work that does not change when our own factorisation becomes faster.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

/// CPU time of one assembly of the Schur matrix of a program, its factorisation by CHOLMOD (one core, its own
/// choice of a simplicial or supernodal code on OpenBLAS, its own order in small systems and nested
/// dissection in large ones) and a solve: the least of several measurements [s]. conic/UnitOfWork.h has the
/// same with our own factor.
double cholmodUnitOfWork(const PlaneConeProgram& program);

} // namespace drystone
