// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From programs to the arrays of the kernels and back.
#include "conic/lanes/LaneGeometry.h"

#include "conic/form/Form.h"
#include "conic/form/PowerOfTwo.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace drystone
{
namespace
{

bool isOnLine(const LaneFace& face, const LaneFace& other)
{
    return face.first == other.first && face.second == other.second && face.normal[0] == other.normal[0]
           && face.normal[1] == other.normal[1] && face.tangent[0] == other.tangent[0]
           && face.tangent[1] == other.tangent[1] && face.tangentMoment[0] == other.tangentMoment[0]
           && face.tangentMoment[1] == other.tangentMoment[1];
}

} // namespace

bool haveSamePoints(const std::vector<ConeColumns<3, 2>>& one, const std::vector<ConeColumns<3, 2>>& other)
{
    return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                      [](const ConeColumns<3, 2>& a, const ConeColumns<3, 2>& b) {
                          return a.first == b.first && a.second == b.second && a.onFirst == b.onFirst
                                 && a.onSecond == b.onSecond;
                      });
}

LaneGeometry::LaneGeometry(const PlaneConeProgram& program, int laneCount)
    : contacts(program.contacts), bodies(program.bodies), lever(powerOfTwo(meanLeverArm(program)))
{
    SymbolicAnalysis symbolic;
    analyse(program, symbolic);
    position = placesIn(symbolic.order);
    pattern = makeFactorPattern(makeBlockPattern(bodies, couplingsByPlace(symbolic.touching, position)));
    listProducts();
    for (const ConeColumns<3, 2>& columns : contacts)
    {
        addPoint(columns);
    }
    allotLanes(static_cast<std::size_t>(laneCount));
}

/// A point becomes part of the last face where it lies on the line of that one.
void LaneGeometry::addPoint(const ConeColumns<3, 2>& columns)
{
    const int one = columns.first < 0 ? bodies : position[columns.first];
    const int other = columns.second < 0 ? bodies : position[columns.second];
    // Of a body that does not move the rows may have been left out.
    Eigen::Matrix2d force = columns.first >= 0 ? Eigen::Matrix2d(columns.onFirst.topRows<2>())
                                               : Eigen::Matrix2d(-columns.onSecond.topRows<2>());
    Eigen::RowVector2d first =
        columns.first >= 0 ? Eigen::RowVector2d(columns.onFirst.row(2) / lever) : Eigen::RowVector2d(0, 0);
    Eigen::RowVector2d second =
        columns.second >= 0 ? Eigen::RowVector2d(columns.onSecond.row(2) / lever) : Eigen::RowVector2d(0, 0);
    if (other < one)
    {
        force = -force;
        first.swap(second);
    }
    const int count = static_cast<int>(points.size());
    LaneFace face{.first = std::min(one, other),
                  .second = std::max(one, other),
                  .begin = count,
                  .end = count + 1,
                  .friction = 0,
                  .firstDiagonal = -1,
                  .coupling = -1,
                  .secondDiagonal = -1,
                  .normal = {force(0, 0), force(1, 0)},
                  .tangent = {force(0, 1), force(1, 1)},
                  .tangentMoment = {first[1], second[1]}};
    points.push_back({{first[0], second[0]}});
    if (!faces.empty() && isOnLine(faces.back(), face))
    {
        ++faces.back().end;
        return;
    }
    face.firstDiagonal = face.first < bodies ? pattern.factor.slot(face.first, face.first) : -1;
    if (face.second < bodies)
    {
        face.coupling = pattern.factor.slot(face.first, face.second);
        face.secondDiagonal = pattern.factor.slot(face.second, face.second);
    }
    faces.push_back(face);
}

/// The products that each block of a factor takes away.
void LaneGeometry::listProducts()
{
    const BlockPattern& factor = pattern.factor;
    std::vector<std::vector<LaneProduct>> ofBlock(factor.row.size());
    std::vector<int> place(static_cast<std::size_t>(factor.columns()), -1);
    for (int column = 0; column < factor.columns(); ++column)
    {
        for (int entry = factor.columnStart[column]; entry < factor.columnStart[column + 1]; ++entry)
        {
            place[factor.row[entry]] = entry;
        }
        for (int update = pattern.updateStart[column]; update < pattern.updateStart[column + 1]; ++update)
        {
            const int first = pattern.updatePosition[update];
            for (int entry = first; entry < factor.columnStart[pattern.columnOf[update] + 1]; ++entry)
            {
                ofBlock[place[factor.row[entry]]].push_back({entry, first});
            }
        }
    }
    for (const std::vector<LaneProduct>& ofOne : ofBlock)
    {
        productStart.push_back(static_cast<int>(products.size()));
        products.insert(products.end(), ofOne.begin(), ofOne.end());
    }
    productStart.push_back(static_cast<int>(products.size()));
}

