// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/SecondOrderCone.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// Product of the eigenvalues, x0^2 - |(x1 x2)|^2, without its cancellation.
double determinant(const Eigen::Vector3d& x)
{
    const double radius = x.tail<2>().norm();
    return (x[0] - radius) * (x[0] + radius);
}

/// x0 y0 - x1 y1 - x2 y2
double lorentzProduct(const Eigen::Vector3d& x, const Eigen::Vector3d& y)
{
    return x[0] * y[0] - x[1] * y[1] - x[2] * y[2];
}

Eigen::Vector2d directionOf(const Eigen::Vector3d& x, double radius)
{
    return radius > 0 ? Eigen::Vector2d(x.tail<2>() / radius) : Eigen::Vector2d::UnitX();
}

} // namespace

double smallerEigenvalue(const Eigen::Vector3d& x)
{
    return x[0] - x.tail<2>().norm();
}

Eigen::Vector3d jordanProduct(const Eigen::Vector3d& x, const Eigen::Vector3d& y)
{
    Eigen::Vector3d product;
    product[0] = x.dot(y);
    product.tail<2>() = x[0] * y.tail<2>() + y[0] * x.tail<2>();
    return product;
}

Eigen::Vector3d jordanDivide(const Eigen::Vector3d& x, const Eigen::Vector3d& y)
{
    Eigen::Vector3d quotient;
    quotient[0] = lorentzProduct(x, y) / determinant(x);
    quotient.tail<2>() = (y.tail<2>() - quotient[0] * x.tail<2>()) / x[0];
    return quotient;
}

/// The determinant of x + t dx is a t^2 + 2 b t + c; its first zero is c / (-b + sqrt(b^2 - a c)).
double stepToConeSurface(const Eigen::Vector3d& x, const Eigen::Vector3d& dx)
{
    const double a = determinant(dx);
    const double b = lorentzProduct(x, dx);
    const double c = determinant(x);
    const double discriminant = b * b - a * c;
    if ((a >= 0 && b >= 0) || discriminant < 0)
    {
        return 1;
    }
    const double root = -b + std::sqrt(discriminant);
    return root > c ? c / root : 1;
}

Eigen::Vector3d clampEigenvalues(const Eigen::Vector3d& x, double low, double high)
{
    const double radius = x.tail<2>().norm();
    const double larger = std::clamp(x[0] + radius, low, high);
    const double smaller = std::clamp(x[0] - radius, low, high);
    Eigen::Vector3d result;
    result[0] = 0.5 * (larger + smaller);
    result.tail<2>() = 0.5 * (larger - smaller) * directionOf(x, radius);
    return result;
}

/// The positive parts of the eigenvalues on the same frame; off the frame the derivative is the difference
/// quotient of the two (Hayashi, Yamashita & Fukushima 2005).
ConeProjection projectOntoCone(const Eigen::Vector3d& x)
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

Eigen::Vector3d FramedMatrix::apply(const Eigen::Vector3d& x) const
{
    const double along = direction.dot(x.tail<2>());
    const double plus = 0.5 * eigenvalues[0] * (x[0] + along);
    const double minus = 0.5 * eigenvalues[1] * (x[0] - along);
    const double across = eigenvalues[2] * (direction.x() * x[2] - direction.y() * x[1]);
    return {plus + minus, (plus - minus) * direction.x() - across * direction.y(),
            (plus - minus) * direction.y() + across * direction.x()};
}

Eigen::Matrix3d FramedMatrix::frame() const
{
    const double half = std::sqrt(0.5);
    Eigen::Matrix3d vectors;
    vectors.col(0) << half, half * direction;
    vectors.col(1) << half, -half * direction;
    vectors.col(2) << 0, -direction.y(), direction.x();
    return vectors;
}

Eigen::Vector3d NesterovToddScaling::apply(const Eigen::Vector3d& x) const
{
    return FramedMatrix{direction, {eta * spread, eta / spread, eta}}.apply(x);
}

Eigen::Vector3d NesterovToddScaling::applyInverse(const Eigen::Vector3d& x) const
{
    return FramedMatrix{direction, {1 / (eta * spread), spread / eta, 1 / eta}}.apply(x);
}

FramedMatrix NesterovToddScaling::squared(double compliance) const
{
    const auto eigenvalue = [compliance](double root) { return 1 / (1 / (root * root) + compliance); };
    return {direction, {eigenvalue(eta * spread), eigenvalue(eta / spread), eigenvalue(eta)}};
}

/// With s and z over the roots of their determinants, gamma^2 = (1 + s'z)/2 and J = diag(1, -1, -1), the
/// point w = (s + J z)/(2 gamma) has determinant 1 and W^2 = eta^2 (2 w w' - J) takes z to s. The eigenvalues
/// of 2 w w' - J are (w0 +- |(w1 w2)|)^2 and 1.
NesterovToddScaling nesterovToddScaling(const Eigen::Vector3d& s, const Eigen::Vector3d& z)
{
    NesterovToddScaling scaling;
    const double rootS = std::sqrt(determinant(s));
    const double rootZ = std::sqrt(determinant(z));
    const Eigen::Vector2d tail = s.tail<2>() / rootS - z.tail<2>() / rootZ;
    const double gamma = std::sqrt(0.5 * (1 + s.dot(z) / (rootS * rootZ)));
    const double radius = tail.norm() / (2 * gamma);
    scaling.direction = radius > 0 ? Eigen::Vector2d(tail / tail.norm()) : Eigen::Vector2d::UnitX();
    scaling.spread = std::sqrt(1 + radius * radius) + radius;
    scaling.eta = std::sqrt(rootS / rootZ);
    scaling.lambda = scaling.apply(z);
    return scaling;
}

} // namespace drystone
