// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Each point by its own force, and a little inside its piece.
#include "conic/coulomb/PathStart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace drystone
{
namespace
{

/// Forces below this share of the largest are none, and a shear nearer than this to its limit is at it.
constexpr double negligibleForce = 1e-9;

/// How far inside its piece a point begins whose force does not say, as a share of the largest force; points
/// differ in it, so that they do not change their states at one instant.
constexpr double margin = 1e-6;

/// Of the associative law w is its force and what is across the cone from there, or of no force in the polar
/// cone. \param trial w of the natural map, which becomes that of the start \param inside how far
template<int Forces, typename Trial>
void beginOnCone(const SlidingLaw& law, const Eigen::Matrix<double, Forces, 1>& force,
                 const PointState<Forces>& state, double inside, Trial trial)
{
    using Force = Eigen::Matrix<double, Forces, 1>;
    if (!state.presses())
    {
        const double beyond = trial[0] + law.mu * trial.template tail<Forces - 1>().norm();
        trial[0] -= beyond > -inside ? beyond + inside : 0;
    }
    else if (state.sticks())
    {
        trial = force;
    }
    else
    {
        // w = c + a (-mu, e) with a > 0 has this c for its nearest point of the cone.
        Force outwards, onEdge;
        outwards << -law.mu, state.direction;
        onEdge << force[0], state.direction * (law.mu * force[0]);
        const double natural = outwards.dot(trial) / outwards.squaredNorm();
        trial = onEdge + std::max(natural, inside) * outwards;
    }
}

} // namespace

template<int Forces>
PathStart<Forces> pathStart(const std::vector<SlidingLaw>& laws, const Eigen::VectorXd& force,
                            Eigen::VectorXd ofDisplacement)
{
    using State = PointState<Forces>;
    using Force = Eigen::Matrix<double, Forces, 1>;
    using Shear = Eigen::Matrix<double, Forces - 1, 1>;
    PathStart<Forces> start{std::move(ofDisplacement), std::vector<State>(laws.size())};
    const double largest = force.size() > 0 ? force.template lpNorm<Eigen::Infinity>() : 0;
    const double least = negligibleForce * largest;
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        const auto row = Forces * static_cast<Eigen::Index>(point);
        const SlidingLaw& law = laws[point];
        auto trial = start.w.template segment<Forces>(row);
        auto trialShear = trial.template tail<Forces - 1>();
        const double normal = force[row];
        const Shear shear = force.template segment<Forces - 1>(row + 1);
        // Golden sections spread evenly however many there are.
        const double part = std::fmod(0.6180339887498949 * static_cast<double>(point), 1.0);
        const double inside = margin * (1 + part) * std::max(largest, std::numeric_limits<double>::min());
        State& state = start.states[point];
        const double held = std::max(normal, -law.tension);
        const double limit = law.cohesion + law.mu * held;
        state.normal = normal > -law.tension + least ? State::Normal::presses : State::Normal::open;
        state.shear = shear.norm() < (1 - negligibleForce) * limit - least ? State::Shear::sticks
                                                                           : State::Shear::slides;
        state.direction = directionOf<Forces>(shear.isZero(0) ? Shear(trialShear) : shear);
        if (law.sliding == Sliding::associative)
        {
            beginOnCone<Forces>(law, Force(force.template segment<Forces>(row)), state, inside, trial);
            continue;
        }
        trial[0] = state.presses() ? normal : std::min(trial[0], -law.tension - inside);
        if (state.sticks())
        {
            trialShear = shear;
        }
        else if (limit > least || state.presses())
        {
            trialShear = state.direction * std::max(limit + inside, state.direction.dot(trialShear));
        }
        else
        {
            state.direction = directionOf<Forces>(trialShear);
        }
        turnTangent<Forces>(law, trial, state);
    }
    return start;
}

template PathStart<2> pathStart<2>(const std::vector<SlidingLaw>&, const Eigen::VectorXd&, Eigen::VectorXd);
template PathStart<3> pathStart<3>(const std::vector<SlidingLaw>&, const Eigen::VectorXd&, Eigen::VectorXd);

} // namespace drystone
