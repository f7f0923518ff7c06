// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Load vectors.
#include "assembly/Loads.h"

#include "assembly/CaseFile.h"
#include "assembly/Facing.h"
#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

Eigen::VectorXd gravityLoad(const Assembly<2>& assembly, const std::vector<double>& masses,
                            const Vector<2>& gravity)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    std::vector<double> rows;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (freeIndex[i] >= 0)
        {
            rows.insert(rows.end(), {masses[i] * gravity.x(), masses[i] * gravity.y(), 0});
        }
    }
    return Eigen::VectorXd::Map(rows.data(), static_cast<Eigen::Index>(rows.size()));
}

Eigen::VectorXd inertialLoad(const Assembly<2>& assembly, const std::vector<double>& masses,
                             const Vector<2>& gravity, const Vector<2>& direction)
{
    return gravityLoad(assembly, masses, gravity.norm() * direction.normalized());
}

std::optional<int> findLoadedBlock(const Assembly<2>& assembly, const Vector<2>& point, double tolerance)
{
    std::optional<int> nearest;
    double least = tolerance;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<2>& block = assembly.blocks[i];
        if (block.support >= 0 || !contains(enlarged(boundingBox(block.outline), tolerance), {point, point}))
        {
            continue;
        }
        // Inside counts as no distance at all, so that among blocks which hold the point the first is taken.
        const double away = std::max(0.0, signedDistance(block.outline, point));
        if (away < least || (away <= least && !nearest))
        {
            least = away;
            nearest = static_cast<int>(i);
        }
    }
    return nearest;
}

Eigen::VectorXd pointLoad(const Assembly<2>& assembly, int block, const Vector<2>& point,
                          const Vector<2>& force)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    const auto freeBlocks =
        std::count_if(freeIndex.begin(), freeIndex.end(), [](int index) { return index >= 0; });
    Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * freeBlocks);
    const Vector<2> arm = point - blockMass(assembly.blocks[block]).centroid;
    load.segment<3>(3 * freeIndex[block]) << force, cross(arm, force);
    return load;
}

namespace
{

struct GravitySettings
{
};

void declare(Options&, GravitySettings&) {}

struct InertialSettings
{
    Vector<2> direction{1, 0};
};

void declare(Options& options, InertialSettings& settings)
{
    options.required("direction", settings.direction, "of the load; its length does not matter")
        .example("(1 0 0)");
    options.check("direction",
                  [&settings]() -> std::string
                  {
                      return settings.direction.isZero(0)
                                 ? "A direction cannot be (0 0 0). Write for instance `direction (1 0 0);`."
                                 : "";
                  });
}

struct ForceSettings
{
    Vector<2> at{0, 0};
    Vector<2> value{0, 0};
};

void declare(Options& options, ForceSettings& settings)
{
    options.required("at", settings.at, "point in or on a free block").unit("m").example("(0.5 1.2)");
    options.required("value", settings.value, "force").unit("N").example("(0 -1000 0)");
    options.check("value",
                  [&settings]() -> std::string
                  {
                      return settings.value.isZero(0)
                                 ? "A force cannot be (0 0 0). Write for instance `value (0 -1000 0);`."
                                 : "";
                  });
}

struct SupportMovementSettings
{
    std::string support;
    Vector<2> direction{0, -1};
};

void declare(Options& options, SupportMovementSettings& settings)
{
    options.required("support", settings.support, "name of the support that moves").example("right");
    options.required("direction", settings.direction, "of its movement").example("(0 -1 0)");
}

/// A force may miss the outline by this part of the mean block size: the extrados of an arch of trapezoids,
/// say.
constexpr double reachOfAForce = 0.05;

LoadMaker makeForce(const ForceSettings& settings, const Dictionary& dictionary)
{
    return [settings, place = dictionary.locationOf("at")](const LoadContext& context) -> Eigen::VectorXd
    {
        const double reach = reachOfAForce * meanBlockSize(context.assembly);
        const std::optional<int> block = findLoadedBlock(context.assembly, settings.at, reach);
        if (!block)
        {
            throw FatalIOError(
                fmt::format("There is no free block at ({:.6g} {:.6g}): the force needs one to act on. "
                            "VTK/assembly.vtp shows where the blocks are.",
                            settings.at.x(), settings.at.y()),
                place);
        }
        return pointLoad(context.assembly, *block, settings.at, settings.value);
    };
}

} // namespace

const Registry<LoadMaker>& loadTypes()
{
    static const Registry<LoadMaker> registry{
        "load",
        {
            model<LoadMaker, GravitySettings>("gravity", "the weight of the blocks",
                                              [](const GravitySettings&) -> LoadMaker
                                              {
                                                  return [](const LoadContext& context) {
                                                      return gravityLoad(context.assembly, context.masses,
                                                                         context.gravity);
                                                  };
                                              }),
            model<LoadMaker, InertialSettings>(
                "inertial", "each block's own weight, turned into a direction",
                [](const InertialSettings& settings) -> LoadMaker
                {
                    return [direction = settings.direction](const LoadContext& context)
                    { return inertialLoad(context.assembly, context.masses, context.gravity, direction); };
                }),
            model<LoadMaker, ForceSettings>("force", "a force on the block at a point", makeForce),
            model<LoadMaker, SupportMovementSettings>(
                "supportMovement", "settlement of a support: not simulated by this version",
                [](const SupportMovementSettings&, const Dictionary& dictionary) -> LoadMaker
                {
                    throw FatalIOError("This version does not simulate supportMovement. Loads that it does: "
                                       "force gravity inertial.",
                                       dictionary.locationOf("type"));
                }),
        }};
    return registry;
}

void declare(Options& options, LoadCases& cases)
{
    options.required("dead", cases.dead, loadTypes(), "load that acts in full");
    options.optional("live", cases.live, loadTypes(), "load that the multiplier alpha makes grow");
}

LoadVectors readLoads(const std::filesystem::path& caseDirectory, const LoadContext& context,
                      LiveLoad liveLoad)
{
    constexpr std::string_view file = "constant/loads";
    if (liveLoad == LiveLoad::optional && !std::filesystem::exists(caseDirectory / file))
    {
        return {gravityLoad(context.assembly, context.masses, context.gravity), {}};
    }
    const Dictionary dictionary = readCaseFile(
        caseDirectory, file, "dead { type gravity; } live { type inertial; direction (1 0 0); }");
    const auto cases = readOptions<LoadCases>(dictionary);
    if (!cases.live && liveLoad == LiveLoad::required)
    {
        throw FatalIOError(
            "There is no live load to find the multiplier of. Add, for instance, \n\n    live { type "
            "inertial; direction (1 0 0); }",
            dictionary.location());
    }
    LoadVectors loads{cases.dead(context), cases.live ? (*cases.live)(context) : Eigen::VectorXd()};
    if (liveLoad == LiveLoad::required && loads.live.isZero(0))
    {
        throw FatalIOError(
            "The live load is zero on every block, as where gravity (constant/g) is zero: there "
            "is nothing to find the multiplier of. Give gravity, or a live load of type force.",
            dictionary.locationOf("live"));
    }
    return loads;
}

} // namespace drystone
