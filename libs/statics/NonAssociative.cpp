// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/NonAssociative.h"

#include "conic/coulomb/CollapsePath.h"
#include "conic/form/Form.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// Stiffnesses of the joints differ by factors up to exp(2 spread): little on the first path, so that blocks
/// alike do not change at once, and more on others.
constexpr double firstSpread = 0.2;
constexpr double secondSpread = 0.5;
constexpr double largestSpread = 1.5;

/// gamma of the first path, whose mechanism is that of the associative law; later ones have 1.01 to 2.
constexpr double firstPenalty = 5;

/// Forces at the start of a path are moved inwards by this share of those for the dead load.
constexpr double inwards = 0.01;

/// Every so many paths begin with other forces for the dead load, from a random objective.
constexpr int pathsToOtherForces = 8;

/// Paths besides those asked for, until there is a pair.
constexpr int furtherStarts = 4;

/// Dilatancy of blocks that fall: first, and what remains of it in the pair, as a share of the tolerance.
constexpr double wedging = 3e-2;
constexpr double remainingDilatancy = 0.1;

/// Tolerance of programs whose forces are nothing but a start.
constexpr double startTolerance = 1e-6;

/// Points that open or slide by less than this share of the largest rate stand still.
constexpr double stillRate = 1e-7;

/// Exchanges of forces and mechanism after a path, while each lowers the multiplier by this share.
constexpr int mostExchanges = 8;
constexpr double leastGain = 1e-7;

/// Forces nearer to a limit than this share of the largest are at it.
constexpr double atLimit = 1e-7;

/// A mechanism is another one where what is in the way of a lower multiplier moves less by this share.
constexpr double smallestChange = 1e-3;

/// Of the forces that keep points from moving, whose weights in the objective are at most 1.
constexpr double widestBound = 1e4;

/// Forces and what they carry besides the dead load.
struct Start
{
    double alpha = 0;
    VectorXd contactForce;
};

struct Pair
{
    double alpha = std::numeric_limits<double>::infinity();
    VectorXd contactForce;
    VectorXd mechanism;
    CoulombResiduals residuals;
    bool exists() const { return contactForce.size() > 0; }
};

/// A pair with the least multiplier that its mechanism allows.
struct Least
{
    Pair pair;
    VectorXd balance; ///< multipliers of the equations of balance
};

template<int Rows, int Forces>
class Search
{
public:
    using Program = ConeProgram<Rows, Forces>;

    /// \param work the associative analysis, whose work it adds to
    Search(const Program& program, const NonAssociativeSettings& settings,
           const InteriorPointSettings& solver, LimitAnalysis& work)
        : given(program),
          searchSettings(settings),
          solverSettings(solver),
          effort(work),
          generator(static_cast<std::mt19937::result_type>(settings.seed))
    {
        range.lowest = std::numeric_limits<double>::infinity();
        range.highest = -range.lowest;
        range.associative = range.lowest;
        if (work.status == CollapseStatus::optimal)
        {
            range.associative = work.alpha;
            associativePair = {
                work.alpha, work.contactForce, work.mechanism / program.liveLoad.dot(work.mechanism), {}};
        }
    }

    /// \return whether there are forces for the dead load to begin with
    bool findRest()
    {
        Program dead = given;
        dead.liveLoad.resize(0);
        InteriorPointSettings settings = solverSettings;
        settings.tolerance = std::max(solverSettings.tolerance, startTolerance);
        const ConeSolution resting = solve(dead, settings);
        restingStart.contactForce = resting.contactForce;
        return resting.status == SolveStatus::optimal;
    }

    /// One path and what follows from it.
    void go(int number)
    {
        ++range.starts;
        double spread = number == 0 ? firstSpread : number == 1 ? secondSpread : largestSpread * uniform();
        std::optional<Start> start;
        if (number == 0)
        {
            start = associativePair.exists() ? lowForces(associativePair, firstPenalty) : std::nullopt;
        }
        else if (number % pathsToOtherForces == pathsToOtherForces - 1)
        {
            start = otherRest();
        }
        else if (number > 1 && lowest.exists())
        {
            const double gamma = 1 + std::pow(10, -2 * uniform());
            start = lowForces(number % 2 == 1 ? lowest : latestPair, gamma);
        }
        else if (number > 1)
        {
            spread = largestSpread * uniform();
        }
        const CollapsePathSettings settings{.stiffnessSpread = spread,
                                            .seed = static_cast<unsigned>(generator())};
        const Start from = start.value_or(restingStart);
        range.converged += follow(from, settings) || (!lowest.exists() && followWedged(from, settings));
    }

