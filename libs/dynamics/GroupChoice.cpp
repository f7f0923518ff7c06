// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The guess which blocks rest, and which move as one.
#include "dynamics/GroupChoice.h"

#include "conic/ProgramPart.h"
#include "core/DisjointSets.h"
#include "dynamics/BlockGroups.h"
#include "dynamics/MovingGeometry.h"
#include "geometry/Rotation.h"

#include <algorithm>
#include <optional>
#include <set>

namespace drystone
{
namespace
{

/// A block that is slower than this part of the fastest is held, if that is proved: the motion of a wall that
/// breaks dies out into it by powers of ten, and ends where the solver's error begins.
constexpr double heldSpeed = 1e-9;

/// See isCreeping.
constexpr double creeping = 1e-5;

/// Joined blocks are worth it if they make no more bodies than this part of the blocks that are not held, and
/// if these are many, far fewer: in a wall that breaks some of so many bodies always part.
constexpr double worthJoining = 0.5;
constexpr double worthJoiningMany = 0.1;
constexpr long many = 100;

/// Of the error allowed in gaps: on the length of a joint, and many joints on each other, a gap adds up to
/// more.
constexpr double partOfGap = 0.1;

/// And of that what blocks that are one may keep, or move against each other: walls that turn in a few bodies
/// of many courses are off by twenty times as much at their top.
constexpr double partKeptByBodies = 0.1;

/// Of more failing points than these it is not where bodies have to be parted that is to be learned.
constexpr std::size_t fewFailing = 20;

/// So many neighbours deep blocks wake up.
constexpr int rings = 2;

/// How points move that are at an arm from the centre of a block which has turned until now, but for the
/// linear part of it: they were at R(-t) arm, and so have moved by arm - R(-t) arm, not by t x arm.
template<int Dim>
class BentMotion
{
public:
    using Rows = Eigen::Matrix<double, rotationCount<Dim>, 1>;

    explicit BentMotion(const Rows& ofBlock) : turn(ofBlock), back(turnOf<Dim>(Rows(-ofBlock))) {}

    Vector<Dim> operator()(const Vector<Dim>& arm) const
    {
        return -back(arm) - velocityOfArm(turnOf<Dim>(turn), arm);
    }

