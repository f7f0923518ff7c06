// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Slips of corners on faces, and momenta of blocks that turn, in space.
#include "dynamics/MovingGeometry.h"

namespace drystone
{
namespace
{

/// How a point of a block, now at `position`, is displaced; to the last digits, however little that is [m].
Vector<3> displacementOf(const Step<3>& step, int block, const Vector<3>& position,
                         const BlockMotions<3>::Motion& motion)
{
    const auto index = static_cast<std::size_t>(block);
    const Vector<3> arm =
        position - step.scene.blocks[index].centroid - step.motion.state.placements[index].translation;
    return motion.translation + motion.swing(arm);
}

} // namespace

Shear<3> slip(const Step<3>& step, BlockMotions<3>& motions, std::size_t index,
              const ConeColumns<6, 3>& columns)
{
    const ContactPoint<3>& point = step.points[index];
    const int faceBlock = point.feature.vertexBlock == point.block ? point.neighbour : point.block;
    // The columns have the directions of shear where they were taken, 1 - theta of the way.
    const Swing<3> swing(step.scheme.theta * motions.of(faceBlock).turn);
    const Vector<3> slid = displacementOf(step, point.neighbour, point.position, motions.of(point.neighbour))
                           - displacementOf(step, point.block, point.position, motions.of(point.block));
    Shear<3> along;
    for (int component = 0; component < 2; ++component)
    {
        const Vector<3> direction = columns.onSecond.col(1 + component).head<3>();
        along[component] = (direction + swing(direction)).dot(slid);
    }
    return along;
}

double turnMomenta(const Step<3>& step, const Eigen::VectorXd& displacement,
                   const Eigen::VectorXd& contactForce, StepProgram<3>& program)
{
    const Eigen::VectorXd byContacts = applyEquilibrium(program, contactForce);
    const double timeStep = step.scheme.timeStep;
    const double damping = traitsOf(step.scene.effects).damping / timeStep;
    double error = 0;
    for (int body = 0; body < program.bodies; ++body)
    {
        const Eigen::Index row = 6 * body + 3;
        const Eigen::Matrix3d& tensor = step.mass.tensors[static_cast<std::size_t>(body)];
        const Vector<3> turn = displacement.segment<3>(row);
        Vector<3> momentum; // R1 J W1, from the moments, or from r = dt R0 W1 with theta 1
        if (!step.isShared.empty() && step.isShared[static_cast<std::size_t>(body)])
        {
            momentum = turned(turn, Vector<3>(tensor * turn / timeStep));
        }
        else
        {
            const Vector<3> moment = step.load.segment<3>(row) - byContacts.segment<3>(row);
            momentum = tensor * step.solved.velocity.segment<3>(row) + timeStep * moment;
        }
        Vector<3> load = step.program.load.segment<3>(row) + swing(Vector<3>(-turn), momentum) / timeStep;
        if (damping > 0 && step.scheme.theta < 1)
        {
            load -= swing(Vector<3>((step.scheme.theta - 1) * turn), Vector<3>(damping * (tensor * turn)));
        }
        BlockVector<3> change = BlockVector<3>::Zero();
        change.tail<3>() = load - program.load.segment<3>(row);
        const BlockVector<3> moved = solveBlock(program.inertia[static_cast<std::size_t>(body)], change);
        error = std::max(error, step.scene.blockSize * moved.tail<3>().norm());
        program.load.segment<3>(row) = load;
    }
    return error;
}

} // namespace drystone
