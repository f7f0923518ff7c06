// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The Schur matrix of a form, in numbers of either precision: assembly from the weights of its cones, and
/// solution with the rows of limits, which are not in the matrix.
#pragma once

#include "conic/form/Form.h"

namespace drystone
{

/// Puts S = M + delta I + B D B' into the system, its diagonal entries raised by the share `relative`.
template<int Rows, class Scalar>
void assembleSchur(const Form<Rows>& form, const ConeWeights<Scalar>& d, double delta, double relative,
                   SchurSystem<Rows, Scalar>& system);

/// Solves S x = right for bodies and limits with the factor of the bodies' part. \param d that S was
/// assembled with \param x right, replaced by the solution
template<int Rows, class Scalar>
void solveWithLimits(const Form<Rows>& form, const ConeWeights<Scalar>& d, SchurSystem<Rows, Scalar>& system,
                     VectorOf<Scalar>& x);

} // namespace drystone
