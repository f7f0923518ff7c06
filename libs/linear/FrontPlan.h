// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The fronts of a factor, where their rows and updates are, and in which order they are eliminated: the
/// symbolic analysis of FrontalCholesky.
#pragma once

#include "linear/BlockPattern.h"
#include "linear/FrontSchedule.h"

#include <cstddef>
#include <vector>

namespace drystone
{

/// One front of a factor.
template<int Rows>
struct Front
{
    int firstBody = 0;       ///< of its columns
    int lastBody = 0;        ///< one past
    int firstRow = 0;        ///< of its rows below the columns, in `rows`
    int lastRow = 0;         ///< one past
    int outerRow = 0;        ///< first of them that does not belong to a front of the same task
    std::size_t columns = 0; ///< where L11 and L21 are in `lower`
    std::size_t update = 0;  ///< where U is, until the parent has taken it
    bool isOfTask = false;   ///< then U is among those of a worker, but that of the task's last front
    std::vector<int> children;

    int width() const { return Rows * (lastBody - firstBody); }
    int below() const { return Rows * (lastRow - firstRow); }
    /// Rows of the whole, with empty ones up to whole vector registers.
    int height() const { return (width() + below() + 3) / 4 * 4; }
    /// From one column of U to the next, in whole vector registers.
    int updateStride() const { return (below() + 3) / 4 * 4; }
    /// Multiplications, about.
    double operations() const;
};

/// Depends on the patterns alone. Sizes are in numbers.
template<int Rows>
struct FrontPlan
{
    std::vector<Front<Rows>> fronts; ///< children before their parents
    std::vector<int> rows;           ///< bodies
    std::vector<int> inParent;       ///< of each of `rows`: the place of that body in the parent's front
    std::vector<int> inFront; ///< of each block of the matrix: the place of its row in its column's front
    FrontSchedule schedule;
    std::vector<int>
        outerPlace; ///< of each of `rows` that is not of its task: its place below the task's root
    std::size_t factorSize = 0;     ///< of all L11 and L21
    std::size_t updatesWaiting = 0; ///< for fronts above the tasks, at most
    std::size_t updatesOfTask = 0;  ///< at most
    int highest = 0;
};

/// Nothing is permuted. \param factor the pattern of L
template<int Rows>
FrontPlan<Rows> planFronts(const BlockPattern& matrix, const BlockPattern& factor);

} // namespace drystone
