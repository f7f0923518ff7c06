// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What plane/ and space/ draw as text; the drawings themselves are there.
#include "io/MechanismPicture.h"

#include "io/SvgText.h"

namespace drystone
{

template<int Dim>
std::string mechanismSvg(const Assembly<Dim>& assembly, const std::vector<Placement<Dim>>& placements,
                         const MechanismPicture& picture)
{
    return svgText(drawnMechanism(assembly, placements, picture));
}

template std::string mechanismSvg(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                                  const MechanismPicture& picture);
template std::string mechanismSvg(const Assembly<3>& assembly, const std::vector<Placement<3>>& placements,
                                  const MechanismPicture& picture);
} // namespace drystone
