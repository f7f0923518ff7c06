// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/JointBonds.h"

#include "contact/JointLaws.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

/// A solver that is not asked for much leaves forces that much below a strength that is reached.
constexpr double nearlyYielding = 1e-3;

/// Where a point of a block as built is now.
Vector<2> placed(const Vector<2>& position, int block, const std::vector<BlockMass<2>>& blocks,
                 const std::vector<Placement<2>>& placements)
{
    const auto index = static_cast<std::size_t>(block);
    const Placement<2>& placement = placements[index];
    if (placement.rotation == 0)
    {
        return position + placement.translation;
    }
    const Vector<2>& centre = blocks[index].centroid;
    return centre + placement.translation + Eigen::Rotation2Dd(placement.rotation) * (position - centre);
}

} // namespace

std::vector<Bond> jointBonds(const std::filesystem::path& caseDirectory, const ContactProperties& properties,
                             const Assembly<2>& assembly)
{
    const bool isInJoints =
        std::any_of(properties.joints.begin(), properties.joints.end(),
                    [](const auto& joint) { return joint.second.cohesion || joint.second.tension; });
    if (!properties.cohesion && !properties.tension && !isInJoints)
    {
        return {};
    }
    const std::vector<ContactPoint<2>> points = findContactPoints(assembly);
    const std::vector<PointLaw> laws = pointLaws(caseDirectory, properties, assembly, points);
    std::vector<Bond> bonds;
    bonds.reserve(points.size());
    bool isAny = false;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Strength strength{laws[i].cohesion, laws[i].tension};
        bonds.push_back({points[i].block, points[i].neighbour, points[i].position, strength});
        isAny = isAny || strength.cohesion > 0 || strength.tension > 0;
    }
    return isAny ? bonds : std::vector<Bond>();
}

std::vector<char> partedBonds(const std::vector<Bond>& bonds, const std::vector<BlockMass<2>>& blocks,
                              const std::vector<Placement<2>>& placements, double reach)
{
    std::vector<char> isParted;
    isParted.reserve(bonds.size());
    for (const Bond& bond : bonds)
    {
        const Vector<2> apart = placed(bond.position, bond.block, blocks, placements)
                                - placed(bond.position, bond.neighbour, blocks, placements);
        const bool isNone = bond.strength.cohesion == 0 && bond.strength.tension == 0;
        isParted.push_back(isNone || apart.norm() > reach);
    }
    return isParted;
}

std::vector<int> bondsOfPoints(const std::vector<Bond>& bonds, const std::vector<char>& isBroken,
                               const std::vector<BlockMass<2>>& blocks,
                               const std::vector<Placement<2>>& placements,
                               const std::vector<ContactPoint<2>>& points, double reach)
{
    std::vector<int> bondOfPoint(points.size(), -1);
    std::size_t first = 0; // points and bonds are both sorted by pairs of blocks
    for (std::size_t bond = 0; bond < bonds.size(); ++bond)
    {
        if (isBroken[bond])
        {
            continue;
        }
        const std::pair pair(bonds[bond].block, bonds[bond].neighbour);
        const auto pairOf = [&](std::size_t point)
        { return std::pair(points[point].block, points[point].neighbour); };
        while (first < points.size() && pairOf(first) < pair)
        {
            ++first;
        }
        const Vector<2> onBlock = placed(bonds[bond].position, bonds[bond].block, blocks, placements);
        const Vector<2> onNeighbour = placed(bonds[bond].position, bonds[bond].neighbour, blocks, placements);
        double nearest = reach;
        std::size_t found = points.size();
        for (std::size_t point = first; point < points.size() && pairOf(point) == pair; ++point)
        {
            const double distance = std::max((points[point].position - onBlock).norm(),
                                             (points[point].position - onNeighbour).norm());
            if (bondOfPoint[point] < 0 && distance < nearest)
            {
                nearest = distance;
                found = point;
            }
        }
        if (found < points.size())
        {
            bondOfPoint[found] = static_cast<int>(bond);
        }
    }
    return bondOfPoint;
}

double openingOf(const Bond& bond, const std::vector<BlockMass<2>>& blocks,
                 const std::vector<Placement<2>>& placements, const ContactPoint<2>& point)
{
    return point.normal.dot(placed(bond.position, bond.block, blocks, placements)
                            - placed(bond.position, bond.neighbour, blocks, placements));
}

bool isAnyHeld(const std::vector<int>& bondOfPoint)
{
    return std::any_of(bondOfPoint.begin(), bondOfPoint.end(), [](int bond) { return bond >= 0; });
}

std::vector<Strength> strengthsOf(const std::vector<Bond>& bonds, const std::vector<int>& bondOfPoint)
{
    std::vector<Strength> strengths;
    strengths.reserve(bondOfPoint.size());
    for (const int bond : bondOfPoint)
    {
        strengths.push_back(bond < 0 ? Strength{} : bonds[static_cast<std::size_t>(bond)].strength);
    }
    return strengths;
}

std::vector<int> bondsGivingWay(const PlaneConeProgram& program, const std::vector<int>& bondOfPoint,
                                const Eigen::VectorXd& opening, const Eigen::VectorXd& contactForce,
                                const YieldTolerance& tolerance)
{
    std::vector<int> givingWay;
    for (std::size_t point = 0; point < bondOfPoint.size(); ++point)
    {
        if (bondOfPoint[point] < 0)
        {
            continue;
        }
        const Eigen::Index row = 2 * static_cast<Eigen::Index>(point);
        const Strength& strength = program.strength[point];
        const double normal = contactForce[row];
        const double shear = std::abs(contactForce[row + 1]);
        const bool opens =
            opening[row] > tolerance.length
            && normal + strength.tension <= nearlyYielding * strength.tension + tolerance.force;
        const bool slides = std::abs(opening[row + 1]) > tolerance.length
                            && strength.cohesion + program.friction[point] * normal - shear
                                   <= nearlyYielding * strength.cohesion + tolerance.force;
        if (opens || slides)
        {
            givingWay.push_back(bondOfPoint[point]);
        }
    }
    return givingWay;
}

} // namespace drystone
