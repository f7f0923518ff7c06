// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registry of function objects, with the settings of each: what `functions` of controlDict can contain.
#include "functionObjects/FunctionList.h"

#include <fmt/format.h>

namespace drystone
{

namespace
{

/// Keys that every function object takes.
template<int Dim>
void declareCommon(Options& options, FunctionPlan<Dim>& plan)
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
template<int Dim>
struct PlainSettings
{
    FunctionPlan<Dim> plan;
};

template<int Dim>
void declare(Options& options, PlainSettings<Dim>& settings)
{
    declareCommon(options, settings.plan);
}

template<int Dim, class Function>
FunctionPlan<Dim> planPlain(PlainSettings<Dim> settings)
{
    settings.plan.make = [](FunctionOutput output, const Assembly<Dim>&)
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

template<int Dim>
struct BlockMotionSettings
{
    FunctionPlan<Dim> plan;
    BlockSelection blocks;
};

template<int Dim>
void declare(Options& options, BlockMotionSettings<Dim>& settings)
{
    options.required("blocks", settings.blocks, "indices of the blocks to follow, or all").example("(3 7)");
    declareCommon(options, settings.plan);
}

template<int Dim>
FunctionPlan<Dim> planBlockMotion(BlockMotionSettings<Dim> settings, const Dictionary& dictionary)
{
    const SourceLocation location = dictionary.locationOf("blocks");
    settings.plan.make =
        [selection = settings.blocks, location](FunctionOutput output, const Assembly<Dim>& assembly)
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
        return std::make_unique<BlockMotionFunction<Dim>>(std::move(output), std::move(blocks));
    };
    return settings.plan;
}

template<int Dim>
struct ContactForcesSettings
{
    FunctionPlan<Dim> plan;
    bool points = false;
};

template<int Dim>
void declare(Options& options, ContactForcesSettings<Dim>& settings)
{
    options.optional("points", settings.points, "also list each contact point, in points.dat");
    declareCommon(options, settings.plan);
}

template<int Dim>
FunctionPlan<Dim> planContactForces(ContactForcesSettings<Dim> settings)
{
    const auto table = settings.points ? ContactPointTable::all : ContactPointTable::none;
    settings.plan.make = [table](FunctionOutput output, const Assembly<Dim>&)
    { return std::make_unique<ContactForcesFunction<Dim>>(std::move(output), table); };
    return settings.plan;
}

} // namespace

template<int Dim>
const Registry<FunctionPlan<Dim>>& functionTypes()
{
    static const Registry<FunctionPlan<Dim>> registry{
        "function",
        {model<FunctionPlan<Dim>, PlainSettings<Dim>>("energy", "the energy ledger and its imbalance",
                                                      planPlain<Dim, EnergyFunction<Dim>>),
         model<FunctionPlan<Dim>, BlockMotionSettings<Dim>>(
             "blockMotion", "placement and velocity of some blocks", planBlockMotion<Dim>),
         model<FunctionPlan<Dim>, ContactForcesSettings<Dim>>(
             "contactForces",
             "contact points and reactions of supports, means over the step with the impulses of impacts",
             planContactForces<Dim>),
         model<FunctionPlan<Dim>, PlainSettings<Dim>>("residuals", "convergence of the solver",
                                                      planPlain<Dim, ResidualsFunction<Dim>>),
         model<FunctionPlan<Dim>, PlainSettings<Dim>>("stageTimes",
                                                      "elapsed time that each stage of the steps takes",
                                                      planPlain<Dim, StageTimesFunction<Dim>>)}};
    return registry;
}

template const Registry<FunctionPlan<2>>& functionTypes<2>();
template const Registry<FunctionPlan<3>>& functionTypes<3>();

} // namespace drystone
