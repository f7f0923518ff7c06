// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The linear algebra of a collapse path: a program in units of its own, and the tangent stiffness of its
/// points. Internal to CollapsePath.
#pragma once

#include "conic/coulomb/CollapsePiece.h"
#include "linear/BlockLu.h"

#include <optional>

namespace drystone
{

/// A program in units of a mean lever arm and of its largest loads, and K = A (k dc/dw) A'.
template<int Rows, int Forces>
class CollapseSystem
{
public:
    using Derivative = Eigen::Matrix<double, Forces, Forces>;
    using Body = Eigen::Matrix<double, Rows, Rows>;

    explicit CollapseSystem(const ConeProgram<Rows, Forces>& program);

    /// Rows of forces to units of the system and back are by factors; moments are divided by the lever arm,
    /// and rotations likewise when they go back.
    Eigen::VectorXd scaledRows(Eigen::VectorXd rows) const;

    /// A c
    Eigen::VectorXd columnsTimes(const Eigen::VectorXd& forces) const;
    /// A'v
    Eigen::VectorXd columnsTransposedTimes(const Eigen::VectorXd& displacement) const;

    /// k dc/dw of a point, from now on
    void change(int point, const Derivative& derivative);
    /// k dc/dw A'v
    Eigen::VectorXd forcesOf(Eigen::VectorXd closing) const;
    /// Brings the factor of K up to date. \return false where that fails
    bool factorise();
    /// (K + regularisation)^-1 rows
    Eigen::VectorXd solve(const Eigen::VectorXd& rows);

    double lever = 1;
    double force = 1; ///< the unit of forces
    double live = 1;  ///< the unit of the live load
    Eigen::VectorXd load, liveLoad;
    int factorisations = 0;
    int solves = 0;

private:
    void add(int point, const Derivative& derivative);

    int bodyCount;
    std::vector<ConeColumns<Rows, Forces>> pointColumns;
    std::vector<Derivative> derivatives; ///< of each point, as in the matrix
    std::vector<int> positions;          ///< of each body in elimination order
    std::vector<int> slots;              ///< of each point's pair in the pattern, or -1 on the ground
    BlockPattern patternOfK;
    std::vector<Body> lowerOfK, upperOfK;
    std::optional<BlockLu<Rows>> factorOfK;
    std::vector<int> changedColumns; ///< columns since the last factorisation
    bool isUpToDate = false;
    int changeCount = 0;         ///< of points since the matrix was summed up
    Eigen::VectorXd orderedRows; ///< work: rows in elimination order
};

extern template class CollapseSystem<3, 2>;
extern template class CollapseSystem<6, 3>;

} // namespace drystone
