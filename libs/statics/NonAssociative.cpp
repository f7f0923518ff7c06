// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The order of the moves: paths, the associative forces, steps from rest, programs with cohesion, paths that
/// may wedge; the programs first where paths would take minutes.
#include "statics/NonAssociative.h"

#include "statics/CollapseSearch.h"

#include <algorithm>
#include <limits>

namespace drystone
{
namespace
{

/// Paths in addition to those requested, until one has met a pair.
constexpr int furtherStarts = 4;

/// Where all starts so far have cost next to nothing (isCheap), others are followed, up to so many. In space,
/// where paths from starts that differ by rounding end in collapses far apart, others are also followed until
/// so many in a row have not lowered the multiplier by this share.
constexpr int vainStarts = 4;
constexpr int mostStartsToLower = 16;
constexpr double leastLowering = 1e-3;

/// The largest multiplier of joints without friction, below which there is no pair. Minus infinity where they
/// stand with none, and infinity where they carry the live load alone: there is no pair at all then.
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
    constexpr double infinity = std::numeric_limits<double>::infinity();
    SymbolicAnalysis kept;
    const auto analyse = [&]
    {
        LimitAnalysis analysis = solveLimitAnalysis(smooth, solver, &kept);
        addWork(effort, analysis);
        return analysis;
    };
    const LimitAnalysis analysis = analyse();
    if (analysis.status != CollapseStatus::unstable)
    {
        return analysis.status == CollapseStatus::optimal     ? analysis.alpha
               : analysis.status == CollapseStatus::unbounded ? infinity
                                                              : -infinity;
    }
    // The live load may hold what falls without it: from the least of these multipliers on.
    const std::optional<MultiplierRange> held = multipliersThatHold(smooth, solver, kept);
    if (held && held->least > -infinity)
    {
        return held->largest;
    }
    smooth.load.setZero();
    return analyse().status == CollapseStatus::unbounded ? infinity : -infinity;
}

/// The starts of a search, each further one for as long as such starts pay.
template<int Rows, int Forces>
class StartsOfSearch
{
public:
    /// \param requested number of starts that are followed in any case
    StartsOfSearch(CollapseSearch<Rows, Forces>& ofPairs, int requested) : search(ofPairs), starts(requested)
    {
    }

    void follow();

private:
    bool goesOn(int start) const;

    CollapseSearch<Rows, Forces>& search;
    int starts;
    int vain = 0; ///< paths in a row that have not lowered the multiplier
};

template<int Rows, int Forces>
bool StartsOfSearch<Rows, Forces>::goesOn(int start) const
{
    const int further = start - starts;
    const bool isFound = search.found.lowest.exists() && !search.found.isByRefinement;
    const bool goesLower = search.isCheap() || (Forces == 3 && vain < vainStarts);
    return further < 0 || further < (!isFound ? furtherStarts : goesLower ? mostStartsToLower : 0);
}

template<int Rows, int Forces>
void StartsOfSearch<Rows, Forces>::follow()
{
    for (int start = 0; goesOn(start) && !search.isOver(); ++start)
    {
        const double before = search.found.lowest.alpha;
        search.go(start);
        const bool isLower = search.found.lowest.alpha < (1 - leastLowering) * before;
        vain = isLower || !search.found.lowest.exists() ? 0 : vain + 1;
    }
}

/// The moves of a search, in their order, until there is a pair. \param ofAssociative how the associative
/// analysis has ended
template<int Rows, int Forces>
void searchPairs(CollapseSearch<Rows, Forces>& search, int requestedStarts, CollapseStatus ofAssociative)
{
    StartsOfSearch<Rows, Forces> starts(search, requestedStarts);
    const bool isLarge = !search.followsPaths;
    if (isLarge)
    {
        starts.follow();
        search.followsPaths = true;
        if (search.found.lowest.exists())
        {
            return;
        }
    }
    // What wedges by the associative law mostly slides out with a mechanism of which a path knows the forces.
    search.takesMechanisms = ofAssociative == CollapseStatus::unbounded;
    starts.follow();
    // Pairs of motion from rest are mostly lower than those that had to be refined. In the plane a fall has
    // been tried with dilatancy; in space what follows may lead to a collapse.
    const auto isSettled = [&] { return Forces == 2 && search.found.fall.exists(); };
    const auto isShort = [&]
    { return (!search.found.lowest.exists() || search.found.isByRefinement) && !isSettled(); };
    // One program: in space, where a path may take longer than the time there is, also after that.
    const bool isTooLate = search.isOver() && (Forces == 2 || search.found.lowest.exists());
    if (isShort() && !isTooLate)
    {
        search.takeAssociativeForces();
    }
    if (isShort())
    {
        search.takeStepsFromRest();
    }
    const auto isWithout = [&] { return !search.found.lowest.exists() && !isSettled(); };
    if (isWithout() && !isLarge)
    {
        search.followsPaths = false;
        starts.follow();
        search.followsPaths = true;
    }
    if (isWithout())
    {
        search.takesMechanisms = true;
        search.wedges = true;
        starts.follow();
    }
}

/// The analysis becomes that of a pair.
void takePair(LimitAnalysis& analysis, const CoulombPair& pair)
{
    analysis.status = CollapseStatus::optimal;
    analysis.alpha = pair.alpha;
    analysis.contactForce = pair.contactForce;
    analysis.mechanism = pair.mechanism / pair.mechanism.lpNorm<Eigen::Infinity>();
    analysis.certificate = {std::max(pair.residuals.balance, pair.residuals.yield), pair.residuals.flow,
                            pair.residuals.mismatch};
}

/// The analysis, still that of the associative law, becomes the upper bound that it is without a pair. Where
/// that law has none it stays `unbounded`: forces in the friction cones, which are those of either law, carry
/// the dead load with any multiple of the live one. Of a search that was cut short that says too little, as
/// other forces may let the blocks slide out which the associative law wedges.
template<int Rows, int Forces>
void takeBounds(LimitAnalysis& analysis, const ConeProgram<Rows, Forces>& program,
                const InteriorPointSettings& solver)
{
    if (analysis.status == CollapseStatus::optimal)
    {
        analysis.coulomb->safe = safeMultiplier(program, solver, analysis);
        analysis.status = CollapseStatus::upperBound;
    }
    else if (analysis.status == CollapseStatus::unbounded && isCutShort(analysis))
    {
        analysis.status = CollapseStatus::upperBound;
        analysis.alpha = std::numeric_limits<double>::infinity();
    }
}

} // namespace

