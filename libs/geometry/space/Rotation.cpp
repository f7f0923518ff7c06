// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rotations of space: rotation vectors, composed as quaternions.
#include "geometry/Rotation.h"

#include <Eigen/Geometry>

#include <cmath>

namespace drystone
{
namespace
{

/// sin(x)/x, to the last digits.
double sinc(double x)
{
    return std::abs(x) < 1e-8 ? 1 : std::sin(x) / x;
}

Eigen::Quaterniond quaternionOf(const Vector<3>& turn)
{
    const double angle = turn.norm();
    const Vector<3> axis = 0.5 * sinc(angle / 2) * turn;
    return {std::cos(angle / 2), axis.x(), axis.y(), axis.z()};
}

Vector<3> vectorOf(const Eigen::Quaterniond& turn)
{
    const double sine = turn.vec().norm(); // of half the angle
    if (sine == 0)
    {
        return Vector<3>::Zero();
    }
    const double sign = turn.w() < 0 ? -1 : 1;
    return sign * 2 * std::atan2(sine, std::abs(turn.w())) / sine * turn.vec();
}

} // namespace

Vector<3> turned(const Vector<3>& turn, const Vector<3>& arm)
{
    return arm + swing(turn, arm);
}

Swing<3>::Swing(const Vector<3>& turn) : axis(turn)
{
    const double angle = turn.norm();
    const double half = sinc(angle / 2);
    once = sinc(angle);
    twice = 0.5 * half * half;
}

Vector<3> velocityOfArm(const Vector<3>& angularVelocity, const Vector<3>& arm)
{
    return momentOf(angularVelocity, arm);
}

Vector<3> composed(const Vector<3>& first, const Vector<3>& then)
{
    return vectorOf((quaternionOf(then) * quaternionOf(first)).normalized());
}

Vector<3> turnBetween(const Vector<3>& from, const Vector<3>& to)
{
    return vectorOf((quaternionOf(to) * quaternionOf(from).conjugate()).normalized());
}

Vector<3> rowsOf(const Vector<3>& turn)
{
    return turn;
}

} // namespace drystone
