// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Gaps and momenta of groups of blocks that turn: h(r) of BlockGroups.h.
#include "dynamics/TurnedGroups.h"

#include "geometry/Rotation.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// B of each group, which are not all single blocks.
template<int Dim>
class Bending
{
public:
    Bending(const BlockGroups<Dim>& ofGroups, const Eigen::VectorXd& displacement)
        : groups(ofGroups), bent(ofGroups.blocks.size(), PackedMatrix<Dim>::Zero())
    {
        for (std::size_t group = 0; group < bent.size(); ++group)
        {
            if (groups.blocks[group].size() > 1)
            {
                const auto rows = displacement.segment<freedomCount<Dim>>(
                    freedomCount<Dim> * static_cast<Eigen::Index>(group));
                const Turn<Dim> turn = turnOf<Dim>(rows.template tail<rotationCount<Dim>>());
                const Swing<Dim> swing(turn);
                for (int axis = 0; axis < Dim; ++axis)
                {
                    const Vector<Dim> arm = Vector<Dim>::Unit(axis);
                    bent[group].col(axis) = swing(arm) - velocityOfArm(turn, arm);
                }
            }
        }
    }

    /// A'h at the points of a program of the blocks.
    Eigen::VectorXd closing(const StepProgram<Dim>& ofBlocks) const
    {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(ofBlocks.gap.size());
        Eigen::Index row = 0;
        const auto add = [&](int body, const auto& onBody)
        {
            if (const int group = groups.of(body); group >= 0)
            {
                const Vector<Dim> moved = bent[static_cast<std::size_t>(group)].lazyProduct(
                    groups.arm[static_cast<std::size_t>(body)]);
                sum.segment<Dim>(row) += onBody.template topRows<Dim>().transpose().lazyProduct(moved);
            }
        };
        for (const auto& columns : ofBlocks.contacts)
        {
            add(columns.first, columns.onFirst);
            add(columns.second, columns.onSecond);
            row += Dim;
        }
        return sum;
    }

    /// Takes T'Mbar h from rows of the groups.
    void takeLoad(Eigen::VectorXd& rows) const
    {
        for (std::size_t group = 0; group < bent.size(); ++group)
        {
            auto moment =
                rows.segment<rotationCount<Dim>>(freedomCount<Dim> * static_cast<Eigen::Index>(group) + Dim);
            const Eigen::Matrix<double, Dim, Dim> product =
                groups.spread[group].lazyProduct(bent[group].transpose());
            if constexpr (Dim == 2)
            {
                moment[0] -= product(0, 1) - product(1, 0);
            }
            else
            {
                moment -= Vector<3>(product(1, 2) - product(2, 1), product(2, 0) - product(0, 2),
                                    product(0, 1) - product(1, 0));
            }
        }
    }

private:
    const BlockGroups<Dim>& groups;
    std::vector<PackedMatrix<Dim>> bent;
};

/// Which blocks a relinearisation needs: in the plane finite rotations change gaps and no momenta, so that
/// it is those at the points. \return empty: of all
template<int Dim>
std::vector<char> blocksThatMatter(const BlockGroups<Dim>& groups, const StepProgram<Dim>& ofBlocks)
{
    std::vector<char> atPoints;
    if constexpr (Dim == 2)
    {
        atPoints.resize(groups.group.size());
        for (const auto& columns : ofBlocks.contacts)
        {
            for (const int body : {columns.first, columns.second})
            {
                if (body >= 0)
                {
                    atPoints[static_cast<std::size_t>(body)] = true;
                }
            }
        }
    }
    return atPoints;
}

/// T'f with the momenta of the end of a step, which only blocks that turn in space change. \param ofGroups
/// their program as it was made
template<int Dim>
Eigen::VectorXd loadAtEnd(const BlockGroups<Dim>& groups, const StepProgram<Dim>& ofBlocks,
                          const StepProgram<Dim>& ofGroups)
{
    return Dim == 2 ? ofGroups.load : rowsOfGroups(groups, ofBlocks.load);
}

} // namespace

