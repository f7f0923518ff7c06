// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Courses of the bonds, brick by brick.
#include "texture/space/WallBond.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// Bricks side by side up to the end of the wall, `first` long at the beginning, then `unit`. Ends are
/// multiples of the unit from the first, so that courses two apart have the same joints to the last digit.
void addRow(std::vector<Brick>& bricks, double first, double unit, double length, const Interval& across)
{
    const double rounding = 1e-9 * unit;
    double from = 0;
    for (int k = 0; from < length - rounding; ++k)
    {
        const double to = first + k * unit;
        bricks.push_back({{from, to < length - rounding ? to : length}, across});
        from = to;
    }
}

/// Bricks of the given lengths side by side, each once or, as a pair, in both halves of the thickness.
struct Stone
{
    double halfWidths = 2; ///< length along the wall in half widths of a brick
    int leaves = 1;        ///< 1: through the thickness, 2: a pair of stretchers
};

std::vector<Brick> rowOf(const std::vector<Stone>& stones, double width, double thickness)
{
    std::vector<Brick> bricks;
    double halfWidths = 0;
    for (const Stone& stone : stones)
    {
        const Interval along{halfWidths * width / 2, (halfWidths + stone.halfWidths) * width / 2};
        for (int leaf = 0; leaf < stone.leaves; ++leaf)
        {
            bricks.push_back(
                {along, {leaf * thickness / stone.leaves, (leaf + 1) * thickness / stone.leaves}});
        }
        halfWidths += stone.halfWidths;
    }
    return bricks;
}

constexpr Stone header{2, 1};
constexpr Stone closer{1, 1};
constexpr Stone pair{4, 2};

void append(std::vector<Stone>& stones, int times, const Stone& stone)
{
    stones.insert(stones.end(), static_cast<std::size_t>(std::max(0, times)), stone);
}

enum class Course
{
    even,
    odd
};

std::vector<Stone> englishRow(int length, Course course)
{
    std::vector<Stone> stones;
    if (course == Course::even)
    {
        append(stones, length, pair);
        return stones;
    }
    stones = {header, closer};
    append(stones, 2 * length - 3, header);
    stones.push_back(closer);
    stones.push_back(header);
    return stones;
}

std::vector<Stone> flemishRow(int pairs, Course course)
{
    std::vector<Stone> stones;
    if (course == Course::even)
    {
        for (int i = 0; i < pairs; ++i)
        {
            append(stones, i > 0 ? 1 : 0, header);
            stones.push_back(pair);
        }
        return stones;
    }
    stones = {header, closer, pair};
    for (int i = 0; i < pairs - 2; ++i)
    {
        stones.push_back(header);
        stones.push_back(pair);
    }
    stones.push_back(closer);
    stones.push_back(header);
    return stones;
}

bool hasHalfThickness(Bond bond)
{
    return bond == Bond::stack || bond == Bond::running;
}

} // namespace

std::string bondFault(const Walls& walls)
{
    const double length = walls.unit.x();
    const double width = walls.unit.y();
    if (!hasHalfThickness(walls.bond) && std::abs(length - 2 * width) > 1e-9 * length)
    {
        return fmt::format(
            "In this bond a brick is twice as long as it is wide, and this one is {:g} m by {:g} m: "
            "change \"unit\", or choose running or stack.",
            length, width);
    }
    if ((walls.leaves > 1 || walls.headersEvery > 0) && walls.bond != Bond::running)
    {
        return "Only a running bond is built in leaves with courses of headers: remove \"leaves\" and "
               "\"headersEvery\", or choose running.";
    }
    if (walls.headersEvery > 0 && walls.leaves != 2)
    {
        return "Headers reach through two leaves: give \"leaves 2;\".";
    }
    const int least = walls.bond == Bond::english || walls.bond == Bond::flemish ? 2 : 0;
    for (const auto& [name, line] : walls.walls)
    {
        if (least > 0 && (line.length != std::round(line.length) || line.length < least))
        {
            return fmt::format(
                "Wall {} is {:g} bricks long: in this bond its length is a whole number from {} on.", name,
                line.length, least);
        }
    }
    return {};
}

double wallLength(const Walls& walls, double bricks)
{
    return walls.bond == Bond::flemish ? (3 * bricks - 1) * walls.unit.y() : bricks * walls.unit.x();
}

double wallThickness(const Walls& walls)
{
    return hasHalfThickness(walls.bond) ? walls.leaves * walls.unit.y() : walls.unit.x();
}

std::vector<Brick> bondCourse(const Walls& walls, double length, int course, int firstCourse)
{
    const Course parity = (course + firstCourse) % 2 == 0 ? Course::even : Course::odd;
    const double unit = walls.unit.x();
    const double width = walls.unit.y();
    const double thickness = wallThickness(walls);
    std::vector<Brick> bricks;
    switch (walls.bond)
    {
    case Bond::stack:
        addRow(bricks, unit, unit, length, {0, thickness});
        break;
    case Bond::running:
        if (walls.headersEvery > 0 && (course + 1) % walls.headersEvery == 0)
        {
            addRow(bricks, width, width, length, {0, thickness});
            break;
        }
        for (int leaf = 0; leaf < walls.leaves; ++leaf)
        {
            addRow(bricks, parity == Course::even ? unit : unit / 2, unit, length,
                   {leaf * width, (leaf + 1) * width});
        }
        break;
    case Bond::header:
        addRow(bricks, parity == Course::even ? width : width / 2, width, length, {0, thickness});
        break;
    case Bond::english:
        bricks = rowOf(englishRow(static_cast<int>(std::lround(length / unit)), parity), width, thickness);
        break;
    case Bond::flemish:
        bricks = rowOf(flemishRow(static_cast<int>(std::lround((length / width + 1) / 3)), parity), width,
                       thickness);
        break;
    }
    return bricks;
}

void subtract(std::vector<Brick>& bricks, const Interval& hole)
{
    std::vector<Brick> left;
    for (const Brick& brick : bricks)
    {
        // A remainder this short is rounding, not a brick.
        const double rounding = 1e-9 * (brick.along.to - brick.along.from);
        if (hole.to <= brick.along.from + rounding || hole.from >= brick.along.to - rounding)
        {
            left.push_back(brick);
            continue;
        }
        if (hole.from > brick.along.from + rounding)
        {
            left.push_back({{brick.along.from, hole.from}, brick.across});
        }
        if (hole.to < brick.along.to - rounding)
        {
            left.push_back({{hole.to, brick.along.to}, brick.across});
        }
    }
    bricks = std::move(left);
}

} // namespace drystone
