// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The types of single loads: their keys, and the load vectors that they make.
#include "assembly/LoadTypes.h"
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

template const Registry<LoadMaker<2>>& singleLoadTypes();
template const Registry<LoadMaker<3>>& singleLoadTypes();

} // namespace drystone
