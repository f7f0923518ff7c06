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
    : contacts(program.contacts),
      bodies(program.bodies),
      lanes(laneCount),
      lever(powerOfTwo(meanLeverArm(program))),
      scales(static_cast<std::size_t>(laneCount))
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
    allot();
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

void LaneGeometry::allot()
{
    LaneNumbers& numbers = task.numbers;
    const std::size_t rows = 3 * (static_cast<std::size_t>(bodies) + 1);
    const std::size_t rays = 2 * points.size();
    struct Share
    {
        double** array;
        std::size_t count;
    };
    const std::vector<Share> shares{
        {&numbers.friction, faces.size()},
        {&numbers.load, rows},
        {&numbers.liveLoad, rows},
        {&numbers.liveWork, 1},
        {&numbers.s, rays},
        {&numbers.y, rows},
        {&numbers.alpha, 1},
        {&numbers.resting, rays},
        {&numbers.z, rays},
        {&numbers.ratioS, rays},
        {&numbers.ratioZ, rays},
        {&numbers.correctionS, rays},
        {&numbers.correctionZ, rays},
        {&numbers.inverseZ, rays},
        {&numbers.inverseProduct, rays},
        {&numbers.leverage, rays},
        {&numbers.endS, rays},
        {&numbers.endZ, rays},
        {&numbers.endY, rows},
        {&numbers.endAlpha, 1},
        {&numbers.balance, rows},
        {&numbers.step, rows},
        {&numbers.correction, rows},
        {&numbers.target, rows},
        {&numbers.liveSolution, rows},
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

void LaneGeometry::setPrograms(const std::vector<const PlaneConeProgram*>& ofLane)
{
    setFriction(ofLane);
    for (int lane = 0; lane < lanes; ++lane)
    {
        LaneScale& scale = scales[lane];
        scale.load = setRows(ofLane[lane]->load, lane, task.numbers.load);
        scale.liveLoad = setRows(ofLane[lane]->liveLoad, lane, task.numbers.liveLoad);
        double sum = 0;
        for (int row = 0; row < 3 * bodies; ++row)
        {
            sum += std::abs(task.numbers.liveLoad[lanes * row + lane]);
        }
        task.numbers.liveWork[lane] = powerOfTwo(sum);
        scale.displacement = 1 / (scale.liveLoad * powerOfTwo(sum));
        task.ends[lane] = {};
    }
}

LaneIterate LaneGeometry::iterateOf(int lane) const
{
    const LaneNumbers& numbers = task.numbers;
    const std::size_t rays = 2 * points.size();
    return {columnOf(numbers.s, rays, lane), columnOf(numbers.z, rays, lane),
            columnOf(numbers.y, 3 * static_cast<std::size_t>(bodies), lane), numbers.alpha[lane]};
}

std::vector<double> LaneGeometry::restingOf(int lane) const
{
    return task.ends[lane].isResting ? columnOf(task.numbers.resting, 2 * points.size(), lane)
                                     : std::vector<double>();
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

std::vector<double> LaneGeometry::columnOf(const double* numbers, std::size_t count, int lane) const
{
    std::vector<double> column(count);
    for (std::size_t index = 0; index < count; ++index)
    {
        column[index] = numbers[lanes * index + lane];
    }
    return column;
}

ConeSolution LaneGeometry::solutionOf(const PlaneConeProgram& program, int lane) const
{
    const LaneEnd& end = task.ends[lane];
    ConeSolution solution;
    solution.iterations = solution.factorisations = end.iterations;
    if (!end.isAnswered)
    {
        return solution;
    }
    solution.multiplier = task.numbers.alpha[lane] * scales[lane].load / scales[lane].liveLoad;
    solution.contactForce = forcesOf(program, task.numbers.s, lane);
    solution.displacement = displacementOf(lane);
    if (end.isResting)
    {
        solution.forceOfLoadAlone = forcesOf(program, task.numbers.resting, lane);
    }
    return solution;
}

/// Rows of the program in one lane, scaled. \return their scale, a power of two
double LaneGeometry::setRows(const Eigen::VectorXd& rowsOfProgram, int lane, double* rows) const
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
        double* of = rows + lanes * 3 * position[body] + lane;
        of[0] = rowsOfProgram[3 * body] / scale;
        of[lanes] = rowsOfProgram[3 * body + 1] / scale;
        of[2 * lanes] = rowsOfProgram[3 * body + 2] * moment / scale;
    }
    return scale;
}

/// Friction of a face in all lanes; faces that follow each other and have the same share it.
void LaneGeometry::setFriction(const std::vector<const PlaneConeProgram*>& ofLane)
{
    int count = 0;
    double* friction = task.numbers.friction;
    for (LaneFace& face : faces)
    {
        double* of = friction + lanes * count;
        for (int lane = 0; lane < lanes; ++lane)
        {
            of[lane] = ofLane[lane]->friction[face.begin];
        }
        const bool isAsBefore = count > 0 && std::equal(of, of + lanes, of - lanes);
        count += isAsBefore ? 0 : 1;
        face.friction = count - 1;
    }
}

/// Forces of the points of the program in one lane, from those of its rays.
Eigen::VectorXd LaneGeometry::forcesOf(const PlaneConeProgram& program, const double* s, int lane) const
{
    const double scale = scales[lane].load;
    Eigen::VectorXd forces(2 * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        const double one = s[lanes * (2 * point) + lane] * scale;
        const double other = s[lanes * (2 * point + 1) + lane] * scale;
        forces[2 * point] = one + other;
        forces[2 * point + 1] = program.friction[point] * (one - other);
    }
    return forces;
}

Eigen::VectorXd LaneGeometry::displacementOf(int lane) const
{
    const double scale = scales[lane].displacement;
    Eigen::VectorXd displacement(3 * bodies);
    for (int body = 0; body < bodies; ++body)
    {
        const double* y = task.numbers.y + lanes * 3 * position[body] + lane;
        displacement.segment<3>(3 * body) << y[0] * scale, y[lanes] * scale, y[2 * lanes] * scale / lever;
    }
    return displacement;
}

} // namespace drystone
