// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/Motion.h"

#include "conic/RayProgram.h"
#include "dynamics/PartedStep.h"
#include "dynamics/StepWithImpacts.h"
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace drystone
{
namespace
{

constexpr int mostHalvings = 10;

/// The ends of an unbroken bond are no farther apart than this, in mean block sizes: what steps leave of
/// slips adds up.
constexpr double bondReach = 1e-3;

/// A bond gives way when its point moves by more than this part of what the step moves the blocks by, or by
/// more than the error allowed in gaps.
constexpr double yieldsBy = 1e-2;

double kineticEnergy(const DynamicCase& scene, const Eigen::VectorXd& velocity)
{
    return 0.5 * scene.mass.dot(velocity.cwiseAbs2());
}

/// Of the dead load, a constant generalised force on each block.
double potentialEnergy(const DynamicCase& scene, const std::vector<Placement<2>>& placements)
{
    double energy = 0;
    for (std::size_t block = 0; block < placements.size(); ++block)
    {
        if (scene.free[block] >= 0)
        {
            const auto load = scene.deadLoad.segment<3>(3 * scene.free[block]);
            energy -=
                load.head<2>().dot(placements[block].translation) + load[2] * placements[block].rotation;
        }
    }
    return energy;
}

/// Largest acceleration that the loads alone give a block [m/s2].
double largestAcceleration(const DynamicCase& scene, const Eigen::VectorXd& load)
{
    double largest = 0;
    for (Eigen::Index row = 0; row < load.size(); row += 3)
    {
        largest = std::max(largest, load.segment<2>(row).norm() / scene.mass[row]);
    }
    return largest;
}

/// Of supports the mean from one instant to another, where they move. \param velocity of the free blocks
std::vector<Vector<3>> velocitiesOfAllBlocks(const DynamicCase& scene,
                                             const std::vector<Placement<2>>& placements,
                                             const Eigen::VectorXd& velocity, double from, double to)
{
    std::vector<Vector<3>> result =
        supportVelocities(scene.supportMotions, scene.assembly, scene.blocks, placements, from, to);
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        if (scene.free[block] >= 0)
        {
            result[block] = velocity.segment<3>(3 * scene.free[block]);
        }
    }
    return result;
}

/// Moves blocks by a share of the way that they go with their supports. \param steps see supportSteps
void moveWithSupports(std::vector<Placement<2>>& placements, const std::vector<SupportStep>& steps,
                      double share = 1)
{
    for (std::size_t block = 0; block < steps.size(); ++block)
    {
        const Vector<3> displacement = displacementAfter(steps[block], share);
        placements[block].translation += displacement.head<2>();
        placements[block].rotation += displacement[2];
    }
}

/// The placements that a step leads to, or a share of the way there. \param supports see supportSteps
std::vector<Placement<2>> moved(const DynamicCase& scene, const Motion& motion,
                                const Eigen::VectorXd& displacement, const std::vector<SupportStep>& supports,
                                double share = 1)
{
    std::vector<Placement<2>> placements = moved(motion.state.placements, scene.free, displacement, share);
    moveWithSupports(placements, supports, share);
    return placements;
}

/// By how much points close and slide because supports move, two a point [m]; empty where none does.
Eigen::VectorXd closingBySupports(const std::vector<ContactPoint<2>>& points,
                                  const std::vector<ContactColumns<2>>& columns,
                                  const std::vector<SupportStep>& supports)
{
    if (supports.empty())
    {
        return {};
    }
    Eigen::VectorXd closing(2 * static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const auto part = [&](const ContactColumns<2>::Matrix& column, int block) -> Vector<2>
        { return column.transpose() * displacementAfter(supports[static_cast<std::size_t>(block)]); };
        closing.segment<2>(2 * static_cast<Eigen::Index>(i)) =
            part(columns[i].onBlock, points[i].block) + part(columns[i].onNeighbour, points[i].neighbour);
    }
    return closing;
}

/// The blocks that have left the box stop where they are, and are left out from now on.
void deleteBlocks(const DynamicCase& scene, Motion& motion)
{
    if (!scene.contact.deletion || !motion.contacts)
    {
        return;
    }
    motion.isDeleted.resize(scene.free.size(), false);
    const auto& [lower, upper] = scene.contact.deletion->box;
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        const Vector<2> centre = scene.blocks[block].centroid + motion.state.placements[block].translation;
        const bool isOutside =
            centre.x() < lower[0] || centre.y() < lower[1] || centre.x() > upper[0] || centre.y() > upper[1];
        if (isOutside && scene.free[block] >= 0 && !motion.isDeleted[block])
        {
            motion.isDeleted[block] = true;
            motion.contacts->leaveOut(static_cast<int>(block));
            motion.state.velocity.segment<3>(3 * scene.free[block]).setZero();
        }
    }
}

