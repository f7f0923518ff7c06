// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The types of loads: their keys, and the load vectors that they make.
#include "assembly/LoadTypes.h"

#include "assembly/MovingLoad.h"
#include "assembly/SurfaceLoads.h"
#include "core/Log.h"

#include <algorithm>

namespace drystone
{

namespace
{

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
    options.check("value", [&settings] { return faultOfForce<Dim>(settings.value); });
}

template<int Dim>
struct LineSettings
{
    Vector<Dim> from = Vector<Dim>::Zero();
    Vector<Dim> to = Vector<Dim>::Zero();
    Vector<Dim> value = Vector<Dim>::Zero();
    std::optional<int> block;
};

template<int Dim>
void declare(Options& options, LineSettings<Dim>& settings)
{
    options.required("from", settings.from, "start of the line, in or on free blocks")
        .unit("m")
        .example(Dim == 2 ? "(0 1.05)" : "(0 0.1 1.05)");
    options.required("to", settings.to, "its end").unit("m").example(Dim == 2 ? "(2 1.05)" : "(2 0.1 1.05)");
    options.required("value", settings.value, "force per length").unit("N/m").example(downwards<Dim>("1000"));
    options
        .optional("block", settings.block,
                  "index of the block it acts on where it runs along a joint; required there")
        .atLeast(0)
        .example("12");
    options.check("to",
                  [&settings]() -> std::string
                  {
                      return settings.from == settings.to
                                 ? "A line needs two different ends. For a single point write `type force;`."
                                 : "";
                  });
}

/// A force may miss the outline by this part of the mean block size: the extrados of an arch of trapezoids,
/// say.
constexpr double reachOfAForce = 0.05;

/// Says that a load was taken from outside the blocks, where it is farther than a joint is wide.
template<int Dim>
void reportDistance(const std::string& load, double distance, const Assembly<Dim>& assembly)
{
    if (distance > widthOfAJoint(assembly))
    {
        info("{}, {:.3g} m away.", load, distance);
    }
}

template<int Dim>
LoadMaker<Dim> makeForce(const ForceSettings<Dim>& settings, const Dictionary& dictionary)
{
    return [settings, place = dictionary.locationOf("at"),
            blockPlace = dictionary.locationOf("block")](const LoadContext<Dim>& context) -> Load
    {
        const double reach = reachOfAForce * meanBlockSize(context.assembly);
        const LoadedBlocks loaded = findLoadedBlocks(context.assembly, settings.at, reach);
        std::vector<int> blocks = loaded.blocks;
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
        reportDistance<Dim>(
            fmt::format("The force at {} acts on block {}", asWritten<Dim>(settings.at), blocks.front()),
            loaded.distance, context.assembly);
        return pointLoad(context.assembly, blocks.front(), settings.at, settings.value);
    };
}

/// The block that a piece of a line acts on.
template<int Dim>
int blockUnder(const LinePiece<Dim>& piece, const LineSettings<Dim>& settings, const Assembly<Dim>& assembly,
               const SourceLocation& place)
{
    const std::string line =
        fmt::format("The line from {} to {}", asWritten<Dim>(settings.from), asWritten<Dim>(settings.to));
    const std::vector<int>& blocks = piece.on.blocks;
    if (blocks.empty())
    {
        throw FatalIOError(fmt::format("{} leaves the free blocks at {}: all of it needs one to act on. "
                                       "VTK/assembly.vtp shows where the blocks are.",
                                       line, asWritten<Dim>(piece.middle)),
                           place);
    }
    if (settings.block && std::find(blocks.begin(), blocks.end(), *settings.block) != blocks.end())
    {
        return *settings.block;
    }
    // What is as short as a joint is wide crosses it, and either block is right.
    const double width = widthOfAJoint(assembly);
    if (blocks.size() > 1 && piece.length > 4 * width)
    {
        throw FatalIOError(
            fmt::format(
                "{} runs along the joint of blocks {} at {}, and may act on either: the answers differ. "
                "Choose one, for instance `block {};`, or move the line by more than {:.3g} m. Where it "
                "runs along several joints, give a line for each in a sum.",
                line, fmt::join(blocks, " and "), asWritten<Dim>(piece.middle), blocks.front(), width),
            place);
    }
    return blocks.front();
}

template<int Dim>
LoadMaker<Dim> makeLine(const LineSettings<Dim>& settings, const Dictionary& dictionary)
{
    return [settings, place = dictionary.locationOf("from"),
            blockPlace = dictionary.locationOf("block")](const LoadContext<Dim>& context) -> Load
    {
        const Assembly<Dim>& assembly = context.assembly;
        const double reach = reachOfAForce * meanBlockSize(assembly);
        SumOfLoads<Dim> load(assembly);
        std::vector<int> carrying;
        double farthest = 0; // [m]
        int blockOfFarthest = -1;
        for (const LinePiece<Dim>& piece : piecesOfLine(assembly, settings.from, settings.to, reach))
        {
            const int block = blockUnder(piece, settings, assembly, place);
            load.add(pointLoad(assembly, block, piece.middle, piece.length * settings.value));
            carrying.push_back(block);
            if (piece.on.distance > farthest)
            {
                farthest = piece.on.distance;
                blockOfFarthest = block;
            }
        }
        if (settings.block && std::find(carrying.begin(), carrying.end(), *settings.block) == carrying.end())
        {
            throw FatalIOError(
                fmt::format("The line from {} to {} can not act on block {}: no part of it is in or on it.",
                            asWritten<Dim>(settings.from), asWritten<Dim>(settings.to), *settings.block),
                blockPlace);
        }
        reportDistance<Dim>(fmt::format("The line from {} to {} acts on block {}",
                                        asWritten<Dim>(settings.from), asWritten<Dim>(settings.to),
                                        blockOfFarthest),
                            farthest, assembly);
        return load.sum();
    };
}

template<int Dim>
std::vector<Model<LoadMaker<Dim>>> singleLoads()
{
    std::vector<Model<LoadMaker<Dim>>> types{
        model<LoadMaker<Dim>, GravitySettings>(
            "gravity", "the weight of the blocks",
            [](const GravitySettings&) -> LoadMaker<Dim>
            {
                return [](const LoadContext<Dim>& context)
                { return Load{gravityLoad(context.assembly, context.masses, context.gravity)}; };
            }),
        model<LoadMaker<Dim>, InertialSettings<Dim>>(
            "inertial", "each block's own weight, turned into a direction",
            [](const InertialSettings<Dim>& settings, const Dictionary& dictionary) -> LoadMaker<Dim>
            {
                return [direction = settings.direction,
                        place = dictionary.locationOf("type")](const LoadContext<Dim>& context)
                {
                    if (context.gravity.isZero(0))
                    {
                        printWarningOnce("Gravity (constant/g) is zero, and so is this load: it is each "
                                         "block's own weight.",
                                         place);
                    }
                    return Load{inertialLoad(context.assembly, context.masses, context.gravity, direction)};
                };
            }),
        model<LoadMaker<Dim>, ForceSettings<Dim>>(
            "force", "a force on a block at a point of it, with which it moves; its direction stays",
            makeForce<Dim>),
        model<LoadMaker<Dim>, LineSettings<Dim>>(
            "line",
            "a force per length on the blocks along a line, whose points move with them; its direction stays",
            makeLine<Dim>),
    };
    for (Model<LoadMaker<Dim>>& type : surfaceLoadTypes<Dim>())
    {
        types.push_back(std::move(type));
    }
    return types;
}

} // namespace

