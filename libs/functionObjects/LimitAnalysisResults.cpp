// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Prints and writes the results of limit analysis.
#include "functionObjects/LimitAnalysisResults.h"

#include "functionObjects/EarlierResults.h"

#include "conic/ProgramFile.h"
#include "contact/AlmostJoints.h"
#include "contact/ContactState.h"
#include "contact/Facing.h"
#include "contact/JointClosure.h"
#include "contact/SupportPaths.h"
#include "core/Error.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "effects/EffectList.h"
#include "functionObjects/ColumnFile.h"
#include "functionObjects/FunctionList.h"
#include "functionObjects/KeptResults.h"
#include "functionObjects/LoadEnvelope.h"
#include "functionObjects/LoadMeaning.h"
#include "io/Frames.h"
#include "io/Mechanism.h"
#include "io/MechanismPicture.h"
#include "io/Plot.h"
#include "quantities/LimitAnalysisFigures.h"
#include "runControl/CaseFiles.h"
#include "statics/JointDissipation.h"
#include "statics/SolveCase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

template<int Dim>
std::string statusText(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    switch (result.status)
    {
    case CollapseStatus::optimal:
        return "optimal";
    case CollapseStatus::unstable:
        return "unstable (the blocks cannot carry the dead load: the mechanism is written)";
    case CollapseStatus::unbounded:
        return structure.movement ? "unbounded (no force moves the support in this direction)"
                                  : "unbounded (no load of this direction makes it collapse)";
    case CollapseStatus::notConverged:
        break;
    }
    return "not converged: there is no answer. Raise tolerance or maximumIterations in "
           "system/solution/limitAnalysis";
}

/// The status in the caption of the picture.
template<int Dim>
std::string caption(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    switch (result.status)
    {
    case CollapseStatus::optimal:
        return structure.movement ? fmt::format("base reaction {:.6g} N", result.alpha)
                                  : fmt::format("alpha = {:.6f}", result.alpha);
    case CollapseStatus::unstable:
        return "unstable under its dead load";
    case CollapseStatus::unbounded:
        return structure.movement ? "no force moves the support in this direction"
                                  : "no live load of this direction makes it collapse";
    case CollapseStatus::notConverged:
        break;
    }
    return "not converged";
}

template<int Dim>
std::string tableText(const LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results,
                      double cpuTime)
{
    std::string text = fmt::format("# {}\n", fmt::join(limitAnalysisHeadings(), " "));
    for (const LimitAnalysis& result : results)
    {
        std::string row;
        for (const TabledFigure& figure : limitAnalysisFigures(structure, result, cpuTime))
        {
            row += (row.empty() ? "" : " ") + figure.text;
        }
        text += row + "\n";
    }
    return text;
}

template<int Rows, int Forces>
std::vector<double> cohesionsOf(const ConeProgram<Rows, Forces>& program)
{
    std::vector<double> cohesions;
    for (const Strength& strength : program.strength)
    {
        cohesions.push_back(strength.cohesion);
    }
    return cohesions;
}

/// Stress resultants of each joint about its middle: normal and shear force on the first block, moment
/// (positive where the pressure lies towards the joint's tangent), and the centre of pressure, where the line
/// of thrust passes. Joints that carry nothing are left out.
std::string thrustText(const std::vector<ContactPoint<2>>& points, const std::vector<Vector<2>>& forces)
{
    double largest = 0;
    for (const Vector<2>& force : forces)
    {
        largest = std::max(largest, force.norm());
    }
    std::string text =
        "# x[m] y[m] normalForce[N] shearForce[N] moment[Nm] eccentricity[m] block[-] neighbour[-]\n";
    for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end)
    {
        Vector<2> middle = Vector<2>::Zero();
        Vector<2> force = Vector<2>::Zero();
        for (end = begin; end < points.size() && points[end].joint == points[begin].joint; ++end)
        {
            middle += points[end].position;
            force += forces[end];
        }
        middle /= static_cast<double>(end - begin);
        double moment = 0;
        for (std::size_t i = begin; i < end; ++i)
        {
            moment += forces[i].x() * tangent(points[i]).dot(points[i].position - middle);
        }
        if (force.norm() <= 1e-6 * largest)
        {
            continue;
        }
        const double eccentricity = force.x() != 0 ? moment / force.x() : 0;
        const Vector<2> pressure = middle + eccentricity * tangent(points[begin]);
        text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {} {}\n", pressure.x(), pressure.y(),
                            force.x(), force.y(), moment, eccentricity, points[begin].block,
                            points[begin].neighbour);
    }
    return text;
}