/// No load on blocks that are out.
void unloadDeleted(const DynamicCase& scene, const Motion& motion, Eigen::VectorXd& load)
{
    for (std::size_t block = 0; block < motion.isDeleted.size(); ++block)
    {
        if (motion.isDeleted[block])
        {
            load.segment<3>(3 * scene.free[block]).setZero();
        }
    }
}

std::vector<ContactColumns<2>> columnsAt(const DynamicCase& scene,
                                         const std::vector<Placement<2>>& placements,
                                         const std::vector<ContactPoint<2>>& points)
{
    return equilibriumColumns(scene.assembly, placedMasses(scene.blocks, placements), points);
}

/// Which point of the last step each of this one is, or -1 where it is new.
std::vector<int> pointsOfLastStep(const Motion& motion, const std::vector<ContactPoint<2>>& points)
{
    std::vector<int> old(points.size(), -1);
    if (!motion.contacts)
    {
        std::iota(old.begin(), old.end(), 0); // they stay as built
        return old;
    }
    // Both lists are sorted by (block, neighbour); a pair has a handful of points.
    std::size_t first = 0;
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        const auto pairOf = [](const ContactPoint<2>& p) { return std::pair(p.block, p.neighbour); };
        while (first < motion.points.size() && pairOf(motion.points[first]) < pairOf(points[point]))
        {
            ++first;
        }
        for (std::size_t there = first;
             there < motion.points.size() && pairOf(motion.points[there]) == pairOf(points[point]); ++there)
        {
            if (motion.points[there].feature == points[point].feature)
            {
                old[point] = static_cast<int>(there);
            }
        }
    }
    return old;
}

/// What the points of the last step had, two numbers each, at those of this one; zero where a point is new.
/// \param valueOf a point of the last step
template<typename ValueOf>
Eigen::VectorXd atPoints(const std::vector<int>& old, const ValueOf& valueOf)
{
    Eigen::VectorXd values = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(old.size()));
    for (std::size_t point = 0; point < old.size(); ++point)
    {
        if (old[point] >= 0)
        {
            values.segment<2>(2 * static_cast<Eigen::Index>(point)) = valueOf(old[point]);
        }
    }
    return values;
}

/// A step's guess: where the blocks are heading, and what the last step knew of its points.
StepGuess guessFrom(const Motion& motion, const std::vector<ContactPoint<2>>& points, double timeStep)
{
    const std::vector<int> old = pointsOfLastStep(motion, points);
    const auto of = [](const Eigen::VectorXd& values)
    { return [&values](int point) { return values.segment<2>(2 * point); }; };
    StepGuess guess;
    guess.displacement = timeStep * motion.state.velocity;
    guess.contactForce =
        atPoints(old, [&](int point) { return motion.contactForces[static_cast<std::size_t>(point)]; });
    if (const InteriorStart& interior = motion.interior; !interior.isEmpty())
    {
        guess.interior = {atPoints(old, of(interior.contactForce)), atPoints(old, of(interior.opening)),
                          interior.displacement};
    }
    return guess;
}

/// Which unbroken bond holds each point.
std::vector<int> bondsAt(const DynamicCase& scene, const Motion& motion, const std::vector<char>& isBroken,
                         const std::vector<ContactPoint<2>>& points)
{
    if (motion.contacts)
    {
        return bondsOfPoints(scene.bonds, isBroken, scene.blocks, motion.state.placements, points,
                             bondReach * scene.blockSize);
    }
    std::vector<int> bondOfPoint(points.size()); // they stay as built, in the order of the bonds
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        bondOfPoint[point] = isBroken[point] ? -1 : static_cast<int>(point);
    }
    return bondOfPoint;
}

/// Whether a bond holds any of the points.
bool isAnyHeld(const std::vector<int>& bondOfPoint)
{
    return std::any_of(bondOfPoint.begin(), bondOfPoint.end(), [](int bond) { return bond >= 0; });
}

