// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a contact point carries for a trial force, and how that changes with it: the joint laws as
/// projections, one text for the shear of the plane and of space.
#pragma once

#include "conic/ConeProgram.h"

#include <array>
#include <cmath>

namespace drystone
{

/// How a point slides.
enum class Sliding
{
    coulomb,    ///< without opening
    associative ///< normal to its cone: it opens by mu times the slip
};

/// The law of one contact point with strengths -T <= c_n, |c_t| <= C + mu c_n; the associative one without.
struct SlidingLaw
{
    Sliding sliding = Sliding::coulomb;
    double mu = 0;
    double cohesion = 0;
    double tension = 0;
};

/// What a point does: the pieces between which its law is smooth. With one component of shear it is linear on
/// each of them.
template<int Forces>
struct PointState
{
    enum class Normal : char
    {
        open,   ///< carries minus its tension strength, or nothing
        presses ///< its normal force grows with its closing
    };
    enum class Shear : char
    {
        sticks,
        slides
    };
    Normal normal = Normal::open;
    Shear shear = Shear::slides;
    Eigen::Matrix<double, Forces - 1, 1> direction =
        Eigen::Matrix<double, Forces - 1, 1>::Unit(0); ///< of the shear of a point that slides

    bool presses() const { return normal == Normal::presses; }
    bool sticks() const { return shear == Shear::sticks; }
};

/// The force of a point on one piece, and its derivative by the trial force.
template<int Forces>
struct PointForce
{
    Eigen::Matrix<double, Forces, 1> force = Eigen::Matrix<double, Forces, 1>::Zero();
    Eigen::Matrix<double, Forces, Forces> derivative = Eigen::Matrix<double, Forces, Forces>::Zero();
};

/// The piece that a trial force w is on. Coulomb's law (Alart & Curnier 1991): c_n = max(-T, w_n), and c_t
/// the nearest to w_t in the disc of radius C + mu c_n. The associative law: c the nearest to w in the cone.
template<int Forces>
PointState<Forces> stateOf(const SlidingLaw& law, const Eigen::Matrix<double, Forces, 1>& w)
{
    using State = PointState<Forces>;
    State state;
    const auto shear = w.template tail<Forces - 1>();
    const double size = shear.norm();
    if (size > 0)
    {
        state.direction = shear / size;
    }
    const bool isAssociative = law.sliding == Sliding::associative;
    const bool presses = isAssociative ? w[0] + law.mu * size > 0 : w[0] > -law.tension;
    const double normal = isAssociative ? w[0] : std::max(w[0], -law.tension);
    state.normal = presses ? State::Normal::presses : State::Normal::open;
    state.shear = size < law.cohesion + law.mu * normal ? State::Shear::sticks : State::Shear::slides;
    return state;
}

/// The force of a piece, which may be extended beyond where the law is on it.
template<int Forces>
PointForce<Forces> forceOn(const SlidingLaw& law, const PointState<Forces>& state,
                           const Eigen::Matrix<double, Forces, 1>& w)
{
    constexpr int shears = Forces - 1;
    using Shears = Eigen::Matrix<double, shears, shears>;
    PointForce<Forces> result;
    const auto shear = w.template tail<shears>();
    // The direction of shear turns with w_t: across it the force changes by limit / |w_t|.
    const auto across = [&](double limit) -> Shears
    {
        const double size = shear.norm();
        return shears > 1 && size > 0 && limit > 0 ? Shears(
                   limit / size * (Shears::Identity() - state.direction * state.direction.transpose()))
                                                   : Shears(Shears::Zero());
    };
    if (law.sliding == Sliding::associative)
    {
        if (state.presses() && state.sticks())
        {
            result.force = w;
            result.derivative.setIdentity();
        }
        else if (state.presses())
        {
            Eigen::Matrix<double, Forces, 1> edge;
            edge << 1, law.mu * state.direction;
            const double along = edge.dot(w) / edge.squaredNorm();
            result.force = along * edge;
            result.derivative = edge * edge.transpose() / edge.squaredNorm();
            result.derivative.template bottomRightCorner<shears, shears>() += across(along * law.mu);
        }
        return result;
    }
    result.force[0] = state.presses() ? w[0] : -law.tension;
    result.derivative(0, 0) = state.presses() ? 1 : 0;
    if (state.sticks())
    {
        result.force.template tail<shears>() = shear;
        result.derivative.template bottomRightCorner<shears, shears>().setIdentity();
        return result;
    }
    const double limit = law.cohesion + law.mu * result.force[0];
    result.force.template tail<shears>() = limit * state.direction;
    result.derivative.template bottomLeftCorner<shears, 1>() =
        result.derivative(0, 0) * law.mu * state.direction;
    result.derivative.template bottomRightCorner<shears, shears>() = across(limit);
    return result;
}

/// A side of a piece of the plane: w is on the piece while normal'w + offset <= 0.
struct PieceSide
{
    Eigen::Vector2d normal;
    double offset;
    PointState<2> beyond;
};

/// The sides of a piece.
struct PieceSides
{
    std::array<PieceSide, 3> side;
    int count = 0;

    void add(const Eigen::Vector2d& normal, double offset, const PointState<2>& beyond)
    {
        side[static_cast<std::size_t>(count++)] = {normal, offset, beyond};
    }
};

inline PieceSides sidesOf(const SlidingLaw& law, const PointState<2>& state)
{
    using State = PointState<2>;
    PieceSides sides;
    const auto to = [](State::Normal normal, State::Shear shear, double direction)
    {
        State beyond{normal, shear, {}};
        beyond.direction[0] = direction;
        return beyond;
    };
    const double e = state.direction[0];
    if (law.sliding == Sliding::associative)
    {
        if (!state.presses())
        {
            sides.add({1, law.mu}, 0, to(State::Normal::presses, State::Shear::slides, 1));
            sides.add({1, -law.mu}, 0, to(State::Normal::presses, State::Shear::slides, -1));
            return sides;
        }
        if (!state.sticks())
        {
            sides.add({-1, -law.mu * e}, 0, to(State::Normal::open, State::Shear::slides, e));
        }
    }
    else
    {
        const State::Normal other = state.presses() ? State::Normal::open : State::Normal::presses;
        const double outwards = state.presses() ? -1 : 1;
        sides.add({outwards, 0}, outwards * law.tension, to(other, state.shear, e));
    }
    // Without friction and cohesion nothing sticks.
    const double mu = state.presses() ? law.mu : 0;
    const double limit = state.presses() ? law.cohesion : law.cohesion - law.mu * law.tension;
    if (mu > 0 || limit > 0)
    {
        if (state.sticks())
        {
            sides.add({-mu, 1}, -limit, to(state.normal, State::Shear::slides, 1));
            sides.add({-mu, -1}, -limit, to(state.normal, State::Shear::slides, -1));
        }
        else
        {
            sides.add({mu, -e}, limit, to(state.normal, State::Shear::sticks, e));
        }
    }
    return sides;
}

} // namespace drystone
