// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Each number of a motion under its name in a state, and back.
#include "functionObjects/MotionState.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace drystone
{
namespace
{

/// The scalars of the ledger with their names in a state.
template<class Ledger, class Visit>
void visitLedger(Ledger& energy, const Visit& visit)
{
    visit("energyOpening", energy.opening);
    visit("energyKinetic", energy.kinetic);
    visit("energyPotential", energy.potential);
    visit("energyExternalWork", energy.externalWork);
    visit("energyFrictionLoss", energy.frictionLoss);
    visit("energyImpactLoss", energy.impactLoss);
    visit("energyAlgorithmicLoss", energy.algorithmicLoss);
    visit("energyElastic", energy.elastic);
    visit("energyDampingLoss", energy.dampingLoss);
}

/// The solver's residuals of the step that led to a state, likewise.
template<class Residuals, class Visit>
void visitResiduals(Residuals& residuals, const Visit& visit)
{
    visit("solverInitialResidual", residuals.initialResidual);
    visit("solverPrimalResidual", residuals.primalResidual);
    visit("solverDualResidual", residuals.dualResidual);
    visit("solverGap", residuals.dualityGap);
    visit("solverFlowError", residuals.flowError);
    visit("solverIterations", residuals.iterations);
    visit("solverFactorisations", residuals.factorisations);
    visit("solverPrograms", residuals.programs);
    visit("solverRetries", residuals.retries);
}

/// The vector with this index in a list of them.
template<int Size>
Eigen::Matrix<double, Size, 1> vectorAt(const std::vector<double>& values, std::size_t index)
{
    return Eigen::Map<const Eigen::Matrix<double, Size, 1>>(&values[Size * index]);
}

template<class Derived>
void append(std::vector<double>& values, const Eigen::MatrixBase<Derived>& vector)
{
    values.insert(values.end(), vector.derived().begin(), vector.derived().end());
}

/// A whole number, which counts or identifies something. \param where `entry timeIndex`
/// \throws FatalIOError where it is not at least `least` and less than `end`
long wholeNumber(const State& saved, const std::string& where, double value, double least, double end)
{
    if (!(value >= least && value < end) || value != std::floor(value))
    {
        throw FatalIOError(fmt::format("The {} of the state has {:g}, which is no such number: the file is "
                                       "damaged.\n\nRemove the time directory to start from an earlier one.",
                                       where, value),
                           {saved.file.string(), "", 1});
    }
    return static_cast<long>(value);
}

/// Of steps, times or iterations.
template<class Count = long>
Count countOf(const State& saved, const std::string& name)
{
    constexpr double exact = 1e15; // whole numbers up to there are exact
    const double end = std::min(exact, static_cast<double>(std::numeric_limits<Count>::max()));
    return static_cast<Count>(wholeNumber(saved, "entry " + name, stateScalar(saved, name), 0, end));
}

/// The integers that identify corner and edge of one contact point.
constexpr std::size_t featureNumbers = 5;

} // namespace

TimeState timeOf(const State& saved)
{
    TimeState time;
    time.value = stateScalar(saved, "time");
    time.deltaT = stateScalar(saved, "deltaT");
    time.index = countOf(saved, "timeIndex");
    time.origin = stateScalar(saved, "timeOrigin");
    time.originIndex = countOf(saved, "timeOriginIndex");
    time.detourEnd = stateScalar(saved, "timeDetourEnd");
    // Older versions did not keep these, and most motions begin at 0.
    const auto kept = [&saved](const char* name)
    { return saved.scalars.contains(name) ? stateScalar(saved, name) : 0; };
    time.beginning = kept("timeBeginning");
    time.wanted = kept("deltaTWanted");
    time.given = kept("deltaTGiven");
    time.stepLength = kept("stepLength");
    time.writeTimes = saved.scalars.contains("timeWrites") ? countOf(saved, "timeWrites") : 0;
    time.unfinished = saved.scalars.contains("timeUnfinished") ? countOf(saved, "timeUnfinished") : 0;
    return time;
}

template<int Dim>
std::vector<Placement<Dim>> placementsIn(const State& saved, std::size_t blocks)
{
    const auto& translation = stateArray(saved, "translation", Dim * blocks);
    const auto& rotation = stateArray(saved, "rotation", rotationCount<Dim> * blocks);
    std::vector<Placement<Dim>> placements;
    for (std::size_t block = 0; block < blocks; ++block)
    {
        placements.push_back(
            {vectorAt<Dim>(translation, block), turnOf<Dim>(vectorAt<rotationCount<Dim>>(rotation, block))});
    }
    return placements;
}

namespace
{

/// Contact points with their forces. \throws FatalError where the points as built are others
template<int Dim>
void readPoints(const State& saved, std::size_t blocks, Motion<Dim>& motion)
{
    const auto gapsThere = saved.arrays.find("contactGap");
    const std::size_t points = gapsThere == saved.arrays.end() ? 0 : gapsThere->second.size();
    const auto& gaps = stateArray(saved, "contactGap", points);
    const auto& features = stateArray(saved, "contactFeature", featureNumbers * points);
    const auto& forces = stateArray(saved, "contactForce", Dim * points);
    if (!motion.contacts && motion.points.size() != points)
    {
        throw FatalError(fmt::format("{} has {} contact points, the structure as built {}: with "
                                     "`smallDisplacements yes;` they must be the same. Start from time 0.",
                                     saved.file.string(), points, motion.points.size()));
    }
    const auto& positions = stateArray(saved, "contactPosition", Dim * points);
    const auto& normals = stateArray(saved, "contactNormal", Dim * points);
    motion.points.resize(points);
    motion.contactForces.resize(points);
    for (std::size_t i = 0; i < points; ++i)
    {
        ContactPoint<Dim>& point = motion.points[i];
        const double* numbers = &features[featureNumbers * i];
        const auto number = [&](std::size_t index, double least, double end)
        { return static_cast<int>(wholeNumber(saved, "list contactFeature", numbers[index], least, end)); };
        constexpr double least = std::numeric_limits<int>::min(); // of corners and edges, which shapes number
        constexpr double most = std::numeric_limits<int>::max();
        const auto count = static_cast<double>(blocks);
        point.block = number(0, 0, count);
        point.neighbour = number(1, 0, count);
        point.feature = {number(2, -1, count), number(3, least, most), number(4, least, most)};
        point.gap = gaps[i];
        point.position = vectorAt<Dim>(positions, i);
        point.normal = vectorAt<Dim>(normals, i);
        motion.contactForces[i] = vectorAt<Dim>(forces, i);
    }
    if (saved.arrays.contains("contactForceMean")) // else the same
    {
        const auto& means = stateArray(saved, "contactForceMean", Dim * points);
        for (std::size_t i = 0; i < points; ++i)
        {
            motion.meanForces.push_back(vectorAt<Dim>(means, i));
        }
    }
}

/// Where the next program begins, if it is kept.
template<int Dim>
void readInterior(const State& saved, Motion<Dim>& motion)
{
    if (!saved.arrays.contains("interiorForce"))
    {
        return;
    }
    const auto vectorOf = [&saved](const char* name, Eigen::Index size)
    {
        const auto& values = stateArray(saved, name, static_cast<std::size_t>(size));
        return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), size));
    };
    const auto ofPoints = Dim * static_cast<Eigen::Index>(motion.points.size());
    motion.interior = {vectorOf("interiorForce", ofPoints), vectorOf("interiorOpening", ofPoints),
                       vectorOf("interiorDisplacement", motion.state.velocity.size())};
}

} // namespace

