// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Changes by Sherman & Morrison; where LU loses its digits, the minimal residuals of Saad & Schultz 1986.
#include "conic/coulomb/PieceMatrix.h"

#include <Eigen/QR>

#include <cmath>

namespace drystone
{
namespace
{

/// Changes of rank 1 from which the matrix is factorised anew: a solve costs a tenth of a factorisation or
/// less, and each change adds a product to it.
constexpr std::size_t mostUpdates = 24;

/// What a solution of the linear system may leave of the right-hand side, and the directions tried to
/// have it so.
constexpr double acceptedLoss = 1e-10;
constexpr int mostDirections = 30;

} // namespace

template<int Rows, int Forces>
bool PieceMatrix<Rows, Forces>::factorise(const std::vector<PointForce<Forces>>& pieces)
{
    derivatives.clear();
    for (const PointForce<Forces>& piece : pieces)
    {
        derivatives.push_back(piece.derivative);
    }
    changes.clear();
    ++factorisations;
    isReady =
        system.factorise(VectorXd::Constant(static_cast<Eigen::Index>(pieces.size()), stiffness), pieces);
    return isReady;
}

template<int Rows, int Forces>
bool PieceMatrix<Rows, Forces>::isFull() const
{
    return changes.size() >= mostUpdates;
}

template<int Rows, int Forces>
const typename PieceMatrix<Rows, Forces>::Change*
PieceMatrix<Rows, Forces>::change(int point, const Force& u, const Force& v, const Derivative& derivative)
{
    VectorXd rows = VectorXd::Zero(system.rows());
    system.addForce(point, stiffness * u, rows);
    Change change{point, v, solveByFactor(rows), 1};
    change.determinant += v.dot(system.closing(point, change.solved));
    if (change.determinant == 0 || !std::isfinite(change.determinant))
    {
        return nullptr;
    }
    derivatives[static_cast<std::size_t>(point)] = derivative;
    changes.push_back(std::move(change));
    return &changes.back();
}

/// From S0^-1 rows one change after the other.
template<int Rows, int Forces>
Eigen::VectorXd PieceMatrix<Rows, Forces>::solveByFactor(const VectorXd& rows)
{
    VectorXd solved = system.solve(rows);
    for (const Change& change : changes)
    {
        const double along = change.v.dot(system.closing(change.point, solved));
        solved -= along / change.determinant * change.solved;
    }
    return solved;
}

/// S times a direction.
template<int Rows, int Forces>
Eigen::VectorXd PieceMatrix<Rows, Forces>::times(const VectorXd& direction) const
{
    VectorXd change = stiffness * system.closings(direction);
    for (std::size_t point = 0; point < derivatives.size(); ++point)
    {
        const auto row = Forces * static_cast<Eigen::Index>(point);
        change.template segment<Forces>(row) =
            (derivatives[point] * change.template segment<Forces>(row)).eval();
    }
    return direction + system.forcesOnBodies(change);
}

/// LU without exchange of rows between blocks may lose all digits where blocks slide freely. What it leaves
/// is then of few dimensions, and the method of generalised minimal residuals (Saad & Schultz 1986), with LU
/// as its preconditioner, ends in as many steps.
template<int Rows, int Forces>
Eigen::VectorXd PieceMatrix<Rows, Forces>::solve(const VectorXd& rows)
{
    VectorXd solved = solveByFactor(rows);
    const double size = rows.norm();
    if (!((rows - times(solved)).norm() > acceptedLoss * size))
    {
        return solved;
    }
    Eigen::MatrixXd basis(rows.size(), mostDirections + 1);
    Eigen::MatrixXd directions(rows.size(), mostDirections);
    Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(mostDirections + 1, mostDirections);
    basis.col(0) = rows / size;
    for (int step = 0; step < mostDirections; ++step)
    {
        directions.col(step) = solveByFactor(basis.col(step));
        VectorXd next = times(directions.col(step));
        for (int pass = 0; pass < 2; ++pass)
        {
            const VectorXd along = basis.leftCols(step + 1).transpose() * next;
            next -= basis.leftCols(step + 1) * along;
            projected.col(step).head(step + 1) += along;
        }
        const double left = next.norm();
        projected(step + 1, step) = left;
        VectorXd target = VectorXd::Zero(step + 2);
        target[0] = size;
        const Eigen::MatrixXd matrix = projected.topLeftCorner(step + 2, step + 1);
        const VectorXd shares = matrix.colPivHouseholderQr().solve(target);
        const double residualLeft = (target - matrix * shares).norm();
        if (!(residualLeft > acceptedLoss * size) || step + 1 == mostDirections || !(left > 0))
        {
            return directions.leftCols(step + 1) * shares;
        }
        basis.col(step + 1) = next / left;
    }
    return solved;
}

template class PieceMatrix<3, 2>;
template class PieceMatrix<6, 3>;

} // namespace drystone
