// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Faces of joints are put on common lines; in space they are counted.
#include "contact/JointClosure.h"

#include "assembly/BlockShape.h"
#include "assembly/WrittenDigits.h"
#include "contact/AlmostJoints.h"
#include "contact/Facing.h"
#include "contact/plane/FaceLines.h"
#include "core/Log.h"
#include "geometry/PolygonShape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{

namespace
{

/// Relative to the mean block size.
constexpr double usualTolerance = 1e-6;
constexpr double coarsestRounding = 1e-3;

/// Units of the last digit by which faces that were meant to meet may be apart: 1.41, in space 1.73, and a
/// little.
template<int Dim>
constexpr double roundingUnits = Dim == 2 ? 1.5 : 1.8;

/// No corner moves farther than this many tolerances.
constexpr double farthestMove = 5;

/// What rounding in double precision leaves between faces that meet [m].
template<int Dim>
double exactness(const Assembly<Dim>& assembly, double size)
{
    double extent = 0;
    for (const Block<Dim>& block : assembly.blocks)
    {
        for (const Vector<Dim>& corner : cornersOf(block))
        {
            extent = std::max(extent, corner.template lpNorm<Eigen::Infinity>());
        }
    }
    return std::max(1e-12 * size, 64 * std::numeric_limits<double>::epsilon() * extent);
}

} // namespace

template<int Dim>
JointTolerance jointTolerance(const Assembly<Dim>& assembly)
{
    const double size = meanBlockSize(assembly);
    JointTolerance tolerance;
    tolerance.rounding = writtenRounding(assembly);
    tolerance.distance = assembly.jointTolerance.value_or(usualTolerance * size);
    tolerance.oblique = assembly.jointTolerance.value_or(
        std::clamp(roundingUnits<Dim> * tolerance.rounding, usualTolerance * size, coarsestRounding * size));
    return tolerance;
}

namespace
{

/// Moves the corners of all outlines to the places of their nodes, where lines of faces meet. \param exact
/// what is nearer stays where it is [m] \param farthest that a corner may move [m] \return whether all could
/// be moved and left outlines that have no fault
bool moveCorners(Assembly<2>& assembly, const CornerNodes& nodes, const FaceLines& faces, double exact,
                 double farthest)
{
    for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
    {
        Polygon& outline = assembly.blocks[block].outline;
        bool isMoved = false;
        for (std::size_t i = 0; i < outline.size(); ++i)
        {
            const int node = nodes.ofCorner[nodes.first[block] + i];
            const double move = (nodes.place[node] - outline[i]).norm();
            if (!faces.linesAt[node].empty() && move > exact)
            {
                if (!(move <= farthest))
                {
                    return false;
                }
                outline[i] = nodes.place[node];
                isMoved = true;
            }
        }
        if (isMoved && !outlineFault(outline).empty())
        {
            return false;
        }
    }
    return true;
}

} // namespace

void closeJoints(Assembly<2>& assembly)
{
    const JointTolerance tolerance = jointTolerance(assembly);
    assembly.closure = {0, 0, tolerance.oblique, tolerance.distance, tolerance.rounding};
    const double size = meanBlockSize(assembly);
    if (!(size > 0) || !std::isfinite(size))
    {
        return;
    }
    FacingTolerance facing;
    facing.distance = tolerance.distance;
    facing.oblique = tolerance.oblique;
    // As findContactPoints has it, or what the tolerance takes for straight and for a point.
    const bool isUsual = tolerance.oblique <= usualTolerance * size;
    facing.straight = isUsual ? usualTolerance * size / 2 : tolerance.oblique;
    facing.leastLength = isUsual ? usualTolerance * size : 2 * tolerance.oblique;
    const std::vector<FacingPiece> pieces = findFacingPieces(assembly, facing);
    const double exact = exactness(assembly, size);
    const auto isOpen = [exact](const FacingPiece& piece) { return openness(piece) > exact; };
    const auto open = std::count_if(pieces.begin(), pieces.end(), isOpen);
    if (open == 0)
    {
        return;
    }
    const double reach = std::max(tolerance.distance, tolerance.oblique);
    CornerNodes nodes = findCornerNodes(assembly, reach);
    FaceLines faces = findFaceLines(assembly, nodes, outlineEdges(assembly, facing), pieces, 2 * reach);
    removeCurves(faces, nodes.place, reach);
    fitLines(faces, nodes.place, exact);

    Assembly<2> closed = assembly;
    if (!moveCorners(closed, nodes, faces, exact, farthestMove * reach))
    {
        return;
    }
    closed.closure.joints = static_cast<int>(open);
    for (const FacingPiece& piece : pieces)
    {
        closed.closure.largest = std::max(closed.closure.largest, openness(piece));
    }
    assembly = std::move(closed);
}

