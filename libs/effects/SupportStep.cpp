// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Fixed blocks on their way with a support.
#include "effects/SupportStep.h"

namespace drystone
{

template<int Dim>
bool isStill(const SupportStep<Dim>& step)
{
    return step.translation.isZero(0) && rowsOf(step.rotation).isZero(0);
}

template<int Dim>
BlockVector<Dim> displacementAfter(const SupportStep<Dim>& step, double share)
{
    BlockVector<Dim> displacement;
    const Turn<Dim> turn = share * step.rotation;
    displacement << share * step.translation + swing(turn, step.arm), rowsOf(turn);
    return displacement;
}

template<int Dim>
void moveWithSupports(std::vector<Placement<Dim>>& placements, const std::vector<SupportStep<Dim>>& steps,
                      double share)
{
    for (std::size_t block = 0; block < steps.size(); ++block)
    {
        const BlockVector<Dim> displacement = displacementAfter(steps[block], share);
        placements[block].translation += displacement.template head<Dim>();
        placements[block].rotation = composed(placements[block].rotation,
                                              turnOf<Dim>(displacement.template tail<rotationCount<Dim>>()));
    }
}

namespace
{

/// \param displacementOf the support of a block
template<int Dim, class Displacement>
Eigen::VectorXd closingBy(const std::vector<ContactPoint<Dim>>& points,
                          const std::vector<ContactColumns<Dim>>& columns,
                          const std::vector<SupportStep<Dim>>& supports, const Displacement& displacementOf)
{
    if (supports.empty())
    {
        return {};
    }
    Eigen::VectorXd closing(Dim * static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const auto part = [&](const typename ContactColumns<Dim>::Matrix& column, int block) -> Vector<Dim>
        { return column.transpose() * displacementOf(supports[static_cast<std::size_t>(block)]); };
        closing.segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
            part(columns[i].onBlock, points[i].block) + part(columns[i].onNeighbour, points[i].neighbour);
    }
    return closing;
}

} // namespace

template<int Dim>
Eigen::VectorXd closingBySupports(const std::vector<ContactPoint<Dim>>& points,
                                  const std::vector<ContactColumns<Dim>>& columns,
                                  const std::vector<SupportStep<Dim>>& supports)
{
    return closingBy(points, columns, supports,
                     [](const SupportStep<Dim>& step) { return displacementAfter(step); });
}

template<int Dim>
Eigen::VectorXd closingAtTheStart(const std::vector<ContactPoint<Dim>>& points,
                                  const std::vector<ContactColumns<Dim>>& columns,
                                  const std::vector<SupportStep<Dim>>& supports)
{
    return closingBy(points, columns, supports,
                     [](const SupportStep<Dim>& step)
                     {
                         BlockVector<Dim> displacement;
                         displacement << step.translation + velocityOfArm(step.rotation, step.arm),
                             rowsOf(step.rotation);
                         return displacement;
                     });
}

template Eigen::VectorXd closingAtTheStart(const std::vector<ContactPoint<2>>& points,
                                           const std::vector<ContactColumns<2>>& columns,
                                           const std::vector<SupportStep<2>>& supports);
template bool isStill(const SupportStep<2>& step);
template BlockVector<2> displacementAfter(const SupportStep<2>& step, double share);
template void moveWithSupports(std::vector<Placement<2>>& placements,
                               const std::vector<SupportStep<2>>& steps, double share);
template Eigen::VectorXd closingBySupports(const std::vector<ContactPoint<2>>& points,
                                           const std::vector<ContactColumns<2>>& columns,
                                           const std::vector<SupportStep<2>>& supports);
template Eigen::VectorXd closingAtTheStart(const std::vector<ContactPoint<3>>& points,
                                           const std::vector<ContactColumns<3>>& columns,
                                           const std::vector<SupportStep<3>>& supports);
template bool isStill(const SupportStep<3>& step);
template BlockVector<3> displacementAfter(const SupportStep<3>& step, double share);
template void moveWithSupports(std::vector<Placement<3>>& placements,
                               const std::vector<SupportStep<3>>& steps, double share);
template Eigen::VectorXd closingBySupports(const std::vector<ContactPoint<3>>& points,
                                           const std::vector<ContactColumns<3>>& columns,
                                           const std::vector<SupportStep<3>>& supports);

} // namespace drystone