    CoulombRange range;
    Pair lowest;
    Pair fall;  ///< the lowest, on whose mechanism the live load does no work
    Pair below; ///< the highest of those below zero

private:
    ConeSolution solve(const Program& program, const InteriorPointSettings& settings)
    {
        ConeSolution solution = solveInteriorPoint(program, settings, &symbolicAnalysis);
        effort.iterations += solution.iterations;
        effort.factorisations += solution.factorisations;
        effort.solves += solution.solves;
        return solution;
    }

    CollapsePair path(const Start& start, const CollapsePathSettings& settings)
    {
        CollapsePair pair = followCollapsePath(given, start.contactForce, start.alpha, settings);
        effort.iterations += pair.pieces;
        effort.factorisations += pair.factorisations;
        effort.solves += pair.solves;
        return pair;
    }

    /// In [0, 1), the same on every machine.
    double uniform() { return static_cast<double>(generator()) / 4294967296.0; }

    Start movedInwards(double alpha, const VectorXd& contactForce) const
    {
        return {(1 - inwards) * alpha, (1 - inwards) * contactForce + inwards * restingStart.contactForce};
    }

    /// Forces for the dead load with little pressure at random points.
    std::optional<Start> otherRest()
    {
        Program dead = given;
        dead.liveLoad.resize(0);
        dead.gap = VectorXd::Zero(Forces * given.points());
        for (int point = 0; point < given.points(); ++point)
        {
            const double weight = std::pow(10, -2 * uniform());
            dead.gap[Forces * point] = weight;
            for (int shear = 1; shear < Forces; ++shear)
            {
                dead.gap[Forces * point + shear] = 0.3 * weight * (2 * uniform() - 1);
            }
        }
        InteriorPointSettings settings = solverSettings;
        settings.tolerance = std::max(solverSettings.tolerance, startTolerance);
        const ConeSolution other = solve(dead, settings);
        return other.status == SolveStatus::optimal ? std::optional(movedInwards(0, other.contactForce))
                                                    : std::nullopt;
    }

    /// Forces of a low multiplier that suit the mechanism of a pair.
    std::optional<Start> lowForces(const Pair& pair, double gamma)
    {
        Program reversed = given;
        reversed.liveLoad = -given.liveLoad;
        reversed.gap = VectorXd::Zero(Forces * given.points());
        const VectorXd closing = applyTransposed(given, pair.mechanism);
        for (int point = 0; point < given.points(); ++point)
        {
            const double slip = closing.template segment<Forces - 1>(Forces * point + 1).norm();
            reversed.gap[Forces * point] = gamma
                                           * (given.friction[static_cast<std::size_t>(point)] * slip
                                              + std::max(0.0, -closing[Forces * point]));
        }
        InteriorPointSettings settings = solverSettings;
        settings.tolerance = std::max(solverSettings.tolerance, startTolerance);
        const ConeSolution low = solve(reversed, settings);
        return low.status == SolveStatus::optimal
                   ? std::optional(movedInwards(-low.multiplier, low.contactForce))
                   : std::nullopt;
    }

    /// Takes a pair that meets the tolerance. \return whether it does
    bool consider(Pair pair)
    {
        pair.residuals = coulombResiduals(given, pair.alpha, pair.contactForce, pair.mechanism);
        if (!(pair.residuals.worst() <= searchSettings.tolerance))
        {
            return false;
        }
        // Below zero the mechanism would be driven by the dead load, which is carried where loading begins.
        if (pair.alpha < 0)
        {
            if (!below.exists() || pair.alpha > below.alpha)
            {
                below = std::move(pair);
            }
            return false;
        }
        range.lowest = std::min(range.lowest, pair.alpha);
        range.highest = std::max(range.highest, pair.alpha);
        latestPair = pair;
        if (!(pair.alpha >= lowest.alpha))
        {
            lowest = std::move(pair);
        }
        return true;
    }

    /// Takes blocks that fall under the dead load alone.
    void considerFall(const CollapsePair& found)
    {
        Pair pair{found.multiplier, found.contactForce, found.mechanism, {}};
        pair.residuals = coulombResiduals(given, pair.alpha, pair.contactForce, pair.mechanism, 0);
        if (pair.alpha >= 0 && pair.residuals.worst() <= searchSettings.tolerance && pair.alpha < fall.alpha)
        {
            range.fall = pair.alpha;
            fall = std::move(pair);
        }
    }

