// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pressures, integrated over the exposed faces.
#include "assembly/SurfaceLoads.h"

#include "assembly/FillFromAbove.h"
#include "core/Log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

namespace drystone
{
namespace
{

/// Directions that differ by rounding only are the same.
constexpr double sameDirection = 1e-9;

/// What is left by rounding where all of a face is taken away, as a part of what was added up.
constexpr double roundingOfAreas = 1e-9;

/// A piece of a face, and which way it is pressed.
template<int Dim>
struct PressedPiece
{
    SurfacePiece<Dim> piece;
    Vector<Dim> direction = Vector<Dim>::Zero(); ///< force per area and pressure [-]
};

/// What presses on faces.
template<int Dim>
struct Tractions
{
    std::vector<PressedPiece<Dim>> pieces;
    std::function<double(const Vector<Dim>& place)> pressure; ///< linear over each piece [Pa]
    std::vector<std::string> remarks;                         ///< for the log
};

/// The integral of tractions over each piece in the forces and moments of its block.
template<int Dim>
Eigen::VectorXd integrated(const Assembly<Dim>& assembly, const Tractions<Dim>& tractions)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    const auto count =
        std::count_if(freeIndex.begin(), freeIndex.end(), [](int index) { return index >= 0; });
    const std::vector<BlockMass<Dim>> masses = blockMasses(assembly);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(freedomCount<Dim> * count);
    Eigen::VectorXd sizes = load; // of all that is added up
    for (const auto& [piece, direction] : tractions.pieces)
    {
        const auto first = freedomCount<Dim> * freeIndex[piece.block];
        for (const auto& [place, weight] : quadratureOf(piece))
        {
            const Vector<Dim> force = weight * Vector<Dim>(tractions.pressure(place) * direction);
            const Vector<Dim> arm = place - masses[piece.block].centroid;
            load.template segment<Dim>(first) += force;
            load.template segment<rotationCount<Dim>>(first + Dim) += momentOf(arm, force);
            sizes.template segment<Dim>(first).array() += force.norm();
            sizes.template segment<rotationCount<Dim>>(first + Dim).array() += arm.norm() * force.norm();
        }
    }
    // What cancels is zero: rounding left of it would be a load with a multiplier of its own.
    load = (load.array().abs() > roundingOfLoads * sizes.array()).select(load, 0);
    return load;
}

/// Whether anything presses on a face. Forces may cancel on a block that is loaded on both sides, and a
/// pressure may be 0; so what is added up is the area that is pressed, from which joints take their part: all
/// but rounding of a face that is covered.
template<int Dim>
bool areOnFaces(const Tractions<Dim>& tractions)
{
    double exposed = 0; // [m2]
    double whole = 0;
    for (const auto& [piece, direction] : tractions.pieces)
    {
        exposed += areaOf(piece) * direction.norm();
        whole += std::abs(areaOf(piece)) * direction.norm();
    }
    return exposed > roundingOfAreas * whole;
}

template<int Dim>
std::vector<char> chosenBlocks(const Assembly<Dim>& assembly, const LoadedFaces<Dim>& faces)
{
    const bool isAll = faces.blocks.empty() && faces.zones.empty();
    std::vector<char> chosen(assembly.blocks.size(), isAll);
    for (const int block : faces.blocks)
    {
        chosen[block] = true;
    }
    for (const Zone& zone : assembly.zones)
    {
        if (std::any_of(faces.zones.begin(), faces.zones.end(),
                        [&](const NamePattern& pattern) { return pattern.matches(zone.name); }))
        {
            for (const int block : zone.blocks)
            {
                chosen[block] = true;
            }
        }
    }
    for (std::size_t block = 0; block < chosen.size(); ++block)
    {
        chosen[block] = chosen[block] && assembly.blocks[block].support < 0;
    }
    return chosen;
}

/// Refuses blocks and zones that the assembly does not have.
template<int Dim>
void requireBlocks(const Assembly<Dim>& assembly, const LoadedFaces<Dim>& faces, const EntryLocations& places)
{
    for (const int block : faces.blocks)
    {
        if (block >= static_cast<int>(assembly.blocks.size()))
        {
            throw FatalIOError(fmt::format("There is no block {}: the assembly has blocks 0 to {}.", block,
                                           assembly.blocks.size() - 1),
                               places.of("blocks"));
        }
    }
    for (const NamePattern& pattern : faces.zones)
    {
        std::vector<std::string> names;
        for (const Zone& zone : assembly.zones)
        {
            names.push_back(zone.name);
        }
        if (std::none_of(names.begin(), names.end(),
                         [&](const std::string& name) { return pattern.matches(name); }))
        {
            throw FatalIOError(unknownWordMessage("zone", pattern.text, names), places.of("zones"));
        }
    }
}

template<int Dim>
std::string exampleOf(const char* plane, const char* space)
{
    return Dim == 2 ? plane : space;
}

} // namespace

