// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Load vectors.
#include "assembly/Loads.h"

#include "assembly/BlockShape.h"
#include "assembly/CaseFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

template<int Dim>
Eigen::Index freeRows(const std::vector<int>& freeIndex)
{
    return freedomCount<
               Dim> * std::count_if(freeIndex.begin(), freeIndex.end(), [](int index) { return index >= 0; });
}

} // namespace

template<int Dim>
Eigen::VectorXd gravityLoad(const Assembly<Dim>& assembly, const std::vector<double>& masses,
                            const std::type_identity_t<Vector<Dim>>& gravity)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(freeRows<Dim>(freeIndex));
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (freeIndex[i] >= 0)
        {
            load.template segment<Dim>(freedomCount<Dim> * freeIndex[i]) = masses[i] * gravity;
        }
    }
    return load;
}

template<int Dim>
Eigen::VectorXd inertialLoad(const Assembly<Dim>& assembly, const std::vector<double>& masses,
                             const std::type_identity_t<Vector<Dim>>& gravity,
                             const std::type_identity_t<Vector<Dim>>& direction)
{
    return gravityLoad(assembly, masses, gravity.norm() * direction.normalized());
}

template<int Dim>
std::optional<int> findLoadedBlock(const Assembly<Dim>& assembly,
                                   const std::type_identity_t<Vector<Dim>>& point, double tolerance)
{
    std::optional<int> nearest;
    double least = tolerance;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<Dim>& block = assembly.blocks[i];
        if (block.support >= 0
            || !contains<Dim>(enlarged<Dim>(boundingBox(block), tolerance), {point, point}))
        {
            continue;
        }
        // Inside counts as no distance at all, so that among blocks which hold the point the first is taken.
        const double away = distanceFrom(block, point);
        if (away < least || (away <= least && !nearest))
        {
            least = away;
            nearest = static_cast<int>(i);
        }
    }
    return nearest;
}

