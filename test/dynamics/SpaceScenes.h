// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Structures in space in memory for the tests of motion.
#pragma once

#include "SceneGravity.h"

#include "dynamics/Advance.h"
#include "geometry/Rotation.h"

namespace drystone::spaceScenes
{

inline Block<3> boxBlock(const Vector<3>& lower, const Vector<3>& upper, int support = -1)
{
    Block<3> block;
    block.shape = makeBox(lower, upper);
    block.support = support;
    return block;
}

/// A box, turned about z, on ground under z = 0, as block 1; or in the air without ground, as block 0.
inline Assembly<3> boxOnGround(const Vector<3>& size, double turn)
{
    Assembly<3> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks.push_back(boxBlock({-5, -5, -1}, {5, 5, 0}, 0));
    assembly.blocks.push_back(boxBlock(-size / 2, size / 2));
    for (Vector<3>& vertex : assembly.blocks[1].shape.vertices)
    {
        vertex = turned(Vector<3>(0, 0, turn), vertex) + Vector<3>(0, 0, size.z() / 2);
        vertex.z() = vertex.z() < size.z() / 2 ? 0 : size.z();
    }
    return assembly;
}

inline Assembly<3> freeBox(const Vector<3>& size)
{
    Assembly<3> assembly;
    assembly.blocks.push_back(boxBlock(-size / 2, size / 2));
    return assembly;
}

inline DynamicCase<3> sceneOf(Assembly<3> assembly, double theta, double mu, const Vector<3>& gravity,
                              FlowRule flowRule = FlowRule::nonAssociative)
{
    DynamicCase<3> scene;
    const std::vector<double> densities(assembly.blocks.size(), 2000);
    setStructure(scene, std::move(assembly), densities);
    setGravity(scene, gravity);
    scene.contact.friction = CoulombFriction{mu, flowRule};
    scene.schemes.timeIntegration.theta = theta;
    scene.solution.tolerance = 1e-10;
    return scene;
}

} // namespace drystone::spaceScenes
