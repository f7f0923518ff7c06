// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Load vectors.
#include "assembly/Loads.h"

#include "assembly/CaseFile.h"
#include "geometry/BroadPhase.h"
#include "geometry/PolygonShape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

std::vector<int> findLoadedBlocks(const Assembly<2>& assembly, const Vector<2>& point, double tolerance,
                                  double same)
{
    std::vector<std::pair<double, int>> found;
    double least = tolerance;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<2>& block = assembly.blocks[i];
        if (block.support < 0
            && contains(enlarged(boundingBox(block.outline), tolerance + same), {point, point}))
        {
            const double away = std::max(0.0, signedDistance(block.outline, point));
            least = std::min(least, away);
            found.emplace_back(away, static_cast<int>(i));
        }
    }
    std::vector<int> blocks;
    for (const auto& [away, block] : found)
    {
        if (away <= least + same && away <= tolerance)
        {
            blocks.push_back(block);
        }
    }
    return blocks;
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

std::optional<Eigen::VectorXd> lineLoad(const Assembly<2>& assembly, const Vector<2>& from,
                                        const Vector<2>& to, const Vector<2>& forcePerLength,
                                        double tolerance)
{
    // Cut wherever the line may pass from one block to another: at their edges, and beside their corners.
    const Vector<2> along = to - from;
    const double length = along.norm();
    std::vector<double> cuts{0, 1};
    const auto cut = [&cuts](double place)
    {
        if (place > 0 && place < 1)
        {
            cuts.push_back(place);
        }
    };
    const BoundingBox reach = enlarged({from.cwiseMin(to), from.cwiseMax(to)}, tolerance);
    for (const Block<2>& block : assembly.blocks)
    {
        if (block.support >= 0 || !meet(reach, boundingBox(block.outline)))
        {
            continue;
        }
        for (std::size_t i = 0; i < block.outline.size(); ++i)
        {
            const Vector<2> corner = block.outline[i] - from;
            const Vector<2> edge = block.outline[(i + 1) % block.outline.size()] - block.outline[i];
            cut(corner.dot(along) / (length * length));
            if (const double sine = cross(along, edge); std::abs(sine) > 1e-12 * length * edge.norm())
            {
                cut(cross(corner, edge) / sine);
            }
        }
    }
    std::sort(cuts.begin(), cuts.end());
    std::optional<Eigen::VectorXd> load;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    {
        const double share = cuts[i + 1] - cuts[i];
        if (share <= 1e-12)
        {
            continue;
        }
        const Vector<2> middle = from + (cuts[i] + cuts[i + 1]) / 2 * along;
        const std::optional<int> block = findLoadedBlock(assembly, middle, tolerance);
        if (!block)
        {
            return std::nullopt;
        }
        const Eigen::VectorXd piece = pointLoad(assembly, *block, middle, share * length * forcePerLength);
        load = load ? Eigen::VectorXd(*load + piece) : piece;
    }
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
    std::optional<int> block;
};

void declare(Options& options, ForceSettings& settings)
{
    options.required("at", settings.at, "point in or on a free block").unit("m").example("(0.5 1.2)");
    options.required("value", settings.value, "force").unit("N").example("(0 -1000 0)");
    options
        .optional(
            "block", settings.block,
            "index of the block it acts on; required where the point lies on a joint, that is on several")
        .atLeast(0)
        .example("12");
    options.check("value",
                  [&settings]() -> std::string
                  {
                      return settings.value.isZero(0)
                                 ? "A force cannot be (0 0 0). Write for instance `value (0 -1000 0);`."
                                 : "";
                  });
}

struct LineSettings
{
    Vector<2> from{0, 0};
    Vector<2> to{0, 0};
    Vector<2> value{0, 0};
};

