// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads, runs and records a study in its case directory.
#include "ensembles/AccuracyCostCase.h"

#include "core/Log.h"
#include "core/Signals.h"
#include "core/WholeFile.h"
#include "ensembles/AccuracyPage.h"
#include "ensembles/CaseRuns.h"
#include "functionObjects/ColumnFile.h"
#include "functionObjects/MotionResults.h"
#include "runControl/Case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* applicationName = "accuracyCost";

/// Whether a key asks for something: an empty list or the default, as etc/annotated has them, does not.
bool asksFor(const Dictionary& dictionary, const std::string& key)
{
    if (!dictionary.found(key))
    {
        return false;
    }
    const std::string value = dictionary.lookupPath(key).valueText();
    return value != "()" && !(key == "repeats" && value == std::to_string(Sweep().repeats))
           && !(key == "phases" && value == std::to_string(Sweep().phases));
}

/// Rejects keys without meaning for a quantity.
template<int Dim>
void rejectKeys(const Dictionary& dictionary, QuantityKind kind)
{
    const std::string ofOthers = Dim == 2 ? "pointsPerSide" : "pointsPerJoint";
    if (asksFor(dictionary, ofOthers))
    {
        throw FatalIOError(Dim == 2 ? "pointsPerSide is for structures in space: write pointsPerJoint."
                                    : "pointsPerJoint divides joints of the plane: write pointsPerSide, of "
                                      "which a rectangular joint has the square.",
                           dictionary.locationOf(ofOthers));
    }
    const std::vector<std::string> meaningless =
        kind == QuantityKind::motion
            ? std::vector<std::string>{"pointsPerJoint", "pointsPerSide", "formulation", "repeats"}
            : std::vector<std::string>{"deltaT", "theta", "solver", "displacements", "phases"};
    for (const std::string& key : meaningless)
    {
        if (asksFor(dictionary, key))
        {
            throw FatalIOError(
                kind == QuantityKind::motion
                    ? fmt::format("{} is for multipliers, and this quantity is one of a motion: remove it.",
                                  key)
                    : fmt::format("{} is for motions, and this quantity is a multiplier: remove it.", key),
                dictionary.locationOf(key));
        }
    }
}

/// Rejects settings that the case cannot be computed with.
template<int Dim>
void requirePossible(const AccuracyCase<Dim>& study, QuantityKind kind, const RunSetting& setting,
                     const Dictionary& dictionary)
{
    if (kind == QuantityKind::limitAnalysis)
    {
        const LimitAnalysisCase<Dim>& structure = study.structures.at(jointPointsOf<Dim>(setting));
        if (setting.flowRule == FlowRule::nonAssociative
            && (structure.program.hasStrength() || structure.movement))
        {
            throw FatalIOError("limitAnalysis follows the non-associative flow rule with friction alone: "
                               "remove nonAssociative.",
                               dictionary.locationOf("flowRule"));
        }
        if (Dim == 3 && setting.formulation == ContactFormulation::surface)
        {
            throw FatalIOError("Contact by surfaces is for joints of the plane: remove surface.",
                               dictionary.locationOf("formulation"));
        }
        const bool hasPoints = setting.pointsPerJoint > 0 || structure.contact.pointsPerJoint;
        if (setting.formulation == ContactFormulation::surface
            && (setting.flowRule == FlowRule::nonAssociative || structure.program.hasStrength()
                || structure.movement || hasPoints))
        {
            throw FatalIOError("Contact by surfaces is for the associative flow rule and for joints with "
                               "friction alone under a live load, and has no points: remove surface.",
                               dictionary.locationOf("formulation"));
        }
        return;
    }
    const DynamicCase<Dim>& scene = *study.scene;
    if (setting.flowRule == FlowRule::nonAssociative && !scene.contact.friction)
    {
        throw FatalIOError("The case has no friction, so that there is no flow rule to choose: remove it.",
                           dictionary.locationOf("flowRule"));
    }
    if (traitsOf(scene.effects).isCompliant && setting.theta < 1)
    {
        throw FatalIOError("Elastic contact points are integrated with theta 1 only.",
                           dictionary.locationOf("theta"));
    }
    if (traitsOf(scene.effects).isCompliant
        && (setting.solver == SolverType::interiorPoint || setting.solver == SolverType::augmentedLagrangian))
    {
        throw FatalIOError("Elastic contact points are solved with automatic or gaussSeidel only.",
                           dictionary.locationOf("solver"));
    }
}

