// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Measures the figures of accuracyCost in runs of statics and dynamics.
#include "ensembles/AccuracyQuantity.h"

#include "conic/UnitOfWork.h"
#include "core/Log.h"
#include "core/Signals.h"
#include "dynamics/Advance.h"
#include "effects/GroundMotion.h"
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

/// How often a step that is not solved is repeated with half its length.
constexpr int mostHalvings = 10;

constexpr double notKnown = std::numeric_limits<double>::quiet_NaN();

// References

struct HousnerSettings
{
};
void declare(Options&, HousnerSettings&) {}

struct ValueSettings
{
    double value = 0;
    std::string source;
};
void declare(Options& options, ValueSettings& settings)
{
    options.required("value", settings.value, "what the quantity is, in its unit").example("0.0849473");
    options.required("source", settings.source, "where the value comes from; the page says it")
        .example("\"closed form\"");
}

struct FinestSettings
{
    ReferencePlan plan;
};
void declare(Options& options, FinestSettings& settings)
{
    ReferencePlan& plan = settings.plan;
    declareSettings(
        options, plan,
        "step of the finest run; of a motion there are runs with twice and four times this too, from "
        "which the limit is extrapolated; absent, as of all below: the case's own");
    options.optional("phases", plan.phases, "of motion; their median counts").atLeast(1).atMost(1000);
}

// Common to all motions

