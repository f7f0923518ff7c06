// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which blocks the force of an axle of a moving load meets on its way.
#pragma once

#include "assembly/MovingLoad.h"

#include <limits>
#include <vector>

namespace drystone
{

/// What an axle meets: how far along its force, and the blocks there, ascending. None: it falls past all.
struct Landing
{
    double distance = std::numeric_limits<double>::infinity(); ///< [m]
    std::vector<int> blocks;
};

/// Of blocks that are met together the one of the lowest index carries a part of a force that is spread; its
/// share is none. \return -1 where there is none
int carrierOf(const Landing& landing);

/// A part of an axle's force on its way to the blocks.
template<int Dim>
struct Ray
{
    Vector<Dim> from = Vector<Dim>::Zero();
    Vector<Dim> direction = Vector<Dim>::Zero(); ///< of unit length
    double share = 1;                            ///< of the force of the axle
    Landing landing = {};
};

/// What a ray from a point meets. \param direction of unit length
template<int Dim>
Landing landingOf(const Assembly<Dim>& assembly, const Vector<Dim>& from, const Vector<Dim>& direction);

/// The parts of an axle's force, those that fall past all blocks left out. \param place of the axle on the
/// path [m]
template<int Dim>
std::vector<Ray<Dim>> raysOf(const Assembly<Dim>& assembly, const MovingLoadSettings<Dim>& settings,
                             const Vector<Dim>& place);

} // namespace drystone
