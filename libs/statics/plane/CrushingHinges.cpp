// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lays each joint along a line and compares moments about its ends with those of the stress block.
#include "statics/CrushingHinges.h"

#include "contact/PointsOfJoints.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// Points nearer to each other than this part of the joint are one.
constexpr double samePlace = 1e-9;

/// A joint laid along a line.
struct Joint
{
    PointRange points;
    Vector<2> axis{1, 0};
    std::vector<double> place; ///< of each point from the first end [m]
    Strength total;            ///< of all points

    double length() const { return place.back(); }
};

Joint jointFrom(const JointPoints<2>& joints, const PointRange& points)
{
    Joint joint;
    joint.points = points;
    joint.total.crushing = 0;
    const Vector<2>& origin = joints.points[points.begin].position;
    joint.axis = (joints.points[points.end - 1].position - origin).normalized();
    for (std::size_t i = points.begin; i < points.end; ++i)
    {
        joint.place.push_back((joints.points[i].position - origin).dot(joint.axis));
        joint.total.cohesion += joints.strength[i].cohesion;
        joint.total.tension += joints.strength[i].tension;
        joint.total.crushing += joints.strength[i].crushing;
    }
    return joint;
}

/// Where forces want a point, if they do: at u from an end, where P lies nearer to it than u/2
/// (CrushingHinges.h).
void findHinge(const Joint& joint, const Eigen::VectorXd& forces, double tolerance,
               std::vector<double>& hinges)
{
    double resultant = joint.total.tension;
    double moment = joint.total.tension * joint.length() / 2; // about the first end
    for (std::size_t i = 0; i < joint.place.size(); ++i)
    {
        const double normal = forces[2 * static_cast<Eigen::Index>(joint.points.begin + i)];
        resultant += normal;
        moment += normal * joint.place[i];
    }
    const double depth = joint.length() * resultant / (joint.total.crushing + joint.total.tension);
    const double beyond = resultant * depth / 2;
    const double allowed = tolerance * resultant * joint.length();
    if (!(resultant > 0))
    {
        return;
    }
    if (beyond - moment > allowed)
    {
        hinges.push_back(depth);
    }
    if (beyond - (resultant * joint.length() - moment) > allowed)
    {
        hinges.push_back(joint.length() - depth);
    }
}

/// The points of a joint, with one more at each hinge that is not at one of them already.
struct DividedJoint
{
    std::vector<ContactPoint<2>> points;
    std::vector<double> places; ///< of each point from the first end [m]
};

DividedJoint dividedAt(const std::vector<double>& hinges, const Joint& joint,
                       const std::vector<ContactPoint<2>>& points)
{
    const ContactPoint<2>* first = &points[joint.points.begin];
    DividedJoint divided{{first, first + joint.points.size()}, joint.place};
    for (const double hinge : hinges)
    {
        const auto next = std::lower_bound(divided.places.begin(), divided.places.end(), hinge);
        const double apart = samePlace * joint.length();
        if (next == divided.places.begin() || next == divided.places.end() || *next - hinge < apart
            || hinge - *(next - 1) < apart)
        {
            continue;
        }
        ContactPoint<2> point = *first;
        point.position += hinge * joint.axis;
        divided.points.insert(divided.points.begin() + (next - divided.places.begin()), point);
        divided.places.insert(next, hinge);
    }
    return divided;
}

/// Adds a joint whose points are as they were, with what each bears.
void keep(const Joint& joint, const JointPoints<2>& joints, JointPoints<2>& result)
{
    const auto add = [&](const auto& from, auto& to)
    {
        const auto* first = &from[joint.points.begin];
        to.insert(to.end(), first, first + joint.points.size());
    };
    add(joints.points, result.points);
    add(joints.friction, result.friction);
    add(joints.strength, result.strength);
}

/// Adds a joint that has more points than before, its strength shared out by the lengths that they stand for:
/// half the way to either neighbour, as in pointAreas.
void share(const Joint& joint, const DividedJoint& divided, double friction, JointPoints<2>& result)
{
    const std::vector<double>& places = divided.places;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        const double from = i > 0 ? places[i - 1] : places[i];
        const double to = i + 1 < places.size() ? places[i + 1] : places[i];
        const double part = (to - from) / 2 / joint.length();
        result.points.push_back(divided.points[i]);
        result.friction.push_back(friction);
        result.strength.push_back(
            {part * joint.total.cohesion, part * joint.total.tension, part * joint.total.crushing});
    }
}

} // namespace

bool addCrushingHinges(JointPoints<2>& joints, const std::vector<Eigen::VectorXd>& contactForces,
                       double tolerance)
{
    JointPoints<2> result;
    for (const PointRange& points : pointsOfJoints(joints.points))
    {
        const Joint joint = jointFrom(joints, points);
        std::vector<double> hinges;
        for (const Eigen::VectorXd& forces : contactForces)
        {
            if (joint.total.isBounded())
            {
                findHinge(joint, forces, tolerance, hinges);
            }
        }
        const DividedJoint divided = dividedAt(hinges, joint, joints.points);
        if (divided.points.size() == points.size())
        {
            keep(joint, joints, result);
        }
        else
        {
            share(joint, divided, joints.friction[points.begin], result);
        }
    }
    const bool isAny = result.points.size() > joints.points.size();
    joints = std::move(result);
    return isAny;
}

} // namespace drystone
