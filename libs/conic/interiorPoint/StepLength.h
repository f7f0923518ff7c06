// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How far steps may go before they leave the cones, and with which weight a correction lets them go
/// farthest (Colombo & Gondzio 2008). Internal to the interior point.
#pragma once

#include "conic/cones/ConeProduct.h"

namespace drystone
{

/// Steps beyond the optimality conditions' own, which is 1, are not needed; knowing that they could be taken
/// shows that 1 is safe.
constexpr double farthestStep = 1.02;

/// A step from x as the cones see it: dx of the rays, and of the round cones from lambda, scaled.
template<class Number>
struct StepOfCones
{
    const Eigen::VectorXd& x;
    const Eigen::VectorXd& dx;
    const std::vector<ConeVector<Number>>& scaled;
};

/// Largest step, at most `farthestStep`, that stays in the cones. \param frames of the round cones' lambda
template<class Number>
double stepToBoundary(const ConeRanges& cones, const std::vector<ConeFrame<Number>>& frames,
                      const StepOfCones<Number>& step)
{
    return 1 / std::max(steepestOf(cones, step.x, step.dx, frames, step.scaled), 1 / farthestStep);
}

/// How much of a correction is added to a step, and how far the sum may go.
struct Weight
{
    double weight = 1;
    double step = 0;
};

/// Which cones limit steps dx + w c for a w from `least` to 1: those that may do so more than others. Kept
/// from call to call for its memory.
class Blocking
{
public:
    void clear();

    /// Adds those of one vector, forces or openings. \param correction c, likewise from x
    template<class Number>
    void collect(const ConeRanges& cones, const std::vector<ConeFrame<Number>>& frames,
                 const StepOfCones<Number>& step, const StepOfCones<Number>& correction, double least);

    /// The weight from `least` to 1 that allows the longest step, and the largest of those that do. It is
    /// looked for among a few: to the last digit it is not worth more.
    Weight best(double least) const;

private:
    /// offset + w slope: the inverse of the step that one ray allows, where w is the weight of a correction.
    struct Line
    {
        double offset;
        double slope;
    };
    /// Likewise of a round cone, which allows the inverse of a convex function of w.
    template<class Number>
    struct Round
    {
        ConeSteepness<Number> offset;
        ConeSteepness<Number> slope;
        Number at(const Number& weight) const;
    };

    /// Those found among some rays, and the floor below which the steepest of all is nowhere.
    struct Found
    {
        std::vector<Line> lines;
        double floor;
    };
    static void collectRays(const Eigen::VectorXd& x, const Eigen::VectorXd& dx, const Eigen::VectorXd& c,
                            double least, Eigen::Index begin, Eigen::Index end, Found& found);

    Found found;
    std::vector<Found> parts; ///< of `found`, where there are many rays
    std::vector<Round<double>> rounds;
};

} // namespace drystone