/// The setting that a reference run is made with, its step and tolerance the finest.
RunSetting finestSetting(const ReferencePlan& plan, RunSetting setting)
{
    forEachKey([](auto& value, const auto& wanted) { value = wanted.value_or(value); }, setting, plan);
    return setting;
}

/// Everything that the rows of a history depend on: the case, the quantities without their references, the
/// machine.
std::string historyHeading(const fs::path& caseDirectory, const Dictionary& dictionary)
{
    std::uint64_t ofCase = 0;
    for (const char* folder : {"0", "constant", "system"})
    {
        if (fs::is_directory(caseDirectory / folder))
        {
            ofCase = ofCase * 31 + fingerprint(caseDirectory / folder, "accuracyCostDict");
        }
    }
    std::string quantities;
    for (const Entry& quantity : dictionary.subDict("quantities").entries())
    {
        if (quantity.isDictionary())
        {
            quantities += quantity.keyword();
            for (const Entry& entry : quantity.dictionary().entries())
            {
                quantities += entry.keyword() == "reference" ? "" : toText(entry);
            }
        }
    }
    return fmt::format(
        "# case {:016x} quantities {:016x} on {}\n"
        "# quantity[-] deltaT[s] theta[-] flowRule[-] solver[-] tolerance[-] pointsPerJoint[-] "
        "pointsPerSide[-] displacements[-] formulation[-] phase[-] phases[-] value hover[m] steps[-] "
        "cpuTime[s] residual[-] "
        "end[-]\n",
        ofCase, fingerprint(quantities), processorName());
}
constexpr std::size_t historyNumbers = 18;

/// When the first runs of a setting are not solved, this many of them, the others are not tried: a solver
/// that fails takes a long time to do so.
constexpr int runsUntilGivenUp = 3;

/// Runs of one setting.
struct RunPlan
{
    std::size_t quantity = 0;
    RunSetting setting;
    int runs = 1;

    RunKey key(int index) const { return {quantity, setting, {index, runs}}; }
};

RunPlan planOf(const AccuracyStudy& study, std::size_t quantity, const RunSetting& setting, int phases,
               int repeats)
{
    return {quantity, setting, study.quantities[quantity].kind == QuantityKind::motion ? phases : repeats};
}

/// The runs of a reference: of a motion with four times, twice and once the step.
std::vector<RunPlan> referencePlans(const AccuracyStudy& study, std::size_t index)
{
    const StudyQuantity& quantity = study.quantities[index];
    std::vector<RunPlan> plans;
    if (quantity.reference.kind == ReferencePlan::Kind::finest)
    {
        const RunSetting finest = finestSetting(quantity.reference, quantity.ofCase);
        for (const double factor : {4.0, 2.0, 1.0})
        {
            RunSetting setting = finest;
            setting.deltaT *= factor;
            if (quantity.kind == QuantityKind::motion || factor == 1)
            {
                plans.push_back(planOf(study, index, setting, quantity.reference.phases, 1));
            }
        }
    }
    return plans;
}

std::vector<RunPlan> sweepPlans(const AccuracyStudy& study, std::size_t index)
{
    const Sweep& sweep = study.sweeps[index].second;
    const std::size_t quantity = study.quantityOfSweep[index];
    std::vector<RunPlan> plans;
    for (const RunSetting& setting : settingsOf(sweep, study.quantities[quantity].ofCase))
    {
        plans.push_back(planOf(study, quantity, setting, sweep.phases, sweep.repeats));
    }
    return plans;
}

