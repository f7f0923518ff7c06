// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the viewer inside a report shows: blocks as built and the frames of an animation, as JSON, with the
/// script that shows them.
#pragma once

#include "assembly/Assembly.h"
#include "io/FrameReader.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// What the times of an animation are.
struct AnimationTime
{
    std::string name = "time"; ///< before the number
    std::string unit;          ///< behind it, with a blank before: " s"
    double magnification = 1;  ///< of displacements, that the viewer begins with
};

/// The motion as JSON: `dimensions`, `timeName`, `timeUnit`, `magnification`; `blocks`, each with `vertices`
/// (x y z of one after the other, as built, from its centre [m]), `faces` (indices, outward by the right-hand
/// rule), `centre` of mass, from the middle of the free ones [m], and `fixed`; `frames`, each with `time`,
/// and `displacement` [m] and `rotation` (a vector [rad]) of one block after the other, `null` for a block
/// that the frame does not show. Blocks of the plane are prisms of their thickness about z = 0. Numbers have
/// six digits, which coordinates of a map need for themselves.
template<int Dim>
std::string viewerJson(const Assembly<Dim>& assembly, const std::vector<BlockFrame>& frames,
                       const AnimationTime& time);

/// The script of the viewer; nothing where the program was built without it.
std::optional<std::string> viewerScript();

/// The part of a page in which the viewer shows `json`. \param id of its data, unique on the page
std::string viewerMarkup(std::string_view json, std::string_view id);

} // namespace drystone
