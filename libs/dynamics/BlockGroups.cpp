// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The program of groups of blocks: sums over each of them, and rigid motions back.
#include "dynamics/BlockGroups.h"

#include "conic/ActiveRays.h"
#include "geometry/Rotation.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace drystone
{
namespace
{

/// T' of the rows of one block.
template<int Dim>
BlockVector<Dim> atGroup(const Vector<Dim>& arm, BlockVector<Dim> rows)
{
    rows.template tail<rotationCount<Dim>>() += momentOf(arm, Vector<Dim>(rows.template head<Dim>()));
    return rows;
}

/// T of one block.
template<int Dim>
BlockVector<Dim> linearOfBlock(const Vector<Dim>& arm, const BlockVector<Dim>& ofGroup)
{
    BlockVector<Dim> own = ofGroup;
    own.template head<Dim>() += velocityOfArm(turnOf<Dim>(ofGroup.template tail<rotationCount<Dim>>()), arm);
    return own;
}

/// Adds T'Mbar T of one block: about another point than its mass centre (Steiner), but for what the masses of
/// all have about their common centre, which is nothing.
template<int Dim>
void addInertiaAbout(const Vector<Dim>& arm, const BlockMatrix<Dim>& inertia, BlockMatrix<Dim>& sum)
{
    const double mass = inertia(0, 0);
    sum += inertia;
    auto tensor = sum.template bottomRightCorner<rotationCount<Dim>, rotationCount<Dim>>();
    if constexpr (Dim == 2)
    {
        tensor(0, 0) += mass * arm.squaredNorm();
    }
    else
    {
        tensor += mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
    }
}

/// The columns of a point with the groups for bodies.
template<int Dim>
ConeColumns<freedomCount<Dim>, Dim> columnsOfGroups(const BlockGroups<Dim>& groups,
                                                    ConeColumns<freedomCount<Dim>, Dim> columns)
{
    const auto move = [&groups](int& body, auto& onBody)
    {
        if (body >= 0)
        {
            const Vector<Dim>& arm = groups.arm[static_cast<std::size_t>(body)];
            for (int column = 0; column < Dim; ++column)
            {
                onBody.col(column) = atGroup<Dim>(arm, BlockVector<Dim>(onBody.col(column)));
            }
            body = groups.of(body);
        }
    };
    move(columns.first, columns.onFirst);
    move(columns.second, columns.onSecond);
    return columns;
}

} // namespace

template<int Dim>
std::vector<Vector<Dim>> centresOfBodies(const Step<Dim>& step)
{
    std::vector<Vector<Dim>> centre(static_cast<std::size_t>(step.program.bodies));
    for (std::size_t block = 0; block < step.scene.free.size(); ++block)
    {
        if (const int body = step.scene.free[block]; body >= 0)
        {
            centre[static_cast<std::size_t>(body)] =
                step.scene.blocks[block].centroid + step.motion.state.placements[block].translation;
        }
    }
    return centre;
}

namespace
{

/// Renumbers groups in the order of their first blocks. \return how many there are
int numberConsecutively(std::vector<int>& group)
{
    const int largest = group.empty() ? -1 : *std::max_element(group.begin(), group.end());
    std::vector<int> numbers(static_cast<std::size_t>(largest + 1), -1);
    int count = 0;
    for (int& number : group)
    {
        if (number >= 0)
        {
            int& consecutive = numbers[static_cast<std::size_t>(number)];
            consecutive = consecutive < 0 ? count++ : consecutive;
            number = consecutive;
        }
    }
    return count;
}

std::vector<std::vector<int>> blocksOfGroups(const std::vector<int>& group, int count)
{
    std::vector<std::vector<int>> blocks(static_cast<std::size_t>(count));
    if (count == 1)
    {
        blocks.front().reserve(group.size());
    }
    for (std::size_t body = 0; body < group.size(); ++body)
    {
        if (group[body] >= 0)
        {
            blocks[static_cast<std::size_t>(group[body])].push_back(static_cast<int>(body));
        }
    }
    return blocks;
}

/// Finds the arms of blocks from the mass centres of their groups, and the spread of these.
template<int Dim>
void measureGroups(const Step<Dim>& step, BlockGroups<Dim>& groups)
{
    const std::vector<Vector<Dim>> centre = centresOfBodies(step);
    const auto massOf = [&step](int body)
    { return step.program.inertia[static_cast<std::size_t>(body)](0, 0); };
    groups.arm.assign(centre.size(), Vector<Dim>::Zero());
    groups.spread.assign(groups.blocks.size(), PackedMatrix<Dim>::Zero());
    for (std::size_t number = 0; number < groups.blocks.size(); ++number)
    {
        const std::vector<int>& blocks = groups.blocks[number];
        if (blocks.size() == 1)
        {
            continue;
        }
        // From the centre of the first, so that a structure far from the origin keeps its digits.
        const Vector<Dim>& first = centre[static_cast<std::size_t>(blocks.front())];
        Vector<Dim> mean = Vector<Dim>::Zero();
        double mass = 0;
        for (const int body : blocks)
        {
            mean += massOf(body) * (centre[static_cast<std::size_t>(body)] - first);
            mass += massOf(body);
        }
        mean /= mass;
        for (const int body : blocks)
        {
            Vector<Dim>& arm = groups.arm[static_cast<std::size_t>(body)];
            arm = (centre[static_cast<std::size_t>(body)] - first) - mean;
            groups.spread[number] += (massOf(body) * arm).lazyProduct(arm.transpose());
        }
    }
}

template<int Dim>
void sortPoints(const StepProgram<Dim>& program, BlockGroups<Dim>& groups)
{
    groups.outer.reserve(program.contacts.size());
    groups.inner.reserve(program.contacts.size());
    for (std::size_t point = 0; point < program.contacts.size(); ++point)
    {
        const auto& contact = program.contacts[point];
        (groups.of(contact.first) != groups.of(contact.second) ? groups.outer : groups.inner)
            .push_back(point);
    }
}

} // namespace

template<int Dim>
BlockGroups<Dim> blockGroups(const Step<Dim>& step, std::vector<int> group)
{
    BlockGroups<Dim> groups;
    const int count = numberConsecutively(group);
    groups.group = std::move(group);
    groups.blocks = blocksOfGroups(groups.group, count);
    measureGroups(step, groups);
    sortPoints(step.program, groups);
    return groups;
}

template<int Dim>
Eigen::VectorXd rowsOfGroups(const BlockGroups<Dim>& groups, const Eigen::VectorXd& rows)
{
    constexpr int size = freedomCount<Dim>;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size * groups.count());
    for (std::size_t body = 0; body < groups.group.size(); ++body)
    {
        if (groups.group[body] >= 0)
        {
            sum.segment<size>(size * groups.group[body]) +=
                atGroup<Dim>(groups.arm[body],
                             BlockVector<Dim>(rows.segment<size>(size * static_cast<Eigen::Index>(body))));
        }
    }
    return sum;
}

