// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registry of function objects, with the settings of each: what `functions` of controlDict can contain.
#include "functionObjects/FunctionList.h"

#include <fmt/format.h>

namespace drystone
{

namespace
{

/// Keys that every function object takes.
void declareCommon(Options& options, FunctionPlan<2>& plan)
{
    options.optional("enabled", plan.enabled, "whether the function is carried out");
    declare(options, plan.control);
    options.optional("timeStart", plan.timeStart, "time from which it writes").unit("s");
    options.optional("timeEnd", plan.timeEnd, "time until which it writes").unit("s");
    options.optional("writePrecision", plan.writePrecision, "significant digits of its tables")
        .atLeast(1)
        .atMost(17);
}

/// Settings of a function without keys of its own.
struct PlainSettings
{
    FunctionPlan<2> plan;
};

void declare(Options& options, PlainSettings& settings)
{
    declareCommon(options, settings.plan);
}

template<class Function>
FunctionPlan<2> planPlain(PlainSettings settings)
{
    settings.plan.make = [](FunctionOutput output, const Assembly<2>&)
    { return std::make_unique<Function>(std::move(output)); };
    return settings.plan;
}

/// `blocks (3 7);` or `blocks all;`
struct BlockSelection
{
    bool all = false;
    std::vector<int> indices;
};

void read(TokenCursor& cursor, BlockSelection& selection)
{
    if (!cursor.atEnd() && cursor.peek().kind == TokenKind::word && cursor.peek().text == "all")
    {
        cursor.take();
        selection.all = true;
        return;
    }
    drystone::read(cursor, selection.indices);
}

struct BlockMotionSettings
{
    FunctionPlan<2> plan;
    BlockSelection blocks;
};

void declare(Options& options, BlockMotionSettings& settings)
{
    options.required("blocks", settings.blocks, "indices of the blocks to follow, or all").example("(3 7)");
    declareCommon(options, settings.plan);
}

FunctionPlan<2> planBlockMotion(BlockMotionSettings settings, const Dictionary& dictionary)
{
    const SourceLocation location = dictionary.locationOf("blocks");
    settings.plan.make =
        [selection = settings.blocks, location](FunctionOutput output, const Assembly<2>& assembly)
    {
        const int count = static_cast<int>(assembly.blocks.size());
        std::vector<int> blocks = selection.indices;
        for (int block = 0; selection.all && block < count; ++block)
        {
            blocks.push_back(block);
        }
        for (const int block : blocks)
        {
            if (block < 0 || block >= count)
            {
                throw FatalIOError(
                    fmt::format("There is no block {}: the assembly has blocks 0 to {}.", block, count - 1),
                    location);
            }
        }
        return std::make_unique<BlockMotionFunction<2>>(std::move(output), std::move(blocks));
    };
    return settings.plan;
}

struct ContactForcesSettings
{
    FunctionPlan<2> plan;
    bool points = false;
};

void declare(Options& options, ContactForcesSettings& settings)
{
    options.optional("points", settings.points, "also list each contact point, in points.dat");
    declareCommon(options, settings.plan);
}

FunctionPlan<2> planContactForces(ContactForcesSettings settings)
{
    const auto table = settings.points ? ContactPointTable::all : ContactPointTable::none;
    settings.plan.make = [table](FunctionOutput output, const Assembly<2>&)
    { return std::make_unique<ContactForcesFunction<2>>(std::move(output), table); };
    return settings.plan;
}

} // namespace

const Registry<FunctionPlan<2>>& functionTypes()
{
    static const Registry<FunctionPlan<2>> registry{
        "function",
        {model<FunctionPlan<2>, PlainSettings>("energy", "the energy ledger and its imbalance",
                                               planPlain<EnergyFunction<2>>),
         model<FunctionPlan<2>, BlockMotionSettings>("blockMotion", "placement and velocity of some blocks",
                                                     planBlockMotion),
         model<FunctionPlan<2>, ContactForcesSettings>(
             "contactForces",
             "contact points and reactions of supports, means over the step with the impulses of impacts",
             planContactForces),
         model<FunctionPlan<2>, PlainSettings>("residuals", "convergence of the solver",
                                               planPlain<ResidualsFunction<2>>),
         model<FunctionPlan<2>, PlainSettings>("stageTimes",
                                               "elapsed time that each stage of the steps takes",
                                               planPlain<StageTimesFunction<2>>)}};
    return registry;
}

} // namespace drystone
