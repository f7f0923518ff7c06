// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A fixed-point iteration that converges where plain iteration swings: for the dilatancy of Coulomb's law.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace drystone
{

/// Fixed-point iteration x = F(x), accelerated (Anderson 1965; Walker & Ni 2011, type II): the next x is the
/// combination of the last ones at which F(x) - x would vanish were it linear. Plain iteration on a wall that
/// collapses ends in swinging between two states. Near a threshold, though, F grows faster than x up to where
/// Coulomb's motion is, thousands of times the associative one: its secant leads back to a fixed point below
/// zero, and plain iteration away from there: slowly where F grows by little more than x, so that then the
/// next x is larger still. Led back to zero there, it went round in threes without end.
class AcceleratedIteration
{
public:
    /// \param x where F was evaluated \param image F(x), not negative \return the next x, not negative
    Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image);

private:
    /// Whether x has grown, and F(x) - x with it: then there is no fixed point on the way back.
    bool growsMore(const Eigen::VectorXd& x, const Eigen::VectorXd& image,
                   const Eigen::VectorXd& residual) const;

    static constexpr std::size_t depth = 6;
    Eigen::VectorXd lastResidual;
    Eigen::VectorXd lastImage;
    std::vector<Eigen::VectorXd> residualChanges;
    std::vector<Eigen::VectorXd> imageChanges;
};

} // namespace drystone
