// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Goes through positions, combinations and ends of the range, again after each round of added points.
#include "statics/SolveCase.h"

#include "conic/form/Form.h"
#include "core/Log.h"
#include "statics/AddedPoints.h"
#include "statics/ReachedPart.h"
#include "statics/Settlement.h"
#include "statics/SurfaceContact.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace drystone
{
namespace
{

/// How many times points are added.
constexpr int mostRounds = 30;

/// Multipliers of positions that differ by less, relative, are equal: those of a symmetric structure.
constexpr double sameMultiplier = 1e-7;

/// Of joints that are one surface each. Solved closer, so that the certificate in resultants, whose residuals
/// are sums, meets the tolerance too.
LimitAnalysis solveWithSurfaces(const LimitAnalysisCase<2>& structure, SymbolicAnalysis& symbolic)
{
    InteriorPointSettings solver = interiorPointSettings(structure.solution);
    const double tolerance = solver.tolerance;
    solver.tolerance *= 0.1;
    LimitAnalysis result = solveLimitAnalysis(structure.program, solver, &symbolic);
    const std::vector<JointResultant> joints =
        jointResultants(structure.points, structure.friction, result.contactForce);
    result.variables = 3 * static_cast<int>(joints.size()) + 1;
    if (result.status == CollapseStatus::optimal)
    {
        result.certificate = certifySurfaceContact(structure.assembly, joints, structure.loads, result);
        if (!(result.certificate.worst() <= tolerance))
        {
            result.status = CollapseStatus::notConverged;
        }
    }
    return result;
}

/// What is known of a structure from one of its answers to the next.
template<int Dim>
struct Kept
{
    SymbolicAnalysis& symbolic;
    CarriedDeadLoad<freedomCount<Dim>, Dim> carried = {};
    PartUse use = {}; ///< so far
};

/// Compares an answer that was found with a part of the blocks with that of all.
template<int Dim>
void verifyAnswer(const LimitAnalysisCase<Dim>& structure, const InteriorPointSettings& solver,
                  const LimitAnalysis& answer, Kept<Dim>& kept)
{
    const LimitAnalysis all = solveLimitAnalysis(structure.program, solver, &kept.symbolic);
    if (all.status == CollapseStatus::notConverged)
    {
        printWarning(
            fmt::format("The multiplier {:.9g}, found with {} of {} blocks, is not verified: with all "
                        "of them the solver did not reach its tolerance.",
                        answer.alpha, simulatedBlocks(answer), structure.freeBlocks));
        return;
    }
    const double difference = all.status == CollapseStatus::optimal ? std::abs(answer.alpha - all.alpha)
                                                                    : std::numeric_limits<double>::infinity();
    ++kept.use.verified;
    kept.use.largestDifference = std::max(kept.use.largestDifference, difference);
    const double allowed = 2 * solver.tolerance * std::max(1.0, std::abs(all.alpha));
    if (difference > allowed)
    {
        printWarning(fmt::format("The multiplier {:.9g}, found with {} of {} blocks, differs by {:.3g} from "
                                 "that of all; tolerance of system/solution/limitAnalysis allows {:.3g}. "
                                 "`selection asGiven;` in system/schemes/effects solves with all blocks.",
                                 answer.alpha, simulatedBlocks(answer), structure.freeBlocks, difference,
                                 allowed));
    }
}

template<int Dim>
LimitAnalysis solveByAssociativeLaw(const LimitAnalysisCase<Dim>& structure, Kept<Dim>& kept)
{
    const InteriorPointSettings solver = interiorPointSettings(structure.solution);
    ++kept.use.answers;
    if (structure.effects.selection == EffectSelection::automatic)
    {
        if (std::optional<LimitAnalysis> answer =
                analyseReachedPart(structure.program, solver, kept.carried, kept.symbolic))
        {
            ++kept.use.ofParts;
            kept.use.blocks += simulatedBlocks(*answer);
            const int interval = structure.effects.verifyInterval;
            if (interval > 0 && kept.use.answers % interval == 0)
            {
                verifyAnswer(structure, solver, *answer, kept);
            }
            return std::move(*answer);
        }
    }
    LimitAnalysis result = solveLimitAnalysis(structure.program, solver, &kept.symbolic);
    if (result.status == CollapseStatus::unstable)
    {
        std::vector<Eigen::VectorXd>* ends = structure.program.hasCrushing() ? &result.otherForces : nullptr;
        result.held = multipliersThatHold(structure.program, solver, kept.symbolic, ends);
    }
    return result;
}

template<int Dim>
LimitAnalysis solveWithPoints(const LimitAnalysisCase<Dim>& structure, Kept<Dim>& kept)
{
    if constexpr (Dim == 2)
    {
        if (isSurfaceContact(structure.contact))
        {
            return solveWithSurfaces(structure, kept.symbolic);
        }
    }
    const InteriorPointSettings solver = interiorPointSettings(structure.solution);
    return structure.movement ? solveSettlement(structure.program, solver)
           : flowRuleOf(structure.contact) == FlowRule::nonAssociative
               ? solveNonAssociative(structure.program, structure.nonAssociative, solver)
               : solveByAssociativeLaw(structure, kept);
}

template<int Dim>
void setLive(LimitAnalysisCase<Dim>& structure, const Eigen::VectorXd& live)
{
    structure.loads.live = live;
    structure.program.liveLoad = live;
}

/// Whether an answer is worse than another: no answer, then none at all that is carried, then the lower one.
bool isWorse(const LimitAnalysis& a, const LimitAnalysis& b)
{
    const auto rank = [](CollapseStatus status)
    {
        constexpr std::array worstFirst{CollapseStatus::notConverged, CollapseStatus::unstable,
                                        CollapseStatus::optimal, CollapseStatus::unbounded};
        const CollapseStatus kind = status == CollapseStatus::upperBound ? CollapseStatus::optimal : status;
        return std::find(worstFirst.begin(), worstFirst.end(), kind) - worstFirst.begin();
    };
    const auto collapses = [](CollapseStatus status)
    { return status == CollapseStatus::optimal || status == CollapseStatus::upperBound; };
    return rank(a.status) != rank(b.status) ? rank(a.status) < rank(b.status)
                                            : collapses(a.status) && a.alpha < b.alpha * (1 - sameMultiplier);
}

/// Gives multipliers of the reversed live load the sign that they have for the live load.
void giveSignOfLive(LimitAnalysis& reversed)
{
    reversed.isReversed = true;
    reversed.alpha *= -1;
    if (const std::optional<MultiplierRange> held = reversed.held)
    {
        reversed.held = {-held->largest, -held->least};
    }
    if (std::optional<CoulombRange>& range = reversed.coulomb)
    {
        for (double* multiplier :
             {&range->associative, &range->safe, &range->lowest, &range->highest, &range->fall})
        {
            *multiplier *= -1;
        }
    }
}

template<int Dim>
std::vector<LimitAnalysis> solveAllWithPoints(const LimitAnalysisCase<Dim>& structure, Kept<Dim>& kept)
{
    std::vector<LimitAnalysis> results;
    if (!structure.loads.positions.empty())
    {
        LimitAnalysisCase<Dim> single = structure;
        single.loads.positions.clear();
        for (const LoadPosition<Dim>& position : structure.loads.positions)
        {
            setLive(single, position.live);
            results.push_back(solveWithPoints(single, kept));
            results.back().position = static_cast<int>(results.size()) - 1;
        }
        return results;
    }
    if (!structure.combinations.empty())
    {
        for (const auto& [name, loads] : structure.combinations)
        {
            LimitAnalysisCase<Dim> single = structure;
            single.combinations.clear();
            static_cast<LoadVectors&>(single.loads) = loads;
            single.multiplier = loads.multiplier;
            single.program.load = loads.dead;
            single.program.liveLoad = loads.live;
            for (LimitAnalysis& result : solveAllWithPoints(single, kept))
            {
                result.combination = name;
                results.push_back(std::move(result));
            }
        }
        return results;
    }
    if (structure.multiplier != Multiplier::negative)
    {
        results.push_back(solveWithPoints(structure, kept));
    }
    if (structure.multiplier != Multiplier::positive)
    {
        LimitAnalysisCase<Dim> reversed = structure;
        reversed.program.liveLoad *= -1;
        reversed.loads.live *= -1;
        results.push_back(solveWithPoints(reversed, kept));
        giveSignOfLive(results.back());
    }
    return results;
}

/// Solves until no joint bears more than it can, and more points would not make much of a difference. Where
/// forces that are not unique require hinges at other places each time, that does not end: in space the last
/// answers stay, since how much less whole faces carry is measured and reported with them. \return the
/// answers; in the plane `notConverged` when it takes too long
template<int Dim, class Solve>
std::vector<LimitAnalysis> solveWithMorePoints(LimitAnalysisCase<Dim>& structure, const Solve& solve,
                                               Kept<Dim>& kept)
{
    std::vector<LimitAnalysis> results = solve(structure, kept);
    for (int round = 0; addPoints(structure, results); ++round)
    {
        const std::vector<LimitAnalysis> before = std::move(results);
        results = solve(structure, kept);
        for (std::size_t i = 0; i < results.size(); ++i)
        {
            addWork(results[i], before[i]);
            if (Dim == 2 && round == mostRounds)
            {
                results[i].status = CollapseStatus::notConverged;
            }
        }
        if (round == mostRounds)
        {
            break;
        }
    }
    return results;
}

} // namespace

template<int Dim>
LimitAnalysis solveLimitAnalysis(LimitAnalysisCase<Dim>& structure)
{
    if (!structure.loads.positions.empty())
    {
        return solveLimitAnalyses(structure).front();
    }
    SymbolicAnalysis symbolic;
    Kept<Dim> ofStructure{symbolic};
    return solveWithMorePoints(
               structure,
               [](const LimitAnalysisCase<Dim>& with, Kept<Dim>& kept)
               { return std::vector<LimitAnalysis>{solveWithPoints(with, kept)}; },
               ofStructure)
        .front();
}

template<int Dim>
std::vector<LimitAnalysis> solveLimitAnalyses(LimitAnalysisCase<Dim>& structure, SymbolicAnalysis* kept)
{
    SymbolicAnalysis own;
    Kept<Dim> ofStructure{kept ? *kept : own};
    std::vector<LimitAnalysis> results = solveWithMorePoints(structure, solveAllWithPoints<Dim>, ofStructure);
    structure.partUse = ofStructure.use;
    structure.cutShort = static_cast<int>(std::count_if(results.begin(), results.end(), isCutShort));
    if (structure.loads.positions.empty())
    {
        return results;
    }
    structure.envelope.clear();
    for (const LimitAnalysis& result : results)
    {
        structure.envelope.push_back({result.status, result.alpha});
    }
    const auto worst = std::min_element(results.begin(), results.end(), isWorse);
    setLive(structure, structure.loads.positions[worst - results.begin()].live);
    return {*worst};
}

template<int Dim>
Pushover solvePushover(const LimitAnalysisCase<Dim>& structure, const PushoverObserver<Dim>& observe)
{
    const double mu = structure.contact.friction ? structure.contact.friction->mu : 0;
    return solvePushover(PushoverScene<Dim>{structure.assembly, mu, structure.loads}, *structure.pushover,
                         interiorPointSettings(structure.solution), observe);
}

template LimitAnalysis solveLimitAnalysis(LimitAnalysisCase<2>& structure);
template std::vector<LimitAnalysis> solveLimitAnalyses(LimitAnalysisCase<2>& structure,
                                                       SymbolicAnalysis* kept);
template Pushover solvePushover(const LimitAnalysisCase<2>& structure, const PushoverObserver<2>& observe);
template LimitAnalysis solveLimitAnalysis(LimitAnalysisCase<3>& structure);
template std::vector<LimitAnalysis> solveLimitAnalyses(LimitAnalysisCase<3>& structure,
                                                       SymbolicAnalysis* kept);
template Pushover solvePushover(const LimitAnalysisCase<3>& structure, const PushoverObserver<3>& observe);

} // namespace drystone
