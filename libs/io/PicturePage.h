// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The page of a mechanism's picture, in the plane and in space: title and subtitle above, the drawing area,
/// a legend and a row of notes below.
#pragma once

#include "geometry/Box.h"
#include "io/Canvas.h"
#include "io/MechanismPicture.h"

namespace drystone
{

struct PicturePage
{
    double scale;     ///< [px/m]
    Vector<2> corner; ///< of the drawing area, upper left [px]
    Vector<2> room;   ///< its size [px]
    Canvas drawing;

    double legend() const { return corner.y() + room.y() + 14; } ///< where it begins, in y [px]
};

/// Where the legend and the notes begin, in x [px].
inline constexpr double leftOfLegend = 20;

/// The page with its titles. \param world size of what is drawn [m]: as wide as the page allows, and no
/// higher than 1.4 times that
PicturePage makePicturePage(const MechanismPicture& picture, const Vector<2>& world);

/// The row of notes below the legend: a scale bar of a round length, the load as an arrow, and what the
/// picture says of its motion. \param onPage the load's direction as it is seen, y downwards, of at most unit
/// length
void paintNotes(PicturePage& page, const MechanismPicture& picture, const Vector<2>& onPage);

/// Where an arrow of the load ends in the drawing area.
struct LoadTip
{
    Vector<2> place; ///< as it is seen, y upwards [m]
    double part = 1; ///< of the largest: the length of the arrow
};

/// The area with room for the arrows of the load, whose lengths are those of the page. \param area that is
/// shown without them, y upwards [m] \param onPage as for paintNotes
Box<2> areaWithLoads(const MechanismPicture& picture, const Box<2>& area, const std::vector<LoadTip>& tips,
                     const Vector<2>& onPage);

/// The arrows of the load in the drawing area. \param area that it shows, y upwards [m] \param onPage as for
/// paintNotes
void paintLoads(PicturePage& page, const Box<2>& area, const std::vector<LoadTip>& tips,
                const Vector<2>& onPage);

/// The load's arrow. \param onPage along it, as for paintNotes \param length from its tail to its tip, where
/// onPage is a unit vector [px]; a point where it is seen along its own direction
void paintLoadArrow(Canvas& drawing, const Vector<2>& tip, const Vector<2>& onPage, double length);

/// The largest of 1, 2 and 5 times a power of ten that is at most `length`, above 0.
double roundLength(double length);

} // namespace drystone
