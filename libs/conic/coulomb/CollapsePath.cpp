// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From one point's exit to the next; in space steps are corrected at once, and taken back if too long.
#include "conic/coulomb/CollapsePath.h"

#include "conic/coulomb/CollapseSystem.h"

#include <random>
#include <stdexcept>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// In space a step is corrected at once; in the plane, where nothing but rounding adds up, sometimes.
constexpr int piecesToCorrection = 8;
constexpr int mostCorrections = 4;
constexpr double balanced = 1e-14;        ///< relative to the largest load
constexpr double largestImbalance = 1e-5; ///< likewise: the path is lost
constexpr double shortestStep = 1e-9;

/// In space a step may take points beyond their piece of the law by so much of the largest load.
constexpr double beyondLaw = 1e-9;

/// A direction is refined, for what the regularisation and missing pivots have changed, until the residual is
/// so small a share of its largest entry, at the end of the path smaller. What is larger than `accepted`
/// after that is wrong.
constexpr int mostRefinementsOfCollapse = 8;
constexpr double sufficient = 1e-12;
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

/// A slip may turn by this angle in one step, and more where its force is a small share of the largest load.
constexpr double largestTurn = 0.2;
constexpr double smallForce = 0.05;

/// In space displacements grow by no more than this factor in one step.
constexpr double largestGrowth = 10;

template<int Rows, int Forces>
class CollapsePath
{
public:
    using Piece = CollapsePiece<Forces>;
    using Force = typename Piece::Force;

    CollapsePath(const ConeProgram<Rows, Forces>& program, const VectorXd& contactForce, double multiplier,
                 const CollapsePathSettings& settings);

    PathEnd follow(int mostPieces, const std::function<void(int, double)>& observe);
    /// Another psi from now on, with the same forces and slips.
    void changeDilatancy(double dilatancy);
    CollapsePair pair(PathEnd end) const;

private:
    Force at(int point) const { return stretch.template segment<Forces>(Forces * point); }
    Force rateAt(int point) const { return stretchRate.template segment<Forces>(Forces * point); }
    int count() const { return static_cast<int>(states.size()); }

    VectorXd contactForces() const;
    VectorXd stretched(VectorXd closing) const;
    void update(int point)
    {
        scaled.change(point,
                      stiffnesses[point] * states[static_cast<std::size_t>(point)].derivative(at(point)));
    }
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
        std::vector<Piece> lastStates = {};
    };

    bool push();
    bool correct();
    bool goBack(Walk& walk);
    void chooseSense(const Walk& walk, const VectorXd& before);
    PathEnd endOfPath();
    void take(Walk& walk, double distance, const typename Piece::Exit& first, int leaving);
    double refineDirection(double enough);
    void orient(double onwards);
    typename Piece::Exit firstExit(double ignored, int& leaving) const;
    double turningDistance() const;
    double stepLimit(double gone) const;

    const ConeProgram<Rows, Forces>& given;
    CollapseSystem<Rows, Forces> scaled;
    VectorXd stiffnesses; ///< of each point
    std::vector<Piece> states;
    VectorXd stretch;
    double alphaNow = 0;
    double elasticReach;  ///< displacements beyond which elasticity is negligible
    VectorXd pushed;      ///< p, K p = L
    VectorXd direction;   ///< dv/ds, largest entry 1
    VectorXd stretchRate; ///< dw/ds
    double alphaRate = 0;
    int pieceCount = 0;
};

template<int Rows, int Forces>
CollapsePath<Rows, Forces>::CollapsePath(const ConeProgram<Rows, Forces>& program,
                                         const VectorXd& contactForce, double multiplier,
                                         const CollapsePathSettings& settings)
    : given(program),
      scaled(program),
      stretch(contactForce / scaled.force),
      alphaNow(multiplier * scaled.live / scaled.force),
      elasticReach(endOfElasticity * (1 + stretch.template lpNorm<Eigen::Infinity>()))
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
        if (program.hasStrength())
        {
            piece.strength = program.strength[static_cast<std::size_t>(point)];
            piece.strength.cohesion /= scaled.force;
            piece.strength.tension /= scaled.force;
            piece.strength.crushing /= scaled.force;
        }
        piece.find(at(point));
        states.push_back(piece);
        update(point);
    }
}

template<int Rows, int Forces>
VectorXd CollapsePath<Rows, Forces>::contactForces() const
{
    VectorXd forces(stretch.size());
    for (int point = 0; point < count(); ++point)
    {
        forces.template segment<Forces>(Forces * point) =
            states[static_cast<std::size_t>(point)].force(at(point));
    }
    return forces;
}