template<int Dim>
const Registry<LoadMaker<Dim>>& singleLoadTypes()
{
    static const Registry<LoadMaker<Dim>> registry{"load", singleLoads<Dim>()};
    return registry;
}

namespace
{

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
        SumOfLoads<Dim> sum(context.assembly);
        for (const auto& [name, load] : loads)
        {
            sum.add(load(context));
        }
        return sum.sum();
    };
}

struct CombinedSettings
{
    std::vector<std::pair<double, std::string>> terms;
};

void declare(Options& options, CombinedSettings& settings)
{
    options
        .required("terms", settings.terms, "factor and name of each of `cases` that acts; the others do not")
        .example("((1.35 selfWeight) (1.5 snow))");
}

template<int Dim>
LoadMaker<Dim> makeCombined(const CombinedSettings& settings, const Dictionary& dictionary)
{
    const SourceLocation place = dictionary.locationOf("terms");
    if (settings.terms.empty())
    {
        throw FatalIOError("A combined load needs terms. Write for instance `terms ((1.35 selfWeight));`.",
                           place);
    }
    for (auto term = settings.terms.begin(); term != settings.terms.end(); ++term)
    {
        const auto isSame = [term](const auto& other) { return other.second == term->second; };
        if (std::any_of(settings.terms.begin(), term, isSame))
        {
            printWarningOnce(
                fmt::format("The load case {} is there twice in these terms: its factors add up. "
                            "Usual is one term a case.",
                            term->second),
                place);
        }
    }
    return [terms = settings.terms, place](const LoadContext<Dim>& context) -> Load
    {
        SumOfLoads<Dim> sum(context.assembly);
        for (const auto& [factor, name] : terms)
        {
            std::vector<std::string> names;
            for (const auto& [known, load] : context.cases)
            {
                if (known == name)
                {
                    sum.add(load, factor);
                }
                names.push_back(known);
            }
            if (names.empty())
            {
                throw FatalIOError("A combined load refers to `cases` of constant/loads, and there are none. "
                                   "Write for instance `cases { selfWeight { type gravity; } }`.",
                                   place);
            }
            if (std::find(names.begin(), names.end(), name) == names.end())
            {
                throw FatalIOError(unknownWordMessage("load case", name, names), place);
            }
        }
        return sum.sum();
    };
}