/// The same in space: force on the first block at the centre of pressure, its parts normal and tangential to
/// the joint, and the moment about the normal through the centre.
std::string thrustText(const std::vector<ContactPoint<3>>& points, const std::vector<Vector<3>>& forces)
{
    double largest = 0;
    for (const Vector<3>& force : forces)
    {
        largest = std::max(largest, force.norm());
    }
    std::string text = "# x[m] y[m] z[m] fx[N] fy[N] fz[N] normalForce[N] shearForce[N] torsion[Nm] block[-] "
                       "neighbour[-]\n";
    for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end)
    {
        Vector<3> force = Vector<3>::Zero();
        Vector<3> centre = Vector<3>::Zero();
        double pressure = 0;
        for (end = begin; end < points.size() && points[end].joint == points[begin].joint; ++end)
        {
            force += contactFrame(points[end]) * forces[end];
            centre += forces[end].x() * points[end].position;
            pressure += forces[end].x();
        }
        if (force.norm() <= 1e-6 * largest || !(pressure > 0))
        {
            continue;
        }
        centre /= pressure;
        double torsion = 0;
        for (std::size_t i = begin; i < end; ++i)
        {
            const Vector<3> arm = points[i].position - centre;
            const Vector<3> at = contactFrame(points[i]) * forces[i];
            torsion += points[begin].normal.dot(momentOf(arm, at));
        }
        const double normalForce = force.dot(points[begin].normal);
        const double shear = (force - normalForce * points[begin].normal).norm();
        text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {} {}\n",
                            centre.x(), centre.y(), centre.z(), force.x(), force.y(), force.z(), normalForce,
                            shear, torsion, points[begin].block, points[begin].neighbour);
    }
    return text;
}

std::string coulombText(const CoulombRange& range)
{
    return fmt::format(
        "# lowest[-] highest[-] associative[-] starts[-] converged[-] fall[-]\n{:.12g} {:.12g} {:.12g} "
        "{} {} {:.12g}\n",
        range.lowest, range.highest, range.associative, range.starts, range.converged, range.fall);
}

} // namespace

template<int Dim>
void printLimitAnalysisCase(const LimitAnalysisCase<Dim>& structure)
{
    ContactProperties atRest = structure.contact;
    atRest.restitution.reset(); // there are no impacts
    auto [simulated, absent] = effectNamesAtRest(atRest);
    (structure.movement ? simulated : absent).emplace_back("supportMovement");
    (structure.pushover ? simulated : absent).emplace_back("pushover");
    printEffects(simulated, absent);
    info("Blocks: {} free, contact points: {}", structure.freeBlocks, structure.points.size());
    for (const std::string& sentence : caseMeaning<Dim>(structure.loads))
    {
        printLine(sentence);
    }
    printClosure(structure.assembly);
    info("Solver: {}, tolerance {:g}\n", nameOf(structure.solution.solver), structure.solution.tolerance);
}