void LaneGeometry::allotLanes(std::size_t lanes)
{
    LaneNumbers& numbers = task.numbers;
    struct Share
    {
        double** array;
        std::size_t count;
    };
    const std::vector<Share> shares{
        {&numbers.friction, faces.size()},
        {&numbers.load, rows()},
        {&numbers.liveLoad, rows()},
        {&numbers.liveWork, 1},
        {&numbers.s, rays()},
        {&numbers.z, rays()},
        {&numbers.y, rows()},
        {&numbers.ratioS, rays()},
        {&numbers.ratioZ, rays()},
        {&numbers.correctionS, rays()},
        {&numbers.correctionZ, rays()},
        {&numbers.inverseZ, rays()},
        {&numbers.inverseProduct, rays()},
        {&numbers.leverage, rays()},
        {&numbers.balance, rows()},
        {&numbers.step, rows()},
        {&numbers.correction, rows()},
        {&numbers.target, rows()},
        {&numbers.liveSolution, rows()},
        {&numbers.blocks, 9 * pattern.factor.row.size()},
    };
    constexpr std::size_t aligned = 64 / sizeof(double);
    std::size_t count = aligned;
    for (const Share& share : shares)
    {
        count += share.count * lanes;
    }
    memory.assign(count, 0);
    const auto address = reinterpret_cast<std::uintptr_t>(memory.data()) / sizeof(double);
    double* next = memory.data() + (aligned - address % aligned) % aligned;
    for (const Share& share : shares)
    {
        *share.array = next;
        next += share.count * lanes;
    }
    task.graph = {.bodies = bodies,
                  .points = static_cast<int>(points.size()),
                  .faces = static_cast<int>(faces.size()),
                  .blocks = static_cast<int>(pattern.factor.row.size()),
                  .point = points.data(),
                  .face = faces.data(),
                  .columnStart = pattern.factor.columnStart.data(),
                  .row = pattern.factor.row.data(),
                  .productStart = productStart.data(),
                  .product = products.data(),
                  .updateStart = pattern.updateStart.data(),
                  .updatePosition = pattern.updatePosition.data(),
                  .updateColumn = pattern.columnOf.data()};
}

bool LaneGeometry::isOf(const PlaneConeProgram& program) const
{
    return bodies == program.bodies && haveSamePoints(contacts, program.contacts);
}

void LaneGeometry::allotPrograms(std::size_t count)
{
    while (rowsOf.size() < count)
    {
        const std::vector<double> ofRows(rows());
        const std::vector<double> ofRays(rays());
        rowsOf.push_back({std::vector<double>(faces.size()), ofRows, ofRows, ofRays, ofRays, ofRows, ofRays});
    }
    programs.assign(count, {});
    scales.resize(count);
    for (std::size_t index = 0; index < count; ++index)
    {
        ProgramRows& of = rowsOf[index];
        LaneProgram& program = programs[index];
        program.friction = of.friction.data();
        program.load = of.load.data();
        program.liveLoad = of.liveLoad.data();
        program.s = of.s.data();
        program.z = of.z.data();
        program.y = of.y.data();
        program.resting = of.resting.data();
    }
    task.programs = programs.data();
    task.programCount = static_cast<int>(count);
}

void LaneGeometry::setPrograms(const std::vector<const PlaneConeProgram*>& ofPrograms)
{
    allotPrograms(ofPrograms.size());
    task.frictionCount = setFriction(ofPrograms);
    for (std::size_t index = 0; index < ofPrograms.size(); ++index)
    {
        ProgramRows& rowsOfProgram = rowsOf[index];
        LaneScale& scale = scales[index];
        scale.load = setRows(ofPrograms[index]->load, rowsOfProgram.load.data());
        scale.liveLoad = setRows(ofPrograms[index]->liveLoad, rowsOfProgram.liveLoad.data());
        double sum = 0;
        for (const double row : rowsOfProgram.liveLoad)
        {
            sum += std::abs(row);
        }
        programs[index].liveWork = powerOfTwo(sum);
        scale.displacement = 1 / (scale.liveLoad * powerOfTwo(sum));
    }
}

