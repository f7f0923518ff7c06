// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/GroundMotion.h"

#include <fmt/format.h>

namespace drystone
{

Eigen::Vector3d groundAcceleration(const GroundMotion& motion, double time)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const GroundMotion::Component& component : motion.components)
        sum += component.acceleration->at(time) * component.direction;
    return sum;
}

Eigen::Vector3d meanGroundAcceleration(const GroundMotion& motion, double from, double to)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const GroundMotion::Component& component : motion.components)
        sum += component.acceleration->mean(from, to) * component.direction;
    return sum;
}

std::string summary(const GroundMotion& motion)
{
    if (motion.components.empty())
        return "Ground motion: none\n";
    std::string text;
    for (const GroundMotion::Component& component : motion.components)
    {
        const Eigen::Vector3d& d = component.direction;
        const GroundAcceleration& history = *component.acceleration;
        text += fmt::format("Ground motion along ({:.6g} {:.6g} {:.6g})\n", d.x(), d.y(), d.z());
        text += component.summary;
        text += fmt::format("    PGA         {:.6g} m/s2 = {:.6g} g\n", history.peak(),
                            history.peak() / standardGravity);
        const std::vector<double> kinks = history.kinks();
        if (kinks.empty())
            text += "    duration    unlimited\n";
        else
            text += fmt::format("    duration    {:.6g} s, from {:.6g} s to {:.6g} s\n",
                                kinks.back() - kinks.front(), kinks.front(), kinks.back());
    }
    return text;
}

} // namespace drystone
