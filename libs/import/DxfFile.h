// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a DXF file says, as it is written there: polylines, and blocks of them that are inserted. Internal to
/// the reader of DXF.
#pragma once

#include "import/Drawing.h"

#include <map>
#include <set>
#include <string_view>

namespace drystone
{

/// What all entities have.
struct DxfEntity
{
    std::string layer;
    std::string_view leftOut; ///< what is said of it where it is not drawn, whatever its layer; or empty
    bool isMirrored = false;  ///< its extrusion direction is -z: its x counts the other way
    bool isTilted = false;    ///< its extrusion direction has other parts than z
    int line = 0;
};

/// A polyline as it is drawn: corner i with the bulge of the segment that follows, the tangent of a quarter
/// of its angle.
struct DxfPolyline : DxfEntity
{
    std::vector<Vector<2>> corners;
    std::vector<double> bulges;
    bool isClosed = false;
};

/// A block that is drawn at a place, or at a grid of places.
struct DxfInsert : DxfEntity
{
    std::string block;
    Vector<2> place = Vector<2>::Zero();
    Vector<2> factor = Vector<2>::Ones();
    double angle = 0; ///< [rad]
    int columns = 1;
    int rows = 1;
    Vector<2> spacing = Vector<2>::Zero();
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
    std::map<std::string, DxfContent> blocks; ///< by their names in lower case: capitals make no difference
    std::set<std::string> hidden;             ///< layers that are off or frozen, likewise
    std::set<std::string> frozen;             ///< those that are frozen: inserts on them are not drawn at all
    std::map<std::string, int> others;        ///< entities that are not read, by their names
    std::optional<double> unit;               ///< of the drawing [m]
    std::string unknownUnit;                  ///< what is said of one that is not known; or empty
    DigitCount digits;                        ///< of the corners
};

/// \throws FatalIOError where the file is damaged
DxfFile readDxfFile(const ImportedFile& file);

} // namespace drystone