/// Lets the bonds that are whole hold their points where they were joined. One that is left without a point
/// is broken. \return which bond holds each point
std::vector<int> holdBonds(const DynamicCase& scene, const Motion& motion,
                           const std::vector<ContactPoint<2>>& points, std::vector<char>& isBroken,
                           PlaneConeProgram& program)
{
    std::vector<int> bondOfPoint = bondsAt(scene, motion, isBroken, points);
    isBroken.assign(scene.bonds.size(), true);
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        if (bondOfPoint[point] >= 0)
        {
            const auto bond = static_cast<std::size_t>(bondOfPoint[point]);
            isBroken[bond] = false;
            if (motion.contacts)
            {
                const double opening =
                    openingOf(scene.bonds[bond], scene.blocks, motion.state.placements, points[point]);
                program.gap[2 * static_cast<Eigen::Index>(point)] =
                    std::abs(opening) <= scene.roundingGap ? 0 : opening;
            }
        }
    }
    if (isAnyHeld(bondOfPoint))
    {
        program.strength = strengthsOf(scene.bonds, bondOfPoint);
    }
    return bondOfPoint;
}

/// Without it a structure at rest, whose corners lie on its edges but for rounding, could only be certified
/// to stand as well as rounding compares with what gravity moves a block in one step: 1e-11.
void forgetRounding(const DynamicCase& scene, std::vector<ContactPoint<2>>& points)
{
    for (ContactPoint<2>& point : points)
    {
        point.gap = std::abs(point.gap) <= scene.roundingGap ? 0 : point.gap;
    }
}

/// How a point of a block, now at `position`, is displaced; to the last digits, however little that is [m].
Vector<2> displacementOf(const DynamicCase& scene, int block, const Vector<2>& position,
                         const std::vector<Placement<2>>& from, const std::vector<Placement<2>>& to)
{
    const auto index = static_cast<std::size_t>(block);
    const Vector<2> arm = position - scene.blocks[index].centroid - from[index].translation;
    const double turn = to[index].rotation - from[index].rotation;
    const double half = std::sin(turn / 2);
    return to[index].translation - from[index].translation + std::sin(turn) * Vector<2>(-arm.y(), arm.x())
           - 2 * half * half * arm;
}

/// By how far the neighbour has slid past the block at a contact point, along the edge there [m].
double slip(const DynamicCase& scene, const std::vector<Placement<2>>& from,
            const std::vector<Placement<2>>& to, const ContactPoint<2>& point)
{
    const auto edgeBlock =
        static_cast<std::size_t>(point.feature.vertexBlock == point.block ? point.neighbour : point.block);
    const Eigen::Rotation2Dd turn(to[edgeBlock].rotation - from[edgeBlock].rotation);
    return (turn * tangent(point))
        .dot(displacementOf(scene, point.neighbour, point.position, from, to)
             - displacementOf(scene, point.block, point.position, from, to));
}

/// Lets an overlap that is there when a step begins stay for now, all but what the loads would move a block
/// in the step from rest. Closed at once, an overlap d would throw the blocks apart with d/dt, the faster the
/// shorter the step. Overlaps that steps leave are smaller than the tolerance and are closed. \return whether
/// there was any
bool leaveOverlaps(PlaneConeProgram& program, double tolerance, double reach)
{
    bool isAny = false;
    for (int point = 0; point < program.points(); ++point)
    {
        const double left = -program.gap[2 * point] - tolerance - reach;
        if (left > 0)
        {
            program.gap[2 * point] += left;
            isAny = true;
        }
    }
    return isAny;
}

