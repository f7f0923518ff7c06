// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What limit analysis reads of a case.
#pragma once

#include "conic/SolverChoice.h"
#include "contact/space/PatchCells.h"
#include "effects/ContactProperties.h"
#include "statics/NonAssociative.h"
#include "statics/Pushover.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace drystone
{

/// system/solution/limitAnalysis.
struct LimitAnalysisControls
{
    SolverChoice solver;
    NonAssociativeSettings nonAssociative;    ///< used with `flowRule nonAssociative;`
    std::optional<PushoverSettings> pushover; ///< absent: collapse from the structure as built only
};
void declare(Options& options, LimitAnalysisControls& controls);

/// The answer for one position of a moving load.
struct PositionResult
{
    CollapseStatus status = CollapseStatus::notConverged;
    double alpha = 0; ///< where the status is optimal
};

/// A structure with its loads, read and checked.
template<int Dim>
struct LimitAnalysisCase
{
    Assembly<Dim> assembly;
    ContactProperties contact;
    std::vector<ContactPoint<Dim>> points; ///< of the structure as built
    std::vector<PatchCells> patches;       ///< of space: the joints, where these have strengths or a grid
    bool isRefined = false;                ///< patches have points where they are twisted
    std::vector<double> friction;          ///< mu of each point
    int freeBlocks = 0;
    StaticProgram<Dim> program;
    SolverChoice solution;
    EntryLocations solutionLocations; ///< of the entries of system/solution/limitAnalysis, for messages
    NonAssociativeSettings nonAssociative;
    Multiplier multiplier = Multiplier::positive;                  ///< which ends of the range are asked for
    std::optional<SupportMovement<Dim>> movement;                  ///< instead of a live load
    std::optional<PushoverSettings> pushover;                      ///< the capacity curve is asked for
    CaseLoads<Dim> loads;                                          ///< with combinations those of the first
    std::vector<std::pair<std::string, LoadVectors>> combinations; ///< mostly none
    std::vector<PositionResult> envelope; ///< of a moving load, one for each of loads.positions, once solved
};

/// Reads constant/assembly, g, materialProperties, contactProperties, loads and system/solution.
/// \param jointPoints contact points of a joint instead of what the case has, for studies: in the plane
/// pointsPerJoint, in space as many along each side
/// \throws FatalIOError with the first thing that is wrong: blocks that overlap, a live load that is missing,
/// a solver that is none for limit analysis, what is not available in space
template<int Dim>
LimitAnalysisCase<Dim> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                             std::optional<int> jointPoints = {});

/// The same of blocks that are not read from constant/assembly. \param assembly joints closed, as by
/// readAssembly
template<int Dim>
LimitAnalysisCase<Dim> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                             Assembly<Dim> assembly, std::optional<int> jointPoints = {});

/// Collapse by the flow rule of the case, for a positive multiplier; for a support that moves, settlement.
///
/// Joints that crush turn about points within them. Unless the case says how many points they have
/// (`pointsPerJoint`, in space `jointPoints`), points are added to where the hinges are, until no joint bears
/// a resultant nearer to its edge than it can, to 1e-7 of its length or ten times the tolerance of the solver
/// (CrushingHinges.h); in space then where joints are twisted, until the multiplier exceeds the bound of its
/// mechanism over whole joints by no more than 1e-3 of itself, or what `jointPoints { type adaptive; }` says
/// (JointDissipation.h). \param structure gets these points
template<int Dim>
LimitAnalysis solveLimitAnalysis(LimitAnalysisCase<Dim>& structure);

/// The live load that an answer belongs to: with combinations and moving loads that of its own.
template<int Dim>
const Eigen::VectorXd& liveLoadOf(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result);

/// The capacity curve of a case that asks for one.
template<int Dim>
Pushover solvePushover(const LimitAnalysisCase<Dim>& structure, const PushoverObserver<Dim>& observe);

/// One answer for each end of the range that the case asks for, the positive one first; for each combination
/// of loads in turn. Multipliers of the negative end have their sign. Of a moving load the answer of its
/// worst position alone: the lowest multiplier, of equal ones the first; one without an answer, if there is
/// any. \param structure gets points where joints crush, see solveLimitAnalysis; with a moving load the
/// envelope and, as live load, that of the worst position
template<int Dim>
std::vector<LimitAnalysis> solveLimitAnalyses(LimitAnalysisCase<Dim>& structure);

} // namespace drystone
