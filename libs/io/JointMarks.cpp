// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rates in each contact frame say what points of a joint do; hulls are by Andrew's monotone chain.
#include "io/JointMarks.h"

#include "contact/PointsOfJoints.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace drystone
{
namespace
{

constexpr double still = 1e-3; ///< relative to the fastest joint

/// Rate of a block at a place.
template<int Dim>
Vector<Dim> rateAt(const Rates<Dim>& rates, const std::vector<BlockMass<Dim>>& masses, int block,
                   const Vector<Dim>& place)
{
    const auto rate = rates.col(block);
    const Vector<Dim> arm = place - masses[static_cast<std::size_t>(block)].centroid;
    if constexpr (Dim == 2)
    {
        return rate.template head<2>() + rate(2) * Vector<2>(-arm.y(), arm.x());
    }
    else
    {
        const Vector<3> turn = rate.template tail<3>();
        return rate.template head<3>() + momentOf(turn, arm); // turn x arm, the moment of `turn` as a force
    }
}

Vector<3> inSpace(const Vector<2>& place)
{
    return {place.x(), place.y(), 0};
}
const Vector<3>& inSpace(const Vector<3>& place)
{
    return place;
}

/// The two places that are farthest apart; one where there is one.
std::vector<Vector<3>> endsOf(const std::vector<Vector<3>>& places)
{
    if (places.size() < 2)
    {
        return places;
    }
    std::vector<Vector<3>> ends{places[0], places[1]};
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            if ((places[i] - places[j]).norm() > (ends[1] - ends[0]).norm())
            {
                ends = {places[j], places[i]};
            }
        }
    }
    return ends;
}

/// The ends of a joint of the plane.
std::vector<Vector<3>> hullOf(const std::vector<ContactPoint<2>>& points, const PointRange& joint)
{
    std::vector<Vector<3>> places;
    for (std::size_t i = joint.begin; i < joint.end; ++i)
    {
        places.push_back(inSpace(points[i].position));
    }
    return endsOf(places);
}

/// The convex hull of the points of a joint, in order round it (Andrew's monotone chain).
std::vector<Vector<3>> hullOf(const std::vector<ContactPoint<3>>& points, const PointRange& joint)
{
    const Eigen::Matrix3d frame = contactFrame(points[joint.begin]);
    struct Place
    {
        Vector<2> inPlane;
        Vector<3> position;
    };
    std::vector<Place> places;
    for (std::size_t i = joint.begin; i < joint.end; ++i)
    {
        const Vector<3> arm = points[i].position - points[joint.begin].position;
        places.push_back({{frame.col(1).dot(arm), frame.col(2).dot(arm)}, points[i].position});
    }
    std::sort(places.begin(), places.end(),
              [](const Place& one, const Place& two) {
                  return std::pair(one.inPlane.x(), one.inPlane.y())
                         < std::pair(two.inPlane.x(), two.inPlane.y());
              });
    std::vector<Place> hull;
    for (int side = 0; side < 2; ++side)
    {
        const std::size_t start = hull.size();
        for (const Place& place : places)
        {
            while (hull.size() >= start + 2
                   && cross(hull.back().inPlane - hull[hull.size() - 2].inPlane,
                            place.inPlane - hull.back().inPlane)
                          <= 0)
            {
                hull.pop_back();
            }
            hull.push_back(place);
        }
        hull.pop_back(); // the first of the other side
        std::reverse(places.begin(), places.end());
    }
    std::vector<Vector<3>> corners;
    for (const Place& place : hull)
    {
        corners.push_back(place.position);
    }
    return corners;
}

/// How fast the two sides of each point part and slip.
template<int Dim>
std::vector<Vector<Dim>> ratesApart(const Assembly<Dim>& assembly,
                                    const std::vector<ContactPoint<Dim>>& points, const Rates<Dim>& rates)
{
    const std::vector<BlockMass<Dim>> masses = blockMasses(assembly);
    std::vector<Vector<Dim>> apart;
    for (const ContactPoint<Dim>& point : points)
    {
        apart.emplace_back(contactFrame(point).transpose()
                           * (rateAt<Dim>(rates, masses, point.block, point.position)
                              - rateAt<Dim>(rates, masses, point.neighbour, point.position)));
    }
    return apart;
}

/// The mark of a joint, where it is a hinge or slides. \param apart (opening, slips) of all points \param
/// least rate of a point that moves
template<int Dim>
std::optional<JointMark> markOf(const std::vector<ContactPoint<Dim>>& points, const PointRange& joint,
                                const std::vector<double>& friction, const std::vector<Vector<Dim>>& apart,
                                double least)
{
    std::vector<Vector<3>> together;
    bool slides = false;
    bool parts = false;
    for (std::size_t i = joint.begin; i < joint.end; ++i)
    {
        const Vector<Dim>& rate = apart[i];
        const double slip = rate.template tail<Dim - 1>().norm();
        if (rate.norm() <= least)
        {
            together.push_back(inSpace(points[i].position));
        }
        else if (slip > least && rate.x() <= friction[i] * slip + least)
        {
            slides = true;
        }
        else
        {
            parts = true;
        }
    }
    JointMark mark;
    mark.block = points[joint.begin].block;
    mark.neighbour = points[joint.begin].neighbour;
    if (!together.empty() && parts)
    {
        mark.motion = JointMotion::hinge;
        mark.points = endsOf(together);
        return mark;
    }
    if (together.empty() && slides)
    {
        mark.motion = JointMotion::sliding;
        mark.points = hullOf(points, joint);
        return mark;
    }
    return std::nullopt;
}

} // namespace

template<int Dim>
std::vector<JointMark> jointMarks(const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points,
                                  const std::vector<double>& friction,
                                  const std::type_identity_t<Rates<Dim>>& rates)
{
    const std::vector<Vector<Dim>> apart = ratesApart<Dim>(assembly, points, rates);
    double fastest = 0;
    for (const Vector<Dim>& rate : apart)
    {
        fastest = std::max(fastest, rate.norm());
    }
    std::vector<JointMark> marks;
    for (const PointRange& joint : pointsOfJoints(points))
    {
        if (std::optional<JointMark> mark = markOf<Dim>(points, joint, friction, apart, still * fastest))
        {
            marks.push_back(std::move(*mark));
        }
    }
    return marks;
}

template std::vector<JointMark> jointMarks(const Assembly<2>& assembly,
                                           const std::vector<ContactPoint<2>>& points,
                                           const std::vector<double>& friction, const Rates<2>& rates);
template std::vector<JointMark> jointMarks(const Assembly<3>& assembly,
                                           const std::vector<ContactPoint<3>>& points,
                                           const std::vector<double>& friction, const Rates<3>& rates);

} // namespace drystone