/// Approximate work of a plan, in steps of a motion; limit analyses count as some tens.
double workOf(const AccuracyStudy& study, const RunPlan& plan)
{
    return plan.runs * (plan.setting.deltaT > 0 ? study.duration / plan.setting.deltaT : 30);
}

/// Carries out runs, shows their progress, and keeps them.
class Worker
{
public:
    Worker(const AccuracyStudy& accuracyStudy, AccuracyRuns& knownRuns)
        : study(accuracyStudy), runs(knownRuns)
    {
        for (std::size_t quantity = 0; quantity < study.quantities.size(); ++quantity)
        {
            count(referencePlans(study, quantity));
        }
        for (std::size_t sweep = 0; sweep < study.sweeps.size(); ++sweep)
        {
            count(sweepPlans(study, sweep));
        }
    }

    /// The runs of a plan; nothing when a signal has come.
    std::optional<std::vector<Measurement>> carryOut(const RunPlan& plan)
    {
        std::vector<Measurement> made;
        bool isNew = false;
        for (int index = 0; index < plan.runs; ++index)
        {
            if (index == runsUntilGivenUp && isUnsolved(made))
            {
                done += isNew ? workOf(study, plan) * (plan.runs - index) / plan.runs : 0;
                break;
            }
            const RunKey key = plan.key(index);
            const Measurement* known = runs.find(key);
            if (known)
            {
                made.push_back(*known);
                continue;
            }
            if (stopSignal() != 0)
            {
                runs.write();
                return {};
            }
            const StudyQuantity& quantity = study.quantities[plan.quantity];
            const double start = clockTime();
            const Measurement run = quantity.quantity.measure(plan.setting, key.phase);
            if (run.end == RunEnd::interrupted)
            {
                runs.write();
                return {};
            }
            isNew = true;
            runs.add(key, run);
            made.push_back(run);
            done += workOf(study, plan) / plan.runs;
            spent += clockTime() - start;
            progress.update(work > 0 ? done / work : 1, quantity.name);
        }
        if (isNew)
        {
            runs.write();
        }
        return made;
    }

    /// `12 s left`
    std::string timeLeft() const
    {
        return done > 0 ? durationText(spent * std::max(work - done, 0.0) / done) + " left" : "known";
    }

private:
    static bool isUnsolved(const std::vector<Measurement>& made)
    {
        return std::all_of(made.begin(), made.end(),
                           [](const Measurement& run) { return run.end == RunEnd::unsolved; });
    }

    /// Counts what is to be done, once.
    void count(const std::vector<RunPlan>& plans)
    {
        for (const RunPlan& plan : plans)
        {
            for (int index = 0; index < plan.runs; ++index)
            {
                if (!runs.find(plan.key(index)) && counted.insert(plan.key(index)).second)
                {
                    work += workOf(study, plan) / plan.runs;
                }
            }
        }
    }

    const AccuracyStudy& study;
    AccuracyRuns& runs;
    std::set<RunKey> counted;
    Progress progress;
    double work = 0; ///< to be done by this call
    double done = 0;
    double spent = 0; ///< [s]
};

