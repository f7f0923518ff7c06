// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The second-order cone K = {x : x0 >= |(x1 x2)|} of three dimensions: its Jordan algebra, the scaling of
/// Nesterov and Todd, and the projection onto it, in numbers of either precision. Round friction cones are
/// scaled to it; nothing here knows of friction. Numbers may be four (FourDoubles.h), of as many cones.
///
/// Every x has a frame, the eigenvectors (1, d)/2 and (1, -d)/2 with the unit vector d along (x1 x2), and
/// the eigenvalues x0 + |(x1 x2)| and x0 - |(x1 x2)|, both >= 0 in the cone. Products are x o y =
/// (x'y, x0 (y1 y2) + y0 (x1 x2)) with the unit e = (1 0 0) (Alizadeh & Goldfarb 2003).
#pragma once

#include "linear/FourDoubles.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace drystone
{

template<class Scalar>
using ConeVector = Eigen::Matrix<Scalar, 3, 1>;

/// A unit vector along (x1 x2), any where that vanishes. \param radius its length
template<class Scalar>
Eigen::Matrix<Scalar, 2, 1> directionOf(const ConeVector<Scalar>& x, const Scalar& radius)
{
    const auto isLong = radius > Scalar(0);
    return {choose(isLong, Scalar(x[1] / radius), Scalar(1)),
            choose(isLong, Scalar(x[2] / radius), Scalar(0))};
}

/// The smaller eigenvalue: how far x is inside (or, negative, outside) the cone.
template<class Scalar>
Scalar smallerEigenvalue(const ConeVector<Scalar>& x)
{
    return x[0] - x.template tail<2>().norm();
}

/// Product of the eigenvalues, x0^2 - |(x1 x2)|^2, without its cancellation.
template<class Scalar>
Scalar determinant(const ConeVector<Scalar>& x)
{
    const Scalar radius = x.template tail<2>().norm();
    return (x[0] - radius) * (x[0] + radius);
}

/// x o y.
template<class Scalar>
ConeVector<Scalar> jordanProduct(const ConeVector<Scalar>& x, const ConeVector<Scalar>& y)
{
    ConeVector<Scalar> product;
    product[0] = x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    product.template tail<2>() = x[0] * y.template tail<2>() + y[0] * x.template tail<2>();
    return product;
}

/// The v with x o v = y. \param x inside the cone \param determinantOfX its determinant
template<class Scalar>
ConeVector<Scalar> jordanDivide(const ConeVector<Scalar>& x, const Scalar& determinantOfX,
                                const ConeVector<Scalar>& y)
{
    ConeVector<Scalar> quotient;
    quotient[0] = (x[0] * y[0] - x[1] * y[1] - x[2] * y[2]) / determinantOfX;
    quotient.template tail<2>() = (y.template tail<2>() - quotient[0] * x.template tail<2>()) / x[0];
    return quotient;
}

/// The element with the frame of x and `change` of each eigenvalue of x: what a function of one number makes
/// of an element of the algebra.
template<class Scalar, class Function>
ConeVector<Scalar> onEigenvalues(const ConeVector<Scalar>& x, const Function& change)
{
    const Scalar radius = x.template tail<2>().norm();
    const Scalar larger = change(Scalar(x[0] + radius));
    const Scalar smaller = change(Scalar(x[0] - radius));
    ConeVector<Scalar> result;
    result[0] = (larger + smaller) * Scalar(0.5);
    result.template tail<2>() = ((larger - smaller) * Scalar(0.5)) * directionOf(x, radius);
    return result;
}

/// A symmetric matrix by its eigenvalues on the frame (1, d)/sqrt2, (1, -d)/sqrt2, (0, d turned by 90
/// degrees). Near the optimum they differ by a factor of 1e20: written as nine entries it would lose the
/// small ones.
template<class Scalar>
struct FramedMatrix
{
    Eigen::Matrix<Scalar, 2, 1> direction{Scalar(1), Scalar(0)}; ///< d
    ConeVector<Scalar> eigenvalues{Scalar(1), Scalar(1), Scalar(1)};

    ConeVector<Scalar> apply(const ConeVector<Scalar>& x) const
    {
        const Scalar along = direction[0] * x[1] + direction[1] * x[2];
        const Scalar plus = Scalar(0.5) * eigenvalues[0] * (x[0] + along);
        const Scalar minus = Scalar(0.5) * eigenvalues[1] * (x[0] - along);
        const Scalar across = eigenvalues[2] * (direction[0] * x[2] - direction[1] * x[1]);
        return {plus + minus, (plus - minus) * direction[0] - across * direction[1],
                (plus - minus) * direction[1] + across * direction[0]};
    }

    /// The eigenvectors, by columns.
    Eigen::Matrix<Scalar, 3, 3> frame() const
    {
        using std::sqrt;
        const Scalar half = sqrt(Scalar(0.5));
        Eigen::Matrix<Scalar, 3, 3> vectors;
        vectors.col(0) << half, half * direction[0], half * direction[1];
        vectors.col(1) << half, -half * direction[0], -half * direction[1];
        vectors.col(2) << Scalar(0), -direction[1], direction[0];
        return vectors;
    }
};

/// The point of the cone nearest to x, and the derivative there (symmetric, eigenvalues in [0, 1]).
struct ConeProjection
{
    Eigen::Vector3d point;
    FramedMatrix<double> derivative;
};

/// The positive parts of the eigenvalues on the same frame; off the frame the derivative is the difference
/// quotient of the two (Hayashi, Yamashita & Fukushima 2005).
inline ConeProjection projectOntoCone(const Eigen::Vector3d& x)
{
    const double radius = x.tail<2>().norm();
    const double larger = x[0] + radius;
    const double smaller = x[0] - radius;
    if (smaller >= 0)
    {
        return {x, {}};
    }
    if (larger <= 0)
    {
        return {Eigen::Vector3d::Zero(), {Eigen::Vector2d::UnitX(), Eigen::Vector3d::Zero()}};
    }
    const Eigen::Vector2d d = directionOf(x, radius);
    ConeProjection projection;
    projection.point[0] = 0.5 * larger;
    projection.point.tail<2>() = 0.5 * larger * d;
    projection.derivative = {d, {1, 0, larger / (larger - smaller)}};
    return projection;
}

/// The symmetric matrix W with W z = W^-1 s =: lambda (Nesterov & Todd 1997), and what is computed with it
/// many times at one iterate. W, W^-1 and D have one frame.
template<class Scalar>
struct NesterovToddScaling
{
    FramedMatrix<Scalar> W;       ///< eigenvalues eta spread, eta / spread, eta
    FramedMatrix<Scalar> inverse; ///< W^-1
    ConeVector<Scalar> lambda{Scalar(1), Scalar(0), Scalar(0)};
    Scalar determinant = 1; ///< of lambda, the root of those of s and z: without the cancellation of its own

    /// D = (W^-2 + compliance I)^-1
    FramedMatrix<Scalar> squared(const Scalar& compliance) const
    {
        FramedMatrix<Scalar> d = W;
        for (Scalar& root : d.eigenvalues)
        {
            root = Scalar(1) / (Scalar(1) / (root * root) + compliance);
        }
        return d;
    }
};

/// With s and z over the roots of their determinants, gamma^2 = (1 + s'z)/2 and J = diag(1, -1, -1), the
/// point w = (s + J z)/(2 gamma) has determinant 1 and W^2 = eta^2 (2 w w' - J) takes z to s. The eigenvalues
/// of 2 w w' - J are (w0 +- |(w1 w2)|)^2 and 1. \param s, z inside the cone
template<class Scalar>
NesterovToddScaling<Scalar> nesterovToddScaling(const ConeVector<Scalar>& s, const ConeVector<Scalar>& z)
{
    using std::sqrt;
    NesterovToddScaling<Scalar> scaling;
    const Scalar rootS = sqrt(determinant(s));
    const Scalar rootZ = sqrt(determinant(z));
    const Eigen::Matrix<Scalar, 2, 1> tail = s.template tail<2>() / rootS - z.template tail<2>() / rootZ;
    const Scalar product = s[0] * z[0] + s[1] * z[1] + s[2] * z[2];
    const Scalar gamma = sqrt(Scalar(0.5) * (1 + product / (rootS * rootZ)));
    const Scalar length = tail.norm();
    const Scalar radius = length / (2 * gamma);
    scaling.W.direction = directionOf(ConeVector<Scalar>(Scalar(0), tail[0], tail[1]), length);
    const Scalar spread = sqrt(1 + radius * radius) + radius;
    const Scalar eta = sqrt(rootS / rootZ);
    scaling.W.eigenvalues = {eta * spread, eta / spread, eta};
    scaling.inverse = {scaling.W.direction, {1 / (eta * spread), spread / eta, 1 / eta}};
    scaling.lambda = scaling.W.apply(z);
    scaling.determinant = rootS * rootZ;
    return scaling;
}

/// The frame of a vector x inside the cone, for steps from it: along it P, the automorphism that takes x to
/// e, divides by the eigenvalues of x, and across it by the root of their product.
template<class Number>
struct ConeFrame
{
    Eigen::Matrix<Number, 2, 1> direction;
    Number inverseLarger;
    Number inverseSmaller;
    Number inverseRoot;
};

template<class Number>
ConeFrame<Number> coneFrameOf(const ConeVector<Number>& x, const Number& determinantOfX)
{
    using std::sqrt;
    const Number radius = x.template tail<2>().norm();
    const Number larger = x[0] + radius;
    return {directionOf(x, radius), 1 / larger, larger / determinantOfX, 1 / sqrt(determinantOfX)};
}

/// P dx in coordinates along the eigenvectors and across them. Linear in dx.
template<class Number>
struct ConeSteepness
{
    Number plus;
    Number minus;
    Number across;

    /// The inverse of the longest step from x along dx: the largest eigenvalue of -P dx, so that it is
    /// negative where nothing limits the step.
    Number steepest() const
    {
        using std::sqrt;
        const Number half = 0.5 * (plus - minus);
        return sqrt(half * half + across * across) - 0.5 * (plus + minus);
    }
};

template<class Number>
ConeSteepness<Number> steepness(const ConeFrame<Number>& frame, const ConeVector<Number>& dx)
{
    const Number along = frame.direction[0] * dx[1] + frame.direction[1] * dx[2];
    const Number across = frame.direction[0] * dx[2] - frame.direction[1] * dx[1];
    return {(dx[0] + along) * frame.inverseLarger, (dx[0] - along) * frame.inverseSmaller,
            across * frame.inverseRoot};
}

} // namespace drystone