template<int Dim>
Relinearisation<Dim> relinearisationOfGroups(const Step<Dim>& step, const BlockGroups<Dim>& groups,
                                             StepProgram<Dim>& ofBlocks, const StepProgram<Dim>& ofGroups)
{
    if (!step.relinearise)
    {
        return {};
    }
    return [&step, &groups, &ofBlocks, &ofGroups, which = blocksThatMatter<Dim>(groups, ofBlocks)](
               const Eigen::VectorXd& displacement, const Eigen::VectorXd& contactForce,
               StepProgram<Dim>& program)
    {
        const Eigen::VectorXd y = displacementOfBlocks(groups, displacement, which);
        if (groups.areSingle())
        {
            std::swap(ofBlocks.gap, program.gap);
            const double error = step.relinearise(y, contactForce, ofBlocks);
            program.gap = ofBlocks.gap;
            program.load = loadAtEnd(groups, ofBlocks, ofGroups);
            return error;
        }
        // The gaps at the end that the groups have predicted: g - A'y of the blocks, A'h of it by bending.
        const Bending<Dim> bending(groups, displacement);
        const Eigen::VectorXd bent = bending.closing(ofBlocks);
        ofBlocks.gap = program.gap + bent;
        const double error = step.relinearise(y, contactForce, ofBlocks);
        program.gap = ofBlocks.gap - bent;
        Eigen::VectorXd load = loadAtEnd(groups, ofBlocks, ofGroups);
        bending.takeLoad(load);
        const double moved =
            farthestMotion<Dim>(displacementUnder(program, load - program.load), step.scene.blockSize);
        program.load = std::move(load);
        return std::max(error, moved);
    };
}

template<int Dim>
Eigen::VectorXd balancedDisplacement(const BlockGroups<Dim>& groups, const StepProgram<Dim>& ofBlocks,
                                     const StepProgram<Dim>& program, const Eigen::VectorXd& contactForce,
                                     Eigen::VectorXd ofGroups)
{
    constexpr int mostRounds = 8; // each leaves of the last the part by which a group turns
    constexpr double lastDigits = 1e-15;
    const Eigen::VectorXd straight =
        loadAtEnd(groups, ofBlocks, program) - applyEquilibrium(program, contactForce);
    for (int round = 0; round < mostRounds; ++round)
    {
        Eigen::VectorXd rows = straight;
        Bending<Dim>(groups, ofGroups).takeLoad(rows);
        const Eigen::VectorXd next = displacementUnder<Dim>(program, std::move(rows));
        const double change = (next - ofGroups).template lpNorm<Eigen::Infinity>();
        ofGroups = next;
        if (change <= lastDigits * ofGroups.lpNorm<Eigen::Infinity>())
        {
            break;
        }
    }
    return ofGroups;
}

template Relinearisation<2> relinearisationOfGroups(const Step<2>& step, const BlockGroups<2>& groups,
                                                    StepProgram<2>& ofBlocks, const StepProgram<2>& ofGroups);
template Eigen::VectorXd balancedDisplacement(const BlockGroups<2>& groups, const StepProgram<2>& ofBlocks,
                                              const StepProgram<2>& program,
                                              const Eigen::VectorXd& contactForce, Eigen::VectorXd ofGroups);
template Relinearisation<3> relinearisationOfGroups(const Step<3>& step, const BlockGroups<3>& groups,
                                                    StepProgram<3>& ofBlocks, const StepProgram<3>& ofGroups);
template Eigen::VectorXd balancedDisplacement(const BlockGroups<3>& groups, const StepProgram<3>& ofBlocks,
                                              const StepProgram<3>& program,
                                              const Eigen::VectorXd& contactForce, Eigen::VectorXd ofGroups);

} // namespace drystone
