// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// An independent judge of solutions: computed from points, normals, centroids and loads, without the
/// equilibrium matrix, the cone program or its certificate.
#pragma once

#include "RandomAssembly.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

class Judge
{
public:
    explicit Judge(const RandomAssembly& structure) : structure_(structure)
    {
        for (const ContactPoint<2>& point : structure.points)
        {
            const auto& centre = structure.blocks[static_cast<std::size_t>(point.block)].centroid;
            lever_ = std::max(lever_, (point.position - centre).norm());
        }
        lever_ = lever_ > 0 ? lever_ : 1;
    }

    /// Largest force on a block; moments are over the largest lever arm. [N]
    double size(const Eigen::VectorXd& load) const
    {
        double largest = 0;
        for (Eigen::Index row = 0; row < load.size(); row += 3)
        {
            largest = std::max({largest, load.segment<2>(row).norm(), std::abs(load[row + 2]) / lever_});
        }
        return largest;
    }

    /// Largest velocity of a block; angles are times the largest lever arm.
    double motionSize(const Eigen::VectorXd& motion) const
    {
        double largest = 0;
        for (Eigen::Index row = 0; row < motion.size(); row += 3)
        {
            largest = std::max({largest, motion.segment<2>(row).norm(), std::abs(motion[row + 2]) * lever_});
        }
        return largest;
    }

    /// What contact forces and load leave on the blocks: 3 rows a free block.
    Eigen::VectorXd resultant(const Eigen::VectorXd& forces, const Eigen::VectorXd& load) const
    {
        Eigen::VectorXd sum = load;
        for (std::size_t i = 0; i < structure_.points.size(); ++i)
        {
            const ContactPoint<2>& point = structure_.points[i];
            const Vector<2> force = forces[at(i)] * point.normal + forces[at(i) + 1] * tangent(point);
            press(point.block, force, point.position, sum);
            press(point.neighbour, -force, point.position, sum);
        }
        return sum;
    }

    /// By how much forces leave their cones [N].
    double outsideCones(const Eigen::VectorXd& forces) const
    {
        double most = 0;
        for (std::size_t i = 0; i < structure_.points.size(); ++i)
        {
            most = std::max({most, -forces[at(i)],
                             std::abs(forces[at(i) + 1]) - structure_.mu * std::max(0.0, forces[at(i)])});
        }
        return most;
    }

    /// By how much a motion closes joints, or opens them less than sliding does by the associative law.
    double outsideFlow(const Eigen::VectorXd& motion) const
    {
        double most = 0;
        for (std::size_t i = 0; i < structure_.points.size(); ++i)
        {
            const Vector<2> opening = openingAt(i, motion);
            most = std::max(most, structure_.mu * std::abs(opening.y()) - opening.x());
        }
        return most;
    }

    /// Power of forces on a motion, each point taken by itself: zero where they belong together.
    double power(const Eigen::VectorXd& forces, const Eigen::VectorXd& motion) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < structure_.points.size(); ++i)
        {
            sum += std::abs(forces.segment<2>(at(i)).dot(openingAt(i, motion)));
        }
        return sum;
    }

    double lever() const { return lever_; }

    /// Of a support that moves: what it carries against its movement [N].
    double reaction(const Eigen::VectorXd& forces) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < structure_.points.size(); ++i)
        {
            const ContactPoint<2>& point = structure_.points[i];
            const Vector<2> force = forces[at(i)] * point.normal + forces[at(i) + 1] * tangent(point);
            const double along = force.dot(structure_.loads.movement->direction);
            sum += isMoving(point.block) ? along : isMoving(point.neighbour) ? -along : 0;
        }
        return sum;
    }

private:
    bool isMoving(int block) const
    {
        return structure_.loads.movement
               && structure_.assembly.blocks[static_cast<std::size_t>(block)].support
                      == structure_.loads.movement->support;
    }

    static Eigen::Index at(std::size_t point) { return 2 * static_cast<Eigen::Index>(point); }

    void press(int block, const Vector<2>& force, const Vector<2>& position, Eigen::VectorXd& sum) const
    {
        const int row = 3 * structure_.free[static_cast<std::size_t>(block)];
        if (row >= 0)
        {
            const Vector<2> arm = position - structure_.blocks[static_cast<std::size_t>(block)].centroid;
            sum.segment<2>(row) += force;
            sum[row + 2] += arm.x() * force.y() - arm.y() * force.x();
        }
    }

    Vector<2> velocityOf(int block, const Vector<2>& position, const Eigen::VectorXd& motion) const
    {
        const int row = 3 * structure_.free[static_cast<std::size_t>(block)];
        if (row < 0)
        {
            return isMoving(block) ? structure_.loads.movement->direction : Vector<2>(0, 0);
        }
        const Vector<2> arm = position - structure_.blocks[static_cast<std::size_t>(block)].centroid;
        return motion.segment<2>(row) + motion[row + 2] * Vector<2>(-arm.y(), arm.x());
    }

    /// (opening, slip) of a point.
    Vector<2> openingAt(std::size_t index, const Eigen::VectorXd& motion) const
    {
        const ContactPoint<2>& point = structure_.points[index];
        const Vector<2> apart = velocityOf(point.block, point.position, motion)
                                - velocityOf(point.neighbour, point.position, motion);
        return {apart.dot(point.normal), apart.dot(tangent(point))};
    }

    const RandomAssembly& structure_;
    double lever_ = 0; ///< [m]
};

} // namespace drystone
