// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The matrix of a path's piece, factorised once and then changed point by point. Internal to ContactPath.
#pragma once

#include "conic/coulomb/ContactSystem.h"

namespace drystone
{

/// S = 1 + A k D A' of ContactSystem.h, k the same at all points, where D of one point after the other
/// changes by a product u v'. Each change costs one solve, which it adds to those that follow (Sherman &
/// Morrison): after some the matrix is better factorised anew.
///
/// Sizes: rows of bodies and displacements R b, in the units of the system.
template<int Rows, int Forces>
class PieceMatrix
{
public:
    using VectorXd = Eigen::VectorXd;
    using Force = Eigen::Matrix<double, Forces, 1>;
    using Derivative = Eigen::Matrix<double, Forces, Forces>;

    /// What a point's D has changed by since the factorisation, and what of it solutions need.
    struct Change
    {
        int point;
        Force v;
        VectorXd solved;    ///< S^-1 k A u, S before the change
        double determinant; ///< of S after the change over that before; neither 0 nor infinite
    };

    /// \param ofPoints whose columns it has; not owned \param ofEachPoint k [N/m]
    PieceMatrix(ContactSystem<Rows, Forces>& ofPoints, double ofEachPoint)
        : system(ofPoints), stiffness(ofEachPoint)
    {
    }
    PieceMatrix(const PieceMatrix&) = delete; // of one path, whose system it refers to
    PieceMatrix& operator=(const PieceMatrix&) = delete;

    /// \param pieces D of each point \return false where it cannot be factorised
    bool factorise(const std::vector<PointForce<Forces>>& pieces);
    bool isFactorised() const { return isReady; }
    /// Columns, or states of many points, have changed.
    void forget() { isReady = false; }
    void setStiffness(double ofEachPoint)
    {
        stiffness = ofEachPoint;
        forget();
    }

    bool isChanged() const { return !changes.empty(); }
    /// Whether the next change is better made by factorising.
    bool isFull() const;
    /// D of a point, until now `derivative` - u v'. \return null where there is no matrix then, and nothing
    /// has changed; valid until the next change
    const Change* change(int point, const Force& u, const Force& v, const Derivative& derivative);

    /// S^-1 rows, nearly exact also where the factor has lost its digits.
    VectorXd solve(const VectorXd& rows);

    int factorisations = 0;

private:
    VectorXd solveByFactor(const VectorXd& rows);
    VectorXd times(const VectorXd& direction) const;

    ContactSystem<Rows, Forces>& system;
    double stiffness;
    std::vector<Derivative> derivatives; ///< of each point now
    bool isReady = false;
    std::vector<Change> changes; ///< since it was factorised
};

extern template class PieceMatrix<3, 2>;
extern template class PieceMatrix<6, 3>;

} // namespace drystone
