// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `walls`: straight walls of bricks in a bond, toothed into each other where they meet, with
/// doors and windows.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

/// How the bricks of a wall lie. Courses count from 0 at the bottom; a brick is l long, w wide.
enum class Bond
{
    stack,   ///< full bricks, joints above each other; one leaf, w thick
    running, ///< even courses of full bricks, odd ones half - full - half; one leaf, w thick, or two
    header,  ///< the same with bricks w along the wall and l deep
    english, ///< even: two leaves of n stretchers; odd: header, closer of w/2, 2n - 3 headers, closer, header
    flemish  ///< even: n pairs of stretchers with n - 1 headers between; odd: header, closer, pair, then
             ///< (header, pair) n - 2 times, closer, header; (3n - 1) w long
};

inline std::array<std::pair<std::string_view, Bond>, 5> namesOf(Bond)
{
    return {{{"stack", Bond::stack},
             {"running", Bond::running},
             {"header", Bond::header},
             {"english", Bond::english},
             {"flemish", Bond::flemish}}};
}

/// On which side of its line a wall stands, seen along it from above.
enum class WallSide
{
    left,
    right
};

inline std::array<std::pair<std::string_view, WallSide>, 2> namesOf(WallSide)
{
    return {{{"left", WallSide::left}, {"right", WallSide::right}}};
}

/// One wall in plan.
struct WallLine
{
    Vector<2> from = Vector<2>::Zero(); ///< where it begins, on one of its faces [m]
    Vector<2> direction{1, 0};          ///< along it; of any length
    double length = 8;                  ///< [bricks]
    WallSide thickness = WallSide::left;
};

void declare(Options& options, WallLine& wall);

/// A door or a window.
struct WallOpening
{
    std::string wall; ///< its name
    Vector<2> from;   ///< lower corner, (bricks, courses) from where the wall begins
    Vector<2> to;     ///< upper corner
    std::optional<double> lintel =
        {}; ///< bearing at both ends of one block in the course above [bricks]; absent: none
};

void declare(Options& options, WallOpening& opening);

struct Walls
{
    Vector<3> unit{0.25, 0.125, 0.065}; ///< length, width, height of a brick [m]
    Bond bond = Bond::running;
    int courses = 20;
    int leaves = 1;       ///< of a running bond, one behind the other
    int headersEvery = 0; ///< of two leaves: every so many courses one of headers through both; 0: none
    std::vector<std::pair<std::string, WallLine>> walls;
    std::vector<WallOpening> openings;
};

void declare(Options& options, Walls& walls);

/// The blocks of all walls, all free, by course from the bottom, in each by wall in the order given, in each
/// along the wall. Where two walls meet, the one named first runs through on even courses and the other on
/// odd ones. A wall's courses are those of its bond on its own if it is the first named where it first meets
/// another, else they begin with an odd one: joints of a running bond lie at whole bricks where it runs
/// through, and half a brick further where it does not. An opening that goes over the whole of a junction
/// cuts the other wall too, over the thickness of its own.
Assembly<3> makeAssembly(const Walls& walls);

} // namespace drystone