template<int Dim>
Motion<Dim> motionOf(const DynamicCase<Dim>& scene, const State& saved)
{
    DynamicState<Dim> state = stateAtRest(scene.assembly);
    state.time = stateScalar(saved, "time");
    const std::size_t blocks = state.placements.size();
    state.placements = placementsIn<Dim>(saved, blocks);
    const auto& velocity = stateArray(saved, "velocity", static_cast<std::size_t>(state.velocity.size()));
    state.velocity = Eigen::Map<const Eigen::VectorXd>(velocity.data(), state.velocity.size());

    Motion<Dim> motion = startMotion(scene, std::move(state));
    visitLedger(motion.energy, [&](const char* name, double& value) { value = stateScalar(saved, name); });
    visitResiduals(motion.residuals,
                   [&]<class Value>(const char* name, Value& value)
                   {
                       if constexpr (std::is_integral_v<Value>)
                       {
                           value = countOf<Value>(saved, name);
                       }
                       else
                       {
                           value = stateScalar(saved, name);
                       }
                   });
    readPoints(saved, blocks, motion);
    readInterior(saved, motion);
    if (saved.scalars.contains("stepSlides"))
    {
        motion.slides = stateScalar(saved, "stepSlides") != 0;
        motion.collisions = countOf<int>(saved, "stepCollisions");
    }
    if (saved.scalars.contains("stepsInVain"))
    {
        motion.stepsInVain = countOf<int>(saved, "stepsInVain");
    }
    if (saved.scalars.contains("stepOverlapsLeft"))
    {
        motion.overlapsLeft = countOf<int>(saved, "stepOverlapsLeft");
    }
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        scene.effects[i]->restore(saved.arrays, motion.effectStates[i]);
    }
    motion.effectStatesBefore = motion.effectStates;
    return motion;
}