/// Corrects the linear prediction of the gaps of moving contacts; see Relinearisation.
///
/// The angular momentum of a block about a fixed point changes over a step by c1 x m v1 - c0 x m v0 + J (w1 -
/// w0), c its mass centre. With c1 - c0 = dt (theta v1 + (1 - theta) v0) the first two are (c0 + (1 - theta)
/// (c1 - c0)) x m (v1 - v0): lever arms are to be taken there. For theta 1 these are the arms at the start,
/// for theta 1/2 those halfway.
/// Of the slip of a point, too: blocks that turn together by a finite angle do not slide on each other, but
/// linear prediction says they do, in proportion to the square of the angle; and where many blocks do so,
/// locked together, no forces would make it vanish.
/// \param ofEffects what effects, and overlaps that may stay, have put into the gaps, which the places of the
/// blocks do not show
Relinearisation movingContactGeometry(const DynamicCase& scene, const Motion& motion,
                                      const std::vector<ContactPoint<2>>& start,
                                      const Eigen::VectorXd& ofEffects,
                                      const std::vector<SupportStep>& supports)
{
    return [&scene, &motion, &start, &ofEffects, &supports](const Eigen::VectorXd& displacement,
                                                            const Eigen::VectorXd& contactForce,
                                                            PlaneConeProgram& program)
    {
        const Eigen::VectorXd linear = applyTransposed(program, displacement);
        std::vector<ContactPoint<2>> points;
        const double early = 1 - scene.schemes.timeIntegration.theta;
        if (early > 0)
        {
            const auto between = moved(scene, motion, displacement, supports, early);
            motion.contacts->measure(between, points);
            setColumns(program, columnsAt(scene, between, points));
        }
        const auto after = moved(scene, motion, displacement, supports);
        motion.contacts->measure(after, points);
        forgetRounding(scene, points);
        const Eigen::VectorXd closing =
            early > 0 ? applyTransposed(program, displacement) : Eigen::VectorXd(linear);
        double error = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const Eigen::Index row = 2 * static_cast<Eigen::Index>(i);
            const Eigen::Vector2d own =
                ofEffects.size() > 0 ? Eigen::Vector2d(ofEffects.segment<2>(row)) : Eigen::Vector2d::Zero();
            const double predicted = program.gap[row] - own[0] - linear[row];
            if (contactForce[row] != 0 || points[i].gap < 0)
            {
                error = std::max(error, std::abs(points[i].gap - predicted));
            }
            const double slid = slip(scene, motion.state.placements, after, start[i]);
            if (program.hasStrength() && program.strength[i].cohesion > 0) // where slip decides what holds
            {
                error = std::max(error, std::abs(slid + program.gap[row + 1] - own[1] - linear[row + 1]));
            }
            program.gap[row] = points[i].gap + closing[row] + own[0];
            program.gap[row + 1] = closing[row + 1] - slid + own[1];
        }
        return error;
    };
}

/// Takes the bonds that a solved step would open or shear out of its program. \return how many
int breakBonds(const StepProblem& problem, const ThetaStep& step, PlaneConeProgram& program,
               std::vector<int>& bondOfPoint, std::vector<char>& isBroken)
{
    const DynamicCase& scene = problem.scene;
    const StepSettings& settings = problem.settings;
    const Eigen::VectorXd opening = openingAtEnd(program, step, problem.relinearise);
    const double farthest = farthestMotion(step.displacement, scene.blockSize);
    // What a solver leaves of forces out of balance moves the blocks as well: the gap of its certificate is
    // of second order in them.
    const double leftover =
        std::sqrt(settings.solver.tolerance) * problem.acceleration * problem.timeStep * problem.timeStep;
    const YieldTolerance tolerance{
        std::max(leftover, std::min(settings.contactTolerance, yieldsBy * farthest)) + 2 * scene.roundingGap,
        10 * settings.solver.tolerance * step.contactForce.lpNorm<Eigen::Infinity>()};
    const std::vector<int> givingWay =
        bondsGivingWay(program, bondOfPoint, opening, step.contactForce, tolerance);
    for (const int bond : givingWay)
    {
        isBroken[static_cast<std::size_t>(bond)] = true;
        const auto point = static_cast<std::size_t>(std::find(bondOfPoint.begin(), bondOfPoint.end(), bond)
                                                    - bondOfPoint.begin());
        bondOfPoint[point] = -1;
        program.strength[point] = {};
    }
    if (!isAnyHeld(bondOfPoint))
    {
        program.strength.clear();
    }
    return static_cast<int>(givingWay.size());
}

void keepLedger(const DynamicCase& scene, Motion& motion, const StepEnergy& step, double externalWork)
{
    EnergyLedger& energy = motion.energy;
    energy.externalWork += externalWork;
    energy.frictionLoss += step.frictionLoss;
    energy.impactLoss += step.normalLoss;
    energy.algorithmicLoss += step.algorithmicLoss;
    energy.elastic += step.elasticChange;
    energy.dampingLoss += step.dampingLoss;
    energy.kinetic = kineticEnergy(scene, motion.state.velocity);
    energy.potential = potentialEnergy(scene, motion.state.placements);
}

/// Where in a step blocks that are apart at its start collide.
struct ImpactChoice
{
    ImpactInstant instant;
    double tolerance;      ///< blocks that would meet within this time meet now [s]
    double shortestFlight; ///< blocks that would be back before this time do not rebound [s]
};