template<int Dim>
Eigen::VectorXd linearDisplacement(const BlockGroups<Dim>& groups, const Eigen::VectorXd& ofGroups)
{
    constexpr int size = freedomCount<Dim>;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(size * static_cast<Eigen::Index>(groups.group.size()));
    for (std::size_t body = 0; body < groups.group.size(); ++body)
    {
        if (groups.group[body] >= 0)
        {
            y.segment<size>(size * static_cast<Eigen::Index>(body)) = linearOfBlock<Dim>(
                groups.arm[body], BlockVector<Dim>(ofGroups.segment<size>(size * groups.group[body])));
        }
    }
    return y;
}

template<int Dim>
Eigen::VectorXd displacementOfBlocks(const BlockGroups<Dim>& groups, const Eigen::VectorXd& ofGroups,
                                     const std::vector<char>& which)
{
    constexpr int size = freedomCount<Dim>;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(size * static_cast<Eigen::Index>(groups.group.size()));
    for (std::size_t group = 0; group < groups.blocks.size(); ++group)
    {
        const BlockVector<Dim> own = ofGroups.segment<size>(size * static_cast<Eigen::Index>(group));
        const std::vector<int>& blocks = groups.blocks[group];
        if (blocks.size() == 1)
        {
            y.segment<size>(size * blocks.front()) = own;
            continue;
        }
        const Swing<Dim> swing(turnOf<Dim>(own.template tail<rotationCount<Dim>>()));
        for (const int body : blocks)
        {
            if (which.empty() || which[static_cast<std::size_t>(body)])
            {
                auto rows = y.segment<size>(size * body);
                rows = own;
                rows.template head<Dim>() += swing(groups.arm[static_cast<std::size_t>(body)]);
            }
        }
    }
    return y;
}

template<int Dim>
StepProgram<Dim> programOfBlocks(const BlockGroups<Dim>& groups, const StepProgram<Dim>& whole)
{
    StepProgram<Dim> program;
    program.bodies = whole.bodies;
    program.inertia = whole.inertia;
    program.load = whole.load;
    program.gap = takenFrom<Dim>(groups.outer, whole.gap);
    program.contacts.reserve(groups.outer.size());
    program.friction.reserve(groups.outer.size());
    for (const std::size_t point : groups.outer)
    {
        program.contacts.push_back(whole.contacts[point]);
        program.friction.push_back(whole.friction[point]);
        if (whole.hasStrength())
        {
            program.strength.push_back(whole.strength[point]);
        }
    }
    return program;
}