/// k times a closing
template<int Rows, int Forces>
VectorXd CollapsePath<Rows, Forces>::stretched(VectorXd closing) const
{
    for (int point = 0; point < count(); ++point)
    {
        closing.template segment<Forces>(Forces * point) *= stiffnesses[point];
    }
    return closing;
}

/// Steps of Newton's method back to the path, across its direction. \return whether they lead there
template<int Rows, int Forces>
bool CollapsePath<Rows, Forces>::correct()
{
    const auto imbalance = [&]() -> VectorXd
    { return scaled.load + alphaNow * scaled.liveLoad - scaled.columnsTimes(contactForces()); };
    VectorXd residual = imbalance();
    double before = residual.lpNorm<Eigen::Infinity>();
    for (int round = 0; round < mostCorrections && before > balanced; ++round)
    {
        const VectorXd moved = scaled.solve(residual);
        const double share = -pushed.dot(moved) / pushed.squaredNorm();
        const VectorXd from = stretch;
        stretch += stretched(scaled.columnsTransposedTimes(moved + share * pushed));
        alphaNow += share;
        residual = imbalance();
        const double after = residual.lpNorm<Eigen::Infinity>();
        if (!(after < before))
        {
            stretch = from;
            alphaNow -= share;
            break;
        }
        before = after;
        if (before < sufficient)
        {
            break;
        }
    }
    return before < largestImbalance;
}

