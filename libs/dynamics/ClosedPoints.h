// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which points of a step can hold blocks at rest: what both proofs of rest need of its program.
#pragma once

#include "effects/Effect.h"

namespace drystone
{

/// Forces at rest are known to this part of the tolerance, so that sums and means of them meet it.
constexpr double partOfTolerance = 0.1;

/// Whether each point is closed, or so nearly that the certificate of rest allows a force there: the work of
/// a force on its gap is compared with that of the largest load on how far it would move its body in the
/// step. \param load of the bodies \param tolerance of the certificate
template<int Dim>
std::vector<char> closedPoints(const StepProgram<Dim>& program, const Eigen::VectorXd& load,
                               double tolerance);

} // namespace drystone