void closeJoints(Assembly<3>& assembly)
{
    const JointTolerance tolerance = jointTolerance(assembly);
    assembly.closure = {0, 0, tolerance.oblique, tolerance.distance, tolerance.rounding};
    const double size = meanBlockSize(assembly);
    if (!(size > 0) || !std::isfinite(size) || !assembly.statedJoints.empty())
    {
        return;
    }
    const double exact = exactness(assembly, size);
    for (const FacingPatch& patch : findFacingPatches(assembly, closedFacing(assembly)))
    {
        if (openness(patch) > exact)
        {
            ++assembly.closure.joints;
            assembly.closure.largest = std::max(assembly.closure.largest, openness(patch));
        }
    }
}

FacingTolerance closedFacing(const Assembly<2>& assembly)
{
    const double distance = usualTolerance * meanBlockSize(assembly);
    return facingTolerance(distance, distance);
}

FacingTolerance closedFacing(const Assembly<3>& assembly)
{
    const double distance = usualToleranceAlongAxes(assembly);
    const double oblique = usualObliqueTolerance(assembly);
    const double larger = std::max(distance, oblique);
    FacingTolerance tolerance = facingTolerance(larger, larger);
    tolerance.distance = distance;
    tolerance.oblique = oblique;
    return tolerance;
}

template<int Dim>
double usualToleranceAlongAxes(const Assembly<Dim>& assembly)
{
    return std::max(usualTolerance * meanBlockSize(assembly), assembly.closure.alongAxes);
}

template<int Dim>
double usualObliqueTolerance(const Assembly<Dim>& assembly)
{
    return std::max(usualTolerance * meanBlockSize(assembly), assembly.closure.tolerance);
}

template<int Dim>
void printClosure(const Assembly<Dim>& assembly)
{
    const JointClosure& closure = assembly.closure;
    if (closure.joints > 0)
    {
        const std::string reason =
            assembly.jointTolerance ? "the jointTolerance that is stated"
            : closure.rounding > 0
                ? fmt::format("which is what rounding of coordinates to {:.3g} m makes", closure.rounding)
                : "1e-6 of the mean block size";
        info("Joints: {} {} up to {:.3g} m from meeting; {} those within {:.3g} m, {}", closure.joints,
             Dim == 2 ? "closed whose faces were" : "taken as they are whose faces are", closure.largest,
             Dim == 2 ? "closed are" : "joints are", closure.tolerance, reason);
    }
    if (const int apart = facesApartOnPurpose(assembly); apart > 0)
    {
        info("Joints: {} pairs of faces almost meet and are none, farther apart than the jointTolerance of "
             "{:g} m",
             apart, *assembly.jointTolerance);
    }
}

template JointTolerance jointTolerance(const Assembly<2>& assembly);
template JointTolerance jointTolerance(const Assembly<3>& assembly);
template double usualToleranceAlongAxes(const Assembly<2>& assembly);
template double usualToleranceAlongAxes(const Assembly<3>& assembly);
template double usualObliqueTolerance(const Assembly<2>& assembly);
template double usualObliqueTolerance(const Assembly<3>& assembly);
template void printClosure(const Assembly<2>& assembly);
template void printClosure(const Assembly<3>& assembly);

} // namespace drystone