template<int Dim>
std::vector<int> findLoadedBlocks(const Assembly<Dim>& assembly,
                                  const std::type_identity_t<Vector<Dim>>& point, double tolerance,
                                  double same)
{
    std::vector<std::pair<double, int>> found;
    double least = tolerance;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<Dim>& block = assembly.blocks[i];
        if (block.support < 0
            && contains<Dim>(enlarged<Dim>(boundingBox(block), tolerance + same), {point, point}))
        {
            const double away = distanceFrom(block, point);
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

template<int Dim>
Eigen::VectorXd pointLoad(const Assembly<Dim>& assembly, int block,
                          const std::type_identity_t<Vector<Dim>>& point,
                          const std::type_identity_t<Vector<Dim>>& force)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(freeRows<Dim>(freeIndex));
    const Vector<Dim> arm = point - blockMass(assembly.blocks[block]).centroid;
    load.template segment<freedomCount<Dim>>(freedomCount<Dim> * freeIndex[block]) << force,
        momentOf(arm, force);
    return load;
}

template<int Dim>
std::optional<Eigen::VectorXd>
lineLoad(const Assembly<Dim>& assembly, const std::type_identity_t<Vector<Dim>>& from,
         const std::type_identity_t<Vector<Dim>>& to, const std::type_identity_t<Vector<Dim>>& forcePerLength,
         double tolerance)
{
    // Cut wherever the line may pass from one block to another.
    const Vector<Dim> along = to - from;
    std::vector<double> cuts{0, 1};
    const Box<Dim> reach = enlarged<Dim>({from.cwiseMin(to), from.cwiseMax(to)}, tolerance);
    for (const Block<Dim>& block : assembly.blocks)
    {
        if (block.support < 0 && meet<Dim>(reach, boundingBox(block)))
        {
            for (const double place : placesToCut(block, from, along))
            {
                if (place > 0 && place < 1)
                {
                    cuts.push_back(place);
                }
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
        const Vector<Dim> middle = from + (cuts[i] + cuts[i + 1]) / 2 * along;
        const std::optional<int> block = findLoadedBlock(assembly, middle, tolerance);
        if (!block)
        {
            return std::nullopt;
        }
        const Eigen::VectorXd piece =
            pointLoad(assembly, *block, middle, share * along.norm() * forcePerLength);
        load = load ? Eigen::VectorXd(*load + piece) : piece;
    }
    return load;
}

namespace
{

/// `(0 -1000 0)`, in space `(0 0 -1000)`.
template<int Dim>
std::string downwards(std::string_view size)
{
    return Dim == 2 ? fmt::format("(0 -{} 0)", size) : fmt::format("(0 0 -{})", size);
}

/// `(0.5 1.2)`, as a dictionary has it.
template<int Dim>
std::string asWritten(const Vector<Dim>& point)
{
    return fmt::format("({:.6g})", fmt::join(point.data(), point.data() + Dim, " "));
}

struct GravitySettings
{
};

void declare(Options&, GravitySettings&) {}

template<int Dim>
struct InertialSettings
{
    Vector<Dim> direction = Vector<Dim>::Unit(0);
};

template<int Dim>
void declare(Options& options, InertialSettings<Dim>& settings)
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

template<int Dim>
struct ForceSettings
{
    Vector<Dim> at = Vector<Dim>::Zero();
    Vector<Dim> value = Vector<Dim>::Zero();
    std::optional<int> block;
};

template<int Dim>
void declare(Options& options, ForceSettings<Dim>& settings)
{
    options.required("at", settings.at, "point in or on a free block")
        .unit("m")
        .example(Dim == 2 ? "(0.5 1.2)" : "(0.5 0.1 1.2)");
    options.required("value", settings.value, "force").unit("N").example(downwards<Dim>("1000"));
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
                                 ? fmt::format("A force cannot be (0 0 0). Write for instance `value {};`.",
                                               downwards<Dim>("1000"))
                                 : "";
                  });
}

template<int Dim>
struct LineSettings
{
    Vector<Dim> from = Vector<Dim>::Zero();
    Vector<Dim> to = Vector<Dim>::Zero();
    Vector<Dim> value = Vector<Dim>::Zero();
};

template<int Dim>
void declare(Options& options, LineSettings<Dim>& settings)
{
    options.required("from", settings.from, "start of the line, in or on free blocks")
        .unit("m")
        .example(Dim == 2 ? "(0 1.05)" : "(0 0.1 1.05)");
    options.required("to", settings.to, "its end").unit("m").example(Dim == 2 ? "(2 1.05)" : "(2 0.1 1.05)");
    options.required("value", settings.value, "force per length").unit("N/m").example(downwards<Dim>("1000"));
    options.check("to",
                  [&settings]() -> std::string
                  {
                      return settings.from == settings.to
                                 ? "A line needs two different ends. For a single point write `type force;`."
                                 : "";
                  });
}

template<int Dim>
struct SupportMovementSettings
{
    std::string support;
    Vector<Dim> direction = -Vector<Dim>::Unit(Dim - 1);
};

template<int Dim>
void declare(Options& options, SupportMovementSettings<Dim>& settings)
{
    options.required("support", settings.support, "name of the support that moves").example("right");
    options.required("direction", settings.direction, "of its movement; its length does not matter")
        .example(downwards<Dim>("1"));
    options.check("direction",
                  [&settings]() -> std::string
                  {
                      return settings.direction.isZero(0) ? fmt::format(
                                 "A direction cannot be (0 0 0). Write for instance `direction {};`.",
                                 downwards<Dim>("1"))
                                                          : "";
                  });
}

/// A force may miss the outline by this part of the mean block size: the extrados of an arch of trapezoids,
/// say.
constexpr double reachOfAForce = 0.05;

/// Points of different blocks that are this near are one [m].
template<int Dim>
double widthOfAJoint(const Assembly<Dim>& assembly)
{
    return std::max(1e-6 * meanBlockSize(assembly), assembly.closure.tolerance);
}

template<int Dim>
LoadMaker<Dim> makeForce(const ForceSettings<Dim>& settings, const Dictionary& dictionary)
{
    return [settings, place = dictionary.locationOf("at"),
            blockPlace = dictionary.locationOf("block")](const LoadContext<Dim>& context) -> Eigen::VectorXd
    {
        const double reach = reachOfAForce * meanBlockSize(context.assembly);
        std::vector<int> blocks =
            findLoadedBlocks(context.assembly, settings.at, reach, widthOfAJoint(context.assembly));
        if (settings.block && !blocks.empty())
        {
            if (std::find(blocks.begin(), blocks.end(), *settings.block) == blocks.end())
            {
                throw FatalIOError(fmt::format("The force at {} can not act on block {}: this point is "
                                               "in or on block {}.",
                                               asWritten<Dim>(settings.at), *settings.block,
                                               fmt::join(blocks, " and ")),
                                   blockPlace);
            }
            blocks = {*settings.block};
        }
        if (blocks.size() > 1)
        {
            throw FatalIOError(
                fmt::format(
                    "The force at {} is on the joint of blocks {}, and may act on either: the "
                    "answers differ. Choose one, for instance `block {};`, or move the point by more than "
                    "{:.3g} m.",
                    asWritten<Dim>(settings.at), fmt::join(blocks, " and "), blocks.front(),
                    widthOfAJoint(context.assembly)),
                place);
        }
        if (blocks.empty())
        {
            throw FatalIOError(fmt::format("There is no free block at {}: the force needs one to act on. "
                                           "VTK/assembly.vtp shows where the blocks are.",
                                           asWritten<Dim>(settings.at)),
                               place);
        }
        return pointLoad(context.assembly, blocks.front(), settings.at, settings.value);
    };
}

template<int Dim>
LoadMaker<Dim> makeLine(const LineSettings<Dim>& settings, const Dictionary& dictionary)
{
    return
        [settings, place = dictionary.locationOf("from")](const LoadContext<Dim>& context) -> Eigen::VectorXd
    {
        const double reach = reachOfAForce * meanBlockSize(context.assembly);
        const std::optional<Eigen::VectorXd> load =
            lineLoad(context.assembly, settings.from, settings.to, settings.value, reach);
        if (!load)
        {
            throw FatalIOError(
                fmt::format("The line from {} to {} leaves the free blocks: all of it "
                            "needs one to act on. VTK/assembly.vtp shows where the blocks are.",
                            asWritten<Dim>(settings.from), asWritten<Dim>(settings.to)),
                place);
        }
        return *load;
    };
}

template<int Dim>
std::vector<Model<LoadMaker<Dim>>> singleLoads()
{
    return {
        model<LoadMaker<Dim>, GravitySettings>("gravity", "the weight of the blocks",
                                               [](const GravitySettings&) -> LoadMaker<Dim>
                                               {
                                                   return [](const LoadContext<Dim>& context) {
                                                       return gravityLoad(context.assembly, context.masses,
                                                                          context.gravity);
                                                   };
                                               }),
        model<LoadMaker<Dim>, InertialSettings<Dim>>(
            "inertial", "each block's own weight, turned into a direction",
            [](const InertialSettings<Dim>& settings) -> LoadMaker<Dim>
            {
                return [direction = settings.direction](const LoadContext<Dim>& context)
                { return inertialLoad(context.assembly, context.masses, context.gravity, direction); };
            }),
        model<LoadMaker<Dim>, ForceSettings<Dim>>("force", "a force on the block at a point", makeForce<Dim>),
        model<LoadMaker<Dim>, LineSettings<Dim>>("line", "a force per length on the blocks along a line",
                                                 makeLine<Dim>),
    };
}

template<int Dim>
const Registry<LoadMaker<Dim>>& singleLoadTypes()
{
    static const Registry<LoadMaker<Dim>> registry{"load", singleLoads<Dim>()};
    return registry;
}

template<int Dim>
struct SumSettings
{
    std::vector<Named<LoadMaker<Dim>>> loads;
};

template<int Dim>
void declare(Options& options, SumSettings<Dim>& settings)
{
    options.required("loads", settings.loads, singleLoadTypes<Dim>(),
                     "that act together; each has a name of yours");
}

template<int Dim>
LoadMaker<Dim> makeSum(const SumSettings<Dim>& settings, const Dictionary& dictionary)
{
    if (settings.loads.empty())
    {
        throw FatalIOError("A sum needs loads. Write for instance `loads { weight { type gravity; } }`.",
                           dictionary.locationOf("loads"));
    }
    return [loads = settings.loads](const LoadContext<Dim>& context)
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

template<int Dim>
const Registry<LoadMaker<Dim>>& loadTypes()
{
    static const Registry<LoadMaker<Dim>> registry = []
    {
        Registry<LoadMaker<Dim>> all{"load", singleLoads<Dim>()};
        all.models.push_back(
            model<LoadMaker<Dim>, SumSettings<Dim>>("sum", "several loads that act together", makeSum<Dim>));
        all.models.push_back(model<LoadMaker<Dim>, SupportMovementSettings<Dim>>(
            "supportMovement", "settlement of a support, of limitAnalysis, instead of a live load",
            [](const SupportMovementSettings<Dim>&, const Dictionary& dictionary) -> LoadMaker<Dim>
            {
                return [place = dictionary.locationOf("type")](const LoadContext<Dim>&) -> Eigen::VectorXd
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

template<int Dim>
void declare(Options& options, LoadCombination<Dim>& combination)
{
    options.required("dead", combination.dead, loadTypes<Dim>(), "load that acts in full");
    options.required("live", combination.live, loadTypes<Dim>(), "load that the multiplier alpha makes grow");
    options.optional("multiplier", combination.multiplier, "of the live load that limitAnalysis looks for");
}

template<int Dim>
void declare(Options& options, LoadCases<Dim>& cases)
{
    options.optional("dead", cases.dead, loadTypes<Dim>(),
                     "load that acts in full; required without combinations");
    options.optional("live", cases.live, loadTypes<Dim>(), "load that the multiplier alpha makes grow");
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

/// The movement that a live load of type supportMovement requests.
template<int Dim>
std::optional<SupportMovement<Dim>> readMovement(const Dictionary& loads, const Assembly<Dim>& assembly)
{
    const Entry* live = loads.findExact("live");
    const Entry* type = live ? live->dictionary().find("type") : nullptr;
    if (!type || type->as<std::string>() != "supportMovement")
    {
        return std::nullopt;
    }
    SupportMovementSettings<Dim> settings;
    Options options;
    options.readElsewhere({"type"});
    declare(options, settings);
    options.readFrom(live->dictionary());
    std::vector<std::string> names;
    for (const Support& support : assembly.supports)
    {
        if (support.name == settings.support)
        {
            return SupportMovement<Dim>{static_cast<int>(names.size()), settings.direction.normalized()};
        }
        names.push_back(support.name);
    }
    throw FatalIOError(unknownWordMessage("support", settings.support, names),
                       live->dictionary().locationOf("support"));
}

} // namespace

template<int Dim>
CaseLoads<Dim> readLoads(const std::filesystem::path& caseDirectory, const LoadContext<Dim>& context,
                         LiveLoad liveLoad)
{
    constexpr std::string_view file = "constant/loads";
    if (liveLoad == LiveLoad::optional && !std::filesystem::exists(caseDirectory / file))
    {
        CaseLoads<Dim> weight;
        weight.dead = gravityLoad(context.assembly, context.masses, context.gravity);
        return weight;
    }
    const Dictionary dictionary = readCaseFile(
        caseDirectory, file, "dead { type gravity; } live { type inertial; direction (1 0 0); }");
    const auto cases = readOptions<LoadCases<Dim>>(dictionary);
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
    CaseLoads<Dim> loads;
    loads.locations = EntryLocations(dictionary);
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

template<int Dim>
std::vector<std::pair<std::string, LoadVectors>>
readLoadCombinations(const std::filesystem::path& caseDirectory, const LoadContext<Dim>& context)
{
    constexpr std::string_view file = "constant/loads";
    std::vector<std::pair<std::string, LoadVectors>> result;
    if (!std::filesystem::exists(caseDirectory / file))
    {
        return result;
    }
    const Dictionary dictionary = Dictionary::readFile(caseDirectory / file);
    for (const auto& [name, combination] : readOptions<LoadCases<Dim>>(dictionary).combinations)
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

template Eigen::VectorXd gravityLoad(const Assembly<2>&, const std::vector<double>&, const Vector<2>&);
template Eigen::VectorXd inertialLoad(const Assembly<2>&, const std::vector<double>&, const Vector<2>&,
                                      const Vector<2>&);
template std::optional<int> findLoadedBlock(const Assembly<2>&, const Vector<2>&, double);
template std::vector<int> findLoadedBlocks(const Assembly<2>&, const Vector<2>&, double, double);
template Eigen::VectorXd pointLoad(const Assembly<2>&, int, const Vector<2>&, const Vector<2>&);
template std::optional<Eigen::VectorXd> lineLoad(const Assembly<2>&, const Vector<2>&, const Vector<2>&,
                                                 const Vector<2>&, double);
template const Registry<LoadMaker<2>>& loadTypes();
template void declare(Options&, LoadCombination<2>&);
template void declare(Options&, LoadCases<2>&);
template CaseLoads<2> readLoads(const std::filesystem::path&, const LoadContext<2>&, LiveLoad);
template std::vector<std::pair<std::string, LoadVectors>> readLoadCombinations(const std::filesystem::path&,
                                                                               const LoadContext<2>&);

template Eigen::VectorXd gravityLoad(const Assembly<3>&, const std::vector<double>&, const Vector<3>&);
template Eigen::VectorXd inertialLoad(const Assembly<3>&, const std::vector<double>&, const Vector<3>&,
                                      const Vector<3>&);
template std::optional<int> findLoadedBlock(const Assembly<3>&, const Vector<3>&, double);
template std::vector<int> findLoadedBlocks(const Assembly<3>&, const Vector<3>&, double, double);
template Eigen::VectorXd pointLoad(const Assembly<3>&, int, const Vector<3>&, const Vector<3>&);
template std::optional<Eigen::VectorXd> lineLoad(const Assembly<3>&, const Vector<3>&, const Vector<3>&,
                                                 const Vector<3>&, double);
template const Registry<LoadMaker<3>>& loadTypes();
template void declare(Options&, LoadCombination<3>&);
template void declare(Options&, LoadCases<3>&);
template CaseLoads<3> readLoads(const std::filesystem::path&, const LoadContext<3>&, LiveLoad);
template std::vector<std::pair<std::string, LoadVectors>> readLoadCombinations(const std::filesystem::path&,
                                                                               const LoadContext<3>&);

} // namespace drystone
