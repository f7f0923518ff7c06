// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The page of a mechanism's picture, in the plane and in space: title and subtitle above, the drawing area,
/// room for a legend below.
#pragma once

#include "io/MechanismPicture.h"
#include "io/Svg.h"

namespace drystone
{

struct PicturePage
{
    double scale;     ///< [px/m]
    Vector<2> corner; ///< of the drawing area, upper left [px]
    Vector<2> room;   ///< its size [px]
    SvgDrawing drawing;

    double legend() const { return corner.y() + room.y() + 14; } ///< where it begins, in y [px]
};

/// The page with its titles. \param world size of what is drawn [m]: as wide as the page allows, and no
/// higher than 1.4 times that
PicturePage makePicturePage(const MechanismPicture& picture, const Vector<2>& world);

} // namespace drystone
