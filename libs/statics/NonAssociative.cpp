// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/NonAssociative.h"

#include "conic/coulomb/CollapsePath.h"
#include "conic/form/Form.h"
#include "statics/CoulombExchange.h"
#include "statics/PairRefinement.h"
#include "statics/StepFromRest.h"

#include <algorithm>
#include <array>
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

/// Paths besides those asked for, until one has met a pair.
constexpr int furtherStarts = 4;

/// Dilatancy of blocks that fall: first, and what remains of it in the pair, as a share of the tolerance.
constexpr double wedging = 3e-2;
constexpr double remainingDilatancy = 0.1;

/// Tolerance of programs whose forces are nothing but a start.
constexpr double startTolerance = 1e-6;

/// Pairs that obey the law to this are refined, with points of less slip than each of these in turn at rest.
constexpr double nearlyPair = 2e-3;
constexpr std::array<double, 3> slidesFrom{1e-6, 1e-4, 1e-2};

/// Exchanges of forces and mechanism after a path, while each lowers the multiplier by this share.
constexpr int mostExchanges = 8;
constexpr double leastGain = 1e-7;

/// Forces and what they carry besides the dead load.
struct Start
{
    double alpha = 0;
    VectorXd contactForce;
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
        const ConeSolution resting = solveRoughly(dead);
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

    /// With the forces of the associative collapse a mechanism that does not open where it slides, and what
    /// follows from it: blocks that slide on level joints at alpha = mu.
    void takeAssociativeForces()
    {
        if (!associativePair.exists())
        {
            return;
        }
        ++range.starts;
        std::optional<VectorXd> mechanism =
            mechanismOf<Rows, Forces>(given, associativePair.contactForce, solver());
        if (mechanism)
        {
            CoulombPair pair{associativePair.alpha, associativePair.contactForce, std::move(*mechanism), {}};
            if (take(pair))
            {
                ++range.converged;
                descend(std::move(pair));
            }
        }
    }

    /// Pairs from steps from rest, with the forces of the associative collapse to begin with, or of the dead
    /// load.
    void takeStepsFromRest()
    {
        if (!associativePair.exists() || given.hasCrushing())
        {
            return;
        }
        for (const VectorXd* forces : {&associativePair.contactForce, &restingStart.contactForce})
        {
            ++range.starts;
            std::optional<CoulombPair> pair = pairFromRest<Rows, Forces>(
                given, associativePair.alpha, *forces, [this](CoulombPair& tried) { return consider(tried); },
                effort.factorisations);
            if (pair)
            {
                ++range.converged;
                descend(std::move(*pair));
                return;
            }
        }
    }

    /// Whether the forces at the end of a path are asked for their mechanism where its own is none.
    bool takesMechanisms = false;
    /// Whether all pairs are near the ends of paths, but were not met by them.
    bool isByRefinement = false;
    CoulombRange range;
    CoulombPair lowest;
    CoulombPair fall;  ///< the lowest, on whose mechanism the live load does no work
    CoulombPair below; ///< the highest of those below zero

private:
    ConeSolution solve(const Program& program, const InteriorPointSettings& settings)
    {
        ConeSolution solution = solveInteriorPoint(program, settings, &symbolicAnalysis);
        effort.iterations += solution.iterations;
        effort.factorisations += solution.factorisations;
        effort.solves += solution.solves;
        return solution;
    }

    /// What the exchanges of forces and mechanism solve their programs with.
    ProgramSolver<Rows, Forces> solver()
    {
        return [this](const Program& program) { return solve(program, solverSettings); };
    }

    /// Of a program whose forces are nothing but a start.
    ConeSolution solveRoughly(const Program& program)
    {
        InteriorPointSettings settings = solverSettings;
        settings.tolerance = std::max(solverSettings.tolerance, startTolerance);
        return solve(program, settings);
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
        const ConeSolution other = solveRoughly(dead);
        return other.status == SolveStatus::optimal ? std::optional(movedInwards(0, other.contactForce))
                                                    : std::nullopt;
    }