    const Rows turn;

private:
    Swing<Dim> back;
};

} // namespace

template<int Dim>
double keptGap(const Step<Dim>& step)
{
    return partOfGap * step.settings.contactTolerance;
}

template<int Dim>
std::vector<double> motionsOfBlocks(const Eigen::VectorXd& rows, double blockSize)
{
    std::vector<double> motions(static_cast<std::size_t>(rows.size() / freedomCount<Dim>));
    for (std::size_t body = 0; body < motions.size(); ++body)
    {
        const auto own = rows.segment<freedomCount<Dim>>(freedomCount<Dim> * static_cast<Eigen::Index>(body));
        motions[body] =
            own.template head<Dim>().norm() + blockSize * own.template tail<rotationCount<Dim>>().norm();
    }
    return motions;
}

template<int Dim>
GroupChoice<Dim>::GroupChoice(const Step<Dim>& step) : current(step)
{
    holdSlowBlocks();
    joinBlocks();
    number();
    const auto moving = std::count(isHeld.begin(), isHeld.end(), false);
    const double worth = moving > many ? worthJoiningMany : worthJoining;
    if (bodies() > worth * static_cast<double>(moving))
    {
        wakeBuffer();
    }
}

template<int Dim>
int GroupChoice<Dim>::bodies() const
{
    int count = 0;
    for (std::size_t body = 0; body < group.size(); ++body)
    {
        count += group[body] == static_cast<int>(body); // the first block of each
    }
    return count;
}

template<int Dim>
void GroupChoice<Dim>::holdSlowBlocks()
{
    const std::vector<double> speeds = motionsOfBlocks<Dim>(current.solved.velocity, current.scene.blockSize);
    const double fastest = speeds.empty() ? 0 : *std::max_element(speeds.begin(), speeds.end());
    const double held = heldSpeed * fastest;
    isSlow.resize(speeds.size());
    creeps.resize(speeds.size());
    for (std::size_t body = 0; body < speeds.size(); ++body)
    {
        isSlow[body] = speeds[body] <= held;
        creeps[body] = speeds[body] <= creeping * fastest;
    }
    wakeAtMovingSupports();
    isHeld = isSlow;
}

template<int Dim>
void GroupChoice<Dim>::wakeAtMovingSupports()
{
    const Eigen::VectorXd& closing = current.bySupports;
    for (Eigen::Index row = 0; row < closing.size(); row += Dim)
    {
        if (closing.template segment<Dim>(row).norm() > keptGap(current))
        {
            const auto& contact = current.program.contacts[static_cast<std::size_t>(row / Dim)];
            const int free = std::max(contact.first, contact.second); // the other block is fixed
            isSlow[static_cast<std::size_t>(free)] = false;
        }
    }
}

template<int Dim>
void GroupChoice<Dim>::joinBlocks()
{
    const StepProgram<Dim>& program = current.program;
    isJoined.assign(program.contacts.size(), false);
    const double kept = partKeptByBodies * keptGap(current);
    const std::vector<Vector<Dim>> centre = centresOfBodies(current);
    const Eigen::VectorXd moved = current.scheme.timeStep * current.solved.velocity;
    const auto turn = [&moved](int body)
    { return moved.segment<rotationCount<Dim>>(freedomCount<Dim> * body + Dim); };
    std::pair<int, int> pair{-1, -1};
    bool turnsAsOne = false;
    Vector<Dim> bent = Vector<Dim>::Zero(); // of the second block against the first
    std::optional<BentMotion<Dim>> bending; // blocks that are one have the same
    for (std::size_t point = 0; point < isJoined.size(); ++point)
    {
        const auto& contact = program.contacts[point];
        const Eigen::Index row = Dim * static_cast<Eigen::Index>(point);
        if (contact.first < 0 || contact.second < 0 || !(current.guess.contactForce[row] > 0)
            || std::abs(program.gap[row]) > kept)
        {
            continue;
        }
        const auto first = static_cast<std::size_t>(contact.first);
        const auto second = static_cast<std::size_t>(contact.second);
        if (pair != std::pair{contact.first, contact.second})
        {
            pair = {contact.first, contact.second};
            turnsAsOne =
                !isHeld[first] && !isHeld[second]
                && current.scene.blockSize * (turn(contact.first) - turn(contact.second)).norm() <= kept;
            // Blocks that turn alike differ by their arms to the point only, and these by the centres.
            if (turnsAsOne && !(bending && bending->turn == turn(contact.second)))
            {
                bending.emplace(turn(contact.second));
            }
            bent = turnsAsOne ? (*bending)(centre[first] - centre[second]) : Vector<Dim>(Vector<Dim>::Zero());
        }
        double squares = 0; // of what it closes and slides by
        for (int component = 0; component < Dim; ++component)
        {
            const double closing = closingAlong(contact, component, moved)
                                   + contact.onSecond.col(component).template head<Dim>().dot(bent);
            squares += closing * closing;
        }
        isJoined[point] = turnsAsOne && squares <= kept * kept;
    }
}

template<int Dim>
void GroupChoice<Dim>::number()
{
    DisjointSets together(isHeld.size());
    for (std::size_t point = 0; point < isJoined.size(); ++point)
    {
        if (isJoined[point])
        {
            together.join(current.program.contacts[point].first, current.program.contacts[point].second);
        }
    }
    group.resize(isHeld.size());
    for (std::size_t body = 0; body < group.size(); ++body)
    {
        group[body] = isHeld[body] ? -1 : together.firstOf(static_cast<int>(body));
    }
}

template<int Dim>
void GroupChoice<Dim>::wakeNeighbours(std::vector<char> isAwake)
{
    isAwake = withNeighbours(current.program, std::move(isAwake), rings);
    for (std::size_t body = 0; body < isHeld.size(); ++body)
    {
        isHeld[body] = isHeld[body] && !isAwake[body];
    }
}

template<int Dim>
void GroupChoice<Dim>::wakeBuffer()
{
    std::vector<char> isAwake(isHeld.size());
    std::transform(isHeld.begin(), isHeld.end(), isAwake.begin(), [](char held) { return !held; });
    wakeNeighbours(std::move(isAwake));
    isJoined.assign(isJoined.size(), false);
    number();
}

template<int Dim>
void GroupChoice<Dim>::change(const std::vector<std::size_t>& failing)
{
    const StepProgram<Dim>& program = current.program;
    if (failing.empty() || (!hasBuffer() && failing.size() > fewFailing))
    {
        wakeBuffer();
        return;
    }
    std::set<std::pair<int, int>> parted;
    std::vector<char> isAwake(isHeld.size(), false);
    bool isAnyHeld = false;
    for (const std::size_t point : failing)
    {
        const auto& contact = program.contacts[point];
        parted.emplace(contact.first, contact.second);
        for (const int body : {contact.first, contact.second})
        {
            if (body >= 0 && isHeld[static_cast<std::size_t>(body)])
            {
                isAwake[static_cast<std::size_t>(body)] = true;
                isAnyHeld = true;
            }
        }
    }
    if (isAnyHeld)
    {
        wakeNeighbours(std::move(isAwake));
    }
    for (std::size_t point = 0; point < isJoined.size(); ++point)
    {
        const auto& contact = program.contacts[point];
        isJoined[point] = isJoined[point] && !parted.count({contact.first, contact.second});
    }
    number();
    partWholly(failing);
}

template<int Dim>
void GroupChoice<Dim>::partWholly(const std::vector<std::size_t>& failing)
{
    const StepProgram<Dim>& program = current.program;
    std::set<int> still; // in one by way of other blocks
    for (const std::size_t point : failing)
    {
        const auto& contact = program.contacts[point];
        if (contact.first >= 0 && contact.second >= 0)
        {
            const int one = group[static_cast<std::size_t>(contact.first)];
            if (one >= 0 && one == group[static_cast<std::size_t>(contact.second)])
            {
                still.insert(one);
            }
        }
    }
    if (still.empty())
    {
        return;
    }
    for (std::size_t point = 0; point < isJoined.size(); ++point)
    {
        isJoined[point] =
            isJoined[point] && !still.count(group[static_cast<std::size_t>(program.contacts[point].first)]);
    }
    number();
}

template double keptGap(const Step<2>& step);
template std::vector<double> motionsOfBlocks<2>(const Eigen::VectorXd& rows, double blockSize);
template class GroupChoice<2>;
template double keptGap(const Step<3>& step);
template std::vector<double> motionsOfBlocks<3>(const Eigen::VectorXd& rows, double blockSize);
template class GroupChoice<3>;

} // namespace drystone
