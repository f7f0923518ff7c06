// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stages from the solids of a file to blocks.
#include "import/SolidBlocks.h"

#include "core/Log.h"
#include "geometry/Box.h"
#include "geometry/PointText.h"
#include "geometry/WholeMetres.h"
#include "geometry/space/PolyhedronFault.h"
#include "import/SolidJoints.h"
#include "import/Zones.h"
#include "import/space/Mesh.h"
#include "import/space/PlaneFaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

constexpr double usualTolerance = 1e-6; // of the mean size of the blocks
constexpr double coarsest = 5e-3;       // likewise: rounding is not followed beyond it
constexpr double roundingUnits = 1.75;  // half a unit along each axis, for two corners: sqrt(3)
constexpr double exact = 1e-9;          // likewise: doubles are not more even
constexpr double unevenest = 1e-4;      // likewise: faces that are more uneven are meant so
constexpr double unevenUnits = 2;       // tolerance where the unevenness alone says what rounding was
constexpr std::size_t mostFaces = 5000; // of a block: checks take time of the order of their square

/// A block in the making, with what messages say of it.
struct Piece
{
    Polyhedron shape;
    std::string name;
    std::vector<std::string> zones;
    int line = 0;
    int solid = 0; ///< of the file, of which it is all or a part
};

/// What was done, for the log.
struct Tally
{
    std::size_t faces = 0; ///< in the file
    int turned = 0;
    int merged = 0;
    int dropped = 0;      ///< faces that are a line or a point
    int repeated = 0;     ///< faces that stand there already
    int joinedMeshes = 0; ///< objects that were parted, being no solids as they are
};

Polyhedron placed(const Solid& solid, const SolidSettings& settings, const ImportedFile& file)
{
    Polyhedron shape{{}, solid.faces};
    for (const Vector<3>& vertex : solid.vertices)
    {
        const Vector<3> place = inMetres(vertex, settings);
        if (!(place.cwiseAbs().maxCoeff() <= farthestCoordinate))
        {
            refuse(file, solid.line,
                   fmt::format(
                       "A vertex is at {} m: coordinates are at most {:g} m. Correct it, or give a smaller "
                       "scale, or an offset that brings the blocks near 0, as `offset {};`.",
                       asWritten<3>(place), farthestCoordinate, inWholeMetres<3>(settings.offset - place)));
        }
        shape.vertices.push_back(place);
    }
    return shape;
}

/// Mean extent of the pieces [m].
double meanSize(const std::vector<Piece>& pieces)
{
    double sum = 0;
    for (const Piece& piece : pieces)
    {
        Box<3> box;
        for (const Vector<3>& vertex : piece.shape.vertices)
        {
            extend<3>(box, vertex);
        }
        sum += (box.upper - box.lower).norm() / std::sqrt(3.0);
    }
    return sum / static_cast<double>(pieces.size());
}

/// Whether a shape is no solid, but the parts of it that share no edge are: blocks that were joined to one
/// object before they were exported.
bool isJoinedMesh(const Polyhedron& shape, const std::vector<Polyhedron>& parts)
{
    if (parts.size() < 2 || !findFault(welded(shape, 0)))
    {
        return false;
    }
    return std::none_of(parts.begin(), parts.end(),
                        [](Polyhedron part)
                        {
                            turnOutwards(part);
                            return findFault(part).has_value();
                        });
}

std::vector<Piece> piecesOf(Solids& solids, const SolidSettings& settings, const ImportedFile& file,
                            Tally& tally)
{
    std::vector<Piece> pieces;
    for (std::size_t index = 0; index < solids.solids.size(); ++index)
    {
        Solid& solid = solids.solids[index];
        const int number = static_cast<int>(index);
        tally.faces += solid.faces.size();
        Polyhedron shape = placed(solid, settings, file);
        solid.vertices = {};
        Polyhedron mesh = welded(shape, settings.tolerance.value_or(0));
        const int repeated = dropRepeatedFaces(mesh);
        std::vector<Polyhedron> parts = parted(mesh);
        if (solids.division == Division::asWritten && !isJoinedMesh(shape, parts))
        {
            pieces.push_back({std::move(shape), solid.name, solid.zones, solid.line, number});
            continue;
        }
        tally.repeated += repeated;
        tally.joinedMeshes += solids.division == Division::asWritten ? 1 : 0;
        for (Polyhedron& part : parts)
        {
            pieces.push_back({std::move(part), solid.name, solid.zones, solid.line, number});
        }
    }
    return pieces;
}

std::string nameOf(const Piece& piece, std::size_t index)
{
    return piece.name.empty() ? fmt::format("Block {}", index)
                              : fmt::format("Block {}, {}", index, shown(piece.name));
}

[[noreturn]] void refusePiece(const ImportedFile& file, const Piece& piece, std::size_t index,
                              const std::string& fault)
{
    refuse(file, piece.line, fmt::format("{} is no solid: {}.", nameOf(piece, index), fault));
}

