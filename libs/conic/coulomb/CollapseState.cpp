// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Points at random stiffnesses, and Newton's steps back to the path.
#include "conic/coulomb/CollapseState.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace drystone
{
namespace
{

constexpr int mostCorrections = 4;
constexpr double balanced = 1e-14;        ///< relative to the largest load
constexpr double largestImbalance = 1e-5; ///< likewise: the path is lost

/// In space a step may take points beyond their piece of the law by so much of the largest load.
constexpr double beyondLaw = 1e-9;

/// A slip may turn by this angle in one step, and more where its force is a small share of the largest load.
constexpr double largestTurn = 0.2;
constexpr double smallForce = 0.05;

} // namespace

template<int Rows, int Forces>
CollapseState<Rows, Forces>::CollapseState(const ConeProgram<Rows, Forces>& program,
                                           const VectorXd& contactForce, double multiplierThere,
                                           const CollapsePathSettings& settings)
    : system(program),
      stretch(contactForce / system.force),
      multiplier(multiplierThere * system.live / system.force)
{
    std::mt19937 random(settings.seed);
    stiffnesses.resize(program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        const double uniform = static_cast<double>(random()) / 4294967296.0;
        stiffnesses[point] = std::exp(settings.stiffnessSpread * (2 * uniform - 1));
        Piece piece;
        piece.friction = program.friction[static_cast<std::size_t>(point)];
        piece.dilatancy = std::min(settings.dilatancy, piece.friction);
        piece.strength = program.strengthOf(static_cast<std::size_t>(point));
        piece.strength.cohesion /= system.force;
        piece.strength.tension /= system.force;
        piece.strength.crushing /= system.force;
        piece.find(at(point));
        pieces.push_back(piece);
        update(point);
    }
}

template<int Rows, int Forces>
Eigen::VectorXd CollapseState<Rows, Forces>::contactForces() const
{
    VectorXd forces(stretch.size());
    for (int point = 0; point < count(); ++point)
    {
        forces.template segment<Forces>(Forces * point) =
            pieces[static_cast<std::size_t>(point)].force(at(point));
    }
    return forces;
}

template<int Rows, int Forces>
Eigen::VectorXd CollapseState<Rows, Forces>::stretched(VectorXd closing) const
{
    for (int point = 0; point < count(); ++point)
    {
        closing.template segment<Forces>(Forces * point) *= stiffnesses[point];
    }
    return closing;
}

template<int Rows, int Forces>
void CollapseState<Rows, Forces>::returnToLaw()
{
    if constexpr (Forces == 3)
    {
        for (int point = 0; point < count(); ++point)
        {
            Piece& piece = pieces[static_cast<std::size_t>(point)];
            if (piece.isSliding || piece.returnToLaw(at(point), beyondLaw))
            {
                update(point);
            }
        }
    }
}

/// By w = c + lambda (-psi, d) of the points that press and slide
template<int Rows, int Forces>
void CollapseState<Rows, Forces>::changeDilatancy(double dilatancy)
{
    for (int point = 0; point < count(); ++point)
    {
        Piece& piece = pieces[static_cast<std::size_t>(point)];
        const Force before = at(point);
        const Force force = piece.force(before);
        piece.dilatancy = std::min(dilatancy, piece.friction);
        if (piece.isSliding && piece.normal == Piece::Normal::presses)
        {
            const double beyond = Piece::shearOf(before) - Piece::shearOf(force);
            stretch[Forces * point] = force[0] - piece.dilatancy * beyond;
        }
        update(point);
    }
}

template<int Rows, int Forces>
bool CollapseState<Rows, Forces>::correct(const VectorXd& pushed)
{
    const auto imbalance = [&]() -> VectorXd
    { return system.load + multiplier * system.liveLoad - system.columnsTimes(contactForces()); };
    VectorXd residual = imbalance();
    double before = residual.lpNorm<Eigen::Infinity>();
    for (int round = 0; round < mostCorrections && before > balanced; ++round)
    {
        const VectorXd moved = system.solve(residual);
        const double share = -pushed.dot(moved) / pushed.squaredNorm();
        const VectorXd from = stretch;
        stretch += stretched(system.columnsTransposedTimes(moved + share * pushed));
        multiplier += share;
        residual = imbalance();
        const double after = residual.lpNorm<Eigen::Infinity>();
        if (!(after < before))
        {
            stretch = from;
            multiplier -= share;
            break;
        }
        before = after;
        if (before < sufficientBalance)
        {
            break;
        }
    }
    return before < largestImbalance;
}

template<int Rows, int Forces>
typename CollapseState<Rows, Forces>::Piece::Exit
CollapseState<Rows, Forces>::firstExit(const VectorXd& rate, double ignored, int& leaving) const
{
    typename Piece::Exit first;
    for (int point = 0; point < count(); ++point)
    {
        const typename Piece::Exit exit =
            pieces[static_cast<std::size_t>(point)].exit(at(point), partOf(rate, point), ignored, first);
        if (exit.distance < first.distance)
        {
            first = exit;
            leaving = point;
        }
    }
    return first;
}

template<int Rows, int Forces>
double CollapseState<Rows, Forces>::turningDistance(const VectorXd& stretchRate) const
{
    double distance = std::numeric_limits<double>::infinity();
    if constexpr (Forces == 3)
    {
        for (int point = 0; point < count(); ++point)
        {
            const Piece& piece = pieces[static_cast<std::size_t>(point)];
            const Force w = at(point);
            const Force rate = partOf(stretchRate, point);
            const double across = std::abs(w[1] * rate[2] - w[2] * rate[1]);
            if (piece.isSliding && across > 0 && (!piece.isFree() || piece.dilatancy > 0))
            {
                const double most = piece.slidingLimit(w);
                const double angle = largestTurn * std::max(1.0, most > 0 ? smallForce / most : 1.0);
                distance = std::min(distance, angle * w.template tail<2>().squaredNorm() / across);
            }
        }
    }
    return distance;
}

template class CollapseState<3, 2>;
template class CollapseState<6, 3>;

} // namespace drystone
