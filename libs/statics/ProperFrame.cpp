// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Axes, order and digits of a program of space that are its own, and the way back.
#include "statics/ProperFrame.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace drystone
{
namespace
{

using Columns = ConeColumns<6, 3>;
using Vector3 = Eigen::Vector3d;

/// What is kept of a number, relative to its unit: rounding is less than 1e-15 of it.
constexpr int keptBits = 34;
/// Places of points that differ by less are the same.
constexpr int bitsOfPlaces = 20;

/// A direction has to have so much of itself square to the axes before it.
constexpr double leastShare = 0.1;

/// A joint is on a side of a plane from this distance on, as a share of the mean lever arm.
constexpr double leastSide = 1e-3;

/// The power of two above a number, but not just above it.
double unitOf(double number)
{
    int exponent = 0;
    std::frexp(1.1 * number, &exponent);
    return std::ldexp(1.0, exponent);
}

double cutOff(double number, double unit, int bits = keptBits)
{
    const double digit = std::ldexp(unit, -bits);
    return std::nearbyint(number / digit) * digit;
}

/// The sum of the forces of a load, 6 rows a body.
Vector3 resultantOf(const Eigen::VectorXd& load)
{
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index row = 0; row < load.size(); row += 6)
    {
        sum += load.segment<3>(row);
    }
    return sum;
}

const Eigen::Matrix<double, 6, 3>& oneSide(const Columns& columns)
{
    return columns.first >= 0 ? columns.onFirst : columns.onSecond;
}

/// Where a point is, from the centre of a body: half the sum of f x m over its columns, m = a x f.
Vector3 armOf(const Columns& columns)
{
    const Eigen::Matrix<double, 6, 3>& side = oneSide(columns);
    Vector3 arm = Vector3::Zero();
    for (int column = 0; column < 3; ++column)
    {
        arm += 0.5 * Vector3(side.col(column).head<3>()).cross(Vector3(side.col(column).tail<3>()));
    }
    return arm;
}

/// One past the last of the points, from one on, that are of the same two bodies.
std::size_t endOfJoint(const std::vector<Columns>& contacts, std::size_t begin)
{
    std::size_t end = begin + 1;
    while (end < contacts.size() && contacts[end].first == contacts[begin].first
           && contacts[end].second == contacts[begin].second)
    {
        ++end;
    }
    return end;
}

/// On which side of a plane through the centres of its bodies the first joint is that is on either side.
double sideOf(const std::vector<Columns>& contacts, const Vector3& normal, double lever)
{
    for (std::size_t begin = 0; begin < contacts.size();)
    {
        const std::size_t end = endOfJoint(contacts, begin);
        double sum = 0;
        for (std::size_t point = begin; point < end; ++point)
        {
            sum += normal.dot(armOf(contacts[point]));
        }
        if (std::abs(sum) > leastSide * lever * static_cast<double>(end - begin))
        {
            return std::copysign(1.0, sum);
        }
        begin = end;
    }
    return 1;
}

/// Rows are the axes.
Eigen::Matrix3d axesOf(const SpaceConeProgram& structure, double lever)
{
    std::vector<Vector3> directions{resultantOf(structure.load), resultantOf(structure.liveLoad)};
    for (const Columns& columns : structure.contacts)
    {
        directions.emplace_back(oneSide(columns).col(0).head<3>());
    }
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    int found = 0;
    for (const Vector3& direction : directions)
    {
        Vector3 square = direction;
        for (int axis = 0; axis < found; ++axis)
        {
            square -= axes.row(axis).dot(square) * axes.row(axis).transpose();
        }
        if (square.norm() > leastShare * direction.norm())
        {
            axes.row(found++) = square.normalized().transpose();
        }
        if (found == 2)
        {
            const Vector3 third = Vector3(axes.row(0)).cross(Vector3(axes.row(1)));
            axes.row(2) = (sideOf(structure.contacts, third, lever) * third).transpose();
            return axes;
        }
    }
    return Eigen::Matrix3d::Identity();
}

/// Forces and moments of each body in the axes, of which moments, and rotations, know whether they are
/// right-handed.
template<class Matrix>
void turn(Matrix& rows, const Eigen::Matrix3d& axes)
{
    const Eigen::Matrix3d ofMoments = axes.determinant() * axes;
    for (Eigen::Index row = 0; row < rows.rows(); row += 6)
    {
        rows.template middleRows<3>(row) = (axes * rows.template middleRows<3>(row)).eval();
        rows.template middleRows<3>(row + 3) = (ofMoments * rows.template middleRows<3>(row + 3)).eval();
    }
}

/// The tangents of a point, columns, in those that it has: the first is nearest to the first axis, or the
/// second where that is nearly normal to the joint; with the normal they are right-handed.
Eigen::Matrix2d tangentsOf(const Columns& columns)
{
    constexpr double nearlyNormal = 0.9;
    const Eigen::Matrix<double, 6, 3>& side = oneSide(columns);
    const int axis = std::abs(side(0, 0)) < nearlyNormal * side.col(0).head<3>().norm() ? 0 : 1;
    const Eigen::Vector2d along = Eigen::Vector2d(side(axis, 1), side(axis, 2)).stableNormalized();
    const double hand = std::copysign(1.0, side.topRows<3>().determinant());
    Eigen::Matrix2d tangents;
    tangents << along[0], -hand * along[1], along[1], hand * along[0];
    return tangents;
}

/// The numbers of the points, those of the same two bodies in the order of their places.
std::vector<int> orderOf(const std::vector<Columns>& contacts, double lever)
{
    std::vector<std::array<double, 3>> places;
    for (const Columns& columns : contacts)
    {
        const Vector3 arm = armOf(columns);
        places.push_back({cutOff(arm[0], lever, bitsOfPlaces), cutOff(arm[1], lever, bitsOfPlaces),
                          cutOff(arm[2], lever, bitsOfPlaces)});
    }
    std::vector<int> order(contacts.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t begin = 0; begin < contacts.size();)
    {
        const std::size_t end = endOfJoint(contacts, begin);
        std::stable_sort(
            order.begin() + static_cast<std::ptrdiff_t>(begin),
            order.begin() + static_cast<std::ptrdiff_t>(end),
            [&](int one, int two)
            { return places[static_cast<std::size_t>(one)] < places[static_cast<std::size_t>(two)]; });
        begin = end;
    }
    return order;
}

/// Cuts off forces and moments, in 6 rows a body.
template<class Matrix>
void cutOffRows(Matrix& rows, double unit, double lever)
{
    for (Eigen::Index row = 0; row < rows.rows(); ++row)
    {
        for (Eigen::Index column = 0; column < rows.cols(); ++column)
        {
            rows(row, column) = cutOff(rows(row, column), row % 6 < 3 ? unit : unit * lever);
        }
    }
}

} // namespace