namespace
{

/// The combination nearest to collapse.
void printGoverning(const std::vector<LimitAnalysis>& results)
{
    const auto demand = [](const LimitAnalysis& result)
    { return result.status == CollapseStatus::unstable ? 0 : std::abs(tabledAlpha(result)); };
    const auto least = std::min_element(results.begin(), results.end(),
                                        [&](const auto& a, const auto& b) { return demand(a) < demand(b); });
    if (least->status == CollapseStatus::unstable)
    {
        info("Governing combination: {}, unstable under its dead load\n", least->combination);
    }
    else
    {
        info("Governing combination: {}, alpha = {:.9g}\n", least->combination, tabledAlpha(*least));
    }
}

/// What is known of the collapses by Coulomb's law: each is an upper bound of the least.
void printCoulombRange(const CoulombRange& range, const LimitAnalysis& result)
{
    if (range.converged > 0)
    {
        info("Coulomb's law: lowest of the collapses found, alpha {:.6f} to {:.6f} ({} of {} starts "
             "converged); "
             "associative, an upper bound: {:.6f}",
             range.lowest, range.highest, range.converged, range.starts, range.associative);
    }
    else
    {
        info("Coulomb's law: no collapse found on which the live load does work ({} starts); its multiplier "
             "is at "
             "most that of the associative law, {:.6f}",
             range.starts, range.associative);
    }
    if (range.fall < range.lowest)
    {
        info("Blocks may fall under the dead load alone from alpha {:.6f} on: with other forces at rest, or "
             "as "
             "joints beside them are relieved.",
             range.fall);
    }
    if (result.status == CollapseStatus::optimal && result.alpha < 0)
    {
        info(
            "The multiplier is below zero: some forces at rest let the dead load alone drive this mechanism, "
            "while others carry it.");
    }
}

/// In space, where joints have strengths: by how much their points are on the unsafe side.
void printWholeJoints(const LimitAnalysisCase<2>&, const LimitAnalysis&) {}
void printWholeJoints(const LimitAnalysisCase<3>& structure, const LimitAnalysis& result)
{
    constexpr double worthSaying = 1e-5;
    if (structure.movement || result.coulomb)
    {
        return;
    }
    const Eigen::VectorXd& live = liveLoadOf(structure, result);
    const double less = dissipatedLess(structure.program, structure.patches, live, result.mechanism);
    if (less > worthSaying * std::abs(result.alpha))
    {
        info("Over the whole faces of its joints this mechanism has alpha <= {:.6g}, {:.2g}% less: strengths "
             "act "
             "at contact points. With `jointPoints {{ type adaptive; tolerance 1e-4; }}` or a finer grid "
             "both come "
             "nearer to the exact multiplier.",
             result.alpha - std::copysign(less, live.dot(result.mechanism)),
             100 * less / std::abs(result.alpha));
    }
}

/// The suffix of the file names of each answer: the combination, and `Negative` for the negative end.
std::vector<std::string> suffixes(const std::vector<LimitAnalysis>& results)
{
    std::vector<std::string> names;
    for (std::size_t i = 0; i < results.size(); ++i)
    {
        const std::string& combination = results[i].combination;
        const bool isSecond = i > 0 && results[i - 1].combination == combination;
        names.push_back((combination.empty() ? "" : "_" + combination) + (isSecond ? "Negative" : ""));
    }
    return names;
}

} // namespace

template<int Dim>
void printLimitAnalysis(const LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results)
{
    printEnvelope(structure);
    for (const LimitAnalysis& result : results)
    {
        if (!result.combination.empty())
        {
            info("Combination {}", result.combination);
        }
        if (result.status == CollapseStatus::optimal)
        {
            if (structure.movement)
            {
                info("Base reaction of {} against its movement = {:.9g} N",
                     structure.assembly.supports[structure.movement->support].name, result.alpha);
            }
            info("Collapse load multiplier alpha = {:.9g}", result.alpha);
            printWholeJoints(structure, result);
            for (const std::string& sentence : loadMeaning(structure, result))
            {
                printLine(sentence);
            }
        }
        if (result.coulomb)
        {
            printCoulombRange(*result.coulomb, result);
        }
        info("Status: {}", statusText(structure, result));
        if (result.status == CollapseStatus::unstable)
        {
            if (const std::string cause = instabilityCause(structure.assembly, structure.points);
                !cause.empty())
                printLine(cause);
        }
        const Certificate& certificate = result.certificate;
        info(
            "Certificate: primal residual = {:.3e}, dual residual = {:.3e}, gap = {:.3e}, No Iterations {}\n",
            certificate.primalResidual, certificate.dualResidual, certificate.gap, result.iterations);
    }
    if (!structure.combinations.empty())
    {
        printGoverning(results);
    }
    else if (results.size() == 2 && results[0].status != CollapseStatus::unstable)
    {
        info("Range of load multipliers: {:.9g} to {:.9g}\n",
             results[1].status == CollapseStatus::unbounded ? -tabledAlpha(results[1]) : results[1].alpha,
             tabledAlpha(results[0]));
    }
}

std::filesystem::path limitAnalysisTable(const std::filesystem::path& caseDirectory)
{
    return postProcessingFolder(caseDirectory, "limitAnalysis", "0") / "limitAnalysis.dat";
}

std::filesystem::path limitAnalysisInput(const std::filesystem::path& caseDirectory)
{
    return limitAnalysisTable(caseDirectory).replace_filename("input");
}

template<int Dim>
void checkFunctions(const Dictionary& controlDict, const std::filesystem::path& caseDirectory,
                    const Assembly<Dim>& assembly)
{
    const Entry* functions = controlDict.find("functions");
    if (!functions)
    {
        return;
    }
    const FunctionList<Dim> list(functions->dictionary(), caseDirectory, "0", {}, 0, assembly);
    if (!list.names().empty())
    {
        info("Functions of system/controlDict apply to time stepping and are not run here: {}\n",
             fmt::join(list.names(), " "));
    }
}