template<int Dim>
void declare(Options& options, LoadedFaces<Dim>& faces)
{
    options.optional("blocks", faces.blocks, "only the faces of these blocks, by index").example("(3 4 5)");
    options.optional("zones", faces.zones, "only the faces of blocks in these zones of the assembly")
        .example("(facade)");
    options
        .optional("box", faces.box,
                  "only what lies between this lower and upper corner; faces are cut at its sides")
        .unit("m")
        .example(exampleOf<Dim>("((0 0) (2 1.5))", "((0 0 0) (2 1 1.5))"));
    options.check("box",
                  [&faces]() -> std::string
                  {
                      const bool isBox =
                          faces.box.size() == 2 && (faces.box[1] - faces.box[0]).minCoeff() > 0;
                      return faces.box.empty() || isBox
                                 ? ""
                                 : "A box has two corners, the second above the first in every direction.";
                  });
    options.check("blocks",
                  [&faces]() -> std::string
                  {
                      return std::any_of(faces.blocks.begin(), faces.blocks.end(),
                                         [](int block) { return block < 0; })
                                 ? "Blocks are counted from 0."
                                 : "";
                  });
}

template<int Dim>
void declare(Options& options, PressureSettings<Dim>& settings)
{
    options
        .required("value", settings.value, "of the pressure: positive presses on the faces, negative pulls")
        .unit("Pa")
        .example("600");
    options
        .required("normal", settings.normal,
                  "which way the loaded faces look, out of the blocks; faces that touch other blocks are not "
                  "loaded")
        .example(exampleOf<Dim>("(-1 0)", "(-1 0 0)"));
    options
        .optional("within", settings.within,
                  "largest angle between `normal` and that of a loaded face, in degrees")
        .atLeast(0)
        .atMost(180);
    options.optional("direction", settings.direction,
                     "of the force; of length 0: on each face against its normal");
    declare(options, static_cast<LoadedFaces<Dim>&>(settings));
    options.check(
        "normal",
        [&settings]() -> std::string
        {
            return settings.normal.isZero(0)
                       ? "The normal of a face cannot be (0 0 0). Write for instance `normal (-1 0 0);` for "
                         "those that look to the left."
                       : "";
        });
}

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
                  exampleOf<Dim>("height y of its surface; required with unitWeight",
                                 "height z of its surface; required with unitWeight"))
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

template<int Dim>
std::vector<SurfacePiece<Dim>> exposedSurface(const Assembly<Dim>& assembly,
                                              const std::vector<SurfacePiece<Dim>>& covered,
                                              const LoadedFaces<Dim>& faces)
{
    const std::vector<char> chosen = chosenBlocks(assembly, faces);
    std::vector<SurfacePiece<Dim>> pieces;
    for (std::size_t block = 0; block < chosen.size(); ++block)
    {
        if (chosen[block])
        {
            const std::vector<SurfacePiece<Dim>> own = surfaceOf(assembly, static_cast<int>(block));
            pieces.insert(pieces.end(), own.begin(), own.end());
        }
    }
    std::copy_if(covered.begin(), covered.end(), std::back_inserter(pieces),
                 [&](const SurfacePiece<Dim>& piece) { return chosen[piece.block] != 0; });
    for (int axis = 0; axis < Dim && !faces.box.empty(); ++axis)
    {
        const Vector<Dim> direction = Vector<Dim>::Unit(axis);
        pieces = partBelow(pieces, direction, faces.box[1][axis]);
        pieces = partBelow(pieces, -direction, -faces.box[0][axis]);
    }
    return pieces;
}