/// The reference of a quantity; nothing when a signal has come.
std::optional<Reference> referenceOf(const AccuracyStudy& study, std::size_t index, Worker& worker)
{
    const StudyQuantity& quantity = study.quantities[index];
    const ReferencePlan& plan = quantity.reference;
    Reference reference;
    if (plan.kind == ReferencePlan::Kind::value)
    {
        reference = {plan.value, 0, plan.source};
    }
    else if (plan.kind == ReferencePlan::Kind::Housner)
    {
        reference = {quantity.housner, 0,
                     "Housner's equation (1963) with its impacts, integrated between events by GSL's "
                     "adaptive method of Prince and Dormand of order 8 to about 1e-12"};
    }
    else
    {
        std::vector<AccuracyPoint> points;
        for (const RunPlan& runs : referencePlans(study, index))
        {
            const auto done = worker.carryOut(runs);
            if (!done)
            {
                return {};
            }
            points.push_back(summarise(runs.setting, *done, 1, done->size()));
            if (!points.back().isWhole())
            {
                throw FatalIOError(fmt::format("The finest run that {} is compared with fails: {} of {} runs "
                                               "({}) were not solved, or "
                                               "did not have the figure before endTime.",
                                               quantity.name, points.back().failed, points.back().runs,
                                               settingText(runs.setting, quantity.kind)),
                                   plan.location, 2);
            }
        }
        const AccuracyPoint& finest = points.back();
        const std::string with = settingText(finest.setting, quantity.kind);
        if (quantity.kind == QuantityKind::motion)
        {
            const Extrapolation limit = extrapolate(points[0].value, points[1].value, points[2].value);
            reference = {
                limit.value, limit.uncertainty,
                limit.order > 0
                    ? fmt::format("Richardson's extrapolation of the case's own finest runs ({}, and twice "
                                  "and four times this step; medians of {} phases), which converge with "
                                  "order {:.2f}",
                                  with, finest.runs, limit.order)
                    : fmt::format("the case's own finest run ({}; median of {} phases); with twice and four "
                                  "times this step it shows no order to extrapolate with",
                                  with, finest.runs)};
        }
        else
        {
            reference = {finest.value, finest.setting.tolerance * std::abs(finest.value),
                         fmt::format("the case's own finest run ({})", with)};
        }
    }
    if (reference.value == 0 || !std::isfinite(reference.value))
    {
        throw FatalIOError(
            fmt::format("The reference of {} is {}: there is no error relative to it. Choose a quantity "
                        "that is not zero.",
                        quantity.name, reference.value),
            plan.location);
    }
    return reference;
}

/// By Housner's equation. \throws FatalIOError when it is about another case
double housnerValue(const Quantity& quantity, const SourceLocation& location)
{
    if (!quantity.housner)
    {
        throw FatalIOError("Housner's equation does not give this quantity: use `finest` or `value`.",
                           location);
    }
    try
    {
        return quantity.housner();
    }
    catch (const FatalError& error)
    {
        throw FatalIOError(error.what(), location);
    }
}

} // namespace

std::string processorName()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
    {
        const auto colon = line.find(": ");
        if (line.starts_with("model name") && colon != line.npos)
        {
            return line.substr(colon + 2);
        }
    }
    return "an unknown processor";
}

fs::path accuracyFolder(const fs::path& caseDirectory)
{
    return postProcessingFolder(caseDirectory, applicationName, "0");
}

