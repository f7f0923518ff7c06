// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks of a step that are taken as one body: its program with fewer bodies, and the way back to all of
/// them.
#pragma once

#include "conic/ProgramPart.h"
#include "dynamics/Step.h"
#include "geometry/PackedMatrix.h"

#include <algorithm>

namespace drystone
{

/// Blocks of a step in groups that each move as one rigid body, some of them held as one with the ground. The
/// displacements of the blocks follow from those of the groups: with r the turn of a group, u the
/// displacement of its mass centre and a the arm from there to the mass centre of a block,
///
///     y = (u + (R(r) - 1) a, r) = T (u, r) + h(r),    T the linear part,    h = (B a, 0),  B = R(r) - 1 - r
///     x.
///
/// Columns and arms are those at the start of a step with theta 1. With T' from the left the balance of the
/// blocks, Mbar y + A c = f, is that of the groups, T'Mbar T (u, r) + T'A c = T'(f - Mbar h), from which the
/// forces among the blocks of a group drop out, as they do no work. Of T'Mbar h the forces are B times the
/// sum of m a, which is zero about the mass centre, and the moments those of sum m a a' B': they follow from
/// the group as a whole.
template<int Dim>
struct BlockGroups
{
    std::vector<int> group;               ///< of each free block, from 0; -1: held with the ground
    std::vector<std::vector<int>> blocks; ///< of each group
    std::vector<Vector<Dim>> arm;         ///< a of each free block, at the start of the step [m]
    /// Sum of m a a' over the blocks of each group, m of Mbar [N m]; zero of a single block.
    std::vector<PackedMatrix<Dim>> spread;
    std::vector<std::size_t> outer; ///< points between two groups, or between one and what is held or fixed
    std::vector<std::size_t> inner; ///< the other points

    int count() const { return static_cast<int>(blocks.size()); }
    int of(int body) const { return body < 0 ? -1 : group[static_cast<std::size_t>(body)]; }
    /// Whether a block shares its group with others, or is held.
    bool isBound(std::size_t body) const
    {
        return group[body] < 0 || blocks[static_cast<std::size_t>(group[body])].size() > 1;
    }
    /// Whether each group is one block.
    bool areSingle() const
    {
        return std::all_of(blocks.begin(), blocks.end(),
                           [](const std::vector<int>& ofGroup) { return ofGroup.size() == 1; });
    }
};

/// Mass centre of each free block at the start of the step [m].
template<int Dim>
std::vector<Vector<Dim>> centresOfBodies(const Step<Dim>& step);

/// \param group of each free block: any numbers from 0 on, or -1. They become consecutive
template<int Dim>
BlockGroups<Dim> blockGroups(const Step<Dim>& step, std::vector<int> group);

/// T' rows: forces on the groups, moments about their mass centres.
template<int Dim>
Eigen::VectorXd rowsOfGroups(const BlockGroups<Dim>& groups, const Eigen::VectorXd& rows);

/// T (u, r).
template<int Dim>
Eigen::VectorXd linearDisplacement(const BlockGroups<Dim>& groups, const Eigen::VectorXd& ofGroups);

/// y of all blocks, turned by finite angles. \param ofGroups (u, r) of each group \param which blocks that
/// are requested, others have zeros; empty: all
template<int Dim>
Eigen::VectorXd displacementOfBlocks(const BlockGroups<Dim>& groups, const Eigen::VectorXd& ofGroups,
                                     const std::vector<char>& which = {});

/// The program of all blocks with the outer points alone, in their order.
template<int Dim>
StepProgram<Dim> programOfBlocks(const BlockGroups<Dim>& groups, const StepProgram<Dim>& whole);

/// The program of the groups. \param ofBlocks see programOfBlocks
template<int Dim>
StepProgram<Dim> programOfGroups(const BlockGroups<Dim>& groups, const StepProgram<Dim>& ofBlocks);

/// What is known of the solution, for the groups: of displacements those with the momenta of the blocks.
/// \param program of the groups \param guess of all blocks and points
template<int Dim>
StepGuess guessOfGroups(const BlockGroups<Dim>& groups, const StepProgram<Dim>& ofBlocks,
                        const StepProgram<Dim>& program, const StepGuess& guess);

} // namespace drystone