/// A step that is not parted. \return 1: it was solved; more than 0: blocks meet after this part of it, to
/// which the next attempt is to be shortened; 0: it was not solved. But for 1 only `attempt` has changed
double advanceUnparted(const DynamicCase& scene, Motion& motion, double timeStep, const ImpactChoice& impacts)
{
    const ThetaScheme scheme{scene.schemes.timeIntegration.theta, timeStep};
    StepSettings settings;
    settings.flowRule = scene.flowRule();
    settings.blockSize = scene.blockSize;
    settings.contactTolerance = scene.schemes.contactTolerance * scene.blockSize;
    settings.solver = scene.solution;
    settings.work = &motion.work;

    const double start = motion.state.time;
    Eigen::VectorXd load =
        loadUnder(scene, meanGroundAcceleration(scene.groundMotion, start, start + timeStep));
    unloadDeleted(scene, motion, load);
    const std::vector<SupportStep> supports = supportSteps(scene.supportMotions, scene.assembly, scene.blocks,
                                                           motion.state.placements, start, start + timeStep);
    const double acceleration = largestAcceleration(scene, load);

    // Contact points, and lever arms where the momenta want them.
    std::vector<ContactPoint<2>> points;
    std::vector<ContactColumns<2>> columns;
    if (motion.contacts)
    {
        const Eigen::VectorXd& velocity = motion.state.velocity;
        const auto velocities =
            velocitiesOfAllBlocks(scene, motion.state.placements, velocity, start, start + timeStep);
        const auto ahead = moved(scene, motion, timeStep * velocity, supports);
        points = motion.contacts->update(motion.state.placements, ahead,
                                         motion.contacts->marginFor(velocities, timeStep, acceleration));
        forgetRounding(scene, points);
        if (scheme.theta == 1)
        {
            columns = columnsAt(scene, motion.state.placements, points);
        }
        else
        {
            const auto between = moved(scene, motion, timeStep * velocity, supports, 1 - scheme.theta);
            std::vector<ContactPoint<2>> pointsBetween;
            motion.contacts->measure(between, pointsBetween);
            columns = columnsAt(scene, between, pointsBetween);
        }
    }
    else
    {
        points = motion.points;
        columns = equilibriumColumns(scene.assembly, scene.blocks, points);
    }

    PlaneConeProgram program = thetaStepProgram(scene.mass, motion.state.velocity, load, points, columns,
                                                frictionAt(scene, points), scheme);
    const StepGuess guess = guessFrom(motion, points, timeStep);
    const EffectContext context{scene.mass, guess.contactForce, motion.contactForces, scheme.timeStep};
    Eigen::VectorXd ofEffects;
    const Eigen::VectorXd gap = program.gap;
    // Points that give way overlap by what their forces press them together.
    const bool isOverlapLeft =
        !scene.contact.elasticity
        && leaveOverlaps(program, settings.contactTolerance, acceleration * timeStep * timeStep);
    std::vector<char> isBondBroken = motion.isBondBroken;
    std::vector<int> bondOfPoint;
    if (!scene.effects.empty() || !scene.bonds.empty() || isOverlapLeft)
    {
        for (const auto& effect : scene.effects)
        {
            effect->contribute(context, program);
        }
        if (!scene.bonds.empty())
        {
            bondOfPoint = holdBonds(scene, motion, points, isBondBroken, program);
        }
        ofEffects = program.gap - gap;
    }
    const Eigen::VectorXd bySupports = closingBySupports(points, columns, supports);
    if (bySupports.size() > 0)
    {
        program.gap -= bySupports;
    }
    const Relinearisation relinearise =
        motion.contacts ? movingContactGeometry(scene, motion, points, ofEffects, supports)
                        : Relinearisation();
    std::vector<ContactColumns<2>> columnsNow;
    const bool areOthers = motion.contacts && scheme.theta < 1 && hasImpacts(scene);
    if (areOthers)
    {
        columnsNow = columnsAt(scene, motion.state.placements, points);
    }
    const StepProblem problem{scene,
                              motion.state,
                              motion.symbolic.get(),
                              motion.work,
                              points,
                              areOthers ? &columnsNow : nullptr,
                              load,
                              bySupports,
                              settings,
                              timeStep,
                              guess,
                              relinearise,
                              acceleration,
                              impacts.instant,
                              impacts.tolerance,
                              0.5 * acceleration * impacts.shortestFlight};
    motion.attempt = {};
    StepSolution solved = solveWithImpacts(problem, program, motion.attempt);
    while (solved.isSolved && program.hasStrength()
           && breakBonds(problem, solved.step, program, bondOfPoint, isBondBroken) > 0)
    {
        solved = solveWithImpacts(problem, program, motion.attempt);
    }
    ThetaStep& step = solved.step;
    double workOfSupports = solved.workOfSupports;

    StepResiduals& residuals = motion.attempt;
    residuals.initialResidual = step.initialResidual;
    residuals.primalResidual = step.certificate.primalResidual;
    residuals.dualResidual = step.certificate.dualResidual;
    residuals.gap = step.certificate.gap;
    residuals.flowError = step.flowError;
    if (!solved.isSolved)
    {
        return solved.length < 1 ? solved.length : 0;
    }

    motion.residuals = motion.attempt;
    motion.interior = std::move(solved.step.interior);
    motion.bondsBrokenInStep = -brokenBonds(scene, motion);
    motion.isBondBroken = std::move(isBondBroken);
    motion.bondsBrokenInStep += brokenBonds(scene, motion);
    motion.state.velocity = solved.velocity;
    advance(motion.state, scene.free, step.displacement, scheme);
    moveWithSupports(motion.state.placements, supports);
    double keptInFlight = 0;
    if (solved.flight.size() > 0)
    {
        motion.state.placements = moved(std::move(motion.state.placements), scene.free, solved.flight);
        step.displacement += solved.flight;
        if (step.closing.size() > 0)
        {
            step.closing += applyTransposed(program, solved.flight);
        }
        const Eigen::VectorXd change = motion.state.velocity - solved.velocity;
        for (Eigen::Index row = 0; row < change.size(); row += 3)
        {
            const bool flies = !solved.flight.segment<3>(row).isZero(0);
            keptInFlight += flies ? (scheme.theta - 0.5)
                                        * change.segment<3>(row).cwiseAbs2().dot(scene.mass.segment<3>(row))
                                  : 0;
        }
    }
    StepEnergy energy = stepEnergy(step, scene.mass, load, solved.velocity, motion.state.velocity, scheme);
    energy.algorithmicLoss -= keptInFlight;
    constexpr double byLoads = 4; // twice the change of velocity, squared
    const double smooth = byLoads * (scheme.theta - 0.5) * timeStep * timeStep
                          * load.cwiseAbs2().cwiseQuotient(scene.mass).sum();
    motion.smoothLoss += std::min(energy.algorithmicLoss, smooth);
    // Points close and slide by A'y and by what the supports do, which work against the same forces.
    for (Eigen::Index row = 0; row < bySupports.size(); row += 2)
    {
        const double normalWork = step.contactForce[row] * bySupports[row];
        const double shearWork = step.contactForce[row + 1] * bySupports[row + 1];
        energy.normalLoss += normalWork;
        energy.frictionLoss += shearWork;
        workOfSupports += normalWork + shearWork;
    }
    for (const auto& effect : scene.effects)
    {
        effect->account(context, step, energy);
    }
    motion.energy.impactLoss += solved.lostInImpacts;
    motion.restitutionShare = solved.restitutionShare;
    double takenAlong = 0;
    if (scene.contact.deletion)
    {
        const double kineticBefore = kineticEnergy(scene, motion.state.velocity);
        deleteBlocks(scene, motion);
        takenAlong = kineticBefore - kineticEnergy(scene, motion.state.velocity);
    }
    keepLedger(scene, motion, energy,
               (load - scene.deadLoad).dot(step.displacement) + workOfSupports - takenAlong);

    motion.largestKinetic = std::max(motion.largestKinetic, motion.energy.kinetic);

    motion.points = std::move(points);
    if (motion.contacts)
    {
        motion.contacts->measure(motion.state.placements, motion.points);
    }
    motion.contactForces.resize(motion.points.size());
    for (std::size_t i = 0; i < motion.points.size(); ++i)
    {
        const Eigen::Index row = 2 * static_cast<Eigen::Index>(i);
        motion.contactForces[i] = step.contactForce.segment<2>(row);
        if (!motion.contacts)
        {
            motion.points[i].gap -= step.closing[row] + (bySupports.size() > 0 ? bySupports[row] : 0);
        }
    }
    motion.meanForces.clear();
    if (solved.impulse.size() > 0)
    {
        motion.meanForces = motion.contactForces;
        for (std::size_t i = 0; i < motion.points.size(); ++i)
        {
            motion.meanForces[i] += solved.impulse.segment<2>(2 * static_cast<Eigen::Index>(i)) / timeStep;
        }
    }
    return 1;
}

} // namespace