    /// Follows a path, and makes the multiplier of its pair least. \return whether it has led to a pair
    bool follow(const Start& start, const CollapsePathSettings& settings)
    {
        CollapsePair found = path(start, settings);
        if (found.end == PathEnd::fall)
        {
            considerFall(found);
        }
        if (found.end != PathEnd::collapse)
        {
            return false;
        }
        Pair pair{found.multiplier, std::move(found.contactForce), std::move(found.mechanism), {}};
        if (!consider(pair))
        {
            return false;
        }
        descend(std::move(pair));
        return true;
    }

    /// From a pair to lower ones: the least multiplier with its mechanism held, then another mechanism of
    /// those forces, in turn, while the multiplier falls.
    void descend(Pair pair)
    {
        double highest = std::numeric_limits<double>::infinity();
        for (int round = 0; round < mostExchanges; ++round)
        {
            std::optional<Least> least = leastOf(pair);
            if (!least || !(least->pair.alpha < highest) || !consider(least->pair))
            {
                return;
            }
            highest = least->pair.alpha - leastGain * std::abs(least->pair.alpha);
            std::optional<VectorXd> other = otherMechanism(*least);
            if (!other)
            {
                return;
            }
            pair = {least->pair.alpha, std::move(least->pair.contactForce), std::move(*other), {}};
        }
    }

    /// The same with a little dilatancy, which is taken away at the end but for what the tolerance allows;
    /// from the start, and from the forces of the associative collapse, where less has to move until all is
    /// wedged.
    bool followWedged(const Start& start, CollapsePathSettings settings)
    {
        settings.dilatancy = wedging;
        settings.finalDilatancy = remainingDilatancy * searchSettings.tolerance;
        if (follow(start, settings))
        {
            return true;
        }
        if (!associativePair.exists())
        {
            return false;
        }
        const Start near = movedInwards(associativePair.alpha, associativePair.contactForce);
        CollapsePathSettings little = settings;
        little.dilatancy = settings.finalDilatancy;
        return follow(near, settings) || follow(near, little);
    }

    /// Least alpha among the forces that suit the mechanism of a pair: those of points that open or crush
    /// stay as they are; at points that slide, t = (C + mu n) d against the slip, so that one column remains,
    /// with the constant part as a load; all others are free within their limits.
    std::optional<Least> leastOf(const Pair& pair)
    {
        const VectorXd closing = applyTransposed(given, pair.mechanism);
        const double still = stillRate * closing.template lpNorm<Eigen::Infinity>();
        Program suited = given;
        suited.liveLoad = -given.liveLoad;
        VectorXd constant = VectorXd::Zero(Forces * given.points());
        for (int point = 0; point < given.points(); ++point)
        {
            const auto at = static_cast<std::size_t>(point);
            const auto slip = closing.template segment<Forces - 1>(Forces * point + 1);
            const double size = slip.norm();
            auto& columns = suited.contacts[at];
            if (std::abs(closing[Forces * point]) > still)
            {
                constant.template segment<Forces>(Forces * point) =
                    pair.contactForce.template segment<Forces>(Forces * point);
                columns.onFirst.setZero();
                columns.onSecond.setZero();
            }
            else if (size > still)
            {
                const Eigen::Matrix<double, Forces - 1, 1> direction = slip / size;
                const double friction = given.friction[at];
                for (auto* side : {&columns.onFirst, &columns.onSecond})
                {
                    side->col(0) += friction * side->template rightCols<Forces - 1>() * direction;
                }
                if (given.hasStrength())
                {
                    constant.template segment<Forces - 1>(Forces * point + 1) =
                        given.strength[at].cohesion * direction;
                    suited.strength[at].cohesion = 0;
                }
                suited.friction[at] = 0;
            }
        }
        suited.load -= applyEquilibrium(given, constant);
        // Columns without force have no say, and their points are left out.
        std::vector<int> kept;
        for (int point = 0; point < given.points(); ++point)
        {
            const auto& columns = suited.contacts[static_cast<std::size_t>(point)];
            if (!columns.onFirst.isZero(0) || !columns.onSecond.isZero(0))
            {
                const auto to = kept.size();
                suited.contacts[to] = columns;
                suited.friction[to] = suited.friction[static_cast<std::size_t>(point)];
                if (given.hasStrength())
                {
                    suited.strength[to] = suited.strength[static_cast<std::size_t>(point)];
                }
                kept.push_back(point);
            }
        }
        suited.contacts.resize(kept.size());
        suited.friction.resize(kept.size());
        suited.strength.resize(given.hasStrength() ? kept.size() : 0);
        const ConeSolution solved = solve(suited, solverSettings);
        if (solved.status != SolveStatus::optimal)
        {
            return std::nullopt;
        }
        Pair least{-solved.multiplier, std::move(constant), pair.mechanism, {}};
        for (std::size_t i = 0; i < kept.size(); ++i)
        {
            auto force = least.contactForce.template segment<Forces>(Forces * kept[i]);
            const auto from =
                solved.contactForce.template segment<Forces>(static_cast<Eigen::Index>(Forces * i));
            const auto slip = closing.template segment<Forces - 1>(Forces * kept[i] + 1);
            const double size = slip.norm();
            if (size > still)
            {
                force[0] = from[0];
                force.template tail<Forces - 1>() +=
                    given.friction[static_cast<std::size_t>(kept[i])] * from[0] * slip / size;
            }
            else
            {
                force = from;
            }
        }
        return Least{std::move(least), solved.displacement};
    }