LaneIterate LaneGeometry::iterateOf(std::size_t index) const
{
    const ProgramRows& of = rowsOf[index];
    return {of.s, of.z, of.y, programs[index].alpha};
}

std::vector<double> LaneGeometry::restingOf(std::size_t index) const
{
    return programs[index].end.isResting ? rowsOf[index].resting : std::vector<double>();
}

std::vector<double> LaneGeometry::frictionOfFaces(const PlaneConeProgram& program) const
{
    std::vector<double> friction;
    friction.reserve(faces.size());
    for (const LaneFace& face : faces)
    {
        friction.push_back(program.friction[face.begin]);
    }
    return friction;
}

ConeSolution LaneGeometry::solutionOf(const PlaneConeProgram& program, std::size_t index) const
{
    const LaneProgram& solved = programs[index];
    const LaneScale& scale = scales[index];
    ConeSolution solution;
    solution.iterations = solution.factorisations = solved.end.iterations;
    if (!solved.end.isAnswered)
    {
        return solution;
    }
    solution.multiplier = solved.alpha * scale.load / scale.liveLoad;
    solution.contactForce = forcesOf(program, solved.s, scale.load);
    solution.displacement = displacementOf(solved.y, scale.displacement);
    if (solved.end.isResting)
    {
        solution.forceOfLoadAlone = forcesOf(program, solved.resting, scale.load);
    }
    return solution;
}

/// Rows of a program, scaled. \return their scale, a power of two
double LaneGeometry::setRows(const Eigen::VectorXd& rowsOfProgram, double* rowsOfLane) const
{
    double largest = 0;
    const auto moment = 1 / lever;
    for (Eigen::Index row = 0; row < rowsOfProgram.size(); ++row)
    {
        largest = std::max(largest, std::abs(rowsOfProgram[row]) * (row % 3 == 2 ? moment : 1));
    }
    const double scale = powerOfTwo(largest);
    for (int body = 0; body < bodies; ++body)
    {
        double* of = rowsOfLane + 3 * position[body];
        of[0] = rowsOfProgram[3 * body] / scale;
        of[1] = rowsOfProgram[3 * body + 1] / scale;
        of[2] = rowsOfProgram[3 * body + 2] * moment / scale;
    }
    return scale;
}

/// Friction of all programs; faces that follow each other and have the same in each share it. \return how
/// many there are of a program
int LaneGeometry::setFriction(const std::vector<const PlaneConeProgram*>& ofPrograms)
{
    int count = 0;
    for (LaneFace& face : faces)
    {
        bool isAsBefore = count > 0;
        for (std::size_t index = 0; index < ofPrograms.size(); ++index)
        {
            std::vector<double>& friction = rowsOf[index].friction;
            friction[count] = ofPrograms[index]->friction[face.begin];
            isAsBefore = isAsBefore && friction[count] == friction[count - 1];
        }
        count += isAsBefore ? 0 : 1;
        face.friction = count - 1;
    }
    return count;
}

/// Forces of the points of a program, from those of its rays.
Eigen::VectorXd LaneGeometry::forcesOf(const PlaneConeProgram& program, const double* s, double scale) const
{
    Eigen::VectorXd forces(2 * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        const double one = s[2 * point] * scale;
        const double other = s[2 * point + 1] * scale;
        forces[2 * point] = one + other;
        forces[2 * point + 1] = program.friction[point] * (one - other);
    }
    return forces;
}

Eigen::VectorXd LaneGeometry::displacementOf(const double* y, double scale) const
{
    Eigen::VectorXd displacement(3 * bodies);
    for (int body = 0; body < bodies; ++body)
    {
        const double* of = y + 3 * position[body];
        displacement.segment<3>(3 * body) << of[0] * scale, of[1] * scale, of[2] * scale / lever;
    }
    return displacement;
}

} // namespace drystone