/// K v' = alpha' L \return the residual that is left
template<int Rows, int Forces>
double CollapsePath<Rows, Forces>::refineDirection(double enough)
{
    double before = std::numeric_limits<double>::infinity();
    VectorXd closing = scaled.columnsTransposedTimes(direction);
    for (int round = 0; round < mostRefinementsOfCollapse; ++round)
    {
        const VectorXd residual = alphaRate * scaled.liveLoad - scaled.columnsTimes(scaled.forcesOf(closing));
        const double error = residual.lpNorm<Eigen::Infinity>();
        if (!(error < 0.5 * before) || error < enough)
        {
            before = std::min(before, error);
            break;
        }
        before = error;
        const VectorXd moved = scaled.solve(residual);
        const double share = -pushed.dot(moved) / pushed.squaredNorm();
        direction += moved + share * pushed;
        alphaRate += share;
        closing = scaled.columnsTransposedTimes(direction);
    }
    stretchRate = stretched(std::move(closing));
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

/// The first point to leave its piece of the law.
template<int Rows, int Forces>
typename CollapsePath<Rows, Forces>::Piece::Exit CollapsePath<Rows, Forces>::firstExit(double ignored,
                                                                                       int& leaving) const
{
    typename Piece::Exit first;
    for (int point = 0; point < count(); ++point)
    {
        const typename Piece::Exit exit =
            states[static_cast<std::size_t>(point)].exit(at(point), rateAt(point), ignored);
        if (exit.distance < first.distance)
        {
            first = exit;
            leaving = point;
        }
    }
    return first;
}

/// How far until the slip of a point has turned by as much as a step may; no limit in the plane.
template<int Rows, int Forces>
double CollapsePath<Rows, Forces>::turningDistance() const
{
    double distance = std::numeric_limits<double>::infinity();
    if constexpr (Forces == 3)
    {
        for (int point = 0; point < count(); ++point)
        {
            const Piece& piece = states[static_cast<std::size_t>(point)];
            const Force w = at(point);
            const Force rate = rateAt(point);
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

/// In space the final direction is approached as displacements grow: none is final before they have.
template<int Rows, int Forces>
double CollapsePath<Rows, Forces>::stepLimit(double gone) const
{
    return Forces == 2 ? std::numeric_limits<double>::infinity()
                       : largestGrowth * (gone + elasticReach / endOfElasticity);
}

/// w = c + lambda (-psi, d) of the points that press and slide
template<int Rows, int Forces>
void CollapsePath<Rows, Forces>::changeDilatancy(double dilatancy)
{
    for (int point = 0; point < count(); ++point)
    {
        Piece& piece = states[static_cast<std::size_t>(point)];
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

/// p of the piece in hand. \return whether there is one
template<int Rows, int Forces>
bool CollapsePath<Rows, Forces>::push()
{
    if (!scaled.factorise())
    {
        return false;
    }
    pushed = scaled.solve(scaled.liveLoad);
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
    stretch = walk.lastStretch;
    alphaNow = walk.lastAlpha;
    states = walk.lastStates;
    for (int point = 0; point < count(); ++point)
    {
        update(point);
    }
    return true;
}

/// Forwards or backwards along the direction. \param before the direction of the last piece
template<int Rows, int Forces>
void CollapsePath<Rows, Forces>::chooseSense(const Walk& walk, const VectorXd& before)
{
    if (pieceCount == walk.begin)
    {
        orient(scaled.liveLoad.dot(direction));
    }
    else if (walk.boundary == Boundary::none || walk.boundary == Boundary::turning)
    {
        orient(before.dot(direction)); // after a step that was shortened
    }
    else
    {
        orient(states[static_cast<std::size_t>(walk.last)].rateWithin(walk.boundary, at(walk.last),
                                                                      rateAt(walk.last)));
    }
}

/// What the path ends with where elasticity is negligible.
template<int Rows, int Forces>
PathEnd CollapsePath<Rows, Forces>::endOfPath()
{
    correct();
    if (alphaRate > noGrowth)
    {
        return PathEnd::unfinished;
    }
    const double work = scaled.liveLoad.dot(direction);
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
        walk.lastAlpha = alphaNow;
        walk.lastGone = walk.gone;
        walk.lastStretch = stretch;
        walk.lastStates = states;
        walk.longest *= 2;
    }
    walk.gone += distance;
    stretch += distance * stretchRate;
    alphaNow += distance * alphaRate;
    walk.boundary = distance < first.distance ? Boundary::none : first.boundary;
    if (walk.boundary != Boundary::none)
    {
        walk.last = leaving;
        states[static_cast<std::size_t>(leaving)].cross(walk.boundary);
        update(leaving);
    }
    if constexpr (Forces == 3)
    {
        for (int point = 0; point < count(); ++point)
        {
            Piece& piece = states[static_cast<std::size_t>(point)];
            if (piece.isSliding || piece.returnToLaw(at(point), beyondLaw))
            {
                update(point);
            }
        }
    }
}

template<int Rows, int Forces>
PathEnd CollapsePath<Rows, Forces>::follow(int mostPieces, const std::function<void(int, double)>& observe)
{
    Walk walk{.begin = pieceCount};
    for (; pieceCount < walk.begin + mostPieces; ++pieceCount)
    {
        if (!push())
        {
            return PathEnd::unfinished;
        }
        if ((Forces == 3 || pieceCount % piecesToCorrection == 0) && !correct())
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
        if (!(refineDirection(sufficient) < accepted))
        {
            return PathEnd::unfinished;
        }
        chooseSense(walk, before);
        int leaving = -1;
        typename Piece::Exit first = firstExit(still * stretchRate.lpNorm<Eigen::Infinity>(), leaving);
        double distance = std::min({first.distance, turningDistance(), stepLimit(walk.gone), walk.longest});
        if (walk.gone + distance > elasticReach)
        {
            if (!(refineDirection(refined) < accepted))
            {
                return PathEnd::unfinished;
            }
            chooseSense(walk, before);
            first = firstExit(stillRefined * stretchRate.lpNorm<Eigen::Infinity>(), leaving);
            distance = std::min({first.distance, turningDistance(), stepLimit(walk.gone)});
            if (walk.gone + distance > elasticReach)
            {
                return endOfPath();
            }
        }
        take(walk, distance, first, leaving);
        if (observe)
        {
            observe(pieceCount, alphaNow * scaled.force / scaled.live);
        }
    }
    return PathEnd::unfinished;
}

template<int Rows, int Forces>
CollapsePair CollapsePath<Rows, Forces>::pair(PathEnd end) const
{
    CollapsePair result;
    result.end = end;
    result.multiplier = alphaNow * scaled.force / scaled.live;
    result.contactForce = scaled.force * contactForces();
    if (direction.size() == 0) // not even the first piece was found
    {
        result.mechanism = VectorXd::Zero(given.load.size());
    }
    else
    {
        result.mechanism = scaled.scaledRows(direction);
        result.mechanism /= end == PathEnd::collapse ? given.liveLoad.dot(result.mechanism)
                                                     : result.mechanism.template lpNorm<Eigen::Infinity>();
    }
    result.pieces = pieceCount;
    result.factorisations = scaled.factorisations;
    result.solves = scaled.solves;
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
    PathEnd end = path.follow(mostPieces, settings.observe);
    if (end == PathEnd::collapse && settings.finalDilatancy < settings.dilatancy)
    {
        path.changeDilatancy(settings.finalDilatancy);
        end = path.follow(mostPieces, settings.observe);
    }
    return path.pair(end);
}

template CollapsePair followCollapsePath(const PlaneConeProgram& program, const VectorXd& contactForce,
                                         double multiplier, const CollapsePathSettings& settings);
template CollapsePair followCollapsePath(const SpaceConeProgram& program, const VectorXd& contactForce,
                                         double multiplier, const CollapsePathSettings& settings);

} // namespace drystone