void declare(Options& options, NonAssociativeSettings& settings)
{
    options
        .optional("starts", settings.starts,
                  "paths to collapse: more of them find lower collapses of the many that Coulomb's law has; "
                  "others follow, up to 16, in structures so small that they take milliseconds, and in space "
                  "until four in a row find none")
        .atLeast(1)
        .atMost(1000);
    options.optional("seed", settings.seed, "of the random numbers that later starts are made from")
        .atLeast(0);
    options.optional("tolerance", settings.tolerance, "on the residuals of yield and flow")
        .above(0)
        .atMost(1e-3);
    options
        .optional(
            "maximumTime", settings.maximumTime,
            "of a search, on the clock: it then ends with the lowest collapse so far, or without one with "
            "the bound of the associative law; each load combination, place of a moving load and sign of "
            "the multiplier has a search of its own; absent: any")
        .unit("s")
        .above(0)
        .example("600");
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
    CollapseSearch<Rows, Forces> search(program, settings, solver, result);
    // Where the associative law has no collapse a program or two may prove that there is none, for which a
    // search would try all its starts without success.
    if (result.status == CollapseStatus::unbounded)
    {
        search.found.range.safe = safeMultiplier(program, solver, result);
    }
    const bool isProved = search.found.range.safe == std::numeric_limits<double>::infinity();
    if (!isProved && search.findRest())
    {
        searchPairs(search, settings.starts, result.status);
    }
    // The same multiplier of the structure and of its program in other axes differ by rounding.
    if (search.found.lowest.exists())
    {
        search.found.lowest.alpha = std::min(search.found.lowest.alpha, search.found.range.associative);
        search.found.range.lowest = search.found.lowest.alpha;
    }
    const CoulombPair& found = search.found.lowest.exists() ? search.found.lowest
                               : search.found.fall.exists() ? search.found.fall
                                                            : search.found.below;
    result.coulomb = search.found.range;
    if (found.exists())
    {
        takePair(result, search.frame.inGiven(found));
    }
    else
    {
        takeBounds(result, program, solver);
    }
    return result;
}

template LimitAnalysis solveNonAssociative(const PlaneConeProgram& program,
                                           const NonAssociativeSettings& settings,
                                           const InteriorPointSettings& solver);
template LimitAnalysis solveNonAssociative(const SpaceConeProgram& program,
                                           const NonAssociativeSettings& settings,
                                           const InteriorPointSettings& solver);

} // namespace drystone
