// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks that are computed no further.
#include "dynamics/Deletion.h"

namespace drystone
{

void deleteBlocks(const DynamicCase& scene, Motion& motion)
{
    if (!scene.contact.deletion || !motion.contacts)
    {
        return;
    }
    motion.isDeleted.resize(scene.free.size(), false);
    const auto& [lower, upper] = scene.contact.deletion->box;
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        const Vector<2> centre = scene.blocks[block].centroid + motion.state.placements[block].translation;
        const bool isOutside =
            centre.x() < lower[0] || centre.y() < lower[1] || centre.x() > upper[0] || centre.y() > upper[1];
        if (isOutside && scene.free[block] >= 0 && !motion.isDeleted[block])
        {
            motion.isDeleted[block] = true;
            motion.contacts->leaveOut(static_cast<int>(block));
            motion.state.velocity.segment<3>(3 * scene.free[block]).setZero();
        }
    }
}

void unloadDeleted(const DynamicCase& scene, const Motion& motion, Eigen::VectorXd& load)
{
    for (std::size_t block = 0; block < motion.isDeleted.size(); ++block)
    {
        if (motion.isDeleted[block])
        {
            load.segment<3>(3 * scene.free[block]).setZero();
        }
    }
}

} // namespace drystone