KeptAnalysis::KeptAnalysis() = default;
KeptAnalysis::KeptAnalysis(const KeptAnalysis&) {}
KeptAnalysis& KeptAnalysis::operator=(const KeptAnalysis&)
{
    return *this;
}
KeptAnalysis::~KeptAnalysis() = default;

SymbolicAnalysis* KeptAnalysis::get()
{
    if (!analysis_)
    {
        analysis_ = std::make_unique<SymbolicAnalysis>();
    }
    return analysis_.get();
}

Motion startMotion(const DynamicCase& scene, DynamicState state)
{
    Motion motion;
    motion.state = std::move(state);
    motion.isBondBroken =
        partedBonds(scene.bonds, scene.blocks, motion.state.placements, bondReach * scene.blockSize);
    if (!scene.schemes.smallDisplacements)
    {
        motion.contacts.emplace(scene.assembly);
        deleteBlocks(scene, motion);
        motion.points = motion.contacts->update(motion.state.placements, scene.roundingGap);
    }
    else
    {
        motion.points = findContactPoints(scene.assembly);
        const auto columns = equilibriumColumns(scene.assembly, scene.blocks, motion.points);
        std::mt19937_64 random(scene.schemes.initialGaps ? scene.schemes.initialGaps->seed : 0);
        const std::vector<Vector<3>> displacements = [&]
        {
            std::vector<Vector<3>> result;
            for (const Placement<2>& placement : motion.state.placements)
            {
                result.emplace_back(placement.translation.x(), placement.translation.y(), placement.rotation);
            }
            return result;
        }();
        for (std::size_t i = 0; i < motion.points.size(); ++i)
        {
            ContactPoint<2>& point = motion.points[i];
            if (scene.schemes.initialGaps)
            {
                // Of the generator's numbers themselves: std::uniform_real_distribution differs among
                // libraries.
                const double share = std::ldexp(double(random() >> 11), -53);
                const bool isHeld = !scene.bonds.empty() && !motion.isBondBroken[i];
                point.gap = isHeld ? 0 : scene.schemes.initialGaps->perturbation * share;
            }
            point.gap -= columns[i].onBlock.col(0).dot(displacements[point.block])
                         + columns[i].onNeighbour.col(0).dot(displacements[point.neighbour]);
        }
    }
    motion.contactForces.assign(motion.points.size(), Vector<2>::Zero());
    motion.energy.kinetic = kineticEnergy(scene, motion.state.velocity);
    motion.energy.potential = potentialEnergy(scene, motion.state.placements);
    motion.energy.opening = motion.energy.kinetic + motion.energy.potential;
    motion.largestKinetic = motion.energy.kinetic;
    return motion;
}

