// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which fronts of a factor are eliminated by tasks of their own, and in which order all are: of
/// FrontalCholesky only.
#pragma once

#include <vector>

namespace drystone
{

/// Subtrees of the tree of fronts are independent of each other until their roots' parents, and of the same
/// size in walls: those of a batch are tasks that several threads carry out. The fronts above them follow one
/// after another. The schedule depends on the tree alone.
struct FrontSchedule
{
    /// A batch of subtrees, or one front.
    struct Step
    {
        int firstSubtree;
        int lastSubtree; ///< one past
        int front;       ///< where there is no subtree
        bool isShared;   ///< whether it is so much work that several threads are worth it
        bool isFront() const { return firstSubtree == lastSubtree; }
    };

    std::vector<std::vector<int>> subtrees; ///< fronts, children before their parents, the root last
    std::vector<Step> steps;
};

/// \param parent of each front, later than itself, or -1 \param operations of each, in multiplications
FrontSchedule scheduleFronts(const std::vector<int>& parent, const std::vector<double>& operations);

} // namespace drystone