void confirmResults(const std::filesystem::path& caseDirectory)
{
    const std::filesystem::path table = limitAnalysisTable(caseDirectory);
    if (!std::filesystem::exists(table))
    {
        throw FatalError(fmt::format("There are no results to process: {} is missing.\n\nRun limitAnalysis "
                                     "without -postProcess first.",
                                     table.string()));
    }
    info("limitAnalysis writes all its results when it runs, {} among them: nothing remains to be "
         "processed.\n",
         table.string());
}

void requireWritableResults(const std::filesystem::path& caseDirectory)
{
    requireWritable(limitAnalysisTable(caseDirectory).parent_path());
    requireWritable(caseDirectory / "VTK");
}

namespace
{

void reportRemoved(const std::vector<std::string>& names)
{
    if (!names.empty())
    {
        info("Removed with what belongs to them, of an earlier run with other loads: {}\n",
             fmt::join(names, " "));
    }
}

} // namespace

void removeLimitAnalysisTable(const std::filesystem::path& caseDirectory)
{
    std::error_code ignored;
    std::filesystem::remove(limitAnalysisTable(caseDirectory), ignored);
    std::filesystem::remove(limitAnalysisInput(caseDirectory), ignored);
    reportRemoved(removeEarlierResults(caseDirectory, {}));
}

template<int Dim>
void writeLimitAnalysisProgram(const std::filesystem::path& caseDirectory,
                               const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    const WriteProgram when = structure.solution.writeProgram;
    if (when == WriteProgram::always
        || (when == WriteProgram::unsolved && result.status == CollapseStatus::notConverged))
    {
        writeProgram(limitAnalysisTable(caseDirectory).parent_path() / "coneProgram", structure.program);
    }
}

namespace
{

/// The line of thrust: a point at each centre of pressure, with the force there [N].
template<int Dim>
PolyData<Dim> thrustFrame(const std::vector<JointForce<Dim>>& joints)
{
    PolyData<Dim> data;
    data.kind = CellKind::point;
    Field force{"jointForce[N]", Dim, {}};
    for (const JointForce<Dim>& joint : joints)
    {
        data.points.push_back(joint.centre);
        force.values.insert(force.values.end(), joint.force.data(), joint.force.data() + Dim);
    }
    data.fields.push_back(std::move(force));
    return data;
}

/// Writes mechanism, forces and thrust of one answer. \param suffix of the file names
template<int Dim>
void writeAnswer(const std::filesystem::path& caseDirectory, const LimitAnalysisCase<Dim>& structure,
                 const LimitAnalysis& result, const std::string& suffix, const Vector<3>& towardsViewer)
{
    const Assembly<Dim>& assembly = structure.assembly;
    const auto file = [&](const std::string& name, const std::string& extension)
    { return limitAnalysisTable(caseDirectory).replace_filename(name + suffix + extension); };
    Rates<Dim> rates = ratesOfAllBlocks(assembly, result.mechanism);
    if (structure.movement && result.status == CollapseStatus::optimal)
    {
        // The mechanism corresponds to a unit movement of the support.
        for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
        {
            if (assembly.blocks[block].support == structure.movement->support)
            {
                rates.col(static_cast<Eigen::Index>(block)).template head<Dim>() =
                    structure.movement->direction;
            }
        }
    }
    VtkSeries blocks(caseDirectory / "VTK", "blocks" + suffix, 0);
    writeMechanism(blocks, assembly, rates);

    const std::vector<Vector<Dim>> forces = pointForces<Dim>(result.contactForce);
    VtkSeries contacts(caseDirectory / "VTK", "contacts" + suffix, 0);
    contacts.write(0,
                   contactFrame(structure.points, forces,
                                contactStates(forces, structure.friction, cohesionsOf(structure.program))));
    writeWholeFile(file("thrust", ".dat"), thrustText(structure.points, forces));
    VtkSeries thrust(caseDirectory / "VTK", "thrust" + suffix, 0);
    thrust.write(0, thrustFrame(jointForces(structure.points, forces)));

    MechanismPicture picture;
    picture.title = caseName(caseDirectory);
    picture.subtitle = fmt::format("{}, {} blocks, {} contact points", caption(structure, result),
                                   structure.freeBlocks, structure.points.size());
    if (const std::optional<EnvelopePoint> worst = worstPlace(structure))
    {
        picture.subtitle += fmt::format(", load from {}", placeText(structure, *worst));
    }
    picture.towardsViewer = towardsViewer;
    picture.load = loadArrow(structure, result);
    const double drawn = 0.5 * meanBlockSize(assembly);
    picture.motion = fmt::format("moved by up to {:.2g} m in this picture", drawn);
    if constexpr (Dim == 3)
    {
        picture.marks = jointMarks(assembly, structure.points, structure.friction, rates);
    }
    writeMechanismPicture(file("mechanism", ".svg"), assembly, mechanismPlacements(assembly, rates, drawn),
                          picture);
    if constexpr (Dim == 2)
    {
        picture.thrust = jointForces(structure.points, forces);
        picture.motion.clear();
        writeMechanismPicture(file("thrust", ".svg"), assembly,
                              std::vector<Placement<2>>(assembly.blocks.size()), picture);
    }
    if (result.coulomb)
    {
        writeWholeFile(file("coulomb", ".dat"), coulombText(*result.coulomb));
    }
}

} // namespace