    /// Of the mechanisms that forces of a least multiplier allow, one that moves points as little as may be
    /// which keep the multiplier from being less:
    ///
    ///     minimise  sum_k w_k s_k + v_k o_k    subject to  L'y = 1,
    ///
    /// slips s_k and opening rates o_k of the points where the forces are at their limits; at others nothing
    /// moves. The weights are by how much the multiplier would fall for a unit less of shear against the
    /// slip, or more of pressure: with u for the multipliers of the equations of balance, L'u = -1,
    ///
    ///     w = -d'(A'u)_t,    v = (A'u)_n + mu |(A'u)_t|,    no less than 0.
    ///
    /// Where s_k or o_k becomes zero the next forces have that freedom. \return none where no point is in the
    /// way of a lower multiplier, so that it is the least nearby
    std::optional<VectorXd> otherMechanism(const Least& least)
    {
        const VectorXd closing = applyTransposed(given, least.pair.mechanism);
        const double still = stillRate * closing.template lpNorm<Eigen::Infinity>();
        const VectorXd price = applyTransposed(given, least.balance);
        const VectorXd& forces = least.pair.contactForce;
        const double none = atLimit * forces.template lpNorm<Eigen::Infinity>();
        VectorXd against = VectorXd::Zero(forces.size()); // w and v, as forces of the points
        for (int point = 0; point < given.points(); ++point)
        {
            const double friction = given.friction[static_cast<std::size_t>(point)];
            const auto slip = closing.template segment<Forces - 1>(Forces * point + 1);
            const auto shearPrice = price.template segment<Forces - 1>(Forces * point + 1);
            const double normalPrice = price[Forces * point];
            if (closing[Forces * point] < -still)
            {
                against[Forces * point] = std::max(0.0, normalPrice + friction * shearPrice.norm());
            }
            else if (slip.norm() > still)
            {
                const double weight = std::max(0.0, -shearPrice.dot(slip) / slip.norm());
                against.template segment<Forces - 1>(Forces * point + 1) = -weight * slip / slip.norm();
            }
        }
        const double largest = against.template lpNorm<Eigen::Infinity>();
        if (!(largest > stillRate * price.template lpNorm<Eigen::Infinity>()))
        {
            return std::nullopt;
        }
        against /= largest;

        // Every component of A'y that is restricted, as a point with a normal force alone: one that must not
        // close, or one that must not move, which a force between wide bounds prevents.
        Program rates;
        rates.bodies = given.bodies;
        rates.liveLoad = given.liveLoad;
        rates.load = applyEquilibrium(given, against);
        const auto restrict =
            [&](int point, const Eigen::Matrix<double, Forces, 1>& component, bool isOneSided)
        {
            ConeColumns<Rows, Forces> columns = given.contacts[static_cast<std::size_t>(point)];
            for (auto* side : {&columns.onFirst, &columns.onSecond})
            {
                side->col(0) = (*side * component).eval();
                side->template rightCols<Forces - 1>().setZero();
            }
            rates.contacts.push_back(columns);
            rates.friction.push_back(0);
            rates.strength.push_back(isOneSided ? Strength{}
                                                : Strength{.tension = widestBound, .crushing = widestBound});
        };
        using Force = Eigen::Matrix<double, Forces, 1>;
        for (int point = 0; point < given.points(); ++point)
        {
            const Strength strength =
                given.hasStrength() ? given.strength[static_cast<std::size_t>(point)] : Strength{};
            const Force force = forces.template segment<Forces>(Forces * point);
            const double limit =
                strength.cohesion + given.friction[static_cast<std::size_t>(point)] * force[0];
            const auto shear = force.template tail<Forces - 1>();
            Force component = Force::Unit(0);
            const bool opens = force[0] <= -strength.tension + none;
            const bool closes = force[0] >= strength.crushing - none;
            restrict(point, closes ? Force(-component) : component, opens || closes);
            if (limit <= none)
            {
                continue;
            }
            if (shear.norm() < limit - none)
            {
                for (int i = 1; i < Forces; ++i)
                {
                    restrict(point, Force::Unit(i), false);
                }
                continue;
            }
            component << 0, -shear / shear.norm();
            restrict(point, component, true);
            if constexpr (Forces == 3)
            {
                component << 0, -shear[1] / shear.norm(), shear[0] / shear.norm();
                restrict(point, component, false);
            }
        }
        const ConeSolution solved = solve(rates, solverSettings);
        const double inTheWay = -rates.load.dot(least.pair.mechanism);
        return solved.status == SolveStatus::optimal
                       && -rates.load.dot(solved.displacement) < (1 - smallestChange) * inTheWay
                   ? std::optional(solved.displacement)
                   : std::nullopt;
    }

