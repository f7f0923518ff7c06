// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Finite rotations: an angle in the plane, a rotation vector in space (its length the angle, right hand).
/// Both have the same functions, so that texts for either dimension can be written once.
#pragma once

#include "geometry/Vector.h"

#include <type_traits>

namespace drystone
{

/// How far something is turned [rad].
template<int Dim>
using Turn = std::conditional_t<Dim == 2, double, Vector<3>>;

/// None, and one by 1 rad, in space about z.
template<int Dim>
Turn<Dim> noTurn()
{
    if constexpr (Dim == 2)
    {
        return 0;
    }
    else
    {
        return Vector<3>::Zero();
    }
}
template<int Dim>
Turn<Dim> unitTurn()
{
    if constexpr (Dim == 2)
    {
        return 1;
    }
    else
    {
        return Vector<3>::UnitZ();
    }
}

/// An arm after the turn: R arm.
Vector<2> turned(double turn, const Vector<2>& arm);
Vector<3> turned(const Vector<3>& turn, const Vector<3>& arm);

/// By how much the ends of arms move in a turn: (R - 1) arm, to the last digits however small the turn is.
template<int Dim>
class Swing;

template<>
class Swing<2>
{
public:
    explicit Swing(double turn);
    Vector<2> operator()(const Vector<2>& arm) const { return across(arm) - along(arm); }

    // Its two parts, for sums to the last digit.
    Vector<2> across(const Vector<2>& arm) const { return sine * perpendicular(arm); }
    Vector<2> along(const Vector<2>& arm) const { return versine * arm; } ///< against the arm

private:
    double sine;
    double versine; ///< 1 - cos
};

/// By Rodrigues' formula.
template<>
class Swing<3>
{
public:
    explicit Swing(const Vector<3>& turn);
    Vector<3> operator()(const Vector<3>& arm) const
    {
        const Vector<3> across = momentOf(axis, arm);
        return once * across + twice * momentOf(axis, across);
    }

private:
    Vector<3> axis; ///< times the angle
    double once;
    double twice;
};

/// The same for one arm.
inline Vector<2> swing(double turn, const Vector<2>& arm)
{
    return Swing<2>(turn)(arm);
}
inline Vector<3> swing(const Vector<3>& turn, const Vector<3>& arm)
{
    return Swing<3>(turn)(arm);
}

/// The velocity of the end of an arm that turns with an angular velocity [rad/s].
Vector<2> velocityOfArm(double angularVelocity, const Vector<2>& arm);
Vector<3> velocityOfArm(const Vector<3>& angularVelocity, const Vector<3>& arm);

/// One turn after another: angles of the plane add, in space the matrices are multiplied. A turn of space has
/// an angle of at most pi.
double composed(double first, double then);
Vector<3> composed(const Vector<3>& first, const Vector<3>& then);

/// The turn that leads from one orientation to another: composed(from, it) is `to`.
double turnBetween(double from, double to);
Vector<3> turnBetween(const Vector<3>& from, const Vector<3>& to);

/// As the rows of rotation of a body (rz; rx ry rz), and back.
Eigen::Matrix<double, 1, 1> rowsOf(double turn);
Vector<3> rowsOf(const Vector<3>& turn);
template<int Dim>
Turn<Dim> turnOf(const Eigen::Matrix<double, rotationCount<Dim>, 1>& rows)
{
    if constexpr (Dim == 2)
    {
        return rows[0];
    }
    else
    {
        return rows;
    }
}

} // namespace drystone