/// The largest gap at a point that carries force [m]: at least a hundredth of the largest force or load,
/// since solvers that end inside the cones leave small forces, within their tolerance, at points far apart.
template<int Dim>
double hoverOf(const DynamicCase<Dim>& scene, const Motion<Dim>& motion)
{
    constexpr double carriesForce = 1e-2;
    double largestForce = scene.deadLoad.template lpNorm<Eigen::Infinity>(); // about mass centres: no moments
    for (const Vector<Dim>& force : motion.contactForces)
    {
        largestForce = std::max(largestForce, force[0]);
    }
    double hover = 0;
    for (std::size_t point = 0; point < motion.points.size(); ++point)
    {
        if (motion.contactForces[point][0] > carriesForce * largestForce)
        {
            hover = std::max(hover, motion.points[point].gap);
        }
    }
    return hover;
}

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
        const Eigen::Index row = 3 * study->scene->free[block] + 2;
        const auto count = static_cast<std::size_t>(settings.count);
        Quantity quantity;
        quantity.summary = fmt::format("time at which block {} is upright again for the {} time",
                                       settings.block, ordinal(settings.count));
        quantity.unit = "s";
        quantity.measure = [study, block, row, count](const RunSetting& setting, const StepPhase& phase)
        {
            ReturnWatch watch(block, row);
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
        };
        quantity.housner = [study, count]
        {
            const HousnerCase housner = housnerCase(*study);
            RockingRun run;
            run.start = housner.start;
            run.endTime = study->endTime;
            run.untilVerdict = false;
            const RockingHistory history = rockingMotion(housner.block, ConstantAcceleration(0), run);
            if (history.impacts.size() < count)
            {
                throw FatalError(fmt::format(
                    "By Housner's equation the block is upright {} times before endTime, not {}: lower "
                    "`count`, or raise endTime.",
                    history.impacts.size(), count));
            }
            return history.impacts[count - 1].time;
        };
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
            const Vector<Dim> way = Eigen::Map<const Vector<Dim>>(settings.direction.data());
            if (!(way.norm() > 0))
            {
                throw FatalIOError("The direction has no length in the plane.", place);
            }
            return quantityAtTheEnd<Dim>(
                displacementAlong<Dim>(study->scene->assembly, settings.block, way.normalized(), location),
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

/// The motion of the ground along x, times a factor.
class ScaledMotion final : public GroundAcceleration
{
public:
    ScaledMotion(std::shared_ptr<const GroundAcceleration> unscaled, double scale)
        : motion(std::move(unscaled)), factor(scale)
    {
    }
    double at(double time) const override { return factor * motion->at(time); }
    double integral(double from, double to) const override { return factor * motion->integral(from, to); }
    std::vector<double> kinks() const override { return motion->kinks(); }
    double peak() const override { return std::abs(factor) * motion->peak(); }

private:
    std::shared_ptr<const GroundAcceleration> motion;
    double factor;
};

/// By Housner's equation, between the lowest and the highest intensity of the plan.
double housnerThreshold(const AccuracyCase<2>& study, const IntensityPlan& plan,
                        const Criterion<2>& criterion, double unit)
{
    const HousnerCase housner = housnerCase(study);
    const auto components = groundMotionOf(study.scene->effects).components;
    if (components.size() != 1 || std::abs(components.front().direction.y()) > 1e-12)
    {
        throw FatalError("Housner's equation is for a ground that moves along x alone.");
    }
    if (criterion.figure.name != "rotation")
    {
        throw FatalError(
            "By Housner's equation a block overturns: take `criterion { type rotation; limit 1; }`.");
    }
    if (housner.start.rotation != 0 || housner.start.angularVelocity != 0)
    {
        throw FatalError("The threshold by Housner's equation is that of a block at rest: remove 0/motion.");
    }
    const auto& ground = components.front();
    const double perUnit = unit * ground.direction.x() / ground.acceleration->peak();
    const std::vector<double> first = plan.next({});
    const auto [low, high] = std::minmax_element(first.begin(), first.end());
    try
    {
        return overturningThreshold(
            housner.block,
            [&](double intensity)
            { return std::make_unique<ScaledMotion>(ground.acceleration, intensity * perUnit); },
            *low, *high);
    }
    catch (const std::domain_error&)
    {
        throw FatalError(
            fmt::format("By Housner's equation the block stands, or overturns, at both {:g} and {:g}: "
                        "take other bounds of the intensity.",
                        *low, *high));
    }
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

const Registry<ReferencePlan>& referenceTypes()
{
    using Kind = ReferencePlan::Kind;
    static const Registry<ReferencePlan> registry{
        "reference",
        {model<ReferencePlan, FinestSettings>("finest",
                                              "the case's own finest run, extrapolated to steps of no length",
                                              [](const FinestSettings& settings, const Dictionary& dictionary)
                                              {
                                                  ReferencePlan plan = settings.plan;
                                                  plan.kind = Kind::finest;
                                                  plan.location = dictionary.location();
                                                  return plan;
                                              }),
         model<ReferencePlan, HousnerSettings>(
             "Housner",
             "Housner's equation with its impacts, integrated by GSL, of the one block of the case",
             [](const HousnerSettings&, const Dictionary& dictionary)
             {
                 ReferencePlan plan;
                 plan.kind = Kind::Housner;
                 plan.location = dictionary.location();
                 return plan;
             }),
         model<ReferencePlan, ValueSettings>("value", "a closed form, or a published figure",
                                             [](const ValueSettings& settings, const Dictionary& dictionary)
                                             {
                                                 ReferencePlan plan;
                                                 plan.kind = Kind::value;
                                                 plan.value = settings.value;
                                                 plan.source = settings.source;
                                                 plan.location = dictionary.location();
                                                 return plan;
                                             })}};
    return registry;
}

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

HousnerCase housnerCase(const AccuracyCase<2>& study)
{
    const DynamicCase<2>& scene = *study.scene;
    const auto refuse = [](const std::string& reason)
    { throw FatalError("Housner's equation is about another case: " + reason); };
    HousnerCase result;
    int freeBlocks = 0;
    for (std::size_t block = 0; block < scene.assembly.blocks.size(); ++block)
    {
        if (scene.assembly.blocks[block].support < 0)
        {
            ++freeBlocks;
            result.index = static_cast<int>(block);
        }
    }
    if (freeBlocks != 1)
    {
        refuse(fmt::format("it has one free block, and this one has {}.", freeBlocks));
    }
    const Polygon& outline = scene.assembly.blocks[static_cast<std::size_t>(result.index)].outline;
    Vector<2> low = outline.front();
    Vector<2> high = outline.front();
    for (const Vector<2>& corner : outline)
    {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
    }
    const double size = (high - low).maxCoeff();
    for (const Vector<2>& corner : outline)
    {
        if ((corner - low).cwiseAbs().cwiseMin((corner - high).cwiseAbs()).maxCoeff() > 1e-9 * size)
        {
            refuse("its block is an upright rectangle.");
        }
    }
    if (outline.size() != 4)
    {
        refuse("its block is an upright rectangle of four corners.");
    }
    const Vector<2>& gravity = scene.gravity;
    if (!(gravity.y() < 0) || gravity.x() != 0)
    {
        refuse("gravity is along -y.");
    }
    if (scene.contact.restitution || traitsOf(scene.effects).isCompliant
        || traitsOf(scene.effects).actsOnBlocks)
    {
        refuse("impacts are plastic and there is no damping: remove restitution, elasticity and damping.");
    }
    result.block = {high.x() - low.x(), high.y() - low.y(), -gravity.y()};
    result.start = {study.start.time, study.start.placements[static_cast<std::size_t>(result.index)].rotation,
                    study.start.velocity[2]};
    return result;
}

template<int Dim>
DynamicCase<Dim> sceneWith(const AccuracyCase<Dim>& study, const RunSetting& setting)
{
    DynamicCase<Dim> scene = *study.scene;
    scene.schemes.timeIntegration.theta = setting.theta;
    scene.schemes.smallDisplacements = setting.displacements == Displacements::small;
    if (setting.contactOverlap > 0)
    {
        scene.schemes.contactOverlap = setting.contactOverlap;
    }
    scene.schemes.effects.selection = setting.effects;
    scene.solution.solver = setting.solver;
    scene.solution.tolerance = setting.tolerance;
    if (scene.contact.friction)
    {
        scene.contact.friction->flowRule = setting.flowRule;
    }
    return scene;
}

template<int Dim>
Measurement stepThrough(const DynamicCase<Dim>& scene, const AccuracyCase<Dim>& study,
                        const RunSetting& setting, const StepPhase& phase,
                        const std::type_identity_t<MotionObserver<Dim>>& observe)
{
    Measurement result;
    const double begin = cpuTime();
    Motion<Dim> motion = startMotion(scene, study.start);
    bool goesOn = observe(motion, 0);
    double stepLength = phase.firstStep() * setting.deltaT;
    while (goesOn && motion.state.time < study.endTime)
    {
        if (stopSignal() != 0)
        {
            result.end = RunEnd::interrupted;
            break;
        }
        const bool isLast = study.endTime - motion.state.time <= stepLength * (1 + 1e-9);
        const double stepEnd = isLast ? study.endTime : motion.state.time + stepLength;
        // As in contactDynamics, a step that is not solved is divided.
        double part = stepEnd - motion.state.time;
        int halvings = 0;
        while (goesOn && motion.state.time < stepEnd && halvings <= mostHalvings)
        {
            const bool endsStep = stepEnd - motion.state.time <= part * (1 + 1e-9);
            const double timeStep = endsStep ? stepEnd - motion.state.time : part;
            if (!advance(scene, motion, timeStep))
            {
                part = timeStep / 2;
                ++halvings;
                continue;
            }
            if (endsStep)
            {
                motion.state.time = stepEnd; // the sum of the steps may differ from it in the last digit
            }
            ++result.steps;
            result.hover = std::max(result.hover, hoverOf(scene, motion));
            result.worstResidual = std::max({result.worstResidual, motion.residuals.primalResidual,
                                             motion.residuals.dualResidual, motion.residuals.gap});
            goesOn = observe(motion, timeStep);
        }
        if (halvings > mostHalvings)
        {
            result.end = RunEnd::unsolved;
            break;
        }
        stepLength = setting.deltaT;
    }
    result.cpuTime = cpuTime() - begin;
    return result;
}

template<int Dim>
double unitOfWork(const AccuracyCase<Dim>& study, const RunSetting& setting, QuantityKind kind)
{
    if (kind == QuantityKind::limitAnalysis)
    {
        return unitOfWork(study.structures.at(jointPointsOf<Dim>(setting)).program);
    }
    const DynamicCase<Dim>& scene = *study.scene;
    const std::vector<ContactPoint<Dim>> points = findContactPoints(scene.assembly);
    const double mu = scene.contact.friction ? scene.contact.friction->mu : 0;
    return unitOfWork(
        thetaStepProgram(massAt(scene, study.start.placements), Eigen::VectorXd::Zero(scene.mass.size()),
                         scene.deadLoad, points, equilibriumColumns(scene.assembly, scene.blocks, points),
                         std::vector<double>(points.size(), mu), {setting.theta, setting.deltaT}));
}

template Measurement stepThrough(const DynamicCase<2>& scene, const AccuracyCase<2>& study,
                                 const RunSetting& setting, const StepPhase& phase,
                                 const MotionObserver<2>& observe);
template DynamicCase<2> sceneWith(const AccuracyCase<2>& study, const RunSetting& setting);
template double unitOfWork(const AccuracyCase<2>& study, const RunSetting& setting, QuantityKind kind);
template Measurement stepThrough(const DynamicCase<3>& scene, const AccuracyCase<3>& study,
                                 const RunSetting& setting, const StepPhase& phase,
                                 const MotionObserver<3>& observe);
template DynamicCase<3> sceneWith(const AccuracyCase<3>& study, const RunSetting& setting);
template double unitOfWork(const AccuracyCase<3>& study, const RunSetting& setting, QuantityKind kind);

} // namespace drystone
