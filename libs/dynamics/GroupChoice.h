// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which blocks of a step are probably at rest, and which probably move as one: a guess that a proof follows.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// Gaps up to this are kept by blocks that move as one, a part of the error allowed in them [m].
template<int Dim>
double keptGap(const Step<Dim>& step);

/// How far each block moves, its turn times the size of a block included [m]; of velocities, how fast.
/// \param rows of the blocks
template<int Dim>
std::vector<double> motionsOfBlocks(const Eigen::VectorXd& rows, double blockSize);

/// A guess from the velocities at the start of the step, after its impacts, and from the forces of the last
/// one: blocks that are slower than 1e-9 of the fastest are held; others are one where they touch at a closed
/// point that carries a force, turn alike and have not moved against each other there, all to less than a gap
/// that is kept. Where that makes hardly fewer bodies, blocks about those that move are not held but
/// simulated, as a buffer: then what moves presses upon them with forces that they can hand on. Holds a
/// reference to the step.
template<int Dim>
class GroupChoice
{
public:
    explicit GroupChoice(const Step<Dim>& step);

    /// A number for each free block, the same for those that move as one; -1: held.
    const std::vector<int>& groups() const { return group; }

    /// Whether some blocks are simulated although they are slow enough to be held.
    bool hasBuffer() const { return isSlow != isHeld; }

    /// Whether a free block is slower than 1e-5 of the fastest.
    bool isCreeping(int body) const { return creeps[static_cast<std::size_t>(body)]; }

    /// How many bodies that makes, what is held aside.
    int bodies() const;

    /// Another guess with more bodies: blocks are one no longer where points between them fail, and blocks
    /// about those of such points that were held are awake. \param failing points of the program; none:
    /// blocks about all that are awake wake up, and none are one
    void change(const std::vector<std::size_t>& failing);

private:
    void holdSlowBlocks();
    void wakeAtMovingSupports(); ///< which take blocks along, or slide along them
    void joinBlocks();
    void wakeNeighbours(std::vector<char> isAwake);
    void wakeBuffer();
    void number();
    void partWholly(const std::vector<std::size_t>& failing);

    const Step<Dim>& current;
    std::vector<char> isSlow;   ///< of each free block: enough to be held
    std::vector<char> creeps;   ///< of each free block, see isCreeping
    std::vector<char> isHeld;   ///< of each free block: not simulated
    std::vector<char> isJoined; ///< of each point: its blocks move as one
    std::vector<int> group;
};

} // namespace drystone