    const Program& given;
    NonAssociativeSettings searchSettings;
    InteriorPointSettings solverSettings;
    LimitAnalysis& effort;
    SymbolicAnalysis symbolicAnalysis; ///< of the last program: most have the same points
    std::mt19937 generator;
    Pair associativePair; ///< where there is one; of the associative law
    Start restingStart;
    Pair latestPair;
};

} // namespace

void declare(Options& options, NonAssociativeSettings& settings)
{
    options
        .optional("starts", settings.starts,
                  "paths to collapse: more of them find lower collapses of the many that Coulomb's law has")
        .atLeast(1)
        .atMost(1000);
    options.optional("seed", settings.seed, "of the random numbers that later starts are made from")
        .atLeast(0);
    options.optional("tolerance", settings.tolerance, "on the residuals of yield and flow")
        .above(0)
        .atMost(1e-3);
}

template<int Rows, int Forces>
LimitAnalysis solveNonAssociative(const ConeProgram<Rows, Forces>& program,
                                  const NonAssociativeSettings& settings, const InteriorPointSettings& solver)
{
    LimitAnalysis result = solveLimitAnalysis(program, solver);
    // What no forces in the friction cones can carry falls with either law.
    if (result.status == CollapseStatus::unstable)
    {
        return result;
    }
    const CollapseStatus associative = result.status;
    Search<Rows, Forces> search(program, settings, solver, result);
    if (search.findRest())
    {
        const auto goesOn = [&](int start) {
            return start < settings.starts
                   || (start < settings.starts + furtherStarts && !search.lowest.exists());
        };
        for (int start = 0; goesOn(start); ++start)
        {
            search.go(start);
        }
    }
    const Pair& found = search.lowest.exists() ? search.lowest
                        : search.fall.exists() ? search.fall
                                               : search.below;
    result.coulomb = search.range;
    if (!found.exists())
    {
        result.status = associative == CollapseStatus::unbounded ? CollapseStatus::unbounded
                                                                 : CollapseStatus::notConverged;
        return result;
    }
    result.status = CollapseStatus::optimal;
    result.alpha = found.alpha;
    result.contactForce = found.contactForce;
    result.mechanism = found.mechanism / found.mechanism.template lpNorm<Eigen::Infinity>();
    result.certificate = {std::max(found.residuals.balance, found.residuals.yield), found.residuals.flow,
                          found.residuals.mismatch};
    return result;
}

template LimitAnalysis solveNonAssociative(const PlaneConeProgram& program,
                                           const NonAssociativeSettings& settings,
                                           const InteriorPointSettings& solver);
template LimitAnalysis solveNonAssociative(const SpaceConeProgram& program,
                                           const NonAssociativeSettings& settings,
                                           const InteriorPointSettings& solver);

} // namespace drystone
