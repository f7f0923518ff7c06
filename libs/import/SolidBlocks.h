// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks from the solids of a file: scaled, welded, parted, turned outwards, their triangles merged and
/// their faces made plane. What is done is said on the log.
#pragma once

#include "assembly/Assembly.h"
#include "import/Solids.h"

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace drystone
{

/// Which axis of the file points upwards.
enum class UpAxis
{
    y, ///< as in most programs for pictures
    z
};

inline std::array<std::pair<std::string_view, UpAxis>, 2> namesOf(UpAxis)
{
    return {{{"z", UpAxis::z}, {"y", UpAxis::y}}};
}

/// What becomes of the interfaces of a file.
enum class Interfaces
{
    ignored, ///< joints are found from the shapes of the blocks
    contacts ///< they are the joints, their points the contact points
};

inline std::array<std::pair<std::string_view, Interfaces>, 2> namesOf(Interfaces)
{
    return {{{"ignored", Interfaces::ignored}, {"contacts", Interfaces::contacts}}};
}

struct SolidSettings
{
    double scale = 1; ///< metres a unit of the file
    UpAxis up = UpAxis::z;
    Vector<3> offset = Vector<3>::Zero();      ///< added to coordinates in metres, z upwards
    std::optional<double> tolerance = {};      ///< [m]; absent: see solidBlocks
    std::optional<Interfaces> interfaces = {}; ///< absent: contacts, where the file has some
};

/// The blocks of a file, in its order, zones and, where requested, joints with them. Corners within the
/// tolerance of each other are one; faces within it of a plane are made plane. Where no tolerance is given it
/// is 1.75 units of the last digit of the coordinates, the most by which rounding parts two corners, but at
/// most 0.005 of the mean size of the blocks. It becomes Assembly::jointTolerance. Where the coordinates have
/// all digits, it is 1e-6 of this size, corners of different blocks are left as they are, and faces that are
/// uneven by up to 1e-4 of it are made plane all the same. An interface of a solid that is several is that of
/// the nearest of them. \throws FatalIOError that names the solid and its line when it is none (see
/// findFault), or coordinates are beyond 1e6 m; where an interface has no area, or lies along no face of its
/// blocks
Assembly<3> solidBlocks(Solids solids, const SolidSettings& settings, const ImportedFile& file);

} // namespace drystone
