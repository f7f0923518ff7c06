// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files in memory for the tests of this library.
#pragma once

#include "../ReportOf.h"

#include "geometry/space/Polyhedron.h"
#include "import/ImportedFile.h"

#include <string>

namespace drystone::test
{

inline ImportedFile fileOf(std::string bytes)
{
    return {"sample", std::move(bytes)};
}

/// The triangles of a polyhedron whose faces are convex.
inline Polyhedron triangulated(const Polyhedron& shape)
{
    Polyhedron result{shape.vertices, {}};
    for (const std::vector<int>& face : shape.faces)
    {
        for (std::size_t i = 1; i + 1 < face.size(); ++i)
        {
            result.faces.push_back({face[0], face[i], face[i + 1]});
        }
    }
    return result;
}

} // namespace drystone::test
