// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What presses on faces. Internal to loads on surfaces.
#pragma once

#include "assembly/BlockSurface.h"

#include <functional>
#include <string>
#include <vector>

namespace drystone
{

/// Directions that differ by rounding only are the same.
inline constexpr double sameDirection = 1e-9;

/// What is left by rounding where all of a face is taken away, as a part of what was added up.
inline constexpr double roundingOfAreas = 1e-9;

/// A piece of a face, and which way it is pressed.
template<int Dim>
struct PressedPiece
{
    SurfacePiece<Dim> piece;
    Vector<Dim> direction = Vector<Dim>::Zero(); ///< force per area and pressure [-]
};

/// What presses on faces.
template<int Dim>
struct Tractions
{
    std::vector<PressedPiece<Dim>> pieces;
    std::function<double(const Vector<Dim>& place)> pressure; ///< linear over each piece [Pa]
    std::vector<std::string> remarks;                         ///< for the log
};

} // namespace drystone