/// One closed surface without repeated vertices and cut faces.
void makeSolid(Piece& piece, double tolerance, Tally& tally)
{
    const std::size_t before = piece.shape.faces.size();
    piece.shape = welded(piece.shape, tolerance);
    tally.dropped += static_cast<int>(before - piece.shape.faces.size());
    tally.repeated += dropRepeatedFaces(piece.shape);
    if (!piece.shape.faces.empty())
    {
        tally.turned += turnOutwards(piece.shape);
        tally.merged += mergeCoplanar(piece.shape, tolerance);
    }
}

/// Where a face is: its index is that after corners have been joined and coplanar faces merged.
std::string placeOf(const Polyhedron& shape, int face)
{
    if (face < 0)
    {
        return {};
    }
    const std::vector<int>& corners = shape.faces[static_cast<std::size_t>(face)];
    Vector<3> middle = Vector<3>::Zero();
    for (const int corner : corners)
    {
        if (corner < 0 || corner >= static_cast<int>(shape.vertices.size()))
        {
            return {};
        }
        middle += shape.vertices[static_cast<std::size_t>(corner)] / static_cast<double>(corners.size());
    }
    return fmt::format(". The corners of face {} have their middle at ({:.6g} {:.6g} {:.6g}) m", face,
                       middle.x(), middle.y(), middle.z());
}

void requireSolid(const ImportedFile& file, const Piece& piece, std::size_t index)
{
    if (piece.shape.faces.size() > mostFaces)
    {
        refusePiece(file, piece, index,
                    fmt::format("it has {} faces, more than {}. Simplify its surface",
                                piece.shape.faces.size(), mostFaces));
    }
    if (const std::optional<PolyhedronFault> fault = findFault(piece.shape))
    {
        const double uneven = unevenness(piece.shape);
        refusePiece(file, piece, index,
                    fault->text
                        + (fault->text.find("is not plane") != std::string::npos ? fmt::format(
                               ", or state a tolerance of {:.2g} m within which faces are made plane", uneven)
                                                                                 : "")
                        + placeOf(piece.shape, fault->face));
    }
}

double largestUnevenness(const std::vector<Polyhedron>& shapes)
{
    double most = 0;
    for (const Polyhedron& shape : shapes)
    {
        most = std::max(most, unevenness(shape));
    }
    return most;
}

void printTally(const Tally& tally, const PlaneFaces& planes, double tolerance, double rounding)
{
    if (tally.merged > 0 || tally.turned > 0 || tally.dropped > 0)
    {
        info("Import: {} faces in the file; {} fewer by merging those that are coplanar, {} turned outwards, "
             "{} without area left out",
             tally.faces, tally.merged, tally.turned, tally.dropped);
    }
    if (tally.repeated > 0)
    {
        info("Import: faces that stand in the file twice: {}; each is left out once", tally.repeated);
    }
    if (tally.joinedMeshes > 0)
    {
        info("Import: objects that are no solid, but several: {}; each is parted into these",
             tally.joinedMeshes);
    }
    if (rounding > 0)
    {
        info("Import: coordinates are written to {:.3g} m", rounding);
    }
    if (planes.moved > 0)
    {
        info("Import: faces were uneven by up to {:.3g} m; {} corners moved by up to {:.3g} m to make them "
             "plane, {} of them joined with a neighbour's; tolerance {:.3g} m",
             planes.unevenness, planes.moved, planes.farthest, planes.joined, tolerance);
    }
}

} // namespace

Assembly<3> solidBlocks(Solids solids, const SolidSettings& settings, const ImportedFile& file)
{
    Tally tally;
    std::vector<Piece> pieces = piecesOf(solids, settings, file, tally);
    if (pieces.empty())
    {
        refuse(file, 0, "There is no face in this file.");
    }
    const double size = meanSize(pieces);
    const double rounding = solids.rounding * settings.scale;
    const bool isRounded = settings.tolerance || rounding > 0;
    const double tolerance = settings.tolerance.value_or(
        std::clamp(roundingUnits * rounding, usualTolerance * size, coarsest * size));
    for (Piece& piece : pieces)
    {
        makeSolid(piece, tolerance, tally);
    }
    std::vector<Polyhedron> shapes;
    for (Piece& piece : pieces)
    {
        shapes.push_back(std::move(piece.shape));
    }
    const double uneven = largestUnevenness(shapes);
    const bool isUneven = uneven > exact * size && uneven <= unevenest * size;
    const PlaneFaces planes = isRounded  ? makePlane(shapes, tolerance, Corners::joined)
                              : isUneven ? makePlane(shapes, unevenUnits * uneven, Corners::own)
                                         : PlaneFaces{};

    Assembly<3> assembly;
    std::vector<int> solidOf;
    ZoneList zones;
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
        pieces[i].shape = std::move(shapes[i]);
        requireSolid(file, pieces[i], i);
        assembly.blocks.push_back({std::move(pieces[i].shape)});
        solidOf.push_back(pieces[i].solid);
        for (const std::string& zone : pieces[i].zones)
        {
            zones.add(zone, static_cast<int>(i));
        }
    }
    assembly.zones = zones.take(file);
    printTally(tally, planes, isRounded ? tolerance : unevenUnits * uneven, rounding);
    if (isRounded)
    {
        assembly.jointTolerance = tolerance;
    }
    chooseJoints(assembly, solids, solidOf, settings, file);
    return assembly;
}

} // namespace drystone