template<int Dim>
AccuracyStudy readAccuracyStudy(const fs::path& caseDirectory)
{
    const Dictionary dictionary =
        Dictionary::readFile(requireCaseFile(caseDirectory, "system/accuracyCostDict",
                                             "It specifies what to measure and over which settings; "
                                             "etc/annotated/system/accuracyCostDict is one to copy."));
    const auto settings = readOptions<AccuracySettings>(dictionary);
    const Dictionary& sweeps = dictionary.subDict("sweeps");
    const Dictionary& quantities = dictionary.subDict("quantities");

    AccuracyStudy study;
    study.sweeps = settings.sweeps;
    study.caseDirectory = caseDirectory;
    const auto shared = std::make_shared<AccuracyCase<Dim>>();
    AccuracyCase<Dim>& ofCase = *shared;
    const auto ofKind = [&](QuantityKind kind)
    {
        return std::any_of(settings.quantities.begin(), settings.quantities.end(),
                           [kind](const auto& quantity) { return quantity.second.kind == kind; });
    };
    RunSetting ofMotion;
    if (ofKind(QuantityKind::motion))
    {
        Time time(caseDirectory, ControlDict::required);
        ofCase.scene = readDynamicCase<Dim>(caseDirectory);
        ofCase.start = startOrContinue(caseDirectory, *ofCase.scene, time).state;
        ofCase.endTime = time.controls().endTime;
        study.duration = ofCase.endTime - ofCase.start.time;
        const DynamicCase<Dim>& scene = *ofCase.scene;
        ofMotion = {time.controls().deltaT,
                    scene.schemes.timeIntegration.theta,
                    scene.flowRule(),
                    scene.solution.solver,
                    scene.solution.tolerance,
                    0,
                    0,
                    scene.schemes.smallDisplacements ? Displacements::small : Displacements::large};
        if (!(study.duration > 0))
        {
            throw FatalIOError("The motions of the study end where they begin: raise endTime.",
                               time.controlDict().locationOf("endTime"));
        }
    }
    RunSetting ofCollapse;
    const auto structureWith = [&](const RunSetting& setting)
    {
        const int points = jointPointsOf<Dim>(setting);
        if (!ofCase.structures.contains(points))
        {
            ofCase.structures.emplace(
                points,
                readLimitAnalysisCase<Dim>(caseDirectory, points > 0 ? std::optional(points) : std::nullopt));
        }
    };
    if (ofKind(QuantityKind::limitAnalysis))
    {
        structureWith({});
        const LimitAnalysisCase<Dim>& structure = ofCase.structures.at(0);
        ofCollapse.flowRule =
            structure.contact.friction ? structure.contact.friction->flowRule : FlowRule::associative;
        ofCollapse.solver = SolverType::interiorPoint;
        ofCollapse.tolerance = structure.solution.tolerance;
        ofCollapse.formulation =
            structure.contact.contact ? structure.contact.contact->formulation : ContactFormulation::points;
    }

    for (const auto& [name, plan] : settings.quantities)
    {
        const bool isMotion = plan.kind == QuantityKind::motion;
        const RunSetting& own = isMotion ? ofMotion : ofCollapse;
        study.quantities.push_back(
            {name, plan.kind, plan.make(shared), plan.reference, own,
             [shared, own, kind = plan.kind] { return unitOfWork(*shared, own, kind); }, 0});
        const Dictionary& reference = quantities.subDict(name).subDict("reference");
        if (plan.reference.kind == ReferencePlan::Kind::Housner)
        {
            StudyQuantity& quantity = study.quantities.back();
            quantity.housner = housnerValue(quantity.quantity, reference.locationOf("type"));
        }
        if (plan.reference.kind == ReferencePlan::Kind::finest)
        {
            rejectKeys<Dim>(reference, plan.kind);
            const RunSetting finest = finestSetting(plan.reference, study.quantities.back().ofCase);
            if (!isMotion)
            {
                structureWith(finest);
            }
            requirePossible(ofCase, plan.kind, finest, reference);
        }
    }
    for (const auto& [name, sweep] : settings.sweeps)
    {
        const Dictionary& own = sweeps.subDict(name);
        const std::string& wanted = sweep.quantity;
        const auto quantity = std::find_if(study.quantities.begin(), study.quantities.end(),
                                           [&](const auto& known) { return known.name == wanted; });
        if (quantity == study.quantities.end())
        {
            std::vector<std::string> names;
            for (const StudyQuantity& known : study.quantities)
            {
                names.push_back(known.name);
            }
            throw FatalIOError(unknownWordMessage("quantity", sweep.quantity, names),
                               own.locationOf("quantity"));
        }
        study.quantityOfSweep.push_back(static_cast<std::size_t>(quantity - study.quantities.begin()));
        rejectKeys<Dim>(own, quantity->kind);
        if (sweep.along && *sweep.along != SweepAxis::tolerance
            && (*sweep.along == SweepAxis::deltaT) != (quantity->kind == QuantityKind::motion))
        {
            throw FatalIOError(
                quantity->kind == QuantityKind::motion
                    ? "Contact points are for multipliers: let this sweep go along deltaT or tolerance."
                    : "deltaT is for motions: let this sweep go along tolerance, pointsPerJoint or "
                      "pointsPerSide.",
                own.locationOf("along"));
        }
        for (const RunSetting& setting : settingsOf(sweep, quantity->ofCase))
        {
            if (quantity->kind == QuantityKind::limitAnalysis)
            {
                structureWith(setting);
            }
            requirePossible(ofCase, quantity->kind, setting, own);
        }
    }
    study.heading = historyHeading(caseDirectory, dictionary);
    return study;
}