namespace
{

/// The force of each named load; without any removes the table of an earlier run.
template<int Dim>
void writeLoadCases(const std::filesystem::path& file, const LoadVectors& loads)
{
    if (loads.cases.empty())
    {
        std::error_code ignored;
        std::filesystem::remove(file, ignored);
        return;
    }
    std::string text = fmt::format("# case fx[N] fy[N]{}\n", Dim == 3 ? " fz[N]" : "");
    for (const auto& [name, load] : loads.cases)
    {
        const Vector<Dim> force = resultantOf<Dim>(load);
        text += fmt::format("{} {:.9g}\n", name, fmt::join(force.data(), force.data() + Dim, " "));
    }
    writeWholeFile(file, text);
}

} // namespace

template<int Dim>
void writeLimitAnalysisResults(const std::filesystem::path& caseDirectory,
                               const LimitAnalysisCase<Dim>& structure,
                               const std::vector<LimitAnalysis>& results, double cpuTime,
                               const Vector<3>& towardsViewer)
{
    const std::vector<std::string> names = suffixes(results);
    reportRemoved(removeEarlierResults(caseDirectory, names));
    for (std::size_t i = 0; i < results.size(); ++i)
    {
        writeAnswer(caseDirectory, structure, results[i], names[i], towardsViewer);
    }
    if (!structure.combinations.empty())
    {
        std::string text = "# combination alpha[-] status[-]\n";
        for (const LimitAnalysis& result : results)
        {
            text += fmt::format("{} {:.12g} {}\n", result.combination, tabledAlpha(result),
                                static_cast<int>(result.status));
        }
        writeWholeFile(limitAnalysisTable(caseDirectory).replace_filename("combinations.dat"), text);
    }
    const std::filesystem::path folder = limitAnalysisTable(caseDirectory).parent_path();
    writeLoadCases<Dim>(folder / "loadCases.dat", structure.loads);
    writeEnvelope(folder, structure, caseName(caseDirectory));
    writeInput(limitAnalysisInput(caseDirectory), inputOfLimitAnalysis(caseDirectory, structure.assembly));
    writeWholeFile(limitAnalysisTable(caseDirectory), tableText(structure, results, cpuTime));
    info("Wrote {}: limitAnalysis.dat and thrust.dat (tables), mechanism.svg{}{}",
         limitAnalysisTable(caseDirectory).parent_path().lexically_normal().string(),
         Dim == 2 ? " and thrust.svg (pictures" : " (picture", results.size() > 1 ? ", one an answer)" : ")");
    info("Wrote {}: blocks (mechanism), contacts (forces), thrust; .vtp.series opens in ParaView\n",
         (caseDirectory / "VTK").lexically_normal().string());
}

namespace
{

std::string endText(PushoverEnd end)
{
    switch (end)
    {
    case PushoverEnd::overturned:
        return "alpha has decreased to zero: the structure overturns by itself";
    case PushoverEnd::falling:
        return "blocks have lost their support: the structure collapses by itself";
    case PushoverEnd::meeting:
        return "blocks meet where a corner or an edge alone touches the other, which pushover in space does "
               "not follow: the curve is incomplete";
    case PushoverEnd::stepsUsedUp:
        return "maximumSteps has been reached, and the structure still stands";
    case PushoverEnd::unbounded:
        return "no live load of this direction makes it move";
    case PushoverEnd::unstable:
        return "the blocks cannot carry the dead load as built";
    case PushoverEnd::notConverged:
        break;
    }
    return "not converged: the curve is incomplete. Try another step";
}

} // namespace

