// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rotations of the plane: angles.
#include "geometry/Rotation.h"

#include <cmath>

namespace drystone
{

Vector<2> turned(double turn, const Vector<2>& arm)
{
    const double cosine = std::cos(turn);
    const double sine = std::sin(turn);
    return {cosine * arm.x() - sine * arm.y(), sine * arm.x() + cosine * arm.y()};
}

Swing<2>::Swing(double turn) : sine(std::sin(turn))
{
    const double half = std::sin(turn / 2);
    versine = 2 * half * half;
}

Vector<2> velocityOfArm(double angularVelocity, const Vector<2>& arm)
{
    return angularVelocity * perpendicular(arm);
}

double composed(double first, double then)
{
    return first + then;
}

double turnBetween(double from, double to)
{
    return to - from;
}

Eigen::Matrix<double, 1, 1> rowsOf(double turn)
{
    return Eigen::Matrix<double, 1, 1>(turn);
}

} // namespace drystone
