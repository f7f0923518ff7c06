// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lays each joint along a line and compares moments about its ends with those of the stress block.
#include "statics/CrushingHinges.h"

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
    std::size_t first = 0, last = 0; ///< its points; the last one belongs to it
    Vector<2> axis{1, 0};
    std::vector<double> place; ///< of each point from the first end [m]
    Strength total;            ///< of all points

    double length() const { return place.back(); }
};

Joint jointFrom(const JointPoints<2>& joints, std::size_t first)
{
    Joint joint;
    joint.first = joint.last = first;
    joint.total.crushing = 0;
    while (joint.last + 1 < joints.points.size()
           && joints.points[joint.last + 1].joint == joints.points[first].joint)
    {
        ++joint.last;
    }
    const Vector<2>& origin = joints.points[first].position;
    joint.axis = (joints.points[joint.last].position - origin).normalized();
    for (std::size_t i = first; i <= joint.last; ++i)
    {
        joint.place.push_back((joints.points[i].position - origin).dot(joint.axis));
        joint.total.cohesion += joints.strength[i].cohesion;
        joint.total.tension += joints.strength[i].tension;
        joint.total.crushing += joints.strength[i].crushing;
    }
    return joint;
}

/// Where forces want a point, if they do.
void findHinge(const Joint& joint, const Eigen::VectorXd& forces, double tolerance,
               std::vector<double>& hinges)
{
    double resultant = joint.total.tension;
    double moment = joint.total.tension * joint.length() / 2; // about the first end
    for (std::size_t i = 0; i < joint.place.size(); ++i)
    {
        const double normal = forces[2 * static_cast<Eigen::Index>(joint.first + i)];
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

} // namespace

bool addCrushingHinges(JointPoints<2>& joints, const std::vector<Eigen::VectorXd>& contactForces,
                       double tolerance)
{
    JointPoints<2> result;
    for (std::size_t first = 0; first < joints.points.size();)
    {
        const Joint joint = jointFrom(joints, first);
        std::vector<double> hinges;
        for (const Eigen::VectorXd& forces : contactForces)
        {
            if (joint.total.isBounded())
            {
                findHinge(joint, forces, tolerance, hinges);
            }
        }
        const auto at = [](std::size_t index) { return static_cast<std::ptrdiff_t>(index); };
        const auto end = at(joint.last + 1);
        std::vector<ContactPoint<2>> points(joints.points.begin() + at(first), joints.points.begin() + end);
        std::vector<double> places = joint.place;
        for (const double hinge : hinges)
        {
            const auto next = std::lower_bound(places.begin(), places.end(), hinge);
            const double apart = samePlace * joint.length();
            if (next == places.begin() || next == places.end() || *next - hinge < apart
                || hinge - *(next - 1) < apart)
            {
                continue;
            }
            ContactPoint<2> point = joints.points[first];
            point.position += hinge * joint.axis;
            points.insert(points.begin() + (next - places.begin()), point);
            places.insert(next, hinge);
        }
        if (places.size() == joint.place.size())
        {
            result.points.insert(result.points.end(), points.begin(), points.end());
            result.friction.insert(result.friction.end(), joints.friction.begin() + at(first),
                                   joints.friction.begin() + end);
            result.strength.insert(result.strength.end(), joints.strength.begin() + at(first),
                                   joints.strength.begin() + end);
        }
        else
        {
            for (std::size_t i = 0; i < points.size(); ++i)
            {
                // Half the way to the neighbours, as in pointAreas.
                const double from = i > 0 ? places[i - 1] : places[i];
                const double to = i + 1 < places.size() ? places[i + 1] : places[i];
                const double share = (to - from) / 2 / joint.length();
                result.points.push_back(points[i]);
                result.friction.push_back(joints.friction[first]);
                result.strength.push_back({share * joint.total.cohesion, share * joint.total.tension,
                                           share * joint.total.crushing});
            }
        }
        first = joint.last + 1;
    }
    const bool isAny = result.points.size() > joints.points.size();
    joints = std::move(result);
    return isAny;
}

} // namespace drystone