template<int Dim>
StepProgram<Dim> programOfGroups(const BlockGroups<Dim>& groups, const StepProgram<Dim>& ofBlocks)
{
    StepProgram<Dim> program;
    program.bodies = groups.count();
    program.contacts.reserve(ofBlocks.contacts.size());
    for (const auto& columns : ofBlocks.contacts)
    {
        program.contacts.push_back(columnsOfGroups<Dim>(groups, columns));
    }
    program.friction = ofBlocks.friction;
    program.strength = ofBlocks.strength;
    program.inertia.assign(groups.blocks.size(), BlockMatrix<Dim>::Zero());
    for (std::size_t body = 0; body < groups.group.size(); ++body)
    {
        if (groups.group[body] >= 0)
        {
            addInertiaAbout<Dim>(groups.arm[body], ofBlocks.inertia[body],
                                 program.inertia[static_cast<std::size_t>(groups.group[body])]);
        }
    }
    program.load = rowsOfGroups(groups, ofBlocks.load);
    program.gap = ofBlocks.gap;
    return program;
}

namespace
{

/// Whether a start inside the cones is of use. Few bodies of the plane are solved by their active rays, which
/// pass no interior: one kept from an earlier step would be carried from step to step and grow old.
template<int Dim>
bool usesInterior(const StepProgram<Dim>& program)
{
    if constexpr (Dim == 2)
    {
        return !areFew(program);
    }
    else
    {
        return true;
    }
}

} // namespace

template<int Dim>
StepGuess guessOfGroups(const BlockGroups<Dim>& groups, const StepProgram<Dim>& ofBlocks,
                        const StepProgram<Dim>& program, const StepGuess& guess)
{
    const auto ofGroups = [&](const Eigen::VectorXd& displacement)
    {
        return displacement.size() == 0
                   ? displacement
                   : displacementUnder(program, rowsOfGroups(groups, applyInertia(ofBlocks, displacement)));
    };
    StepGuess own;
    own.displacement = ofGroups(guess.displacement);
    own.contactForce = takenFrom<Dim>(groups.outer, guess.contactForce);
    if (!guess.interior.isEmpty() && usesInterior(program))
    {
        own.interior = {takenFrom<Dim>(groups.outer, guess.interior.contactForce),
                        takenFrom<Dim>(groups.outer, guess.interior.opening),
                        ofGroups(guess.interior.displacement)};
    }
    return own;
}

template struct BlockGroups<2>;
template std::vector<Vector<2>> centresOfBodies(const Step<2>& step);
template BlockGroups<2> blockGroups(const Step<2>& step, std::vector<int> group);
template Eigen::VectorXd rowsOfGroups(const BlockGroups<2>& groups, const Eigen::VectorXd& rows);
template Eigen::VectorXd linearDisplacement(const BlockGroups<2>& groups, const Eigen::VectorXd& ofGroups);
template Eigen::VectorXd displacementOfBlocks(const BlockGroups<2>& groups, const Eigen::VectorXd& ofGroups,
                                              const std::vector<char>& which);
template StepProgram<2> programOfBlocks(const BlockGroups<2>& groups, const StepProgram<2>& whole);
template StepProgram<2> programOfGroups(const BlockGroups<2>& groups, const StepProgram<2>& ofBlocks);
template StepGuess guessOfGroups(const BlockGroups<2>& groups, const StepProgram<2>& ofBlocks,
                                 const StepProgram<2>& program, const StepGuess& guess);
template struct BlockGroups<3>;
template std::vector<Vector<3>> centresOfBodies(const Step<3>& step);
template BlockGroups<3> blockGroups(const Step<3>& step, std::vector<int> group);
template Eigen::VectorXd rowsOfGroups(const BlockGroups<3>& groups, const Eigen::VectorXd& rows);
template Eigen::VectorXd linearDisplacement(const BlockGroups<3>& groups, const Eigen::VectorXd& ofGroups);
template Eigen::VectorXd displacementOfBlocks(const BlockGroups<3>& groups, const Eigen::VectorXd& ofGroups,
                                              const std::vector<char>& which);
template StepProgram<3> programOfBlocks(const BlockGroups<3>& groups, const StepProgram<3>& whole);
template StepProgram<3> programOfGroups(const BlockGroups<3>& groups, const StepProgram<3>& ofBlocks);
template StepGuess guessOfGroups(const BlockGroups<3>& groups, const StepProgram<3>& ofBlocks,
                                 const StepProgram<3>& program, const StepGuess& guess);

} // namespace drystone
