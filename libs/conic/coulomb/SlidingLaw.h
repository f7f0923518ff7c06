// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a contact point carries for a trial force, and how that changes with it: the joint laws as
/// projections, one text for the shear of the plane and of space.
#pragma once

#include "conic/ConeProgram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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
    /// In space, where it slides: the share of a trial shear across its direction that the force has. The
    /// direction turns with w_t, so it is |c_t| / |w_t|; kept as it was the piece is linear, the law's
    /// tangent.
    double turning = 0;

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

/// The limit of shear on a piece, C + mu c_n, as its growth with c_n and its value without.
struct ShearLimit
{
    double mu;
    double cohesion;

    /// Without friction and cohesion nothing sticks.
    bool isThere() const { return mu > 0 || cohesion > 0; }
};

template<int Forces>
ShearLimit shearLimit(const SlidingLaw& law, const PointState<Forces>& state)
{
    return state.presses() ? ShearLimit{law.mu, law.cohesion}
                           : ShearLimit{0, law.cohesion - law.mu * law.tension};
}

/// Of unit length, the first one where there is no shear.
template<int Forces>
Eigen::Matrix<double, Forces - 1, 1> directionOf(const Eigen::Matrix<double, Forces - 1, 1>& shear)
{
    const double size = shear.norm();
    return size > 0 ? Eigen::Matrix<double, Forces - 1, 1>(shear / size)
                    : Eigen::Matrix<double, Forces - 1, 1>::Unit(0);
}

/// What a point that slides carries of a trial shear across its direction, by Coulomb's law
/// (PointState::turning).
template<int Forces>
double shareAcross(const SlidingLaw& law, const PointState<Forces>& state,
                   const Eigen::Matrix<double, Forces, 1>& trial)
{
    const ShearLimit limit = shearLimit(law, state);
    const double size = trial.template tail<Forces - 1>().norm();
    return size > 0 ? std::max(0.0, limit.cohesion + limit.mu * trial[0]) / size : 0;
}

