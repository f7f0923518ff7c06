// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One section for each type: its keys, how a run measures it and, where there is one, Housner's value.
#include "ensembles/AccuracyQuantity.h"

#include "core/Log.h"
#include "effects/GroundMotion.h"
#include "ensembles/HousnerCase.h"
#include "ensembles/Intensity.h"
#include "quantities/Criterion.h"
#include "statics/SolveCase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

constexpr double notKnown = std::numeric_limits<double>::quiet_NaN();

/// A case that quantities share.
template<int Dim>
using SharedCase = std::shared_ptr<const AccuracyCase<Dim>>;

/// \param make of a case, of the plane or of space, the quantity
template<class Make>
QuantityMaker forBoth(Make make)
{
    return {make, make};
}

/// A figure of the state at the end of a run.
template<int Dim>
Quantity quantityAtTheEnd(InstantFigure<Dim> figure, const SharedCase<Dim>& study)
{
    Quantity quantity;
    quantity.summary = fmt::format("{} at {:g} s", figure.subject, study->endTime);
    quantity.unit = figure.unit;
    quantity.measure = [figure = std::move(figure), study](const RunSetting& setting, const StepPhase& phase)
    {
        double last = notKnown;
        Measurement result = stepThrough(sceneWith(*study, setting), *study, setting, phase,
                                         [&](const Motion<Dim>& motion, double)
                                         {
                                             last = figure.at(study->start, motion);
                                             return true;
                                         });
        result.value = result.end == RunEnd::done ? last : notKnown;
        return result;
    };
    return quantity;
}

