// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From one point's exit to the next; in space steps are corrected at once, and taken back if too long.
#include "conic/coulomb/CollapsePath.h"

#include "conic/coulomb/CollapseState.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// In space a step is corrected at once; in the plane, where nothing but rounding adds up, sometimes.
constexpr int piecesToCorrection = 8;
constexpr double shortestStep = 1e-9;

/// A direction is refined, for what the regularisation and missing pivots have changed, until the residual is
/// sufficiently small relative to its largest entry, at the end of the path below `refined`. What is larger
/// than `accepted` after that is wrong.
constexpr int mostRefinementsOfCollapse = 8;
constexpr double refined = 1e-14;
constexpr double accepted = 1e-9;

/// Rates of w below this share of the largest are rounding: what the mechanism leaves at rest.
constexpr double still = 1e-10;
constexpr double stillRefined = 1e-11;

/// Displacements, relative to the forces of the joints, beyond which elasticity is negligible.
constexpr double endOfElasticity = 1e8;

/// A mechanism on which the live load does less work, relative to its largest entries, is a fall.
constexpr double noWork = 1e-10;

/// A mechanism moves under a load that does not grow: by no more than this for displacements of one.
constexpr double noGrowth = 1e-8;

/// In space displacements grow by no more than this factor in one step.
constexpr double largestGrowth = 10;

template<int Rows, int Forces>
class CollapsePath
{
public:
    using Piece = CollapsePiece<Forces>;
    using State = CollapseState<Rows, Forces>;

    CollapsePath(const ConeProgram<Rows, Forces>& program, const VectorXd& contactForce, double multiplier,
                 const CollapsePathSettings& settings)
        : given(program),
          now(program, contactForce, multiplier, settings),
          elasticReach(endOfElasticity * (1 + now.stretch.template lpNorm<Eigen::Infinity>()))
    {
    }

    PathEnd follow(int mostPieces, const CollapsePathSettings& settings);
    /// Another psi from now on, with the same forces and slips.
    void changeDilatancy(double dilatancy) { now.changeDilatancy(dilatancy); }
    CollapsePair pair(PathEnd end) const;

private:
    /// What one call of `follow` knows between two pieces of the path.
    struct Walk
    {
        int begin;                                                ///< number of its first piece
        double gone = 0;                                          ///< displacements so far
        double longest = std::numeric_limits<double>::infinity(); ///< step, after one that was too long
        int last = -1;                                            ///< point that ended the last piece
        Boundary boundary = Boundary::none;                       ///< of its law at which it did
        // In space, where the last step began:
        double lastDistance = 0;
        double lastGone = 0;
        double lastAlpha = 0;
        VectorXd lastStretch = {};
        std::vector<Piece> lastPieces = {};
    };

    bool push();
    bool goBack(Walk& walk);
    void chooseSense(const Walk& walk, const VectorXd& before);
    PathEnd endOfPath();
    void take(Walk& walk, double distance, const typename Piece::Exit& first, int leaving);
    double refineDirection(double enough);
    void orient(double onwards);
    double stepLimit(double gone) const;

    const ConeProgram<Rows, Forces>& given;
    State now;
    double elasticReach;  ///< displacements beyond which elasticity is negligible
    VectorXd pushed;      ///< p, K p = L
    VectorXd direction;   ///< dv/ds, largest entry 1
    VectorXd stretchRate; ///< dw/ds
    double alphaRate = 0;
    int pieceCount = 0;
};

/// K v' = alpha' L \return the residual that is left
template<int Rows, int Forces>
double CollapsePath<Rows, Forces>::refineDirection(double enough)
{
    double before = std::numeric_limits<double>::infinity();
    VectorXd closing = now.system.columnsTransposedTimes(direction);
    for (int round = 0; round < mostRefinementsOfCollapse; ++round)
    {
        const VectorXd residual =
            alphaRate * now.system.liveLoad - now.system.columnsTimes(now.system.forcesOf(closing));
        const double error = residual.lpNorm<Eigen::Infinity>();
        if (!(error < 0.5 * before) || error < enough)
        {
            before = std::min(before, error);
            break;
        }
        before = error;
        const VectorXd moved = now.system.solve(residual);
        const double share = -pushed.dot(moved) / pushed.squaredNorm();
        direction += moved + share * pushed;
        alphaRate += share;
        closing = now.system.columnsTransposedTimes(direction);
    }
    stretchRate = now.stretched(std::move(closing));
    return before;
}