/// What a load may be that is one of several.
template<int Dim>
std::string loadsToCombine()
{
    std::vector<std::string_view> names;
    for (const auto& load : loadTypes<Dim>().models)
    {
        if (load.name != "supportMovement" && load.name != "moving")
        {
            names.push_back(load.name);
        }
    }
    std::sort(names.begin(), names.end());
    return fmt::format("Loads that can stand here: {}.", fmt::join(names, " "));
}

} // namespace

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

template<int Dim>
const Registry<LoadMaker<Dim>>& loadTypes()
{
    static const Registry<LoadMaker<Dim>> registry = []
    {
        Registry<LoadMaker<Dim>> all{"load", singleLoads<Dim>()};
        all.models.push_back(
            model<LoadMaker<Dim>, SumSettings<Dim>>("sum", "several loads that act together", makeSum<Dim>));
        all.models.push_back(model<LoadMaker<Dim>, CombinedSettings>(
            "combined", "loads of `cases`, each times a factor", makeCombined<Dim>));
        all.models.push_back(model<LoadMaker<Dim>, SupportMovementSettings<Dim>>(
            "supportMovement", "settlement of a support, of limitAnalysis, in place of the live load only",
            [](const SupportMovementSettings<Dim>&, const Dictionary& dictionary) -> LoadMaker<Dim>
            {
                return [place = dictionary.locationOf("type")](const LoadContext<Dim>&) -> Load
                {
                    throw FatalIOError(
                        fmt::format("supportMovement can only be the live load, by itself and without "
                                    "combinations: its answer is a reaction in N, which no multiplier "
                                    "compares with. {}",
                                    loadsToCombine<Dim>()),
                        place);
                };
            }));
        all.models.push_back(model<LoadMaker<Dim>, MovingLoadSettings<Dim>>(
            "moving",
            "a load that moves over the structure, of limitAnalysis, as the live load only: a multiplier for "
            "each place",
            [](const MovingLoadSettings<Dim>&, const Dictionary& dictionary) -> LoadMaker<Dim>
            {
                return [place = dictionary.locationOf("type")](const LoadContext<Dim>&) -> Load
                {
                    throw FatalIOError(
                        fmt::format("A moving load can only be the live load, by itself and without "
                                    "combinations. {}",
                                    loadsToCombine<Dim>()),
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
    options
        .optional("cases", cases.cases, singleLoadTypes<Dim>(),
                  "loads by names of yours, which `type combined;` takes with factors; the log states the "
                  "force of each")
        .example("selfWeight");
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

template void declare(Options&, SupportMovementSettings<2>&);
template const Registry<LoadMaker<2>>& singleLoadTypes();
template const Registry<LoadMaker<2>>& loadTypes();
template void declare(Options&, LoadCombination<2>&);
template void declare(Options&, LoadCases<2>&);

template void declare(Options&, SupportMovementSettings<3>&);
template const Registry<LoadMaker<3>>& singleLoadTypes();
template const Registry<LoadMaker<3>>& loadTypes();
template void declare(Options&, LoadCombination<3>&);
template void declare(Options&, LoadCases<3>&);

} // namespace drystone
