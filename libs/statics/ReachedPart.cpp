// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The part that a live load reaches: guessed by distance, found by a small program, proved by another.
#include "statics/ReachedPart.h"

#include "conic/ProgramPart.h"
#include "conic/form/Form.h"
#include "statics/CompletedAnalysis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace drystone
{
namespace
{

/// Smaller structures are solved in a few milliseconds.
constexpr int fewBodies = 100;

/// A part of so many blocks is tried first, then ones so many times larger, up to this share of all: beyond
/// it they cost what the whole does.
constexpr int firstPart = 30;
constexpr double growth = 2.5;
constexpr double largestShare = 1.0 / 3;

/// A part that carries any load is too small, or the whole carries it too. After so many, and beyond this
/// share of the bodies, where parts begin to cost, the whole is solved.
constexpr int mostUnlimited = 2;
constexpr double shareOfUnlimited = 1.0 / 20;

/// A block is at rest if it moves by less than this part of the farthest: what the solver leaves.
constexpr double atRest = 1e-8;

/// Forces of blocks at rest are found closer than the answer is allowed to be, of which they are a part.
constexpr double partOfTolerance = 0.1;

template<int Rows, int Forces>
std::vector<char> loadedBodies(const ConeProgram<Rows, Forces>& program)
{
    std::vector<char> isLoaded(static_cast<std::size_t>(program.bodies));
    for (int body = 0; body < program.bodies; ++body)
    {
        isLoaded[static_cast<std::size_t>(body)] =
            !program.liveLoad.template segment<Rows>(Rows * body).isZero(0);
    }
    return isLoaded;
}

struct Neighbour
{
    int body;
    double force; ///< that presses the two together [N]
};

/// Of each body. \param forces F k
template<int Rows, int Forces>
std::vector<std::vector<Neighbour>> neighboursOf(const ConeProgram<Rows, Forces>& program,
                                                 const Eigen::VectorXd& forces)
{
    std::vector<std::vector<Neighbour>> neighbours(static_cast<std::size_t>(program.bodies));
    for (std::size_t point = 0; point < program.contacts.size(); ++point)
    {
        const auto& contact = program.contacts[point];
        if (contact.first < 0 || contact.second < 0)
        {
            continue;
        }
        const double normal = std::abs(forces[Forces * static_cast<Eigen::Index>(point)]);
        for (const auto& [from, to] :
             {std::pair(contact.first, contact.second), std::pair(contact.second, contact.first)})
        {
            std::vector<Neighbour>& own = neighbours[static_cast<std::size_t>(from)];
            if (own.empty() || own.back().body != to) // points of one pair stand together
            {
                own.push_back({to, 0});
            }
            own.back().force += normal;
        }
    }
    return neighbours;
}

/// Bodies in the order in which a live load probably reaches them, those first that it acts on: from body to
/// body it has to overcome the forces that press them together, and so the way to a body is as long as the
/// sum of these, along a row of a wall short, through its bed joints long.
/// \param most bodies that are requested
std::vector<int> bodiesByDistance(const std::vector<std::vector<Neighbour>>& neighbours,
                                  const std::vector<char>& isLoaded, std::size_t most)
{
    constexpr double ofFarther = 0.1; // of the mean force at a body, for each that is on the way
    double sum = 0;
    for (const std::vector<Neighbour>& ofBody : neighbours)
    {
        for (const Neighbour& neighbour : ofBody)
        {
            sum += neighbour.force / 2; // which both of a pair have
        }
    }
    const double step = ofFarther * sum / static_cast<double>(neighbours.size());
    using Place = std::pair<double, int>; // distance, body
    std::priority_queue<Place, std::vector<Place>, std::greater<>> next;
    for (std::size_t body = 0; body < isLoaded.size(); ++body)
    {
        if (isLoaded[body])
        {
            next.emplace(0, static_cast<int>(body));
        }
    }
    std::vector<char> isFound(neighbours.size(), false);
    std::vector<int> order;
    while (!next.empty() && order.size() < most)
    {
        const auto [distance, body] = next.top();
        next.pop();
        const auto at = static_cast<std::size_t>(body);
        if (isFound[at])
        {
            continue;
        }
        isFound[at] = true;
        order.push_back(body);
        for (const Neighbour& neighbour : neighbours[at])
        {
            next.emplace(distance + neighbour.force + step, neighbour.body);
        }
    }
    return order;
}

/// Whether each body is among the first of an order.
std::vector<char> firstOf(const std::vector<int>& order, double count, int bodies)
{
    std::vector<char> isFirst(static_cast<std::size_t>(bodies), false);
    for (std::size_t i = 0; i < order.size() && static_cast<double>(i) < count; ++i)
    {
        isFirst[static_cast<std::size_t>(order[i])] = true;
    }
    return isFirst;
}

template<int Rows, int Forces>
void removeMovingBodies(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& mechanism,
                        std::vector<char>& isPart)
{
    const double arm = meanLeverArm(program);
    const auto motionOf = [&](int body)
    {
        const auto own = mechanism.segment<Rows>(Rows * body);
        return std::max(own.template head<Forces>().template lpNorm<Eigen::Infinity>(),
                        arm * own.template tail<Rows - Forces>().template lpNorm<Eigen::Infinity>());
    };
    double farthest = 0;
    for (int body = 0; body < program.bodies; ++body)
    {
        farthest = std::max(farthest, motionOf(body));
    }
    for (int body = 0; body < program.bodies; ++body)
    {
        char& isOwn = isPart[static_cast<std::size_t>(body)];
        isOwn = isOwn && motionOf(body) <= atRest * farthest;
    }
}

/// Finds c_D of the program unless it is known. \param work is added to
template<int Rows, int Forces>
void carryDeadLoad(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                   CarriedDeadLoad<Rows, Forces>& carried, SymbolicAnalysis& kept, ConeSolution& work)
{
    const auto size = Forces * static_cast<Eigen::Index>(program.points());
    if (carried.load.size() == program.load.size() && carried.load == program.load
        && (carried.contactForce.size() == 0 || carried.contactForce.size() == size))
    {
        return;
    }
    ConeProgram<Rows, Forces> dead = program;
    dead.liveLoad.resize(0);
    const ConeSolution resting = solveInteriorPoint(dead, settings, &kept);
    addWork(work, resting);
    carried.load = program.load;
    carried.contactForce = resting.status == SolveStatus::optimal ? resting.contactForce : Eigen::VectorXd();
    carried.changes.reset();
}

/// Forces of the whole that collapse at the multiplier of a part, where blocks about it at rest bear what it
/// gives them. \param collapse of the part, as a solution of the whole; its contact forces are those of the
/// part, and zero elsewhere \param isAround the part and what is about it \return F k, or empty
template<int Rows, int Forces>
Eigen::VectorXd forcesOfWhole(const ConeProgram<Rows, Forces>& program, const ProgramPart<Rows, Forces>& part,
                              const ConeSolution& collapse, std::vector<char> isAround,
                              CarriedDeadLoad<Rows, Forces>& carried, const InteriorPointSettings& settings,
                              ConeSolution& work)
{
    if (!carried.changes)
    {
        carried.changes.emplace(program, carried.contactForce);
        ++work.factorisations;
    }
    InteriorPointSettings closer = settings;
    closer.tolerance *= partOfTolerance;
    const Eigen::VectorXd live = collapse.multiplier * program.liveLoad;
    const Eigen::VectorXd change = carried.changes->under(live, closer.tolerance);
    if (change.size() == 0)
    {
        return {};
    }
    Eigen::VectorXd forces = carried.contactForce + change;
    putInto<Forces>(part.points, takenFrom<Forces>(part.points, collapse.contactForce), forces);
    removeMovingBodies(program, collapse.displacement, isAround);
    ProgramPart<Rows, Forces> resting = partUnderForces(program, forces, isAround);
    if (resting.program.bodies > 0)
    {
        resting.program.load += collapse.multiplier * resting.program.liveLoad;
        resting.program.liveLoad.resize(0);
        const ConeSolution held = solveInteriorPoint(resting.program, closer);
        addWork(work, held);
        if (held.status != SolveStatus::optimal)
        {
            return {};
        }
        putInto<Forces>(resting.points, held.contactForce, forces);
    }
    return forces;
}

/// The collapse of a part as one of the whole, with forces of all blocks. \param isAround the part and what
/// is about it \param whole its work is added to \return whether there are such forces
template<int Rows, int Forces>
bool extendToWhole(const ConeProgram<Rows, Forces>& program, const ProgramPart<Rows, Forces>& part,
                   const ConeSolution& ofPart, std::vector<char> isAround,
                   CarriedDeadLoad<Rows, Forces>& carried, const InteriorPointSettings& settings,
                   ConeSolution& whole)
{
    whole.status = SolveStatus::optimal;
    whole.multiplier = ofPart.multiplier;
    whole.displacement = Eigen::VectorXd::Zero(program.load.size());
    putInto<Rows>(part.bodies, ofPart.displacement, whole.displacement);
    whole.contactForce = Eigen::VectorXd::Zero(carried.contactForce.size());
    putInto<Forces>(part.points, ofPart.contactForce, whole.contactForce);
    whole.contactForce = forcesOfWhole(program, part, whole, std::move(isAround), carried, settings, whole);
    whole.forceOfLoadAlone = carried.contactForce;
    return whole.contactForce.size() > 0;
}

} // namespace

template<int Rows, int Forces>
std::optional<LimitAnalysis>
analyseReachedPart(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                   CarriedDeadLoad<Rows, Forces>& carried, SymbolicAnalysis& kept)
{
    const std::vector<char> isLoaded = loadedBodies(program);
    const auto loaded = static_cast<double>(std::count(isLoaded.begin(), isLoaded.end(), true));
    const double most = largestShare * program.bodies;
    if (program.bodies < fewBodies || program.gap.size() > 0 || loaded == 0 || loaded > most)
    {
        return std::nullopt;
    }
    ConeSolution whole;
    carryDeadLoad(program, settings, carried, kept, whole);
    if (carried.contactForce.size() == 0)
    {
        return std::nullopt;
    }
    const std::vector<int> order = bodiesByDistance(neighboursOf(program, carried.contactForce), isLoaded,
                                                    static_cast<std::size_t>(growth * most));
    int unlimited = 0;
    for (double bodies = std::max<double>(firstPart, loaded); bodies <= most; bodies *= growth)
    {
        const std::vector<char> isPart = firstOf(order, bodies, program.bodies);
        const ProgramPart<Rows, Forces> part = partWithOthersHeld(program, isPart);
        const ConeSolution solution = solveInteriorPoint(part.program, settings);
        addWork(whole, solution);
        unlimited += solution.status == SolveStatus::unbounded ? 1 : 0;
        if (unlimited >= mostUnlimited && part.program.bodies > shareOfUnlimited * program.bodies)
        {
            break;
        }
        if (solution.status != SolveStatus::optimal)
        {
            continue;
        }
        std::vector<char> isAround =
            withNeighbours(program, firstOf(order, growth * bodies, program.bodies), 1);
        if (!extendToWhole(program, part, solution, std::move(isAround), carried, settings, whole))
        {
            continue;
        }
        LimitAnalysis result = completedAnalysis(program, whole, settings, kept);
        if (result.status == CollapseStatus::optimal && result.certificate.worst() <= settings.tolerance)
        {
            result.isSimulated = isPart;
            return result;
        }
    }
    return std::nullopt;
}

template struct CarriedDeadLoad<3, 2>;
template std::optional<LimitAnalysis> analyseReachedPart(const PlaneConeProgram&,
                                                         const InteriorPointSettings&, CarriedDeadLoad<3, 2>&,
                                                         SymbolicAnalysis&);
template struct CarriedDeadLoad<6, 3>;
template std::optional<LimitAnalysis> analyseReachedPart(const SpaceConeProgram&,
                                                         const InteriorPointSettings&, CarriedDeadLoad<6, 3>&,
                                                         SymbolicAnalysis&);

} // namespace drystone