template<>
ProperFrame<3, 2>::ProperFrame(const PlaneConeProgram& structure) : program(structure)
{
}

template<>
CoulombPair ProperFrame<3, 2>::inGiven(const CoulombPair& pair) const
{
    return pair;
}

template<>
ProperFrame<6, 3>::ProperFrame(const SpaceConeProgram& structure)
    : program(structure), axes(axesOf(structure, meanLeverArm(structure)))
{
    const double lever = unitOf(meanLeverArm(structure));
    for (Eigen::VectorXd* load : {&program.load, &program.liveLoad})
    {
        turn(*load, axes);
        cutOffRows(*load, unitOf(load->lpNorm<Eigen::Infinity>()), lever);
    }
    for (Columns& columns : program.contacts)
    {
        for (Eigen::Matrix<double, 6, 3>* side : {&columns.onFirst, &columns.onSecond})
        {
            turn(*side, axes);
        }
    }
    places = orderOf(program.contacts, lever);
    const std::vector<Columns> turned = program.contacts;
    for (std::size_t point = 0; point < places.size(); ++point)
    {
        const auto from = static_cast<std::size_t>(places[point]);
        Columns& columns = program.contacts[point] = turned[from];
        shears.push_back(tangentsOf(columns));
        for (Eigen::Matrix<double, 6, 3>* side : {&columns.onFirst, &columns.onSecond})
        {
            side->rightCols<2>() = (side->rightCols<2>() * shears.back()).eval();
            cutOffRows(*side, 1, lever);
        }
        program.friction[point] = structure.friction[from];
        if (structure.hasStrength())
        {
            program.strength[point] = structure.strength[from];
        }
    }
}

template<>
CoulombPair ProperFrame<6, 3>::inGiven(const CoulombPair& pair) const
{
    CoulombPair given = pair;
    turn(given.mechanism, Eigen::Matrix3d(axes.transpose()));
    for (std::size_t point = 0; point < places.size(); ++point)
    {
        const Vector3 force = pair.contactForce.segment<3>(3 * static_cast<Eigen::Index>(point));
        auto turned = given.contactForce.segment<3>(3 * static_cast<Eigen::Index>(places[point]));
        turned[0] = force[0];
        turned.tail<2>() = shears[point] * force.tail<2>();
    }
    return given;
}

template class ProperFrame<3, 2>;
template class ProperFrame<6, 3>;

} // namespace drystone
