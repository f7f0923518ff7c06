// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sums up what the points of a joint had, and gives each of the new ones the share of its area.
#include "statics/JointPoints.h"

namespace drystone
{

void shareOut(JointPoints<3>& joints, const std::vector<std::size_t>& pointsBefore)
{
    std::vector<double> friction;
    std::vector<Strength> strength;
    std::size_t first = 0;
    for (std::size_t joint = 0; joint < joints.patches.size(); ++joint)
    {
        const PatchCells& patch = joints.patches[joint];
        const std::size_t before = pointsBefore[joint];
        Strength total{0, 0, 0};
        for (std::size_t i = first; i < first + before; ++i)
        {
            total.cohesion += joints.strength[i].cohesion;
            total.tension += joints.strength[i].tension;
            total.crushing += joints.strength[i].crushing;
        }
        const std::vector<double> areas = vertexAreas(patch);
        double area = 0;
        for (const double part : areas)
        {
            area += part;
        }
        for (std::size_t i = 0; i < areas.size(); ++i)
        {
            const double share = areas[i] / area;
            friction.push_back(joints.friction[first]);
            // Infinite crushing times a vertex without an area is no number.
            strength.push_back(
                areas.size() == before ? joints.strength[first + i]
                : total.isBounded()
                    ? Strength{share * total.cohesion, share * total.tension, share * total.crushing}
                    : Strength{share * total.cohesion, share * total.tension, total.crushing});
        }
        first += before;
    }
    joints.points = pointsOf(joints.patches);
    joints.friction = std::move(friction);
    joints.strength = std::move(strength);
}

} // namespace drystone
