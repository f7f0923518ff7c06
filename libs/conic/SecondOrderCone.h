// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The second-order cone K = {x : x0 >= |(x1 x2)|} of three dimensions: its Jordan algebra, the scaling of
/// Nesterov and Todd, and the projection onto it.
///
/// Every x has a frame, the eigenvectors (1, d)/2 and (1, -d)/2 with the unit vector d along (x1 x2), and
/// the eigenvalues x0 + |(x1 x2)| and x0 - |(x1 x2)|, both >= 0 in the cone. Products are x o y =
/// (x'y, x0 (y1 y2) + y0 (x1 x2)) with the unit e = (1 0 0) (Alizadeh & Goldfarb 2003).
#pragma once

#include <Eigen/Core>

namespace drystone
{

/// The smaller eigenvalue: how far x is inside (or, negative, outside) the cone.
double smallerEigenvalue(const Eigen::Vector3d& x);

/// x o y.
Eigen::Vector3d jordanProduct(const Eigen::Vector3d& x, const Eigen::Vector3d& y);

/// The v with x o v = y. \param x inside the cone
Eigen::Vector3d jordanDivide(const Eigen::Vector3d& x, const Eigen::Vector3d& y);

/// Largest step in [0, 1] that keeps x + step dx in the cone. \param x inside the cone
double stepToConeSurface(const Eigen::Vector3d& x, const Eigen::Vector3d& dx);

/// x with its eigenvalues brought into [low, high].
Eigen::Vector3d clampEigenvalues(const Eigen::Vector3d& x, double low, double high);

/// A symmetric matrix by its eigenvalues on the frame (1, d)/sqrt2, (1, -d)/sqrt2, (0, d turned by 90
/// degrees). Near the optimum they differ by a factor of 1e20: written as nine entries it would lose the
/// small ones.
struct FramedMatrix
{
    Eigen::Vector2d direction = Eigen::Vector2d::UnitX(); ///< d
    Eigen::Vector3d eigenvalues = Eigen::Vector3d::Ones();

    Eigen::Vector3d apply(const Eigen::Vector3d& x) const;
    /// The eigenvectors, by columns.
    Eigen::Matrix3d frame() const;
};

/// The point of the cone nearest to x, and the derivative there (symmetric, eigenvalues in [0, 1]).
struct ConeProjection
{
    Eigen::Vector3d point;
    FramedMatrix derivative;
};
ConeProjection projectOntoCone(const Eigen::Vector3d& x);

/// The symmetric matrix W with W z = W^-1 s =: lambda (Nesterov & Todd 1997). Its eigenvalues are eta spread,
/// eta / spread and eta.
struct NesterovToddScaling
{
    Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
    double spread = 1;
    double eta = 1;
    Eigen::Vector3d lambda = Eigen::Vector3d::UnitX();

    /// W x.
    Eigen::Vector3d apply(const Eigen::Vector3d& x) const;
    /// W^-1 x.
    Eigen::Vector3d applyInverse(const Eigen::Vector3d& x) const;
    /// D = (W^-2 + compliance I)^-1
    FramedMatrix squared(double compliance) const;
};
/// \param s, z inside the cone
NesterovToddScaling nesterovToddScaling(const Eigen::Vector3d& s, const Eigen::Vector3d& z);

} // namespace drystone