template AccuracyStudy readAccuracyStudy<2>(const fs::path& caseDirectory);
template AccuracyStudy readAccuracyStudy<3>(const fs::path& caseDirectory);

void printAccuracyStudy(const AccuracyStudy& study)
{
    for (const StudyQuantity& quantity : study.quantities)
    {
        info("Quantity {}: {} [{}]", quantity.name, quantity.quantity.summary, quantity.quantity.unit);
    }
    for (std::size_t index = 0; index < study.sweeps.size(); ++index)
    {
        const std::vector<RunPlan> plans = sweepPlans(study, index);
        int runs = 0;
        for (const RunPlan& plan : plans)
        {
            runs += plan.runs;
        }
        info("Sweep {}: {} over {} settings, {} runs", study.sweeps[index].first,
             study.quantities[study.quantityOfSweep[index]].name, plans.size(), runs);
    }
    printLine();
}

AccuracyRuns::AccuracyRuns(const AccuracyStudy& accuracyStudy)
    : study(accuracyStudy), file(accuracyFolder(study.caseDirectory) / "history.dat")
{
    for (const std::vector<double>& row : readHistory(file, study.heading, historyNumbers, applicationName))
    {
        const auto whole = [&row](std::size_t column) { return static_cast<int>(row[column]); };
        RunKey key{static_cast<std::size_t>(row[0]),
                   {row[1], row[2], FlowRule{whole(3)}, SolverType{whole(4)}, row[5], whole(6), whole(7),
                    Displacements{whole(8)}, ContactFormulation{whole(9)}},
                   {whole(10), whole(11)}};
        add(key, {row[12], row[13], row[14], row[15], row[16], RunEnd{whole(17)}});
    }
    if (size() > 0)
    {
        info("Continuing: {} runs are known from postProcessing/accuracyCost/0/history.dat", size());
    }
}

const Measurement* AccuracyRuns::find(const RunKey& key) const
{
    const auto found = runs.find(key);
    return found == runs.end() ? nullptr : &found->second;
}

void AccuracyRuns::add(const RunKey& key, const Measurement& run)
{
    if (runs.emplace(key, run).second)
    {
        order.push_back(key);
    }
}

void AccuracyRuns::write() const
{
    std::string text = study.heading;
    for (const RunKey& key : order)
    {
        const RunSetting& setting = key.setting;
        const Measurement& run = runs.at(key);
        // The fewest digits that read back as the same number.
        text += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", key.quantity,
                            setting.deltaT, setting.theta, int(setting.flowRule), int(setting.solver),
                            setting.tolerance, setting.pointsPerJoint, setting.pointsPerSide,
                            int(setting.displacements), int(setting.formulation), key.phase.index,
                            key.phase.count, run.value, run.hover, run.steps, run.cpuTime, run.worstResidual,
                            int(run.end));
    }
    writeWholeFile(file, text);
}

