// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What drawings of the plane say, in whatever format: closed outlines on layers, which become blocks.
#pragma once

#include "assembly/Assembly.h"
#include "import/ImportedFile.h"

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

struct DrawnOutline
{
    Polygon corners;   ///< in units of the drawing, y upwards, either orientation
    std::string layer; ///< empty: none
    int line = 0;      ///< of the file; 0: not known
};

struct Drawing
{
    std::vector<DrawnOutline> outlines;
    std::optional<double> unit = {}; ///< metres a unit of the drawing, where the file says it
    double rounding = 0; ///< unit of the last digit of coordinates as they are drawn, after scaling by
                         ///< transforms and inserts; 0: they have all digits
    std::vector<DrawnOutline> open = {};   ///< lines of three and more corners that are not closed, without
                                           ///< these: outlines of blocks, if someone forgot to close them
    std::vector<std::string> ignored = {}; ///< what was left out, a line each for the log: `12 entities TEXT`
};

/// How curves become chords.
struct ChordSettings
{
    int chordsPerCircle = 36; ///< a bulge has as many as it takes for its part of a circle, at least one
};

/// AutoCAD DXF, text form: closed LWPOLYLINE and POLYLINE of layers that are not frozen or off, also in
/// blocks that are inserted (moved, turned, scaled, in arrays, nested) on layers that are not frozen; bulges
/// as chords; $INSUNITS. What is marked invisible is left out. Open polylines whose ends meet are closed;
/// others, and other entities, are reported as ignored. \throws FatalIOError with the line
Drawing readDxf(const ImportedFile& file, const ChordSettings& chords);

/// SVG: `path` with straight segments (M L H V Z, absolute and relative), `polygon`, `polyline` whose ends
/// meet, `rect`, within groups, with transforms; the layer is the id or label of the group next to the svg
/// element. Curves and round corners are refused, hidden shapes (display, visibility, of groups too) left out
/// and counted. The unit follows from width, height, viewBox and preserveAspectRatio where width is in mm,
/// cm, m, in, pt or pc. \throws FatalIOError with the line
Drawing readSvg(const ImportedFile& file);

struct DrawingSettings
{
    std::optional<double> scale = {};     ///< metres a unit of the drawing; absent: as the file says, or 1
    Vector<2> offset = Vector<2>::Zero(); ///< added to coordinates in metres
    double thickness = 1;                 ///< out of plane [m]
    std::optional<double> tolerance = {}; ///< [m]; absent: 1.5 units of the last digit of the file
    std::vector<std::string> layers = {}; ///< that have blocks; empty: all
};

/// The blocks of a drawing, in its order, layers as zones. Corners nearer to each other than 1e-6 of the
/// outline's extent, or than the tolerance, are one. The tolerance becomes Assembly::jointTolerance. Without
/// one it is 1.5 units of the last digit of the coordinates, between 1e-6 and 1e-3 of the mean block size,
/// where there are oblique edges and the coordinates in metres do not have that digit for their last one as
/// well (writtenRounding); else none is stated. \throws FatalIOError with the line of an outline that is no
/// simple polygon, and when there is none, or none of a layer that is named
Assembly<2> drawnBlocks(const Drawing& drawing, const DrawingSettings& settings, const ImportedFile& file);

} // namespace drystone