std::string ordinal(int number)
{
    const int last = number % 100 / 10 == 1 ? 0 : number % 10;
    return fmt::format("{}{}", number, last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th");
}

// returnTime

struct ReturnTime
{
    int block = 0;
    int count = 1;
    ReferencePlan reference;
};
void declare(Options& options, ReturnTime& settings)
{
    options.required("block", settings.block, "index of the block that rocks").atLeast(0).example("1");
    options.optional("count", settings.count, "how many times it has come back upright")
        .atLeast(1)
        .atMost(1000);
    options.required("reference", settings.reference, referenceTypes(), "what the figure is compared with");
}

/// The time of a return in a run. \param count which one
Measurement measuredReturn(const SharedCase<2>& study, std::size_t block, std::size_t count,
                           const RunSetting& setting, const StepPhase& phase)
{
    ReturnWatch watch(block, 3 * study->scene->free[block] + 2);
    Measurement result = stepThrough(sceneWith(*study, setting), *study, setting, phase,
                                     [&](const Motion<2>& motion, double timeStep)
                                     {
                                         watch.observe(motion, timeStep);
                                         return watch.returns().size() < count;
                                     });
    if (result.end == RunEnd::done && watch.returns().size() < count)
    {
        result.end = RunEnd::missing;
    }
    result.value = result.end == RunEnd::done ? watch.returns()[count - 1] : notKnown;
    return result;
}

/// The same by Housner's equation.
double housnerReturn(const SharedCase<2>& study, std::size_t count)
{
    const HousnerCase housner = housnerCase(*study);
    RockingRun run;
    run.start = housner.start;
    run.endTime = study->endTime;
    run.untilVerdict = false;
    const RockingHistory history = rockingMotion(housner.block, *housnerGround(*study), run);
    if (history.impacts.size() < count)
    {
        throw FatalError(fmt::format("By Housner's equation the block is upright {} times before endTime, "
                                     "not {}: lower `count`, or raise endTime.",
                                     history.impacts.size(), count));
    }
    return history.impacts[count - 1].time;
}

QuantityPlan makeReturnTime(const ReturnTime& settings, const Dictionary& dictionary)
{
    QuantityPlan plan{QuantityKind::motion, settings.reference, {}};
    plan.make.inSpace = [location = dictionary.locationOf("type")](const SharedCase<3>&) -> Quantity
    {
        throw FatalIOError("returnTime is of blocks that rock in the plane. In space take displacement, "
                           "energy or threshold.",
                           location);
    };
    plan.make.inPlane = [settings, location = dictionary.locationOf("block")](const SharedCase<2>& study)
    {
        const std::size_t block = freeBlock(study->scene->assembly, settings.block, location);
        const auto count = static_cast<std::size_t>(settings.count);
        Quantity quantity;
        quantity.summary = fmt::format("time at which block {} is upright again for the {} time",
                                       settings.block, ordinal(settings.count));
        quantity.unit = "s";
        quantity.measure = [study, block, count](const RunSetting& setting, const StepPhase& phase)
        { return measuredReturn(study, block, count, setting, phase); };
        quantity.housner = [study, count] { return housnerReturn(study, count); };
        return quantity;
    };
    return plan;
}

// displacement

struct EndDisplacement
{
    int block = 0;
    std::array<double, 3> direction{1, 0, 0};
    ReferencePlan reference;
};
void declare(Options& options, EndDisplacement& settings)
{
    options.required("block", settings.block, "index of the block").atLeast(0).example("1");
    options.optional("direction", settings.direction,
                     "along which the way of its mass centre counts; its length does not matter");
    options.required("reference", settings.reference, referenceTypes(), "what the figure is compared with");
    options.check("direction",
                  [&settings]
                  {
                      const auto& [x, y, z] = settings.direction;
                      return std::hypot(x, y, z) > 0 ? "" : "The direction has no length.";
                  });
}

QuantityPlan makeDisplacement(const EndDisplacement& settings, const Dictionary& dictionary)
{
    QuantityPlan plan{QuantityKind::motion, settings.reference, {}};
    plan.make = forBoth(
        [settings, location = dictionary.locationOf("block"),
         place = dictionary.locationOf("direction")]<int Dim>(const SharedCase<Dim>& study)
        {
            return quantityAtTheEnd<Dim>(displacementAlong<Dim>(study->scene->assembly, settings.block,
                                                                unitDirection<Dim>(settings.direction, place),
                                                                location),
                                         study);
        });
    return plan;
}

// energy

struct EndEnergy
{
    EnergyPart part = EnergyPart::dissipation;
    ReferencePlan reference;
};
void declare(Options& options, EndEnergy& settings)
{
    options.optional(
        "part", settings.part,
        "mechanical: kinetic and potential; dissipation: friction, impacts, damping and what the "
        "integration loses");
    options.required("reference", settings.reference, referenceTypes(), "what the figure is compared with");
}

QuantityPlan makeEnergy(const EndEnergy& settings)
{
    QuantityPlan plan{QuantityKind::motion, settings.reference, {}};
    plan.make = forBoth([settings]<int Dim>(const SharedCase<Dim>& study)
                        { return quantityAtTheEnd<Dim>(energyOf<Dim>(settings.part), study); });
    return plan;
}

// threshold

struct Threshold
{
    IntensityPlan intensity;
    CriterionMaker criterion;
    ReferencePlan reference;
};
void declare(Options& options, Threshold& settings)
{
    options.required("intensity", settings.intensity, intensityTypes(),
                     "peak accelerations of the ground that are tried, as in incrementalDynamicsDict");
    options.required("criterion", settings.criterion, criterionTypes(),
                     "when a run has gone too far, likewise");
    options.required("reference", settings.reference, referenceTypes(), "what the figure is compared with");
}

/// The least intensity at which a run meets the criterion, by the plan's trials.
template<int Dim>
Measurement measureThreshold(const AccuracyCase<Dim>& study, const RunSetting& setting,
                             const StepPhase& phase, const IntensityPlan& plan,
                             const Criterion<Dim>& criterion, double unit)
{
    DynamicCase<Dim> scene = sceneWith(study, setting);
    GroundMotion ground = groundMotionOf(scene.effects);
    Measurement sum;
    std::vector<Trial> trials;
    for (std::vector<double> next = plan.next(trials); !next.empty(); next = plan.next(trials))
    {
        for (const double intensity : next)
        {
            ground.factor = intensity * unit / peakAcceleration(ground);
            setGroundMotion(scene.effects, ground);
            Verdict verdict = Verdict::stands;
            const Measurement run =
                stepThrough(scene, study, setting, phase,
                            [&](const Motion<Dim>& motion, double)
                            {
                                if (criterion.figure.at(study.start, motion) > criterion.limit)
                                {
                                    verdict = Verdict::meets;
                                }
                                return verdict == Verdict::stands;
                            });
            sum.steps += run.steps;
            sum.cpuTime += run.cpuTime;
            sum.hover = std::max(sum.hover, run.hover);
            sum.worstResidual = std::max(sum.worstResidual, run.worstResidual);
            if (run.end != RunEnd::done)
            {
                sum.end = run.end;
                sum.value = notKnown;
                return sum;
            }
            trials.push_back({intensity, verdict});
        }
    }
    const LeastIntensity least = leastIntensity(trials);
    const bool isFound = least.kind == LeastIntensity::Kind::found;
    sum.end = isFound ? RunEnd::done : RunEnd::missing;
    sum.value = isFound ? (least.value + least.below) / 2 : notKnown; // either may be the one sought
    return sum;
}

QuantityPlan makeThreshold(const Threshold& settings, const Dictionary& dictionary)
{
    QuantityPlan plan{QuantityKind::motion, settings.reference, {}};
    plan.make = forBoth(
        [settings, location = dictionary.location()]<int Dim>(const SharedCase<Dim>& study)
        {
            const DynamicCase<Dim>& scene = *study->scene;
            if (!(peakAcceleration(groundMotionOf(scene.effects)) > 0))
            {
                throw FatalIOError(
                    "The ground does not move, so that there is nothing to make stronger: say in "
                    "constant/groundMotion how it does.",
                    location);
            }
            const double unit = settings.intensity.unit == IntensityUnit::g ? scene.gravity.norm() : 1;
            const Criterion<Dim> criterion = settings.criterion(scene.assembly);
            const IntensityPlan intensity = settings.intensity;
            Quantity quantity;
            quantity.summary =
                "least peak acceleration of the ground at which a run meets: " + criterion.summary;
            quantity.unit = nameOf(intensity.unit);
            quantity.resolution = intensity.interval / 2;
            quantity.measure = [=](const RunSetting& setting, const StepPhase& phase)
            { return measureThreshold<Dim>(*study, setting, phase, intensity, criterion, unit); };
            if constexpr (Dim == 2)
            {
                quantity.housner = [=] { return housnerThreshold(*study, intensity, criterion, unit); };
            }
            return quantity;
        });
    return plan;
}

// multiplier

struct CollapseMultiplier
{
    ReferencePlan reference;
};
void declare(Options& options, CollapseMultiplier& settings)
{
    options.required("reference", settings.reference, referenceTypes(), "what the figure is compared with");
}

template<int Dim>
Measurement measureMultiplier(const AccuracyCase<Dim>& study, const RunSetting& setting)
{
    LimitAnalysisCase<Dim> structure = study.structures.at(jointPointsOf<Dim>(setting));
    structure.solution.solver = SolverType::interiorPoint;
    structure.solution.tolerance = setting.tolerance;
    if (structure.contact.friction)
    {
        structure.contact.friction->flowRule = setting.flowRule;
    }
    structure.contact.contact = ContactModel{setting.formulation};
    Measurement result;
    const double start = cpuTime();
    const LimitAnalysis analysis = solveLimitAnalysis(structure);
    result.cpuTime = cpuTime() - start;
    result.steps = analysis.iterations;
    result.worstResidual = analysis.certificate.worst();
    result.end = analysis.status == CollapseStatus::optimal        ? RunEnd::done
                 : analysis.status == CollapseStatus::notConverged ? RunEnd::unsolved
                                                                   : RunEnd::missing;
    result.value = result.end == RunEnd::done ? analysis.alpha : notKnown;
    return result;
}

QuantityPlan makeMultiplier(const CollapseMultiplier& settings)
{
    QuantityPlan plan{QuantityKind::limitAnalysis, settings.reference, {}};
    plan.make = forBoth(
        []<int Dim>(const SharedCase<Dim>& study)
        {
            Quantity quantity;
            quantity.summary = "collapse load multiplier";
            quantity.unit = "-";
            quantity.measure = [study](const RunSetting& setting, const StepPhase&)
            { return measureMultiplier(*study, setting); };
            return quantity;
        });
    return plan;
}

} // namespace

const Registry<QuantityPlan>& quantityTypes()
{
    static const Registry<QuantityPlan> registry{
        "quantity",
        {model<QuantityPlan, EndDisplacement>("displacement", "how far a block has moved at endTime",
                                              makeDisplacement),
         model<QuantityPlan, EndEnergy>("energy", "a part of the ledger of energy at endTime", makeEnergy),
         model<QuantityPlan, CollapseMultiplier>("multiplier", "the collapse load multiplier",
                                                 makeMultiplier),
         model<QuantityPlan, ReturnTime>("returnTime", "when a block that rocks is upright again",
                                         makeReturnTime),
         model<QuantityPlan, Threshold>("threshold",
                                        "the least intensity of the ground's motion that meets a criterion",
                                        makeThreshold)}};
    return registry;
}

} // namespace drystone