template<int Rows, int Forces>
void CollapsePath<Rows, Forces>::orient(double onwards)
{
    if (onwards < 0)
    {
        direction *= -1;
        stretchRate *= -1;
        alphaRate *= -1;
    }
}

/// In space the final direction is approached as displacements grow: none is final before they have.
template<int Rows, int Forces>
double CollapsePath<Rows, Forces>::stepLimit(double gone) const
{
    return Forces == 2 ? std::numeric_limits<double>::infinity()
                       : largestGrowth * (gone + elasticReach / endOfElasticity);
}

/// p of the piece in hand. \return whether there is one
template<int Rows, int Forces>
bool CollapsePath<Rows, Forces>::push()
{
    if (!now.system.factorise())
    {
        return false;
    }
    pushed = now.system.solve(now.system.liveLoad);
    const double size = pushed.template lpNorm<Eigen::Infinity>();
    return size > 0 && std::isfinite(size);
}

/// After a step that was too long: again from where it began, with a quarter of it. \return whether that is
/// possible
template<int Rows, int Forces>
bool CollapsePath<Rows, Forces>::goBack(Walk& walk)
{
    if (Forces == 2 || pieceCount == walk.begin || !(walk.longest > shortestStep))
    {
        return false;
    }
    walk.longest = 0.25 * walk.lastDistance;
    walk.gone = walk.lastGone;
    walk.boundary = Boundary::none;
    now.stretch = walk.lastStretch;
    now.multiplier = walk.lastAlpha;
    now.pieces = walk.lastPieces;
    for (int point = 0; point < now.count(); ++point)
    {
        now.update(point);
    }
    return true;
}

/// Forwards or backwards along the direction. \param before the direction of the last piece
template<int Rows, int Forces>
void CollapsePath<Rows, Forces>::chooseSense(const Walk& walk, const VectorXd& before)
{
    if (pieceCount == walk.begin)
    {
        orient(now.system.liveLoad.dot(direction));
    }
    else if (walk.boundary == Boundary::none || walk.boundary == Boundary::turning)
    {
        orient(before.dot(direction)); // after a step that was shortened
    }
    else
    {
        orient(now.pieces[static_cast<std::size_t>(walk.last)].rateWithin(
            walk.boundary, now.at(walk.last), State::partOf(stretchRate, walk.last)));
    }
}

/// What the path ends with where elasticity is negligible.
template<int Rows, int Forces>
PathEnd CollapsePath<Rows, Forces>::endOfPath()
{
    now.correct(pushed);
    if (alphaRate > noGrowth)
    {
        return PathEnd::unfinished;
    }
    const double work = now.system.liveLoad.dot(direction);
    return work > noWork ? PathEnd::collapse : work > -noWork ? PathEnd::fall : PathEnd::reversed;
}

/// Goes a step along the direction. \param first where a point leaves its piece of the law \param leaving
/// that point
template<int Rows, int Forces>
void CollapsePath<Rows, Forces>::take(Walk& walk, double distance, const typename Piece::Exit& first,
                                      int leaving)
{
    if constexpr (Forces == 3)
    {
        walk.lastDistance = distance;
        walk.lastAlpha = now.multiplier;
        walk.lastGone = walk.gone;
        walk.lastStretch = now.stretch;
        walk.lastPieces = now.pieces;
        walk.longest *= 2;
    }
    walk.gone += distance;
    now.stretch += distance * stretchRate;
    now.multiplier += distance * alphaRate;
    walk.boundary = distance < first.distance ? Boundary::none : first.boundary;
    if (walk.boundary != Boundary::none)
    {
        walk.last = leaving;
        now.pieces[static_cast<std::size_t>(leaving)].cross(walk.boundary);
        now.update(leaving);
    }
    now.returnToLaw();
}