/// The piece that a trial force w is on. Coulomb's law (Alart & Curnier 1991): c_n = max(-T, w_n), and c_t
/// the nearest to w_t in the disc of radius C + mu c_n. The associative law: c the nearest to w in the cone.
template<int Forces>
PointState<Forces> stateOf(const SlidingLaw& law, const Eigen::Matrix<double, Forces, 1>& w)
{
    using State = PointState<Forces>;
    State state;
    const auto shear = w.template tail<Forces - 1>();
    const double size = shear.norm();
    state.direction = directionOf<Forces>(shear);
    const bool isAssociative = law.sliding == Sliding::associative;
    const bool presses = isAssociative ? w[0] + law.mu * size > 0 : w[0] > -law.tension;
    const double normal = isAssociative ? w[0] : std::max(w[0], -law.tension);
    state.normal = presses ? State::Normal::presses : State::Normal::open;
    state.shear = size < law.cohesion + law.mu * normal ? State::Shear::sticks : State::Shear::slides;
    if (Forces > 2 && presses && !state.sticks() && isAssociative)
    {
        state.turning = law.mu * (w[0] + law.mu * size) / (1 + law.mu * law.mu) / size;
    }
    else if (Forces > 2 && !state.sticks() && !isAssociative)
    {
        state.turning = shareAcross<Forces>(law, state, w);
    }
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
    const auto turn = [&]
    {
        if (shears > 1 && state.turning > 0)
        {
            const Shears across =
                state.turning * (Shears::Identity() - state.direction * state.direction.transpose());
            result.force.template tail<shears>() += across * shear;
            result.derivative.template bottomRightCorner<shears, shears>() += across;
        }
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
            turn();
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
    turn();
    return result;
}

/// Turns the direction of a point that slides by Coulomb's law in space to that of a trial force: the piece
/// becomes the law's tangent there.
template<int Forces>
void turnTangent(const SlidingLaw& law, const Eigen::Matrix<double, Forces, 1>& trial,
                 PointState<Forces>& state)
{
    if (Forces == 2 || state.sticks() || law.sliding == Sliding::associative)
    {
        return;
    }
    state.direction = directionOf<Forces>(trial.template tail<Forces - 1>());
    state.turning = shareAcross<Forces>(law, state, trial);
}

/// A side of a piece: w is on the piece while normal'w + offset <= 0.
template<int Forces>
struct PieceSide
{
    Eigen::Matrix<double, Forces, 1> normal = Eigen::Matrix<double, Forces, 1>::Zero();
    double offset = 0;
    PointState<Forces> beyond;
};

/// The plane sides of a piece.
template<int Forces>
struct PieceSides
{
    std::array<PieceSide<Forces>, 3> side;
    int count = 0;

    void add(double alongNormal, const Eigen::Matrix<double, Forces - 1, 1>& alongShear, double offset,
             const PointState<Forces>& beyond)
    {
        PieceSide<Forces>& added = side[static_cast<std::size_t>(count++)];
        added.normal << alongNormal, alongShear;
        added.offset = offset;
        added.beyond = beyond;
    }
};

/// In space of Coulomb's law alone, and without the side round which a point that sticks begins to slide
/// (roundSide).
template<int Forces>
PieceSides<Forces> sidesOf(const SlidingLaw& law, const PointState<Forces>& state)
{
    using State = PointState<Forces>;
    using Shear = Eigen::Matrix<double, Forces - 1, 1>;
    PieceSides<Forces> sides;
    const auto to = [](typename State::Normal normal, typename State::Shear shear, const Shear& direction)
    {
        State beyond;
        beyond.normal = normal;
        beyond.shear = shear;
        beyond.direction = direction;
        return beyond;
    };
    const Shear& e = state.direction;
    const Shear one = Shear::Unit(0);
    if (law.sliding == Sliding::associative)
    {
        if (!state.presses())
        {
            sides.add(1, law.mu * one, 0, to(State::Normal::presses, State::Shear::slides, one));
            sides.add(1, -law.mu * one, 0, to(State::Normal::presses, State::Shear::slides, -one));
            return sides;
        }
        if (!state.sticks())
        {
            sides.add(-1, -law.mu * e, 0, to(State::Normal::open, State::Shear::slides, e));
        }
    }
    else
    {
        State other = state;
        other.normal = state.presses() ? State::Normal::open : State::Normal::presses;
        const double outwards = state.presses() ? -1 : 1;
        sides.add(outwards, Shear::Zero(), outwards * law.tension, other);
    }
    const ShearLimit limit = shearLimit(law, state);
    if (limit.isThere() && !state.sticks())
    {
        sides.add(limit.mu, -e, limit.cohesion, to(state.normal, State::Shear::sticks, e));
    }
    else if (limit.isThere() && Forces == 2)
    {
        sides.add(-limit.mu, one, -limit.cohesion, to(state.normal, State::Shear::slides, one));
        sides.add(-limit.mu, -one, -limit.cohesion, to(state.normal, State::Shear::slides, -one));
    }
    return sides;
}

/// Where in the disc of its shear, |w_t| <= C + mu c_n, a point is that sticks in space.
enum class DiscPlace
{
    inside,
    rim ///< from where it goes inwards
};

/// In space, how far a point that sticks goes along a change of w until it comes to the rim of its disc, from
/// the rim until it comes to it again. \return infinite where it does not
inline double lengthInDisc(const ShearLimit& limit, const Eigen::Vector3d& w, const Eigen::Vector3d& change,
                           DiscPlace place)
{
    // |w_t + s d_t|^2 - (C + mu (w_n + s d_n))^2 = a s^2 + 2 b s + c, and c <= 0 on the piece.
    const double now = limit.cohesion + limit.mu * w[0];
    const double growth = limit.mu * change[0];
    const double a = change.tail<2>().squaredNorm() - growth * growth;
    const double b = w.tail<2>().dot(change.tail<2>()) - now * growth;
    const double c = place == DiscPlace::rim ? 0 : std::min(0.0, w.tail<2>().squaredNorm() - now * now);
    const double infinite = std::numeric_limits<double>::infinity();
    const double inRoot = b * b - a * c;
    if (inRoot < 0 || (b <= 0 && a <= 0) || (place == DiscPlace::rim && b >= 0))
    {
        return infinite;
    }
    const double root = std::sqrt(inRoot);
    return b > 0 ? -c / (b + root) : (root - b) / a;
}

/// That side at a point of it.
inline PieceSide<3> roundSide(const ShearLimit& limit, const PointState<3>& state, const Eigen::Vector3d& on)
{
    PieceSide<3> side;
    side.beyond = state;
    side.beyond.shear = PointState<3>::Shear::slides;
    const double size = on.tail<2>().norm();
    if (size > 0)
    {
        side.beyond.direction = on.tail<2>() / size;
    }
    side.beyond.turning = 1;
    side.normal << -limit.mu, side.beyond.direction;
    side.offset = -limit.cohesion;
    return side;
}

} // namespace drystone
