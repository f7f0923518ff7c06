// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Small matrices for lists of them. In this library like its vectors.
#pragma once

#include <Eigen/Core>

namespace drystone
{

/// Lists of them need no allocation of their own kind, which takes longer than what they are used for.
template<int Dim>
using PackedMatrix = Eigen::Matrix<double, Dim, Dim, Eigen::DontAlign>;

} // namespace drystone
