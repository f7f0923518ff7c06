// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sparse Cholesky factorisation of matrices made of small dense blocks: the factor for large systems.
#pragma once

#include "linear/FrontPlan.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace drystone
{

struct DenseUpdate;

/// S = L L' by fronts (Duff & Reid 1983). Columns of L with nearly the same rows form a front, a dense matrix
///
///     [ L11     ]   columns of the front
///     [ L21  U  ]   rows below them
///
/// in which L11 and L21 are found at once, and U = -L21 L21' is what these columns take from later ones. It
/// is added to the front of the first of them, the parent: a sum of dense matrices from the leaves of a tree
/// to its root.
///
/// In large systems several threads (core/Threads.h) share the subtrees and the rows of large fronts; what is
/// added to what, and in which order, depends on the pattern alone.
///
/// Memory: L and at most as much for the U that wait for their parents. Not for two callers at once.
template<int Rows>
class FrontalCholesky
{
public:
    using Block = Eigen::Matrix<double, Rows, Rows>;

    /// Symbolic analysis; nothing is permuted. \param factor the pattern of L
    FrontalCholesky(const BlockPattern& matrix, const BlockPattern& factor);

    /// Numeric factorisation of values on the pattern of the analysis. \return false at a pivot that is not
    /// positive
    bool factorise(const BlockPattern& matrix, const Block* values);

    /// Solves in place.
    void solve(Eigen::Ref<Eigen::VectorXd> x);
    /// Likewise for two right sides at once.
    void solve(Eigen::Ref<Eigen::VectorXd> one, Eigen::Ref<Eigen::VectorXd> other);
    /// Likewise with L rounded to single precision where that is quicker: half as much has to be fetched from
    /// memory.
    void solveRoughly(Eigen::Ref<Eigen::VectorXd> x);

private:
    /// Rows of a child that stand together in its parent's front, too.
    struct Run
    {
        int end;   ///< one past its last body below the child's columns
        int shift; ///< from the child's bodies to the parent's
    };
    /// What one of the threads works with.
    struct Worker
    {
        std::vector<double> updates; ///< of the fronts of a task
        std::vector<Run> runs;       ///< of `addUpdates`
        std::vector<double> packed;  ///< of the dense kernel, once it was needed
        std::vector<double> parts;   ///< of solves: one front's part of each right side
    };
    /// Bodies of a front, one past the last one too.
    struct Bodies
    {
        int begin;
        int end;
    };

    void provideWorkers();

    bool factoriseFront(const Front<Rows>& front, const BlockPattern& matrix, const Block* values,
                        Worker& worker);
    bool factoriseTogether(const Front<Rows>& front, const BlockPattern& matrix, const Block* values);
    void assembleColumns(const Front<Rows>& front, Bodies bodies, const BlockPattern& matrix,
                         const Block* values);
    void addUpdates(const Front<Rows>& front, Bodies into, Worker& worker);
    bool eliminateColumns(const Front<Rows>& front, Worker& worker);
    bool eliminateTogether(const Front<Rows>& front);
    void updateBelow(const Front<Rows>& front, Worker& worker);
    void updateTogether(const Front<Rows>& front);
    static void updateDensely(const DenseUpdate& task, Worker& worker);
    double* updateOf(const Front<Rows>& front, Worker& worker);

    /// Right sides in hand, and what the tasks of a batch do to those rows of them that are above the tasks.
    template<int Sides>
    struct RightSides
    {
        std::array<double*, Sides> x;
        std::array<double*, Sides> outer;
    };
    template<int Sides, class Scalar>
    void solveFor(const std::array<double*, Sides>& x, const Scalar* factor);
    template<int Sides, class Scalar>
    void forwardBatch(const FrontSchedule::Step& step, const std::array<double*, Sides>& x,
                      const Scalar* factor);
    template<int Sides, class Scalar>
    void forward(const Front<Rows>& front, const RightSides<Sides>& to, const Scalar* factor, Worker& worker);
    template<int Sides, class Scalar>
    void backward(const Front<Rows>& front, const std::array<double*, Sides>& x, const Scalar* factor,
                  Worker& worker);
    template<int Sides, class Scalar>
    void forwardTogether(const Front<Rows>& front, const Scalar* columns,
                         const std::array<double*, Sides>& part);
    template<int Sides, class Scalar>
    void backwardTogether(const Front<Rows>& front, const Scalar* columns,
                          const std::array<double*, Sides>& part);
    template<int Sides>
    std::array<double*, Sides> partsOf(Worker& worker) const;

    FrontPlan<Rows> plan;
    std::vector<double> lower;
    std::vector<float> rounded;  ///< L in single precision, once it was needed
    std::vector<double> updates; ///< that wait for fronts above the tasks
    std::vector<double> outer;   ///< of solves: what the tasks of a batch do to rows above them
    std::vector<Worker> workers;
};

extern template class FrontalCholesky<3>;
extern template class FrontalCholesky<6>;

} // namespace drystone