AccuracyResults carryOut(const AccuracyStudy& study, AccuracyRuns& runs)
{
    AccuracyResults results;
    Worker worker(study, runs);
    const auto interrupted = [&results]
    {
        results.isInterrupted = true;
        return results;
    };
    for (std::size_t index = 0; index < study.quantities.size(); ++index)
    {
        const StudyQuantity& quantity = study.quantities[index];
        const auto reference = referenceOf(study, index, worker);
        if (!reference)
        {
            return interrupted();
        }
        results.references.push_back(*reference);
        results.unitsOfWork.push_back(quantity.unitOfWork());
        info("Reference of {}: {:.9g}{}{}: {}", quantity.name, reference->value,
             quantity.quantity.unit == "-" ? "" : " " + quantity.quantity.unit,
             reference->uncertainty > 0 ? fmt::format(" +- {:.2g}", reference->uncertainty) : "",
             reference->text);
        info("One assembly, factorisation and solve: F = {:.3g} s", results.unitsOfWork.back());
        printLine();
    }
    for (std::size_t index = 0; index < study.sweeps.size(); ++index)
    {
        const auto& [name, sweep] = study.sweeps[index];
        const std::size_t quantity = study.quantityOfSweep[index];
        SweepResult result{name, quantity, axisOf(sweep, study.quantities[quantity].kind), {}};
        info("Sweep {}", name);
        const std::vector<RunPlan> plans = sweepPlans(study, index);
        std::vector<RunSetting> settings;
        for (const RunPlan& plan : plans)
        {
            settings.push_back(plan.setting);
        }
        for (std::size_t number = 0; number < plans.size(); ++number)
        {
            const auto done = worker.carryOut(plans[number]);
            if (!done)
            {
                return interrupted();
            }
            const AccuracyPoint point =
                summarise(plans[number].setting, *done, results.references[quantity].value,
                          static_cast<std::size_t>(plans[number].runs));
            info("    {}: {}, CPU {:.3g} s  ({} of {}, {})", settingText(point.setting, settings),
                 point.isWhole()
                     ? fmt::format("error {:.3g}, worst {:.3g}", point.medianError, point.worstError)
                     : fmt::format("{} of {} runs FAILED{}", point.failed, point.runs,
                                   point.runs < point.planned ? ", no more tried" : ""),
                 point.cpuTime, number + 1, plans.size(), worker.timeLeft());
            std::fflush(stdout); // a study takes long: its log must show the progress
            result.points.push_back(point);
        }
        results.sweeps.push_back(std::move(result));
        printLine();
    }
    shareMostPhases(results.sweeps);
    return results;
}

void printAccuracyResults(const AccuracyStudy& study, const AccuracyResults& results)
{
    if (results.isInterrupted)
    {
        info("Stopped before the end of the study; started again, it continues from here");
        return;
    }
    for (const CheapestRow& row : cheapestRows(study, results))
    {
        const bool isMotion = study.quantities[row.quantity].kind == QuantityKind::motion;
        info("{}: {} is reached {}by {}", study.quantities[row.quantity].name, percentText(row.level),
             !isMotion                             ? ""
             : row.measure == ErrorMeasure::median ? "for half of the phases "
                                                   : "for all phases ",
             row.point ? fmt::format("{} in {:.3g} s",
                                     settingText(row.point->setting, study.quantities[row.quantity].kind),
                                     row.point->cpuTime)
                       : "none of the settings");
    }
}

void writeAccuracyResults(const AccuracyStudy& study, const AccuracyResults& results)
{
    if (results.isInterrupted)
    {
        return;
    }
    const fs::path folder = accuracyFolder(study.caseDirectory);
    writeWholeFile(folder / "accuracyCost.csv", accuracyTable(study, results));
    writePictures(folder, study, results);
    writeWholeFile(folder / "accuracyCost.md", accuracyPage(study, results));
    info("\nThe page: {}", (folder / "accuracyCost.md").string());
}

int exitStatus(const AccuracyResults& results)
{
    return results.isInterrupted ? exitStatusOfSignal(stopSignal()) : 0;
}

} // namespace drystone