void declare(Options& options, LineSettings& settings)
{
    options.required("from", settings.from, "start of the line, in or on free blocks")
        .unit("m")
        .example("(0 1.05)");
    options.required("to", settings.to, "its end").unit("m").example("(2 1.05)");
    options.required("value", settings.value, "force per length").unit("N/m").example("(0 -1000 0)");
    options.check("to",
                  [&settings]() -> std::string
                  {
                      return settings.from == settings.to
                                 ? "A line needs two different ends. For a single point write `type force;`."
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
    options.required("direction", settings.direction, "of its movement; its length does not matter")
        .example("(0 -1 0)");
    options.check("direction",
                  [&settings]() -> std::string
                  {
                      return settings.direction.isZero(0)
                                 ? "A direction cannot be (0 0 0). Write for instance `direction (0 -1 0);`."
                                 : "";
                  });
}

/// A force may miss the outline by this part of the mean block size: the extrados of an arch of trapezoids,
/// say.
constexpr double reachOfAForce = 0.05;

/// Points of different blocks that are this near are one [m].
double widthOfAJoint(const Assembly<2>& assembly)
{
    return std::max(1e-6 * meanBlockSize(assembly), assembly.closure.tolerance);
}

LoadMaker makeForce(const ForceSettings& settings, const Dictionary& dictionary)
{
    return [settings, place = dictionary.locationOf("at"),
            blockPlace = dictionary.locationOf("block")](const LoadContext& context) -> Eigen::VectorXd
    {
        const double reach = reachOfAForce * meanBlockSize(context.assembly);
        std::vector<int> blocks =
            findLoadedBlocks(context.assembly, settings.at, reach, widthOfAJoint(context.assembly));
        if (settings.block && !blocks.empty())
        {
            if (std::find(blocks.begin(), blocks.end(), *settings.block) == blocks.end())
            {
                throw FatalIOError(
                    fmt::format("The force at ({:.6g} {:.6g}) can not act on block {}: this point is "
                                "in or on block {}.",
                                settings.at.x(), settings.at.y(), *settings.block,
                                fmt::join(blocks, " and ")),
                    blockPlace);
            }
            blocks = {*settings.block};
        }
        if (blocks.size() > 1)
        {
            throw FatalIOError(
                fmt::format(
                    "The force at ({:.6g} {:.6g}) is on the joint of blocks {}, and may act on either: the "
                    "answers differ. Choose one, for instance `block {};`, or move the point by more than "
                    "{:.3g} m.",
                    settings.at.x(), settings.at.y(), fmt::join(blocks, " and "), blocks.front(),
                    widthOfAJoint(context.assembly)),
                place);
        }
        if (blocks.empty())
        {
            throw FatalIOError(
                fmt::format("There is no free block at ({:.6g} {:.6g}): the force needs one to act on. "
                            "VTK/assembly.vtp shows where the blocks are.",
                            settings.at.x(), settings.at.y()),
                place);
        }
        return pointLoad(context.assembly, blocks.front(), settings.at, settings.value);
    };
}

LoadMaker makeLine(const LineSettings& settings, const Dictionary& dictionary)
{
    return [settings, place = dictionary.locationOf("from")](const LoadContext& context) -> Eigen::VectorXd
    {
        const double reach = reachOfAForce * meanBlockSize(context.assembly);
        const std::optional<Eigen::VectorXd> load =
            lineLoad(context.assembly, settings.from, settings.to, settings.value, reach);
        if (!load)
        {
            throw FatalIOError(
                fmt::format(
                    "The line from ({:.6g} {:.6g}) to ({:.6g} {:.6g}) leaves the free blocks: all of it "
                    "needs one to act on. VTK/assembly.vtp shows where the blocks are.",
                    settings.from.x(), settings.from.y(), settings.to.x(), settings.to.y()),
                place);
        }
        return *load;
    };
}

std::vector<Model<LoadMaker>> singleLoads()
{
    return {
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
        model<LoadMaker, LineSettings>("line", "a force per length on the blocks along a line", makeLine),
    };
}

const Registry<LoadMaker>& singleLoadTypes()
{
    static const Registry<LoadMaker> registry{"load", singleLoads()};
    return registry;
}

struct SumSettings
{
    std::vector<Named<LoadMaker>> loads;
};

void declare(Options& options, SumSettings& settings)
{
    options.required("loads", settings.loads, singleLoadTypes(),
                     "that act together; each has a name of yours");
}

LoadMaker makeSum(const SumSettings& settings, const Dictionary& dictionary)
{
    if (settings.loads.empty())
    {
        throw FatalIOError("A sum needs loads. Write for instance `loads { weight { type gravity; } }`.",
                           dictionary.locationOf("loads"));
    }
    return [loads = settings.loads](const LoadContext& context)
    {
        Eigen::VectorXd sum = loads.front().second(context);
        for (std::size_t i = 1; i < loads.size(); ++i)
        {
            sum += loads[i].second(context);
        }
        return sum;
    };
}

} // namespace

const Registry<LoadMaker>& loadTypes()
{
    static const Registry<LoadMaker> registry = []
    {
        Registry<LoadMaker> all{"load", singleLoads()};
        all.models.push_back(
            model<LoadMaker, SumSettings>("sum", "several loads that act together", makeSum));
        all.models.push_back(model<LoadMaker, SupportMovementSettings>(
            "supportMovement", "settlement of a support, of limitAnalysis, instead of a live load",
            [](const SupportMovementSettings&, const Dictionary& dictionary) -> LoadMaker
            {
                return [place = dictionary.locationOf("type")](const LoadContext&) -> Eigen::VectorXd
                {
                    throw FatalIOError("supportMovement can only be the live load, by itself and without "
                                       "combinations: its answer is a reaction in N, which no multiplier "
                                       "compares with. Loads that can stand here: force gravity inertial "
                                       "line sum.",
                                       place);
                };
            }));
        return all;
    }();
    return registry;
}

void declare(Options& options, LoadCombination& combination)
{
    options.required("dead", combination.dead, loadTypes(), "load that acts in full");
    options.required("live", combination.live, loadTypes(), "load that the multiplier alpha makes grow");
    options.optional("multiplier", combination.multiplier, "of the live load that limitAnalysis looks for");
}

void declare(Options& options, LoadCases& cases)
{
    options.optional("dead", cases.dead, loadTypes(),
                     "load that acts in full; required without combinations");
    options.optional("live", cases.live, loadTypes(), "load that the multiplier alpha makes grow");
    options.optional("multiplier", cases.multiplier, "of the live load that limitAnalysis looks for");
    options.optional("combinations", cases.combinations,
                     "instead, of limitAnalysis: several pairs of dead and live load, each with a name of "
                     "yours and an answer of its own");
    options.check("dead",
                  [&cases]() -> std::string
                  {
                      const bool isSingle = cases.dead || cases.live;
                      if (!isSingle && cases.combinations.empty())
                      {
                          return "The dead load is missing. Write for instance `dead { type gravity; }`.";
                      }
                      return isSingle && !cases.combinations.empty()
                                 ? "Give either dead and live, or combinations: each of them has its own."
                             : cases.live && !cases.dead
                                 ? "The dead load is missing. Write for instance `dead { type gravity; }`."
                                 : "";
                  });
}

namespace
{

/// The movement that a live load of type supportMovement asks for.
std::optional<SupportMovement> readMovement(const Dictionary& loads, const Assembly<2>& assembly)
{
    const Entry* live = loads.findExact("live");
    const Entry* type = live ? live->dictionary().find("type") : nullptr;
    if (!type || type->as<std::string>() != "supportMovement")
    {
        return std::nullopt;
    }
    SupportMovementSettings settings;
    Options options;
    options.readElsewhere({"type"});
    declare(options, settings);
    options.readFrom(live->dictionary());
    std::vector<std::string> names;
    for (const Support& support : assembly.supports)
    {
        if (support.name == settings.support)
        {
            return SupportMovement{static_cast<int>(names.size()), settings.direction.normalized()};
        }
        names.push_back(support.name);
    }
    throw FatalIOError(unknownWordMessage("support", settings.support, names),
                       live->dictionary().locationOf("support"));
}

} // namespace

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
    if (!cases.combinations.empty())
    {
        throw FatalIOError("combinations are for limitAnalysis. Write for instance `dead { type gravity; }` "
                           "instead.",
                           dictionary.locationOf("combinations"));
    }
    if (!cases.live && liveLoad == LiveLoad::required)
    {
        throw FatalIOError(
            "There is no live load to find the multiplier of. Add, for instance, \n\n    live { type "
            "inertial; direction (1 0 0); }",
            dictionary.location());
    }
    LoadVectors loads;
    loads.multiplier = cases.multiplier;
    loads.dead = cases.dead(context);
    loads.movement = readMovement(dictionary, context.assembly);
    if (cases.live && !loads.movement)
    {
        loads.live = (*cases.live)(context);
    }
    if (liveLoad == LiveLoad::required && !loads.movement && loads.live.isZero(0))
    {
        throw FatalIOError(
            "The live load is zero on every block, as where gravity (constant/g) is zero: there "
            "is nothing to find the multiplier of. Give gravity, or a live load of type force.",
            dictionary.locationOf("live"));
    }
    return loads;
}

std::vector<std::pair<std::string, LoadVectors>>
readLoadCombinations(const std::filesystem::path& caseDirectory, const LoadContext& context)
{
    constexpr std::string_view file = "constant/loads";
    std::vector<std::pair<std::string, LoadVectors>> result;
    if (!std::filesystem::exists(caseDirectory / file))
    {
        return result;
    }
    const Dictionary dictionary = Dictionary::readFile(caseDirectory / file);
    for (const auto& [name, combination] : readOptions<LoadCases>(dictionary).combinations)
    {
        LoadVectors loads;
        loads.multiplier = combination.multiplier;
        loads.dead = combination.dead(context);
        loads.live = combination.live(context);
        if (loads.live.isZero(0))
        {
            throw FatalIOError(
                "The live load is zero on every block: there is nothing to find the multiplier "
                "of. Give gravity, or a live load of type force.",
                dictionary.subDict("combinations").subDict(name).locationOf("live"));
        }
        result.emplace_back(name, std::move(loads));
    }
    return result;
}

} // namespace drystone
