// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stages from the solids of a file to blocks.
#include "import/SolidBlocks.h"

#include "assembly/StatedJoints.h"
#include "core/Log.h"
#include "geometry/Box.h"
#include "geometry/space/FacePolygon.h"
#include "geometry/space/PolyhedronFault.h"
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

/// A place of the file in metres, z upwards.
Vector<3> inMetres(const Vector<3>& ofFile, const SolidSettings& settings)
{
    const Vector<3> place = settings.scale * ofFile;
    return (settings.up == UpAxis::y ? Vector<3>(place.x(), -place.z(), place.y()) : place) + settings.offset;
}

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
                       "A vertex is at ({:g} {:g} {:g}) m: coordinates are at most {:g} m. Correct it, or "
                       "give a smaller scale, or an offset that brings the blocks near 0.",
                       place.x(), place.y(), place.z(), farthestCoordinate));
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

/// The blocks that a solid of the file became: all in one row.
struct BlockRange
{
    std::size_t first = 0;
    std::size_t end = 0;
};

std::vector<BlockRange> blocksOfSolids(const std::vector<Piece>& pieces, std::size_t solids)
{
    std::vector<BlockRange> ranges(solids);
    for (std::size_t block = 0; block < pieces.size(); ++block)
    {
        BlockRange& range = ranges[static_cast<std::size_t>(pieces[block].solid)];
        range = {range.end == 0 ? block : range.first, block + 1};
    }
    return ranges;
}

/// The one of the blocks of a solid on whose surface all points lie, or are nearest to lying.
int nearestBlock(const BlockRange& range, const std::vector<Block<3>>& blocks,
                 const std::vector<Vector<3>>& points)
{
    std::size_t nearest = range.first;
    double least = 1e300;
    for (std::size_t block = range.first; range.end - range.first > 1 && block < range.end; ++block)
    {
        double farthest = 0;
        for (std::size_t i = 0; i < points.size() && farthest < least; ++i)
        {
            farthest = std::max(farthest, distanceFromSurface(blocks[block].shape, points[i]));
        }
        if (farthest < least)
        {
            least = farthest;
            nearest = block;
        }
    }
    return static_cast<int>(nearest);
}

/// How far points are at most from the plane of a face. \param normal of the face
double farthestFromPlane(const std::vector<Vector<3>>& points, const Vector<3>& onFace,
                         const Vector<3>& normal)
{
    double farthest = 0;
    for (const Vector<3>& point : points)
    {
        farthest = std::max(farthest, std::abs(normal.dot(point - onFace)));
    }
    return farthest;
}

/// 1 where the normal points into the block with the lower index, else -1; 0 where no face of the two lies
/// along the joint. The face in whose plane all its points lie, or are nearest to lying, decides: a sloping
/// face that begins at an edge of the joint, as that of a skewback, has but two of them.
double sideOf(const StatedJoint<3>& joint, const std::vector<Block<3>>& blocks)
{
    constexpr double along = 0.9;
    double nearest = 1e300;
    double sign = 0;
    for (const auto& [block, side] : {std::pair(joint.block, -1.0), std::pair(joint.neighbour, 1.0)})
    {
        const Polyhedron& shape = blocks[static_cast<std::size_t>(block)].shape;
        for (const std::vector<int>& face : shape.faces)
        {
            const Vector<3> normal = areaVector(shape, face).normalized();
            const double cosine = joint.normal.dot(normal);
            const double distance = farthestFromPlane(joint.points, shape.vertices[face.front()], normal);
            if (std::abs(cosine) > along && distance < nearest)
            {
                nearest = distance;
                sign = cosine > 0 ? side : -side;
            }
        }
    }
    return sign;
}

/// A joint from an interface: the normal is that of its outline, turned into the block with the lower index.
StatedJoint<3> jointOf(const SolidInterface& interface, const std::vector<BlockRange>& blocksOf,
                       const std::vector<Block<3>>& blocks, const SolidSettings& settings,
                       const ImportedFile& file)
{
    StatedJoint<3> joint;
    Vector<3> centre = Vector<3>::Zero();
    for (const Vector<3>& point : interface.points)
    {
        joint.points.push_back(inMetres(point, settings));
        centre += joint.points.back();
    }
    centre /= static_cast<double>(joint.points.size());
    const int one = nearestBlock(blocksOf[static_cast<std::size_t>(interface.solid)], blocks, joint.points);
    const int other =
        nearestBlock(blocksOf[static_cast<std::size_t>(interface.neighbour)], blocks, joint.points);
    joint.block = std::min(one, other);
    joint.neighbour = std::max(one, other);
    Vector<3> area = Vector<3>::Zero();
    for (std::size_t i = 0; i < joint.points.size(); ++i)
    {
        area += momentOf(Vector<3>(joint.points[i] - centre),
                         Vector<3>(joint.points[(i + 1) % joint.points.size()] - centre));
    }
    joint.normal = area / area.norm();
    if (!(area.norm() > 0) || !joint.normal.allFinite())
    {
        refuse(file, 0,
               fmt::format("The interface of blocks {} and {} has no area. Remove it, or leave the joints to "
                           "`interfaces ignored;`.",
                           joint.block, joint.neighbour));
    }
    const double sign = sideOf(joint, blocks);
    if (sign == 0)
    {
        refuse(
            file, 0,
            fmt::format("The interface of blocks {} and {} about ({:.6g} {:.6g} {:.6g}) lies along no face "
                        "of either. Correct it, or leave the joints to `interfaces ignored;`.",
                        joint.block, joint.neighbour, centre.x(), centre.y(), centre.z()));
    }
    if (sign < 0)
    {
        joint.normal = -joint.normal;
        std::reverse(joint.points.begin(), joint.points.end());
    }
    return joint;
}

void stateJoints(Assembly<3>& assembly, const Solids& solids, const std::vector<Piece>& pieces,
                 const SolidSettings& settings, const ImportedFile& file)
{
    const std::vector<BlockRange> blocksOf = blocksOfSolids(pieces, solids.solids.size());
    for (const SolidInterface& interface : solids.interfaces)
    {
        assembly.statedJoints.push_back(jointOf(interface, blocksOf, assembly.blocks, settings, file));
    }
    sortByPair(assembly.statedJoints);
}

/// Joints are the interfaces of the file, where it has any and the settings do not say otherwise.
void chooseJoints(Assembly<3>& assembly, const Solids& solids, const std::vector<Piece>& pieces,
                  const SolidSettings& settings, const ImportedFile& file)
{
    const Interfaces usual = solids.interfaces.empty() ? Interfaces::ignored : Interfaces::contacts;
    if (settings.interfaces.value_or(usual) == Interfaces::contacts)
    {
        if (solids.interfaces.empty())
        {
            refuse(file, 0,
                   "The file has no interfaces: joints cannot be taken from it. Remove `interfaces "
                   "contacts;`.");
        }
        stateJoints(assembly, solids, pieces, settings, file);
        info("Import: the {} interfaces of the file are the joints{}", solids.interfaces.size(),
             settings.interfaces ? "" : "; with `interfaces ignored;` they are found from the shapes");
    }
    else if (!solids.interfaces.empty())
    {
        info("Import: the {} interfaces of the file are not used, joints are found from the shapes; "
             "`interfaces contacts;` makes them the joints",
             solids.interfaces.size());
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
    ZoneList zones;
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
        pieces[i].shape = std::move(shapes[i]);
        requireSolid(file, pieces[i], i);
        assembly.blocks.push_back({std::move(pieces[i].shape)});
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
    chooseJoints(assembly, solids, pieces, settings, file);
    return assembly;
}

} // namespace drystone
