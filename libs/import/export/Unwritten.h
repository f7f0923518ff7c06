// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a file for other programs has no place for: in this library, which knows the formats, so that no
/// export loses something without a word.
#pragma once

#include "assembly/Assembly.h"

#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// How many names of groups a format gives a block.
enum class WrittenZones
{
    first, ///< one, as a layer or a material
    all
};

/// What a format says of the joints of an assembly.
enum class WrittenJoints
{
    none, ///< who reads the file finds them from the shapes
    all
};

/// What a format has of the thickness of blocks of the plane.
enum class WrittenThickness
{
    none, ///< it draws outlines
    all   ///< blocks are solids
};

/// What a format holds of an assembly apart from the shapes of blocks and which of them are fixed.
struct WrittenProperties
{
    WrittenZones zones = WrittenZones::first;
    WrittenJoints joints = WrittenJoints::none;
    WrittenThickness thickness = WrittenThickness::all;
};

/// What the assembly says and a file of this format does not, a text for the user each. Empty: nothing is
/// lost.
template<int Dim>
std::vector<std::string> unwritten(const Assembly<Dim>& assembly, std::string_view format,
                                   const WrittenProperties& written);

} // namespace drystone
