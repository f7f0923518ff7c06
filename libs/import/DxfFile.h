// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a DXF file says, as it is written there: polylines, and blocks of them that are inserted. Internal to
/// the reader of DXF.
#pragma once

#include "import/Drawing.h"

#include <map>
#include <set>

namespace drystone
{

/// A polyline as it is drawn: corner i with the bulge of the segment that follows, the tangent of a quarter
/// of its angle.
struct DxfPolyline
{
    std::vector<Vector<2>> corners;
    std::vector<double> bulges;
    std::string layer;
    bool isClosed = false;
    bool isInvisible = false; ///< marked so, whatever its layer
    bool isMirrored = false;  ///< its extrusion direction is -z: x counts the other way
    int line = 0;
};

/// A block that is drawn at a place, or at a grid of places.
struct DxfInsert
{
    std::string block;
    std::string layer;
    Vector<2> place = Vector<2>::Zero();
    Vector<2> factor = Vector<2>::Ones();
    double angle = 0; ///< [rad]
    bool isInvisible = false;
    int columns = 1;
    int rows = 1;
    Vector<2> spacing = Vector<2>::Zero();
    int line = 0;
};

/// Entities of the drawing, or of a block.
struct DxfContent
{
    Vector<2> base = Vector<2>::Zero();
    std::vector<DxfPolyline> polylines;
    std::vector<DxfInsert> inserts;
};

struct DxfFile
{
    DxfContent entities;
    std::map<std::string, DxfContent, std::less<>> blocks;
    std::set<std::string, std::less<>> hidden; ///< layers that are off or frozen
    std::map<std::string, int> others;         ///< entities that are not read, by their names
    std::optional<double> unit;                ///< of the drawing [m]
    std::string unknownUnit;                   ///< what is said of one that is not known; or empty
    DigitCount digits;                         ///< of the corners
};

/// \throws FatalIOError where the file is damaged
DxfFile readDxfFile(const ImportedFile& file);

} // namespace drystone
