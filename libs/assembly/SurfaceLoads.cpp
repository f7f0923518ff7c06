// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pressures, integrated over the exposed faces.
#include "assembly/SurfaceLoads.h"

#include "assembly/BlockShape.h"
#include "core/Log.h"
#include "geometry/Box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace drystone
{
namespace
{

/// The integral of tractions over each piece in the forces and moments of its block.
template<int Dim>
Load integrated(const Assembly<Dim>& assembly, const Tractions<Dim>& tractions)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    const auto count =
        std::count_if(freeIndex.begin(), freeIndex.end(), [](int index) { return index >= 0; });
    const std::vector<BlockMass<Dim>> masses = blockMasses(assembly);
    Load load{Eigen::VectorXd::Zero(freedomCount<Dim> * count), Eigen::MatrixXd::Zero(Dim, Dim * count)};
    Eigen::VectorXd sizes = load.rows; // of all that is added up
    for (const auto& [piece, direction] : tractions.pieces)
    {
        const auto first = freedomCount<Dim> * freeIndex[piece.block];
        for (const auto& [place, weight] : quadratureOf(piece))
        {
            const Vector<Dim> force = weight * Vector<Dim>(tractions.pressure(place) * direction);
            const Vector<Dim> arm = place - masses[piece.block].centroid;
            load.rows.template segment<Dim>(first) += force;
            load.rows.template segment<rotationCount<Dim>>(first + Dim) += momentOf(arm, force);
            load.firstMoments.template middleCols<Dim>(Dim * freeIndex[piece.block]) +=
                arm * force.transpose();
            sizes.template segment<Dim>(first).array() += force.norm();
            sizes.template segment<rotationCount<Dim>>(first + Dim).array() += arm.norm() * force.norm();
        }
    }
    // What cancels is zero: rounding left of it would be a load with a multiplier of its own.
    load.rows = (load.rows.array().abs() > roundingOfLoads * sizes.array()).select(load.rows, 0);
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

} // namespace

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
        .example(Dim == 2 ? "(-1 0)" : "(-1 0 0)");
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

namespace
{

template<int Dim>
Tractions<Dim> tractionsOf(const Assembly<Dim>&, const std::vector<SurfacePiece<Dim>>& exposed,
                           const PressureSettings<Dim>& settings)
{
    const Vector<Dim> normal = settings.normal.stableNormalized();
    const double least = std::cos(settings.within * std::numbers::pi / 180) - sameDirection;
    Tractions<Dim> tractions;
    tractions.pressure = [value = settings.value](const Vector<Dim>&) { return value; };
    for (const SurfacePiece<Dim>& piece : exposed)
    {
        if (piece.normal.dot(normal) >= least)
        {
            const Vector<Dim> direction = settings.direction.isZero(0)
                                              ? Vector<Dim>(-piece.normal)
                                              : Vector<Dim>(settings.direction.stableNormalized());
            tractions.pieces.push_back({piece, direction});
        }
    }
    return tractions;
}

template<int Dim>
Tractions<Dim> tractionsOf(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                           const BackfillSettings<Dim>& settings)
{
    return backfillTractions(assembly, exposed, settings);
}

/// What is improbable of a pressure, and the key that it concerns: it may be 0, as the first of a series.
template<int Dim>
std::pair<std::string, std::string> doubtAbout(const Assembly<Dim>&, const Tractions<Dim>&,
                                               const PressureSettings<Dim>& settings)
{
    return {"value", settings.value == 0 ? "A pressure of 0 is no load." : ""};
}

/// Of a fill: its surface lies on the faces that it is to press on, or far above all blocks, as a level in
/// millimetres.
template<int Dim>
std::pair<std::string, std::string> doubtAbout(const Assembly<Dim>& assembly, const Tractions<Dim>& tractions,
                                               const BackfillSettings<Dim>& settings)
{
    constexpr double noPressure = 1e-6; // [Pa]: rounding of a level at 3 x 0.1
    const auto presses = [&](const PressedPiece<Dim>& pressed)
    {
        return pressed.direction.norm() > 0
               && std::any_of(pressed.piece.corners.begin(), pressed.piece.corners.end(),
                              [&](const Vector<Dim>& corner)
                              { return tractions.pressure(corner) > noPressure; });
    };
    if (std::none_of(tractions.pieces.begin(), tractions.pieces.end(), presses))
    {
        return {"level", fmt::format("A fill up to {:g} m is no load: the faces that it lies on are as high.",
                                     settings.level.value_or(0))};
    }
    Box<Dim> blocks;
    for (const Block<Dim>& block : assembly.blocks)
    {
        if (block.support < 0)
        {
            extend<Dim>(blocks, boundingBox(block));
        }
    }
    constexpr double deepest = 20; // [m], and heights of the blocks
    const double height = blocks.upper[Dim - 1] - blocks.lower[Dim - 1];
    const double above = settings.level.value_or(0) - blocks.upper[Dim - 1];
    return {"level", settings.unitWeight > 0 && above > deepest * std::max(1.0, height)
                         ? fmt::format("The fill is {:.4g} m high above the highest block, and all blocks "
                                       "together are {:.3g} m high: `level` is a height in metres. It is "
                                       "used as it stands.",
                                       above, height)
                         : ""};
}

/// A maker that reports where no face is loaded.
template<int Dim, class Settings>
LoadMaker<Dim> surfaceLoad(const Settings& settings, const Dictionary& dictionary)
{
    return [settings, place = dictionary.locationOf("type"),
            places = EntryLocations(dictionary)](const LoadContext<Dim>& context) -> Load
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
        if (const auto [key, doubt] = doubtAbout(context.assembly, tractions, settings); !doubt.empty())
        {
            printWarningOnce(doubt, places.of(key));
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
Load pressureLoad(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                  const PressureSettings<Dim>& settings)
{
    return integrated(assembly, tractionsOf(assembly, exposed, settings));
}

template<int Dim>
Load backfillLoad(const Assembly<Dim>& assembly, const std::vector<SurfacePiece<Dim>>& exposed,
                  const BackfillSettings<Dim>& settings)
{
    return integrated(assembly, tractionsOf(assembly, exposed, settings));
}

template<int Dim>
std::vector<Model<LoadMaker<Dim>>> surfaceLoadTypes()
{
    return {
        model<LoadMaker<Dim>, PressureSettings<Dim>>(
            "pressure",
            "a pressure on faces, as of wind; in motion its forces stay at their points of the blocks, with "
            "their directions",
            surfaceLoad<Dim, PressureSettings<Dim>>),
        model<LoadMaker<Dim>, BackfillSettings<Dim>>("backfill",
                                                     "the weight of a fill on the faces that look up, with a "
                                                     "surcharge on it; in motion its forces stay at "
                                                     "their points of the blocks, with their directions",
                                                     surfaceLoad<Dim, BackfillSettings<Dim>>),
    };
}

template void declare(Options& options, PressureSettings<2>& settings);
template void declare(Options& options, PressureSettings<3>& settings);
template Load pressureLoad(const Assembly<2>& assembly, const std::vector<SurfacePiece<2>>& exposed,
                           const PressureSettings<2>& settings);
template Load pressureLoad(const Assembly<3>& assembly, const std::vector<SurfacePiece<3>>& exposed,
                           const PressureSettings<3>& settings);
template Load backfillLoad(const Assembly<2>& assembly, const std::vector<SurfacePiece<2>>& exposed,
                           const BackfillSettings<2>& settings);
template Load backfillLoad(const Assembly<3>& assembly, const std::vector<SurfacePiece<3>>& exposed,
                           const BackfillSettings<3>& settings);
template std::vector<Model<LoadMaker<2>>> surfaceLoadTypes<2>();
template std::vector<Model<LoadMaker<3>>> surfaceLoadTypes<3>();

} // namespace drystone