namespace
{

/// A step, in parts from impact to impact. \return whether it was solved; otherwise nothing but `attempt` and
/// `work` has changed
bool attemptStep(const DynamicCase& scene, Motion& motion, double timeStep)
{
    motion.work.beginAttempt();
    // Impacts are distinguished from the start of a step, and from each other, by this part of it. Attempts
    // at parts of a step are limited, so that bounces which grow shorter for ever, or blocks that hit each
    // other from all sides, do not part it without an end. Velocities are right to the tolerance of the
    // solver, and so are instants after a flight of some thousand steps: distinguished more finely, corners
    // that meet together would meet one after the other, and a block that bounces flat would begin to rock.
    constexpr double leastTolerance = 1e-3;
    constexpr double stepsOfFlight = 1e4;
    const double tolerance = std::max(leastTolerance, stepsOfFlight * scene.solution.tolerance);
    constexpr double shortestFlight = 0.1; // bounces that grow shorter for ever end with it
    constexpr int mostAttempts = 8;
    constexpr double mostWork = 0.1; // of what a step may take, before it is no longer parted
    const double start = motion.state.time;
    const bool isLocated = scene.schemes.impacts == ImpactInstant::located && tolerance < 1;
    ImpactChoice impacts{isLocated ? ImpactInstant::located : ImpactInstant::stepStart, tolerance * timeStep,
                         isLocated ? shortestFlight * timeStep : 0};
    std::optional<Motion> before; // where the step is parted
    PartedStep parts;
    double left = timeStep;
    double length = left;
    for (int attempts = 0; left > 0; ++attempts)
    {
        const bool isExpensive = motion.work.done > mostWork * motion.work.most;
        impacts.instant =
            attempts < mostAttempts && !isExpensive ? impacts.instant : ImpactInstant::stepStart;
        const double part = advanceUnparted(scene, motion, length, impacts);
        if (part == 0 && before)
        {
            // A part may be too short for the tolerance of the solver: then the step as a whole.
            const StepWork work = motion.work;
            motion = *before; // copied, so that its lists stay where they are: observers may hold on to them
            motion.work = work;
            motion.work.beginAttempt();
            return advanceUnparted(scene, motion, timeStep, {ImpactInstant::stepStart, 0, 0}) == 1;
        }
        if (part == 0)
        {
            return false;
        }
        if (part == 1 && !before)
        {
            return true;
        }
        parts.count(motion.attempt);
        if (part == 1)
        {
            parts.add(motion, length);
            left = length == left ? 0 : left - length;
            length = left;
            continue;
        }
        if (!before)
        {
            before = motion;
        }
        // What is left of the step is not shorter than what counts as its start.
        length = std::min(part * length, left - tolerance * timeStep);
        if (length <= 0)
        {
            length = left;
            impacts.instant = ImpactInstant::stepStart;
        }
    }
    parts.finish(motion);
    motion.state.time = start + timeStep; // as if it had not been parted, to the last digit
    return true;
}

StepWork allowedWork(const DynamicCase& scene)
{
    StepWork work;
    work.most = scene.solution.maximumFactorisations;
    return work;
}

} // namespace