template<int Rows, int Forces>
PathEnd CollapsePath<Rows, Forces>::follow(int mostPieces, const CollapsePathSettings& settings)
{
    Walk walk{.begin = pieceCount};
    for (; pieceCount < walk.begin + mostPieces; ++pieceCount)
    {
        if (settings.isOver && settings.isOver())
        {
            return PathEnd::stopped;
        }
        if (!push())
        {
            return PathEnd::unfinished;
        }
        if ((Forces == 3 || pieceCount % piecesToCorrection == 0) && !now.correct(pushed))
        {
            if (!goBack(walk))
            {
                return PathEnd::unfinished;
            }
            continue;
        }
        const VectorXd before = direction;
        const double size = pushed.template lpNorm<Eigen::Infinity>();
        direction = pushed / size;
        alphaRate = 1 / size;
        if (!(refineDirection(State::sufficientBalance) < accepted))
        {
            return PathEnd::unfinished;
        }
        chooseSense(walk, before);
        int leaving = -1;
        typename Piece::Exit first =
            now.firstExit(stretchRate, still * stretchRate.lpNorm<Eigen::Infinity>(), leaving);
        double distance =
            std::min({first.distance, now.turningDistance(stretchRate), stepLimit(walk.gone), walk.longest});
        if (walk.gone + distance > elasticReach)
        {
            if (!(refineDirection(refined) < accepted))
            {
                return PathEnd::unfinished;
            }
            chooseSense(walk, before);
            first = now.firstExit(stretchRate, stillRefined * stretchRate.lpNorm<Eigen::Infinity>(), leaving);
            distance = std::min({first.distance, now.turningDistance(stretchRate), stepLimit(walk.gone)});
            if (walk.gone + distance > elasticReach)
            {
                return endOfPath();
            }
        }
        take(walk, distance, first, leaving);
        if (settings.observe)
        {
            settings.observe(pieceCount, now.multiplier * now.system.force / now.system.live);
        }
    }
    return PathEnd::unfinished;
}

template<int Rows, int Forces>
CollapsePair CollapsePath<Rows, Forces>::pair(PathEnd end) const
{
    CollapsePair result;
    result.end = end;
    result.multiplier = now.multiplier * now.system.force / now.system.live;
    result.contactForce = now.system.force * now.contactForces();
    if (direction.size() == 0) // not even the first piece was found
    {
        result.mechanism = VectorXd::Zero(given.load.size());
    }
    else
    {
        result.mechanism = now.system.scaledRows(direction);
        result.mechanism /= end == PathEnd::collapse ? given.liveLoad.dot(result.mechanism)
                                                     : result.mechanism.template lpNorm<Eigen::Infinity>();
    }
    result.pieces = pieceCount;
    result.factorisations = now.system.factorisations;
    result.solves = now.system.solves;
    return result;
}

} // namespace

template<int Rows, int Forces>
CollapsePair followCollapsePath(const ConeProgram<Rows, Forces>& program, const VectorXd& contactForce,
                                double multiplier, const CollapsePathSettings& settings)
{
    if (!program.hasMultiplier() || program.hasInertia() || program.hasCompliance() || program.gap.size() > 0)
    {
        throw std::invalid_argument("followCollapsePath is for dead and live load alone");
    }
    CollapsePath<Rows, Forces> path(program, contactForce, multiplier, settings);
    constexpr int piecesOfPoint = Forces == 2 ? 10 : 4;
    const int mostPieces =
        settings.maximumPieces > 0 ? settings.maximumPieces : 1000 + piecesOfPoint * program.points();
    PathEnd end = path.follow(mostPieces, settings);
    if (end == PathEnd::collapse && settings.finalDilatancy < settings.dilatancy)
    {
        path.changeDilatancy(settings.finalDilatancy);
        end = path.follow(mostPieces, settings);
    }
    return path.pair(end);
}

template CollapsePair followCollapsePath(const PlaneConeProgram& program, const VectorXd& contactForce,
                                         double multiplier, const CollapsePathSettings& settings);
template CollapsePair followCollapsePath(const SpaceConeProgram& program, const VectorXd& contactForce,
                                         double multiplier, const CollapsePathSettings& settings);

} // namespace drystone
