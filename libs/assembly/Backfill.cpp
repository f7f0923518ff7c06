// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Presses face by face: by weight where a face looks up, sideways where the fill reaches it from above.
#include "assembly/Backfill.h"

#include "assembly/FillFromAbove.h"
#include "core/ShownList.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace drystone
{
namespace
{

/// The pieces of each face. A piece that is taken away belongs to the nearest face that looks its way: a
/// joint lies halfway between two faces that may be turned a little against each other.
template<int Dim>
std::vector<std::vector<SurfacePiece<Dim>>> facesOf(const std::vector<SurfacePiece<Dim>>& pieces,
                                                    double sameLevel)
{
    std::map<int, std::vector<std::vector<SurfacePiece<Dim>>>> ofBlocks;
    for (const SurfacePiece<Dim>& piece : pieces)
    {
        std::vector<std::vector<SurfacePiece<Dim>>>& faces = ofBlocks[piece.block];
        std::vector<SurfacePiece<Dim>>* nearest = nullptr;
        double least = piece.weight < 0 ? std::numeric_limits<double>::infinity() : sameLevel;
        for (std::vector<SurfacePiece<Dim>>& face : faces)
        {
            const Vector<Dim>& normal = face.front().normal;
            const double away = std::abs(normal.dot(piece.corners[0] - face.front().corners[0]));
            if ((piece.normal - normal).norm() < std::sqrt(sameDirection) && away <= least)
            {
                least = away;
                nearest = &face;
            }
        }
        if (nearest)
        {
            nearest->push_back(piece);
        }
        else
        {
            faces.push_back({piece});
        }
    }
    std::vector<std::vector<SurfacePiece<Dim>>> all;
    for (auto& [block, faces] : ofBlocks)
    {
        std::move(faces.begin(), faces.end(), std::back_inserter(all));
    }
    return all;
}

/// What the log says of some faces.
struct FacesOfRemark
{
    double area = 0; ///< projected [m2]
    std::vector<int> blocks;

    void add(int block, double ofFace)
    {
        area += ofFace;
        if (blocks.empty() || blocks.back() != block)
        {
            blocks.push_back(block);
        }
    }
};

/// `block 3`, `blocks 3 4 and 20 more`.
std::string named(const std::vector<int>& blocks)
{
    return fmt::format("block{} {}", blocks.size() == 1 ? "" : "s", shownList(blocks, 8, " "));
}

} // namespace

template<int Dim>
void declare(Options& options, BackfillSettings<Dim>& settings)
{
    options.optional("unitWeight", settings.unitWeight, "of the fill")
        .unit("N/m3")
        .atLeast(0)
        .usual(5000, 30000)
        .example("18000");
    options
        .optional("level", settings.level,
                  Dim == 2 ? "height y of its surface; required with unitWeight"
                           : "height z of its surface; required with unitWeight")
        .unit("m")
        .example("1.5");
    options.optional("surcharge", settings.surcharge, "on its surface, a vertical pressure")
        .unit("Pa")
        .atLeast(0)
        .example("5000");
    options
        .optional("lateralCoefficient", settings.lateralCoefficient,
                  "horizontal over vertical pressure, on the vertical projection of faces that the fill "
                  "reaches from above, also of those that lean over it; 0: weight alone")
        .unit("-")
        .atLeast(0)
        .usual(0, 4);
    declare(options, static_cast<LoadedFaces<Dim>&>(settings));
    options.check("unitWeight",
                  [&settings]() -> std::string
                  {
                      return settings.unitWeight == 0 && settings.surcharge == 0
                                 ? "A backfill needs a weight or a surcharge. Write for instance `unitWeight "
                                   "18000; level 1.5;`."
                             : settings.unitWeight > 0 && !settings.level
                                 ? "The weight of a backfill needs the height of its surface. Write for "
                                   "instance `level 1.5;`."
                                 : "";
                  });
}

namespace
{

/// Faces of which a remark is made.
struct RemarkedFaces
{
    FacesOfRemark withoutEarthPressure;
    FacesOfRemark sheltered;
};

/// The part of the earth pressure that a face bears, and what is remarked of it. The weight on a face
/// vanishes as it turns to the vertical, and there is none on one that looks down; the earth pressure does
/// not know on which side of the vertical it is.
template<int Dim>
void addFace(const std::vector<SurfacePiece<Dim>>& face, const FillFromAbove<Dim>& fill,
             double lateralCoefficient, Tractions<Dim>& tractions, RemarkedFaces& remarked)
{
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    const Vector<Dim>& normal = face.front().normal;
    const Vector<Dim> vertical = normal.dot(up) * up;
    const Vector<Dim> sideways = normal - vertical;
    double area = 0;
    double whole = 0;
    for (const SurfacePiece<Dim>& piece : face)
    {
        area += areaOf(piece);
        whole += std::abs(areaOf(piece));
    }
    const bool isPressed = lateralCoefficient > 0 && sideways.norm() > sameDirection;
    const bool isBare = area > roundingOfAreas * whole;
    const bool isReached = !isPressed || !isBare || fill.reaches(face);
    if (!isReached)
    {
        remarked.withoutEarthPressure.add(face.front().block, area * sideways.norm());
    }
    if (isBare && normal.dot(up) > sameDirection && fill.isSheltered(face))
    {
        remarked.sheltered.add(face.front().block, area * normal.dot(up));
    }
    const double lateral = isReached ? lateralCoefficient : 0;
    for (const SurfacePiece<Dim>& piece : face)
    {
        tractions.pieces.push_back({piece, -(std::max(0.0, normal.dot(up)) * up + lateral * sideways)});
    }
}

std::vector<std::string> remarksOf(const RemarkedFaces& remarked)
{
    std::vector<std::string> remarks;
    if (!remarked.withoutEarthPressure.blocks.empty())
    {
        remarks.push_back(
            fmt::format("Backfill: no earth pressure on {:.4g} m2 of faces, vertical projection, which the "
                        "fill cannot reach from above, of {}",
                        remarked.withoutEarthPressure.area, named(remarked.withoutEarthPressure.blocks)));
    }
    if (!remarked.sheltered.blocks.empty())
    {
        remarks.push_back(
            fmt::format("Backfill: {:.4g} m2 of faces, horizontal projection, bear all the fill up to its "
                        "level though other blocks stand above them, of {}; leave them out by `blocks`, "
                        "`zones` or `box` where it does not come to them",
                        remarked.sheltered.area, named(remarked.sheltered.blocks)));
    }
    return remarks;
}

} // namespace

template<int Dim>
Tractions<Dim> backfillTractions(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                                 const BackfillSettings<Dim>& settings)
{
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    Tractions<Dim> tractions;
    tractions.pressure = [settings, up](const Vector<Dim>& place)
    { return settings.unitWeight * (settings.level.value_or(0) - place.dot(up)) + settings.surcharge; };
    const FillFromAbove<Dim> fill(assembly, settings.level);
    RemarkedFaces remarked;
    for (const std::vector<SurfacePiece<Dim>>& face :
         facesOf(settings.level ? partBelow(exposed, up, *settings.level) : exposed, widthOfAJoint(assembly)))
    {
        addFace(face, fill, settings.lateralCoefficient, tractions, remarked);
    }
    tractions.remarks = remarksOf(remarked);
    return tractions;
}

template void declare(Options& options, BackfillSettings<2>& settings);
template void declare(Options& options, BackfillSettings<3>& settings);
template Tractions<2> backfillTractions(const Assembly<2>& assembly,
                                        const std::vector<SurfacePiece<2>>& exposed,
                                        const BackfillSettings<2>& settings);
template Tractions<3> backfillTractions(const Assembly<3>& assembly,
                                        const std::vector<SurfacePiece<3>>& exposed,
                                        const BackfillSettings<3>& settings);

} // namespace drystone
