// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sums the forces at both ends to resultants; writes balance anew from the middles of the joints.
#include "statics/SurfaceContact.h"

#include "contact/Facing.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// Generalised force of unit N, T and M on a block. \param arm from the block's centroid to the joint's
/// middle
Eigen::Matrix3d columnsOn(const Vector<2>& arm, const ContactPoint<2>& joint)
{
    const Vector<2> along = tangent(joint);
    Eigen::Matrix3d columns;
    columns.col(0) << joint.normal, cross(arm, joint.normal);
    columns.col(1) << along, cross(arm, along);
    columns.col(2) << 0, 0, cross(along, joint.normal);
    return columns;
}

/// The largest entry, moments divided by a lever arm.
double largest(const Eigen::VectorXd& rows, double lever)
{
    double result = 0;
    for (Eigen::Index row = 0; row < rows.size(); ++row)
    {
        result = std::max(result, std::abs(rows[row]) / (row % 3 == 2 ? lever : 1));
    }
    return result;
}

} // namespace

std::vector<JointResultant> jointResultants(const std::vector<ContactPoint<2>>& points,
                                            const std::vector<double>& friction,
                                            const Eigen::VectorXd& contactForce)
{
    std::vector<JointResultant> joints;
    joints.reserve(points.size() / 2);
    for (std::size_t i = 0; i + 1 < points.size(); i += 2)
    {
        const auto force = contactForce.segment<4>(2 * static_cast<Eigen::Index>(i));
        JointResultant joint;
        joint.joint = points[i];
        joint.joint.position = (points[i].position + points[i + 1].position) / 2;
        const double reach = tangent(points[i]).dot(points[i + 1].position - joint.joint.position);
        joint.halfLength = std::abs(reach);
        joint.friction = friction[i];
        joint.force << force[0] + force[2], force[1] + force[3], reach * (force[2] - force[0]);
        joints.push_back(joint);
    }
    return joints;
}

Certificate certifySurfaceContact(const Assembly<2>& assembly, const std::vector<JointResultant>& joints,
                                  const LoadVectors& loads, const LimitAnalysis& collapse)
{
    const std::vector<int> free = freeIndices(assembly);
    const std::vector<BlockMass<2>> masses = blockMasses(assembly);
    const double lever = meanBlockSize(assembly);
    // The live load does unit work on the mechanism.
    const double work = loads.live.dot(collapse.mechanism);
    const Eigen::VectorXd rates = collapse.mechanism / work;

    Eigen::VectorXd unbalanced = loads.dead + collapse.alpha * loads.live;
    double outside = 0;
    double against = 0;
    double largestRate = 0;
    for (Eigen::Index row = 0; row < rates.size(); ++row)
    {
        largestRate = std::max(largestRate, std::abs(rates[row]) * (row % 3 == 2 ? lever : 1));
    }
    for (const JointResultant& joint : joints)
    {
        const double mu = joint.friction;
        const double half = joint.halfLength;
        const Eigen::Vector3d& s = joint.force;
        outside =
            std::max({outside, -s[0], std::abs(s[1]) - mu * s[0], (std::abs(s[2]) - half * s[0]) / lever});
        Eigen::Vector3d rate = Eigen::Vector3d::Zero(); // opening, slip, rotation
        for (const auto& [block, sign] :
             {std::pair(joint.joint.block, 1.0), std::pair(joint.joint.neighbour, -1.0)})
        {
            const auto index = static_cast<std::size_t>(block);
            if (free[index] >= 0)
            {
                const Eigen::Matrix3d columns =
                    sign * columnsOn(joint.joint.position - masses[index].centroid, joint.joint);
                unbalanced.segment<3>(3 * free[index]) += columns * s;
                rate += columns.transpose() * rates.segment<3>(3 * free[index]);
            }
        }
        against = std::max(against, mu * std::abs(rate[1]) + half * std::abs(rate[2]) - rate[0]);
    }
    const double largestLoad =
        std::max(largest(loads.dead, lever), std::abs(collapse.alpha) * largest(loads.live, lever));
    Certificate certificate;
    certificate.primalResidual = std::max(largest(unbalanced, lever), outside) / largestLoad;
    certificate.dualResidual = against / largestRate;
    const double terms = std::max(std::abs(collapse.alpha), loads.dead.cwiseProduct(rates).lpNorm<1>());
    certificate.dualityGap = std::abs(collapse.alpha + loads.dead.dot(rates)) / terms;
    return certificate;
}

} // namespace drystone