bool advance(const DynamicCase& scene, Motion& motion, double timeStep)
{
    motion.work = allowedWork(scene);
    return attemptStep(scene, motion, timeStep);
}

bool advance(const DynamicCase& scene, Motion& motion, Time& time)
{
    motion.work = allowedWork(scene);
    double timeStep = time.deltaT();
    for (int retries = 0;; ++retries)
    {
        const bool isSolved = attemptStep(scene, motion, timeStep);
        motion.attempt.retries = retries;
        if (isSolved)
        {
            motion.residuals.retries = retries;
            motion.state.time = time.value(); // the sum of the steps may differ from it in the last digit
            break;
        }
        if (retries == mostHalvings || motion.work.isUsedUp())
        {
            time.abandonStep();
            return false;
        }
        timeStep /= 2;
        time.shortenStep(timeStep);
    }
    if (time.controls().adjustTimeStep)
    {
        double fastest = 0;
        for (const Vector<3>& velocity : velocitiesOfAllBlocks(
                 scene, motion.state.placements, motion.state.velocity, motion.state.time, motion.state.time))
        {
            fastest = std::max(fastest, velocity.head<2>().norm() + scene.blockSize * std::abs(velocity[2]));
        }
        const double allowed = std::min(scene.schemes.maxDeltaT, 1.2 * timeStep);
        const double reach = scene.schemes.maxDisplacement * scene.blockSize;
        time.setDeltaT(fastest * allowed > reach ? reach / fastest : allowed);
    }
    return true;
}

int brokenBonds(const DynamicCase& scene, const Motion& motion)
{
    int broken = 0;
    for (std::size_t bond = 0; bond < scene.bonds.size(); ++bond)
    {
        const bool isOne = scene.bonds[bond].strength.cohesion > 0 || scene.bonds[bond].strength.tension > 0;
        broken += isOne && motion.isBondBroken[bond] ? 1 : 0;
    }
    return broken;
}

std::vector<Strength> strengthsOf(const DynamicCase& scene, const Motion& motion)
{
    return scene.bonds.empty()
               ? std::vector<Strength>()
               : strengthsOf(scene.bonds, bondsAt(scene, motion, motion.isBondBroken, motion.points));
}

const std::vector<Vector<2>>& meanContactForces(const Motion& motion)
{
    return motion.meanForces.empty() ? motion.contactForces : motion.meanForces;
}

StepObservation<2> observe(const DynamicCase& scene, const Motion& motion, const Time& time,
                           ObservedLists& lists)
{
    lists.friction = frictionAt(scene, motion.points);
    lists.cohesion.clear();
    for (const Strength& strength : strengthsOf(scene, motion))
    {
        lists.cohesion.push_back(strength.cohesion);
    }
    lists.velocities.clear();
    for (const Vector<3>& velocity : velocitiesOfAllBlocks(
             scene, motion.state.placements, motion.state.velocity, motion.state.time, motion.state.time))
    {
        lists.velocities.push_back({velocity.head<2>(), velocity[2]});
    }
    StepObservation<2> seen;
    seen.time = time.value();
    seen.timeStep = time.value() - time.previousValue();
    seen.step = time.index();
    seen.assembly = &scene.assembly;
    seen.placements = motion.state.placements;
    seen.velocities = lists.velocities;
    seen.contactPoints = motion.points;
    seen.contactForces = meanContactForces(motion);
    seen.frictionCoefficients = lists.friction;
    seen.cohesions = lists.cohesion;
    seen.energy = motion.energy;
    seen.residuals = motion.residuals;
    return seen;
}

} // namespace drystone