template<int Dim>
bool runPushover(const std::filesystem::path& caseDirectory, const LimitAnalysisCase<Dim>& structure)
{
    constexpr double frames = 100;
    const double between = std::max(structure.pushover->step, meanBlockSize(structure.assembly) / frames);
    VtkSeries series(caseDirectory / "VTK", "pushover", 0);
    double next = 0;
    const Pushover pushover = solvePushover<Dim>(
        structure,
        [&](const CapacityPoint& point, const std::vector<Placement<Dim>>& placements)
        {
            if (point.displacement >= next || point.alpha == 0)
            {
                series.write(point.displacement, blockFrame(structure.assembly, placements));
                next = point.displacement + between;
            }
        });
    std::string table = "# displacement[m] alpha[-] largestDisplacement[m] certificate[-] iterations[-]\n";
    PlotCurve curve;
    for (const CapacityPoint& point : pushover.curve)
    {
        table += fmt::format("{:.9g} {:.9g} {:.9g} {:.3e} {}\n", point.displacement, point.alpha,
                             point.largest, point.worst, point.iterations);
        curve.x.push_back(point.displacement);
        curve.y.push_back(point.alpha);
    }
    const auto file = [&](const char* name)
    { return limitAnalysisTable(caseDirectory).replace_filename(name); };
    writeWholeFile(file("capacity.dat"), table);
    if (pushover.curve.size() > 1)
    {
        Plot plot;
        plot.title = "Capacity curve of " + caseName(caseDirectory);
        plot.subtitle = endText(pushover.end);
        plot.x.label = "displacement of the live load [m]";
        plot.y.label = "alpha [-]";
        plot.curves.push_back(std::move(curve));
        writePlot(file("capacity.svg"), plot);
    }
    info("Pushover: {} positions; {}{}\n", pushover.curve.size(), endText(pushover.end),
         pushover.curve.empty() ? "" : fmt::format(", at d = {:.6g} m", pushover.curve.back().displacement));
    if (pushover.end == PushoverEnd::meeting)
    {
        info("{} and {} would be {:.3g} m in each other\n",
             blockName(structure.assembly, pushover.overlap.block),
             blockName(structure.assembly, pushover.overlap.neighbour), pushover.overlap.depth);
    }
    return pushover.end != PushoverEnd::notConverged && pushover.end != PushoverEnd::meeting;
}

template void checkFunctions(const Dictionary& controlDict, const std::filesystem::path& caseDirectory,
                             const Assembly<2>& assembly);
template void checkFunctions(const Dictionary& controlDict, const std::filesystem::path& caseDirectory,
                             const Assembly<3>& assembly);
template bool runPushover(const std::filesystem::path& caseDirectory, const LimitAnalysisCase<2>& structure);
template bool runPushover(const std::filesystem::path& caseDirectory, const LimitAnalysisCase<3>& structure);
template void printLimitAnalysisCase(const LimitAnalysisCase<2>& structure);
template void printLimitAnalysis(const LimitAnalysisCase<2>& structure,
                                 const std::vector<LimitAnalysis>& results);
template void writeLimitAnalysisProgram(const std::filesystem::path& caseDirectory,
                                        const LimitAnalysisCase<2>& structure, const LimitAnalysis& result);
template void writeLimitAnalysisResults(const std::filesystem::path& caseDirectory,
                                        const LimitAnalysisCase<2>& structure,
                                        const std::vector<LimitAnalysis>& results, double cpuTime,
                                        const Vector<3>& towardsViewer);
template void printLimitAnalysisCase(const LimitAnalysisCase<3>& structure);
template void printLimitAnalysis(const LimitAnalysisCase<3>& structure,
                                 const std::vector<LimitAnalysis>& results);
template void writeLimitAnalysisProgram(const std::filesystem::path& caseDirectory,
                                        const LimitAnalysisCase<3>& structure, const LimitAnalysis& result);
template void writeLimitAnalysisResults(const std::filesystem::path& caseDirectory,
                                        const LimitAnalysisCase<3>& structure,
                                        const std::vector<LimitAnalysis>& results, double cpuTime,
                                        const Vector<3>& towardsViewer);

} // namespace drystone
