// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The weight, and the step, of structures that tests and benchmarks of motion make in memory.
#pragma once

#include "dynamics/DynamicCase.h"

namespace drystone
{

inline constexpr double g = 9.81;         ///< [m/s2]
inline constexpr double wallStep = 0.002; ///< of walls that stand or fall [s]

/// Has a scene of known masses under gravity from now on, with no other dead load. \param gravity [m/s2]
template<int Dim>
void setGravity(DynamicCase<Dim>& scene, const std::type_identity_t<Vector<Dim>>& gravity)
{
    scene.gravity = gravity;
    scene.deadLoad.rows = Eigen::VectorXd::Zero(scene.mass.size());
    for (Eigen::Index row = 0; row < scene.mass.size(); row += freedomCount<Dim>)
    {
        scene.deadLoad.rows.template segment<Dim>(row) = scene.mass[row] * gravity;
    }
}

} // namespace drystone
