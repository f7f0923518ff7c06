// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads what quantities need, one structure for each number of points; refuses settings without meaning.
#include "ensembles/AccuracyCostCase.h"

#include "ensembles/AccuracyHistory.h"
#include "ensembles/CaseRuns.h"
#include "functionObjects/MotionResults.h"
#include "runControl/Case.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// Whether a key requests something: an empty list or the default, as etc/annotated has them, does not.
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
            : std::vector<std::string>{"deltaT",         "theta",   "solver", "displacements",
                                       "contactOverlap", "effects", "phases"};
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
    if (setting.flowRule == FlowRule::nonAssociative && !scene.contact.friction
        && setting.effects != EffectSelection::everything)
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

/// The setting that a reference run is made with, its step and tolerance the finest.
RunSetting finestSetting(const ReferencePlan& plan, RunSetting setting)
{
    forEachKey([](auto& value, const auto& wanted) { value = wanted.value_or(value); }, setting, plan);
    return asComputed(setting);
}

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
    return postProcessingFolder(caseDirectory, accuracyCostName, "0");
}

namespace
{

/// Reads the structure with as many points to a joint as a setting has, if it is not known yet.
template<int Dim>
void requireStructure(AccuracyCase<Dim>& ofCase, const fs::path& caseDirectory, const RunSetting& setting)
{
    const int points = jointPointsOf<Dim>(setting);
    if (!ofCase.structures.contains(points))
    {
        ofCase.structures.emplace(
            points,
            readLimitAnalysisCase<Dim>(caseDirectory, points > 0 ? std::optional(points) : std::nullopt));
    }
}

/// Reads the motion of the case. \param study gets its duration \return its settings
template<int Dim>
RunSetting readMotion(const fs::path& caseDirectory, AccuracyCase<Dim>& ofCase, AccuracyStudy& study)
{
    Time time(caseDirectory, ControlDict::required, RunsOfCase::many);
    ofCase.scene = readDynamicCase<Dim>(caseDirectory);
    ofCase.start = startOrContinue(caseDirectory, *ofCase.scene, time).state;
    ofCase.endTime = time.controls().endTime;
    study.duration = ofCase.endTime - ofCase.start.time;
    if (!(study.duration > 0))
    {
        throw FatalIOError("The motions of the study end where they begin: raise endTime.",
                           time.controlDict().locationOf("endTime"));
    }
    const DynamicCase<Dim>& scene = *ofCase.scene;
    return {time.controls().deltaT,
            scene.schemes.timeIntegration.theta,
            scene.flowRule(),
            scene.solution.solver,
            scene.solution.tolerance,
            0,
            0,
            scene.schemes.smallDisplacements ? Displacements::small : Displacements::large,
            ContactFormulation::points,
            scene.schemes.contactOverlap,
            scene.schemes.effects.selection};
}

/// Reads the limit analysis of the case. \return its settings
template<int Dim>
RunSetting readCollapse(const fs::path& caseDirectory, AccuracyCase<Dim>& ofCase)
{
    requireStructure(ofCase, caseDirectory, {});
    const LimitAnalysisCase<Dim>& structure = ofCase.structures.at(0);
    RunSetting setting;
    setting.flowRule = flowRuleOf(structure.contact);
    setting.solver = SolverType::interiorPoint;
    setting.tolerance = structure.solution.tolerance;
    setting.formulation =
        structure.contact.contact ? structure.contact.contact->formulation : ContactFormulation::points;
    return setting;
}

/// \param own the settings of the case \param reference its sub-dictionary
template<int Dim>
StudyQuantity quantityOf(const std::string& name, const QuantityPlan& plan, const RunSetting& own,
                         const std::shared_ptr<AccuracyCase<Dim>>& shared, const fs::path& caseDirectory,
                         const Dictionary& reference)
{
    StudyQuantity quantity{name,
                           plan.kind,
                           plan.make(shared),
                           plan.reference,
                           own,
                           [shared, own, kind = plan.kind] { return unitOfWork(*shared, own, kind); },
                           0};
    if (plan.reference.kind == ReferencePlan::Kind::Housner)
    {
        quantity.housner = housnerValue(quantity.quantity, reference.locationOf("type"));
    }
    if (plan.reference.kind == ReferencePlan::Kind::finest)
    {
        rejectKeys<Dim>(reference, plan.kind);
        const RunSetting finest = finestSetting(plan.reference, own);
        if (plan.kind == QuantityKind::limitAnalysis)
        {
            requireStructure(*shared, caseDirectory, finest);
        }
        requirePossible(*shared, plan.kind, finest, reference);
    }
    return quantity;
}

/// The number of the quantity that a sweep names. \param own the dictionary of the sweep
std::size_t quantityOfSweep(const AccuracyStudy& study, const std::string& wanted, const Dictionary& own)
{
    const auto quantity = std::find_if(study.quantities.begin(), study.quantities.end(),
                                       [&](const auto& known) { return known.name == wanted; });
    if (quantity == study.quantities.end())
    {
        std::vector<std::string> names;
        for (const StudyQuantity& known : study.quantities)
        {
            names.push_back(known.name);
        }
        throw FatalIOError(unknownWordMessage("quantity", wanted, names), own.locationOf("quantity"));
    }
    return static_cast<std::size_t>(quantity - study.quantities.begin());
}

/// Where a reference has a key; its dictionary where it takes the value of the case.
SourceLocation locationIn(const Dictionary& dictionary, const std::string& key)
{
    return dictionary.found(key) ? dictionary.locationOf(key) : dictionary.location();
}

/// Rejects a finest run that is coarser than the settings that it judges, whose errors would be its own.
void requireFinerReference(const StudyQuantity& quantity, const Dictionary& reference,
                           const std::string& sweep, const std::vector<RunSetting>& settings)
{
    if (quantity.reference.kind != ReferencePlan::Kind::finest)
    {
        return;
    }
    const RunSetting finest = finestSetting(quantity.reference, quantity.ofCase);
    RunSetting wanted = finest;
    for (const RunSetting& setting : settings)
    {
        wanted.deltaT = std::min(wanted.deltaT, setting.deltaT);
        wanted.tolerance = std::min(wanted.tolerance, setting.tolerance);
        wanted.pointsPerJoint = std::max(wanted.pointsPerJoint, setting.pointsPerJoint);
        wanted.pointsPerSide = std::max(wanted.pointsPerSide, setting.pointsPerSide);
    }
    const auto message = [&](const char* key, double has, double needs, const char* bound)
    {
        return fmt::format("The finest run that {} is compared with has {} {:g}, and the sweep {} goes to "
                           "{:g}: the errors of the finer settings would be those of the reference.\n\n"
                           "Give the reference a {} of at {} {:g}.",
                           quantity.name, key, has, sweep, needs, key, bound, needs);
    };
    if (wanted.deltaT < finest.deltaT)
    {
        throw FatalIOError(message("deltaT", finest.deltaT, wanted.deltaT, "most"),
                           locationIn(reference, "deltaT"));
    }
    // Without a number of its own a structure has its points where the mechanism needs them.
    if (quantity.reference.pointsPerJoint && wanted.pointsPerJoint > finest.pointsPerJoint)
    {
        throw FatalIOError(message("pointsPerJoint", finest.pointsPerJoint, wanted.pointsPerJoint, "least"),
                           locationIn(reference, "pointsPerJoint"));
    }
    if (quantity.reference.pointsPerSide && wanted.pointsPerSide > finest.pointsPerSide)
    {
        throw FatalIOError(message("pointsPerSide", finest.pointsPerSide, wanted.pointsPerSide, "least"),
                           locationIn(reference, "pointsPerSide"));
    }
    // Two decades more show from where on a smaller tolerance gains nothing.
    if (100.1 * wanted.tolerance < finest.tolerance)
    {
        printWarning(message("tolerance", finest.tolerance, wanted.tolerance, "most"),
                     locationIn(reference, "tolerance"));
    }
}

/// Rejects a sweep without meaning for its quantity, or that the case cannot be computed with.
/// \param plan the sweep and its name \param duration of a motion [s]
/// \param own the dictionary of the sweep \param reference that of what its quantity is compared with
template<int Dim>
void requireSweep(AccuracyCase<Dim>& ofCase, const fs::path& caseDirectory, const StudyQuantity& quantity,
                  const Named<Sweep>& plan, double duration, const Dictionary& own,
                  const Dictionary& reference)
{
    const auto& [name, sweep] = plan;
    rejectKeys<Dim>(own, quantity.kind);
    const bool isMotion = quantity.kind == QuantityKind::motion;
    if (sweep.along && *sweep.along != SweepAxis::tolerance
        && (*sweep.along == SweepAxis::deltaT) != isMotion)
    {
        throw FatalIOError(
            isMotion ? "Contact points are for multipliers: let this sweep go along deltaT or tolerance."
                     : "deltaT is for motions: let this sweep go along tolerance, pointsPerJoint or "
                       "pointsPerSide.",
            own.locationOf("along"));
    }
    const std::vector<RunSetting> settings = settingsOf(sweep, quantity.ofCase);
    for (const RunSetting& setting : settings)
    {
        if (isMotion && setting.deltaT > duration * (1 + 1e-9))
        {
            throw FatalIOError(
                fmt::format("A step of {:g} s is longer than the motion, which lasts {:g} s.\n\n"
                            "Give shorter steps, or a later endTime in system/controlDict.",
                            setting.deltaT, duration),
                locationIn(own, "deltaT"));
        }
        if (!isMotion)
        {
            requireStructure(ofCase, caseDirectory, setting);
        }
        requirePossible(ofCase, quantity.kind, setting, own);
    }
    requireFinerReference(quantity, reference, name, settings);
}

} // namespace

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
    const auto ofKind = [&](QuantityKind kind)
    {
        return std::any_of(settings.quantities.begin(), settings.quantities.end(),
                           [kind](const auto& quantity) { return quantity.second.kind == kind; });
    };
    const RunSetting ofMotion =
        ofKind(QuantityKind::motion) ? readMotion(caseDirectory, *shared, study) : RunSetting();
    const RunSetting ofCollapse =
        ofKind(QuantityKind::limitAnalysis) ? readCollapse(caseDirectory, *shared) : RunSetting();

    for (const auto& [name, plan] : settings.quantities)
    {
        const RunSetting& own = plan.kind == QuantityKind::motion ? ofMotion : ofCollapse;
        study.quantities.push_back(quantityOf(name, plan, own, shared, caseDirectory,
                                              quantities.subDict(name).subDict("reference")));
    }
    for (const auto& [name, sweep] : settings.sweeps)
    {
        const Dictionary& own = sweeps.subDict(name);
        study.quantityOfSweep.push_back(quantityOfSweep(study, sweep.quantity, own));
        const StudyQuantity& quantity = study.quantities[study.quantityOfSweep.back()];
        requireSweep(*shared, caseDirectory, quantity, {name, sweep}, study.duration, own,
                     quantities.subDict(quantity.name).subDict("reference"));
    }
    study.heading = historyHeading(caseDirectory, dictionary);
    return study;
}

template AccuracyStudy readAccuracyStudy<2>(const fs::path& caseDirectory);
template AccuracyStudy readAccuracyStudy<3>(const fs::path& caseDirectory);

} // namespace drystone
