// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What solvers do with the matrices of a form, in numbers of either precision: double, or DoubleDouble.
#pragma once

#include "conic/form/Form.h"

namespace drystone
{

/// out = B' y. \param y Rows (bodies + 1) + limits, ground zero \param out as the cones
template<int Rows, class Scalar>
void applyTransposed(const Form<Rows>& form, const VectorOf<Scalar>& y, VectorOf<Scalar>& out);

/// out += B s. \param out Rows (bodies + 1) + limits; the rows of the ground stay as they are
template<int Rows, class Scalar>
void addForces(const Form<Rows>& form, const VectorOf<Scalar>& s, VectorOf<Scalar>& out);

/// out += M y, nothing without inertia.
template<int Rows, class Scalar>
void addInertia(const Form<Rows>& form, const VectorOf<Scalar>& y, VectorOf<Scalar>& out);

} // namespace drystone
