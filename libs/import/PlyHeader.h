// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The header of a PLY file, which says what its data are.
#pragma once

#include "import/ImportedFile.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// Of one number, whatever the header calls it: `char` and `int8` are the same.
enum class PlyType
{
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    float32,
    float64
};

/// One value, or one list of values, of each element of a kind.
struct PlyProperty
{
    std::string name;
    PlyType type = PlyType::float32;
    std::optional<PlyType> count = {}; ///< of a list
};

/// So many elements with the same properties, one after the other.
struct PlyElement
{
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

/// How values are written: as words, or as bytes in either order.
enum class PlyFormat
{
    ascii,
    little,
    big
};

struct PlyHeader
{
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t end = 0; ///< byte where the data begins
    int lines = 0;       ///< of the header
};

/// \throws FatalIOError with the line of the first fault: an unknown word, type or format, a property of no
/// element, a header without an end
PlyHeader readPlyHeader(const ImportedFile& file);

} // namespace drystone