namespace
{

template<int Dim>
Tractions<Dim> tractionsOf(const Assembly<Dim>&, const std::vector<SurfacePiece<Dim>>& exposed,
                           const PressureSettings<Dim>& settings)
{
    const Vector<Dim> normal = settings.normal.normalized();
    const double least = std::cos(settings.within * std::numbers::pi / 180) - sameDirection;
    Tractions<Dim> tractions;
    tractions.pressure = [value = settings.value](const Vector<Dim>&) { return value; };
    for (const SurfacePiece<Dim>& piece : exposed)
    {
        if (piece.normal.dot(normal) >= least)
        {
            const Vector<Dim> direction = settings.direction.isZero(0)
                                              ? Vector<Dim>(-piece.normal)
                                              : Vector<Dim>(settings.direction.normalized());
            tractions.pieces.push_back({piece, direction});
        }
    }
    return tractions;
}

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
    constexpr std::size_t most = 8;
    const std::size_t shown = std::min(most, blocks.size());
    const std::size_t more = blocks.size() - shown;
    return fmt::format("block{} {}{}", blocks.size() == 1 ? "" : "s",
                       fmt::join(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(shown), " "),
                       more > 0 ? fmt::format(" and {} more", more) : "");
}

template<int Dim>
Tractions<Dim> tractionsOf(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                           const BackfillSettings<Dim>& settings)
{
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    Tractions<Dim> tractions;
    tractions.pressure = [settings, up](const Vector<Dim>& place)
    { return settings.unitWeight * (settings.level.value_or(0) - place.dot(up)) + settings.surcharge; };
    const FillFromAbove<Dim> fill(assembly, settings.level);
    FacesOfRemark withoutEarthPressure;
    FacesOfRemark sheltered;
    for (const std::vector<SurfacePiece<Dim>>& face :
         facesOf(settings.level ? partBelow(exposed, up, *settings.level) : exposed, widthOfAJoint(assembly)))
    {
        // The weight on a face vanishes as it turns to the vertical, and there is none on one that looks
        // down; the earth pressure does not know on which side of the vertical it is.
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
        const bool isPressed = settings.lateralCoefficient > 0 && sideways.norm() > sameDirection;
        const bool isBare = area > roundingOfAreas * whole;
        const bool isReached = !isPressed || !isBare || fill.reaches(face);
        if (!isReached)
        {
            withoutEarthPressure.add(face.front().block, area * sideways.norm());
        }
        if (isBare && normal.dot(up) > sameDirection && fill.isSheltered(face))
        {
            sheltered.add(face.front().block, area * normal.dot(up));
        }
        const double lateral = isReached ? settings.lateralCoefficient : 0;
        for (const SurfacePiece<Dim>& piece : face)
        {
            tractions.pieces.push_back({piece, -(std::max(0.0, normal.dot(up)) * up + lateral * sideways)});
        }
    }
    if (!withoutEarthPressure.blocks.empty())
    {
        tractions.remarks.push_back(
            fmt::format("Backfill: no earth pressure on {:.4g} m2 of faces, vertical projection, which the "
                        "fill cannot reach from above, of {}",
                        withoutEarthPressure.area, named(withoutEarthPressure.blocks)));
    }
    if (!sheltered.blocks.empty())
    {
        tractions.remarks.push_back(
            fmt::format("Backfill: {:.4g} m2 of faces, horizontal projection, bear all the fill up to its "
                        "level though other blocks stand above them, of {}; leave them out by `blocks`, "
                        "`zones` or `box` where it does not come to them",
                        sheltered.area, named(sheltered.blocks)));
    }
    return tractions;
}

/// Whether settings are of no load: a pressure may be 0, as the first of a series.
template<int Dim>
bool isNothing(const PressureSettings<Dim>& settings)
{
    return settings.value == 0;
}
template<int Dim>
bool isNothing(const BackfillSettings<Dim>&)
{
    return false;
}