    /// Forces of a low multiplier that suit the mechanism of a pair.
    std::optional<Start> lowForces(const CoulombPair& pair, double gamma)
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
        const ConeSolution low = solveRoughly(reversed);
        return low.status == SolveStatus::optimal
                   ? std::optional(movedInwards(-low.multiplier, low.contactForce))
                   : std::nullopt;
    }

    /// Judges a pair, and takes it if it meets the tolerance. \return whether it does
    bool consider(CoulombPair& pair)
    {
        pair.alpha = std::min(pair.alpha, range.associative); // which it exceeds by rounding alone
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
                below = pair;
            }
            return false;
        }
        range.lowest = std::min(range.lowest, pair.alpha);
        range.highest = std::max(range.highest, pair.alpha);
        latestPair = pair;
        if (!(pair.alpha >= lowest.alpha))
        {
            lowest = pair;
        }
        return true;
    }

    /// Takes blocks that fall under the dead load alone.
    void considerFall(const CollapsePair& found)
    {
        CoulombPair pair{found.multiplier, found.contactForce, found.mechanism, {}};
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
        const double power = given.liveLoad.dot(found.mechanism);
        if ((found.end != PathEnd::collapse && found.end != PathEnd::unfinished) || power == 0)
        {
            return false;
        }
        CoulombPair pair{found.multiplier, std::move(found.contactForce), found.mechanism / power, {}};
        if (!take(pair) && !(takesMechanisms && takeMechanism(pair)))
        {
            return false;
        }
        descend(std::move(pair));
        return true;
    }

    /// Where a stone slides between others nothing but rounding holds its motion across in the end of a path
    /// in space: its forces are right, and they tell the mechanism. \return whether that is a pair
    bool takeMechanism(CoulombPair& pair)
    {
        std::optional<VectorXd> mechanism = mechanismOf<Rows, Forces>(given, pair.contactForce, solver());
        if (mechanism)
        {
            pair.mechanism = std::move(*mechanism);
        }
        return mechanism && take(pair);
    }

    /// Takes a pair, or one near it. \return whether there is one
    bool take(CoulombPair& pair)
    {
        const bool isFirst = !lowest.exists();
        if (consider(pair))
        {
            isByRefinement = false;
            return true;
        }
        const bool isRefined = refine(pair);
        isByRefinement = isByRefinement || (isRefined && isFirst);
        return isRefined;
    }

    /// Takes the pair to its last digits, where it is near one. \return whether that is one
    bool refine(CoulombPair& pair)
    {
        const double worst = pair.residuals.worst();
        if (!(worst <= nearlyPair) || worst <= searchSettings.tolerance) // of which one is below zero
        {
            return false;
        }
        for (const double slides : slidesFrom)
        {
            std::optional<CoulombPair> refined = refinedPair<Rows, Forces>(given, pair, slides);
            if (!refined)
            {
                return false;
            }
            if (consider(*refined))
            {
                pair = std::move(*refined);
                return true;
            }
            // Where the mechanism is right the forces that suit it are many, not all of them within their
            // limits.
            std::optional<CoulombPair> within = refined->residuals.flow <= searchSettings.tolerance
                                                    ? nearestPair<Rows, Forces>(given, *refined, solver())
                                                    : std::nullopt;
            if (within && consider(*within))
            {
                pair = std::move(*within);
                return true;
            }
        }
        return false;
    }

    /// From a pair to lower ones: the least multiplier with its mechanism held, then another mechanism of
    /// those forces, in turn, while the multiplier falls.
    void descend(CoulombPair pair)
    {
        double highest = std::numeric_limits<double>::infinity();
        for (int round = 0; round < mostExchanges; ++round)
        {
            std::optional<LeastPair> least = leastPair<Rows, Forces>(given, pair, solver());
            if (!least || !(least->pair.alpha < highest) || !consider(least->pair))
            {
                return;
            }
            highest = least->pair.alpha - leastGain * std::abs(least->pair.alpha);
            std::optional<VectorXd> other = otherMechanism<Rows, Forces>(given, *least, solver());
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

    const Program& given;
    NonAssociativeSettings searchSettings;
    InteriorPointSettings solverSettings;
    LimitAnalysis& effort;
    SymbolicAnalysis symbolicAnalysis; ///< of the last program: most have the same points
    std::mt19937 generator;
    CoulombPair associativePair; ///< where there is one; of the associative law
    Start restingStart;
    CoulombPair latestPair;
};

/// The multiplier of joints without friction, below which there is no pair. Minus infinity where they cannot
/// carry the dead load.
template<int Rows, int Forces>
double safeMultiplier(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& solver,
                      LimitAnalysis& effort)
{
    ConeProgram<Rows, Forces> smooth = program;
    smooth.friction.assign(program.friction.size(), 0);
    for (std::size_t point = 0; point < smooth.strength.size(); ++point)
    {
        Strength& strength = smooth.strength[point];
        strength.cohesion = std::max(0.0, strength.cohesion - program.friction[point] * strength.tension);
    }
    const LimitAnalysis analysis = solveLimitAnalysis(smooth, solver);
    effort.iterations += analysis.iterations;
    effort.factorisations += analysis.factorisations;
    effort.solves += analysis.solves;
    return analysis.status == CollapseStatus::optimal     ? analysis.alpha
           : analysis.status == CollapseStatus::unbounded ? std::numeric_limits<double>::infinity()
                                                          : -std::numeric_limits<double>::infinity();
}

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
    Search<Rows, Forces> search(program, settings, solver, result);
    if (search.findRest())
    {
        const auto goesOn = [&](int start)
        {
            return start < settings.starts
                   || (start < settings.starts + furtherStarts
                       && (!search.lowest.exists() || search.isByRefinement));
        };
        const auto follow = [&]
        {
            for (int start = 0; goesOn(start); ++start)
            {
                search.go(start);
            }
        };
        // What wedges by the associative law mostly slides out with a mechanism of which a path knows the
        // forces.
        search.takesMechanisms = result.status == CollapseStatus::unbounded;
        follow();
        // Pairs of motion from rest are mostly lower than those that had to be refined.
        const auto isShort = [&]
        { return (!search.lowest.exists() || search.isByRefinement) && !search.fall.exists(); };
        if (isShort())
        {
            search.takeAssociativeForces();
        }
        if (isShort())
        {
            search.takeStepsFromRest();
        }
        if (!search.lowest.exists() && !search.fall.exists())
        {
            search.takesMechanisms = true;
            follow();
        }
    }
    const CoulombPair& found = search.lowest.exists() ? search.lowest
                               : search.fall.exists() ? search.fall
                                                      : search.below;
    result.coulomb = search.range;
    if (!found.exists())
    {
        // A load that needs no friction is feasible by any law. One that is feasible by the associative law,
        // as friction and dilatancy wedge the blocks, need not be by Coulomb's.
        const bool isBounded = result.status == CollapseStatus::optimal;
        if (isBounded || result.status == CollapseStatus::unbounded)
        {
            result.coulomb->safe = safeMultiplier(program, solver, result);
            if (isBounded || result.coulomb->safe < std::numeric_limits<double>::infinity())
            {
                result.status = CollapseStatus::upperBound;
                result.alpha = isBounded ? result.alpha : std::numeric_limits<double>::infinity();
            }
        }
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
