// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registry of function objects, with the settings of each: what `functions` of controlDict can contain.
#include "functionObjects/FunctionList.h"

#include "functionObjects/GroundMotionFunction.h"
#include "functionObjects/MotionPictures.h"
#include "io/MechanismPicture.h"
#include "runControl/Case.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace drystone
{

namespace
{

/// When it writes.
template<int Dim>
void declareTimes(Options& options, FunctionPlan<Dim>& plan)
{
    options.optional("timeStart", plan.timeStart, "time from which it writes").unit("s");
    options.optional("timeEnd", plan.timeEnd, "time until which it writes").unit("s");
    options.check("timeEnd",
                  [&plan]() -> std::string
                  {
                      return plan.timeStart && plan.timeEnd && *plan.timeEnd < *plan.timeStart
                                 ? "It ends before timeStart: nothing would be written."
                                 : "";
                  });
}

/// Keys that every function object takes.
template<int Dim>
void declareCommon(Options& options, FunctionPlan<Dim>& plan)
{
    options.optional("enabled", plan.enabled, "whether the function is carried out");
    declare(options, plan.control);
    declareTimes(options, plan);
    options.optional("writePrecision", plan.writePrecision, "significant digits of its tables")
        .atLeast(1)
        .atMost(17);
    options.optional("pictures", plan.pictures,
                     "also draw its tables over time when the run ends, a picture for each unit");
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
    options.check("blocks",
                  [&settings]
                  {
                      return settings.blocks.all || !settings.blocks.indices.empty()
                                 ? ""
                                 : "There is no block to follow: name some, as (3 7), or all.";
                  });
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

/// Reads the motion of the ground, so that a fault of it is found before the run.
template<int Dim>
FunctionPlan<Dim> planGroundMotion(PlainSettings<Dim> settings)
{
    settings.plan.make = [](FunctionOutput output, const Assembly<Dim>&)
    {
        const Dictionary dictionary = Dictionary::readFile(
            requireCaseFile(output.caseDirectory, "constant/groundMotion",
                            "The function groundMotion of system/controlDict lists it: where the ground does "
                            "not move, leave the function out."));
        GroundMotion motion = readGroundMotion(dictionary, output.caseDirectory, Dim);
        return std::make_unique<GroundMotionFunction<Dim>>(std::move(output), std::move(motion));
    };
    return settings.plan;
}

template<int Dim>
struct MotionPicturesSettings
{
    FunctionPlan<Dim> plan;
    double magnification = 1;
    std::string view;
};

template<int Dim>
void declare(Options& options, MotionPicturesSettings<Dim>& settings)
{
    options
        .optional(
            "times", settings.plan.times,
            "to draw at, each at the nearest step, or with adjustTimeStep exactly; absent: as writeControl "
            "and writeInterval say")
        .unit("s")
        .example("(0.1 0.2)");
    options
        .optional("magnification", settings.magnification,
                  "of displacements and rotations; 1 where a collapse is shown")
        .above(0);
    options
        .optional("view", settings.view,
                  "in space, from where it is seen: front, back, left, right, top, or \"(1 -1.4 0.8)\"")
        .example("front");
    options.optional("enabled", settings.plan.enabled, "whether the function is carried out");
    declare(options, settings.plan.control);
    declareTimes(options, settings.plan);
    options.check("times",
                  [&settings]() -> std::string
                  {
                      const std::vector<double>& times = settings.plan.times;
                      const bool isAscending =
                          std::adjacent_find(times.begin(), times.end(), std::greater_equal<>())
                          == times.end();
                      return isAscending ? "" : "The times must ascend: write them in order, each once.";
                  });
}

template<int Dim>
FunctionPlan<Dim> planMotionPictures(MotionPicturesSettings<Dim> settings, const Dictionary& dictionary)
{
    MotionPictureSettings drawn;
    drawn.magnification = settings.magnification;
    drawn.towardsViewer = usualView();
    if (!settings.view.empty())
    {
        if (Dim == 2)
        {
            throw FatalIOError(
                "view is for structures in space: in the plane there is one view. Leave it out.",
                dictionary.locationOf("view"));
        }
        try
        {
            drawn.towardsViewer = viewFrom(settings.view);
        }
        catch (const FatalError& error)
        {
            throw FatalIOError(error.what(), dictionary.locationOf("view"));
        }
    }
    settings.plan.make = [drawn](FunctionOutput output, const Assembly<Dim>&)
    {
        MotionPictureSettings own = drawn;
        own.title = caseName(output.caseDirectory);
        own.formats = output.pictureFormats;
        return std::make_unique<MotionPicturesFunction<Dim>>(std::move(output), std::move(own));
    };
    return settings.plan;
}

} // namespace

template<int Dim>
const Registry<FunctionPlan<Dim>>& functionTypes()
{
    static const Registry<FunctionPlan<Dim>> registry{
        "function",
        {model<FunctionPlan<Dim>, PlainSettings<Dim>>(
             "energy",
             "the energy ledger and its imbalance; impactLoss is the work of normal forces, by "
             "the associative law negative where sliding opens joints, frictionLoss that of shear "
             "forces, which give back a little where a joint that rocks shears back",
             planPlain<Dim, EnergyFunction<Dim>>),
         model<FunctionPlan<Dim>, BlockMotionSettings<Dim>>(
             "blockMotion", "placement and velocity of some blocks", planBlockMotion<Dim>),
         model<FunctionPlan<Dim>, ContactForcesSettings<Dim>>(
             "contactForces",
             "contact points and reactions of supports, means over the step with the impulses of "
             "impacts, in the directions that joints have at its end, from which those of a support "
             "that turns differ by its turn in a step; what a body loses that stops with theta below 1 is in "
             "no force",
             planContactForces<Dim>),
         model<FunctionPlan<Dim>, PlainSettings<Dim>>("residuals", "convergence of the solver",
                                                      planPlain<Dim, ResidualsFunction<Dim>>),
         model<FunctionPlan<Dim>, PlainSettings<Dim>>("stageTimes",
                                                      "elapsed time that each stage of the steps takes",
                                                      planPlain<Dim, StageTimesFunction<Dim>>),
         model<FunctionPlan<Dim>, PlainSettings<Dim>>(
             "groundMotion", "acceleration of the ground, as constant/groundMotion has it",
             planGroundMotion<Dim>),
         model<FunctionPlan<Dim>, MotionPicturesSettings<Dim>>(
             "motionPictures", "pictures of the displaced blocks at chosen times", planMotionPictures<Dim>)}};
    return registry;
}

template const Registry<FunctionPlan<2>>& functionTypes<2>();
template const Registry<FunctionPlan<3>>& functionTypes<3>();

} // namespace drystone