/// A maker that reports where no face is loaded.
template<int Dim, class Settings>
LoadMaker<Dim> surfaceLoad(const Settings& settings, const Dictionary& dictionary)
{
    return [settings, place = dictionary.locationOf("type"),
            places = EntryLocations(dictionary)](const LoadContext<Dim>& context) -> Eigen::VectorXd
    {
        requireBlocks<Dim>(context.assembly, settings, places);
        const std::vector<SurfacePiece<Dim>> covered =
            context.coveredSurface ? context.coveredSurface() : std::vector<SurfacePiece<Dim>>();
        const Tractions<Dim> tractions =
            tractionsOf(context.assembly, exposedSurface<Dim>(context.assembly, covered, settings), settings);
        if (!areOnFaces(tractions))
        {
            throw FatalIOError("No face of a free block is loaded: each that is chosen touches another "
                               "block, looks elsewhere or lies outside the box or above the level. "
                               "VTK/assembly.vtp shows where the blocks are.",
                               place);
        }
        if (isNothing(settings))
        {
            printWarningOnce("A pressure of 0 is no load.", places.of("value"));
        }
        for (const std::string& remark : tractions.remarks)
        {
            printLine(remark);
        }
        return integrated(context.assembly, tractions);
    };
}

} // namespace

template<int Dim>
Eigen::VectorXd pressureLoad(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                             const PressureSettings<Dim>& settings)
{
    return integrated(assembly, tractionsOf(assembly, exposed, settings));
}

template<int Dim>
Eigen::VectorXd backfillLoad(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                             const BackfillSettings<Dim>& settings)
{
    return integrated(assembly, tractionsOf(assembly, exposed, settings));
}

template<int Dim>
std::vector<Model<LoadMaker<Dim>>> surfaceLoadTypes()
{
    return {
        model<LoadMaker<Dim>, PressureSettings<Dim>>("pressure", "a pressure on faces, as of wind",
                                                     surfaceLoad<Dim, PressureSettings<Dim>>),
        model<LoadMaker<Dim>, BackfillSettings<Dim>>(
            "backfill", "the weight of a fill on the faces that look up, with a surcharge on it",
            surfaceLoad<Dim, BackfillSettings<Dim>>),
    };
}

template void declare(Options& options, LoadedFaces<2>& faces);
template void declare(Options& options, LoadedFaces<3>& faces);
template void declare(Options& options, PressureSettings<2>& settings);
template void declare(Options& options, PressureSettings<3>& settings);
template void declare(Options& options, BackfillSettings<2>& settings);
template void declare(Options& options, BackfillSettings<3>& settings);
template std::vector<SurfacePiece<2>> exposedSurface(const Assembly<2>& assembly,
                                                     const std::vector<SurfacePiece<2>>& covered,
                                                     const LoadedFaces<2>& faces);
template std::vector<SurfacePiece<3>> exposedSurface(const Assembly<3>& assembly,
                                                     const std::vector<SurfacePiece<3>>& covered,
                                                     const LoadedFaces<3>& faces);
template Eigen::VectorXd pressureLoad(const Assembly<2>& assembly,
                                      const std::vector<SurfacePiece<2>>& exposed,
                                      const PressureSettings<2>& settings);
template Eigen::VectorXd pressureLoad(const Assembly<3>& assembly,
                                      const std::vector<SurfacePiece<3>>& exposed,
                                      const PressureSettings<3>& settings);
template Eigen::VectorXd backfillLoad(const Assembly<2>& assembly,
                                      const std::vector<SurfacePiece<2>>& exposed,
                                      const BackfillSettings<2>& settings);
template Eigen::VectorXd backfillLoad(const Assembly<3>& assembly,
                                      const std::vector<SurfacePiece<3>>& exposed,
                                      const BackfillSettings<3>& settings);
template std::vector<Model<LoadMaker<2>>> surfaceLoadTypes<2>();
template std::vector<Model<LoadMaker<3>>> surfaceLoadTypes<3>();

} // namespace drystone
