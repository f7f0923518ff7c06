// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The contents of one .vtp file as plain data, and its bytes: what everything else knows of VTK's format.
#pragma once

#include "geometry/Vector.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

enum class FieldType
{
    real,    ///< 64 bit floating point
    integer, ///< 32 bit; values must be whole
};

/// One quantity, with a value for every cell.
struct Field
{
    std::string name;           ///< with its unit, like the columns of tables: `displacement[m]`
    int components = 1;         ///< 1, or 2 or 3 for a vector; a plane vector is written with z = 0
    std::vector<double> values; ///< components x cells, the components of one cell following each other
    FieldType type = FieldType::real;
};

enum class CellKind
{
    polygon, ///< a polygon with its own vertices; fields are cell data
    point,   ///< a single point; fields are point data, as ParaView's glyphs require
};

/// Cells, of the plane z = 0 or of space, each with its own points.
template<int Dim>
struct PolyData
{
    CellKind kind = CellKind::polygon;
    std::vector<int> cellSizes;      ///< vertices of each polygon; left empty for points
    std::vector<Vector<Dim>> points; ///< polygon by polygon [m]
    std::vector<Field> fields;       ///< the first scalar and the first vector are what ParaView shows first
    std::vector<Field> pointFields;  ///< of polygons, with a value for every point; to be displayed only
};

template<int Dim>
std::size_t cellCount(const PolyData<Dim>& data);

/// \throws FatalError when a value is not finite, a field has not one value a cell or point, or sizes do not
/// add up; the message names the field and the cell
template<int Dim>
void checkPolyData(const PolyData<Dim>& data);

/// The bytes of a .vtp file: VTK's XML, arrays in base 64 of zlib's format, as VTK writes the same
/// data (vtpBytesOfVtk; a test compares what its reader makes of both). Coordinates, unless they are far from
/// the origin (isFarFromOrigin), and fields of the points of polygons are written in single precision, since
/// they are only displayed, other fields in double precision, since they are also used in computations.
///
/// \throws FatalError as checkPolyData
template<int Dim>
std::string vtpBytes(const PolyData<Dim>& data);

/// The same as a file, written whole or not at all.
template<int Dim>
void writeVtp(const std::filesystem::path& file, const PolyData<Dim>& data);

} // namespace drystone
