// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis with Coulomb's law: joints that slide do not open.
#pragma once

#include "dictionary/Options.h"
#include "statics/CoulombCheck.h"
#include "statics/LimitAnalysis.h"

#include <functional>
#include <optional>

namespace drystone
{

/// How far a search has come.
struct CollapseProgress
{
    int path = 0;          ///< or start that is being followed, from 1
    int pieces = 0;        ///< of it, or programs, so far
    double multiplier = 0; ///< to which it has been followed
    double lowest = 0;     ///< of the pairs met so far; infinite: none
    bool isPath = true;    ///< or programs with cohesion in place of friction
};

/// Keys of `nonAssociative { ... }` in system/solution/limitAnalysis.
struct NonAssociativeSettings
{
    int starts = 1; ///< paths to collapse; more of them while there is no collapse, and in space while lower
                    ///< ones are found
    int seed = 1;   ///< of the random numbers that they are made from
    double tolerance = 1e-6;                ///< on the residuals of a pair of forces and mechanism
    std::optional<double> maximumTime = {}; ///< of a search, on the clock [s]; none: any
    std::function<void(const CollapseProgress&)> observe = {}; ///< no key: called after each piece; or empty
    std::function<bool()> isOver = {}; ///< no key: called on the way, and the search ends there; or empty
};

void declare(Options& options, NonAssociativeSettings& settings);

/// Searches for the least multiplier at which forces and a mechanism obey Coulomb's law together (Ferris &
/// Tin-Loi 2001: a program with complementarity constraints, whose solutions are many).
///
/// A pair is the end of a path on which the live load pushes the structure until it collapses
/// (conic/coulomb/CollapsePath.h). The first path begins with forces of a low multiplier that suit the
/// mechanism of the associative collapse, those of the program
///
///       minimise  alpha + gamma sum_k (mu |s_k| + o_k) n_k,    s_k slip and o_k opening rate of point k,
///
/// in which the dissipation of the mechanism is a penalty. Each further path begins elsewhere: with forces
/// that carry the dead load; likewise with forces that suit the mechanism of a pair already found, where
/// lower pairs are nearby if gamma is little above 1, at which the multiplier would follow from the power
/// alone; at times with other forces that carry the dead load, and with other stiffnesses of the joints.
///
/// From each pair the search goes down to the least nearby. With its mechanism held the multiplier is made
/// least, which is a convex program: nothing presses where points open, friction is at its limit against the
/// slip where they slide. With those forces held another mechanism is chosen of the many that they allow, one
/// that does not move the points which keep the multiplier from being less; and so on, in turn, until there
/// is none.
///
/// In space, where blocks turn and slide in more ways than paths from few starts meet, each start is followed
/// by another mechanism: that of its pressures (mechanismOfPressures of FictitiousCohesion.h), and down from
/// there. Further starts are followed while all of them cost milliseconds: in small structures the lowest
/// pair is mostly not that of the first.
///
/// With thousands of points a path takes minutes to hours. Starts are then followed by programs of the
/// associative law with a cohesion in place of friction (FictitiousCohesion.h), whose pairs are those of a
/// fixed point and not met by loading; paths follow where they lead to none. They are also tried where paths
/// and steps from rest have led to none.
///
/// Where a path ends with blocks that fall under the dead load alone, so that the live load does no work on
/// the mechanism, it is repeated with a little dilatancy, by which they wedge, and that is taken away again
/// but for a tenth of the tolerance; in space, where that seldom leads to a pair and takes longest, after all
/// else has been tried.
///
/// The result is the lowest pair that meets `tolerance` in CoulombCheck.h (`optimal`, its residuals as the
/// certificate: balance and yield, flow, mismatch). Its multiplier is that of a collapse, and so an upper
/// bound on the least of all collapses, which nothing here proves (in space paths whose starts differ by
/// rounding end in collapses as far apart as 2.5 and 5.8: others are followed until four in a row find none
/// lower, in a frame of the structure's own, ProperFrame.h); that of the associative law is one that is
/// proved. In space paths often end just before their collapse, as rounding ends them, and blocks that slide
/// as one have shears whose directions are known to 1e-5 only: what is nearly a pair is refined
/// (PairRefinement.h). Where no path has met a collapse, in the plane nor a fall, a mechanism is tried that
/// the forces of the associative collapse allow by Coulomb's law, and where motion from rest begins
/// (StepFromRest.h). Where only falls have been met the lowest of them is the result. Where all pairs are
/// below zero, which says that some forces at rest are not safe, it is the highest of them. Without any pair
/// the result is `upperBound`: forces, mechanism and certificate of the associative collapse, which no pair
/// exceeds; where there is no such collapse, `unbounded`: forces that either law allows carry any multiple of
/// the live load, and nothing was found to collapse all the same (by a mixed-integer program over the states
/// of all points none of 47 such small structures has a pair). A search whose time is over ends at the next
/// piece of a path, step or exchange, with what it has met until then, in space or else that mechanism. What
/// the friction cones cannot carry is `unstable` with either law.
///
/// Where no pair is met the range says from where on there may be one. A pair of Coulomb's law has
/// (c - c')'A'y >= 0 for all forces c' with |c'_t| <= C - mu T, -T <= c'_n <= N: where a point opens, c_n is
/// -T and so the least, where it slides, c't = (C + mu c_n)|s| is the larger work. With A c = f + alpha L,
/// A c' = f + alpha' L and L'y = 1 that is alpha >= alpha' (Radenkovic 1961): no pair is below the greatest
/// alpha' of joints without friction, whether or not these stand without the live load. Where these carry the
/// live load alone, A c' = L with c'_n >= 0 and no shear, there is none at all, since no point closes:
/// L'y = c'A'y <= 0. \throws
/// std::invalid_argument for a program with gaps
template<int Rows, int Forces>
LimitAnalysis solveNonAssociative(const ConeProgram<Rows, Forces>& program,
                                  const NonAssociativeSettings& settings = {},
                                  const InteriorPointSettings& solver = {});

} // namespace drystone
