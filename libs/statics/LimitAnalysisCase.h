// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What limit analysis reads of a case.
#pragma once

#include "conic/SolverChoice.h"
#include "contact/space/PatchCells.h"
#include "effects/ContactProperties.h"
#include "runControl/Schemes.h"
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

/// How often a part of the blocks stood for all, `selection automatic`.
struct PartUse
{
    int answers = 0;              ///< found, for each position, combination and end of the range
    int ofParts = 0;              ///< of them those of a part (ReachedPart.h)
    double blocks = 0;            ///< of these parts, summed up
    int verified = 0;             ///< of them those that were found with all blocks too
    double largestDifference = 0; ///< of a multiplier
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
    ChosenEffects effects; ///< of system/schemes: whether all blocks are simulated
    PartUse partUse;       ///< once solved
    /// Searches that maximumTime has ended, those of all positions of a load too, once solved.
    int cutShort = 0;
    Multiplier multiplier = Multiplier::positive;                  ///< which ends of the range are requested
    std::optional<SupportMovement<Dim>> movement;                  ///< instead of a live load
    std::optional<PushoverSettings> pushover;                      ///< the capacity curve is requested
    CaseLoads<Dim> loads;                                          ///< with combinations those of the first
    std::vector<std::pair<std::string, LoadVectors>> combinations; ///< mostly none
    std::vector<PositionResult> envelope; ///< of a moving load, one for each of loads.positions, once solved
};

/// Blocks that limit analysis takes, and where they touch: what cases have in common that differ in
/// properties and loads alone. To find them takes as long as to solve.
template<int Dim>
struct SoundStructure
{
    Assembly<Dim> assembly;
    std::vector<ContactPoint<Dim>> points; ///< findContactPoints of it
};

/// \param assembly joints closed, as by readAssembly. \param caseDirectory for messages
/// \throws FatalIOError when blocks overlap or almost meet, or none is free
template<int Dim>
SoundStructure<Dim> soundStructure(const std::filesystem::path& caseDirectory, Assembly<Dim> assembly);

/// Reads constant/assembly, g, materialProperties, contactProperties, loads, system/solution and schemes.
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

/// The same of blocks that have been found sound.
template<int Dim>
LimitAnalysisCase<Dim> readLimitAnalysisCase(const std::filesystem::path& caseDirectory,
                                             SoundStructure<Dim> blocks, std::optional<int> jointPoints = {});

/// Gives a structure of the plane, as it was read, the contact properties that the case has now: a tenth of
/// reading it anew. \return false where its points are others \throws as readLimitAnalysisCase
bool readContactAnew(LimitAnalysisCase<2>& structure, const std::filesystem::path& caseDirectory);

/// The program of the points that the structure has. \param strengths of each point, or empty
template<int Dim>
StaticProgram<Dim> programOf(const LimitAnalysisCase<Dim>& structure, std::vector<Strength> strengths);

/// The live load that an answer belongs to: with combinations and moving loads that of its own.
template<int Dim>
const Eigen::VectorXd& liveLoadOf(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result);

/// What differences of an answer are compared with: the size of its multiplier; of the base reaction of a
/// settlement, which may be 0, a hundredth of the dead load at least.
template<int Dim>
double sizeOf(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result);

} // namespace drystone
