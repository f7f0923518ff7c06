// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What solvers do with the matrices of a ray program, in numbers of either precision: double, or
/// DoubleDouble.
#pragma once

#include "conic/RayProgram.h"

namespace drystone
{

template<class Scalar>
using RayVector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// out = B' y. \param y 3 (bodies + 1) + limits, ground zero \param out one entry a ray
template<class Scalar>
void applyRaysTransposed(const RayProgram& program, const RayVector<Scalar>& y, RayVector<Scalar>& out);

/// out += B s. \param out 3 (bodies + 1) + limits; the rows of the ground stay as they are
template<class Scalar>
void addRays(const RayProgram& program, const RayVector<Scalar>& s, RayVector<Scalar>& out);

/// Puts S = M + delta I + B diag(d) B' into the system, its diagonal entries raised by the share `relative`.
template<class Scalar>
void assembleSchur(const RayProgram& program, const RayVector<Scalar>& d, double delta, double relative,
                   SchurSystem<3, Scalar>& system);

/// Solves S x = right for bodies and limits with the factor of the bodies' part. \param d that S was
/// assembled with \param x right, replaced by the solution
template<class Scalar>
void solveWithLimits(const RayProgram& program, const RayVector<Scalar>& d, SchurSystem<3, Scalar>& system,
                     RayVector<Scalar>& x);

} // namespace drystone
