// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// In space rough hinges first, then cells where joints are farthest from whole faces, then exact hinges.
#include "statics/AddedPoints.h"

#include "statics/CrushingHinges.h"
#include "statics/JointDissipation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace drystone
{
namespace
{

/// By how much of the length of a joint its resultant may be beyond where it crushes, unless the tolerance of
/// the solver requires less.
constexpr double hingeTolerance = 1e-7;
constexpr double looseHinges = 3e-3; ///< while other points are missing too

/// How many times the points that joints in space have at their corners and hinges refining may make of them:
/// then what is left is reported with the result.
constexpr std::size_t mostRefined = 20;
constexpr std::size_t alwaysRefined = 2000; ///< points that it may make of few, too

/// Adds points where joints crush in the answers, which are those of one structure.
/// \param tolerance of the length of a joint \return whether any was
template<int Dim>
bool addHinges(JointPoints<Dim>& joints, const std::vector<LimitAnalysis>& results, double tolerance)
{
    std::vector<Eigen::VectorXd> forces;
    for (const LimitAnalysis& result : results)
    {
        if (result.status == CollapseStatus::optimal)
        {
            forces.push_back(result.contactForce);
        }
    }
    return addCrushingHinges(joints, forces, tolerance);
}

/// The same where joints crush apart from collapse: under the dead load alone, which points carry that joints
/// do not, or at the ends of the range in which a live load holds the structure up. Last of all, since their
/// forces are often borne by what collapse has required.
template<int Dim>
bool addOtherHinges(JointPoints<Dim>& joints, const std::vector<LimitAnalysis>& results, double tolerance)
{
    std::vector<Eigen::VectorXd> forces;
    for (const LimitAnalysis& result : results)
    {
        forces.insert(forces.end(), result.otherForces.begin(), result.otherForces.end());
    }
    return addCrushingHinges(joints, forces, tolerance);
}

/// By how much of itself a multiplier may exceed the bound of its mechanism; none where points are not added
/// for that.
std::optional<double> refinementTolerance(const LimitAnalysisCase<3>& structure)
{
    if (!structure.program.hasStrength())
    {
        return std::nullopt;
    }
    const AdaptivePoints* adaptive = jointPointsOf<AdaptivePoints>(structure.contact);
    return adaptive                          ? adaptive->tolerance
           : structure.program.hasCrushing() ? std::optional(AdaptivePoints().tolerance)
                                             : std::nullopt;
}

/// What joints dissipate less over their cells, or carry less, in the answer that is farthest from whole
/// faces; empty: in none by more than the tolerance, or there are as many points as may be.
std::vector<std::vector<double>> farthestFromFaces(const LimitAnalysisCase<3>& structure,
                                                   const std::vector<LimitAnalysis>& results,
                                                   double tolerance)
{
    std::size_t corners = 0;
    for (const PatchCells& patch : structure.patches)
    {
        corners += patch.corners.size();
    }
    std::vector<std::vector<double>> farthest;
    double largest = structure.points.size() > alwaysRefined + mostRefined * corners
                         ? std::numeric_limits<double>::infinity()
                         : tolerance;
    for (const LimitAnalysis& result : results)
    {
        if (result.status != CollapseStatus::optimal || result.coulomb)
        {
            continue;
        }
        const Eigen::VectorXd& live = liveLoadOf(structure, result);
        const double size = sizeOf(structure, result);
        const auto consider = [&](std::vector<std::vector<double>> less)
        {
            const double sum = sumOf(less);
            if (sum > largest * size)
            {
                largest = sum / size;
                farthest = std::move(less);
            }
        };
        consider(dissipatedLessByCell(structure.program, structure.patches, live, result.mechanism));
        consider(carriedLessByCell(structure.program, structure.patches, live, result.mechanism,
                                   result.contactForce));
    }
    return farthest;
}

} // namespace

template<>
bool addPoints(LimitAnalysisCase<2>& structure, const std::vector<LimitAnalysis>& results)
{
    if (structure.contact.pointsPerJoint || !structure.program.hasCrushing())
    {
        return false;
    }
    JointPoints<2> joints{structure.points, structure.friction, structure.program.strength};
    const double exact = std::max(hingeTolerance, 10 * structure.solution.tolerance);
    if (!addHinges(joints, results, exact) && !addOtherHinges(joints, results, exact))
    {
        return false;
    }
    structure.points = std::move(joints.points);
    structure.friction = std::move(joints.friction);
    structure.program = programOf(structure, std::move(joints.strength));
    return true;
}

template<>
bool addPoints(LimitAnalysisCase<3>& structure, const std::vector<LimitAnalysis>& results)
{
    if (jointPointsOf<PointGrid>(structure.contact))
    {
        return false;
    }
    JointPoints<3> joints{structure.patches, structure.points, structure.friction,
                          structure.program.strength};
    const double exact = std::max(hingeTolerance, 10 * structure.solution.tolerance);
    const auto addAt = [&](double tolerance)
    { return structure.program.hasCrushing() && addHinges(joints, results, tolerance); };
    // Hinges are lines and cost few points; what is left outside them is divided all over. Once joints are
    // twisted hinges need not be nearer than the rest.
    const std::optional<double> refinement = refinementTolerance(structure);
    bool isAny = addAt(std::max(exact, looseHinges));
    if (!isAny && refinement)
    {
        const std::vector<std::vector<double>> less = farthestFromFaces(structure, results, *refinement);
        if (!less.empty())
        {
            refineJoints(joints, less);
            structure.isRefined = true;
            isAny = true;
        }
    }
    const double finest = structure.isRefined ? std::max(exact, 0.1 * *refinement) : exact;
    isAny = isAny || addAt(finest)
            || (structure.program.hasCrushing() && addOtherHinges(joints, results, finest));
    if (isAny)
    {
        structure.patches = std::move(joints.patches);
        structure.points = std::move(joints.points);
        structure.friction = std::move(joints.friction);
        structure.program = programOf(structure, std::move(joints.strength));
    }
    return isAny;
}

} // namespace drystone