namespace
{

template<int Dim>
void addPlacements(const Motion<Dim>& motion, State& state)
{
    auto& translation = state.arrays["translation"];
    auto& rotation = state.arrays["rotation"];
    for (const Placement<Dim>& placement : motion.state.placements)
    {
        append(translation, placement.translation);
        append(rotation, rowsOf(placement.rotation));
    }
}

template<int Dim>
void addPoints(const Motion<Dim>& motion, State& state)
{
    auto& arrays = state.arrays;
    auto& features = arrays["contactFeature"];
    auto& gaps = arrays["contactGap"];
    auto& forces = arrays["contactForce"];
    auto& positions = arrays["contactPosition"];
    auto& normals = arrays["contactNormal"];
    for (std::size_t i = 0; i < motion.points.size(); ++i)
    {
        const ContactPoint<Dim>& point = motion.points[i];
        for (const int number : {point.block, point.neighbour, point.feature.vertexBlock,
                                 point.feature.vertex, point.feature.edge})
        {
            features.push_back(number);
        }
        gaps.push_back(point.gap);
        append(positions, point.position);
        append(normals, point.normal);
        append(forces, motion.contactForces[i]);
    }
    for (const Vector<Dim>& mean : motion.meanForces)
    {
        append(arrays["contactForceMean"], mean);
    }
}

} // namespace

template<int Dim>
State stateOf(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time)
{
    State state;
    const TimeState now = time.state();
    state.scalars = {{"time", now.value},
                     {"deltaT", now.deltaT},
                     {"timeIndex", static_cast<double>(now.index)},
                     {"timeOrigin", now.origin},
                     {"timeOriginIndex", static_cast<double>(now.originIndex)},
                     {"timeDetourEnd", now.detourEnd},
                     {"timeBeginning", now.beginning},
                     {"deltaTWanted", now.wanted},
                     {"deltaTGiven", now.given},
                     {"timeWrites", static_cast<double>(now.writeTimes)},
                     {"timeUnfinished", static_cast<double>(now.unfinished)},
                     {"stepLength", now.stepLength}};
    visitResiduals(motion.residuals,
                   [&](const char* name, auto value) { state.scalars[name] = static_cast<double>(value); });
    visitLedger(motion.energy, [&](const char* name, double value) { state.scalars[name] = value; });
    if (scene.schemes.effects.selection == EffectSelection::automatic) // which tries what they let hope for
    {
        state.scalars["stepSlides"] = motion.slides ? 1 : 0;
        state.scalars["stepCollisions"] = motion.collisions;
        state.scalars["stepsInVain"] = motion.stepsInVain;
    }
    if (motion.overlapsLeft > 0)
    {
        state.scalars["stepOverlapsLeft"] = motion.overlapsLeft;
    }
    addPlacements(motion, state);
    state.arrays["velocity"].assign(motion.state.velocity.begin(), motion.state.velocity.end());
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        scene.effects[i]->save(motion.effectStates[i], state.arrays);
    }
    addPoints(motion, state);
    if (const InteriorStart& interior = motion.interior; !interior.isEmpty())
    {
        state.arrays["interiorForce"].assign(interior.contactForce.begin(), interior.contactForce.end());
        state.arrays["interiorOpening"].assign(interior.opening.begin(), interior.opening.end());
        state.arrays["interiorDisplacement"].assign(interior.displacement.begin(),
                                                    interior.displacement.end());
    }
    return state;
}

template State stateOf(const DynamicCase<2>& scene, const Motion<2>& motion, const Time& time);
template std::vector<Placement<2>> placementsIn<2>(const State& saved, std::size_t blocks);
template Motion<2> motionOf(const DynamicCase<2>& scene, const State& saved);
template State stateOf(const DynamicCase<3>& scene, const Motion<3>& motion, const Time& time);
template std::vector<Placement<3>> placementsIn<3>(const State& saved, std::size_t blocks);
template Motion<3> motionOf(const DynamicCase<3>& scene, const State& saved);

} // namespace drystone
