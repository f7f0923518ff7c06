// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The text of the lane kernels, fourth part: which program each lane has, and what is copied between the
/// two.
#pragma once

#include "conic/lanes/LaneSteps.h"

namespace drystone
{
namespace
{

template<int lanes>
struct LanePrograms : LaneSteps<lanes>
{
    using Base = LaneSteps<lanes>;
    using Base::alpha;
    using Base::numbers;
    using Base::rays;
    using Base::rows;
    using Base::task;
    using typename Base::Mask;

    using Base::Base;

    LaneProgram* program[lanes] = {}; ///< never null once lanes have programs: see `giveLanes`
    Mask active = {};                 ///< lanes with a program that is neither answered nor given up

    /// Gives the lanes programs from `first` on; where there are none up to `end`, that of `first` once more,
    /// which is not active.
    void giveLanes(int first, int end)
    {
        for (int lane = 0; lane < lanes; ++lane)
        {
            const bool isThere = first + lane < end;
            give(lane, task.programs[isThere ? first + lane : first]);
            active[lane] = isThere ? -1 : 0;
        }
    }

    void give(int lane, LaneProgram& of)
    {
        program[lane] = &of;
        toLane(of.friction, task.frictionCount, lane, numbers.friction);
        toLane(of.load, rows, lane, numbers.load);
        toLane(of.liveLoad, rows, lane, numbers.liveLoad);
        numbers.liveWork[lane] = of.liveWork;
    }

    /// The iterate that was kept with the program, at which it stands.
    void standAtKept(int lane)
    {
        const LaneProgram& of = *program[lane];
        toLane(of.s, rays, lane, numbers.s);
        toLane(of.z, rays, lane, numbers.z);
        toLane(of.y, rows + 3, lane, numbers.y);
        alpha[lane] = of.alpha;
        for (long ray = lane; ray < lanes * rays; ray += lanes)
        {
            numbers.ratioS[ray] = numbers.ratioZ[ray] = 0;
            numbers.correctionS[ray] = numbers.correctionZ[ray] = 0;
        }
    }

    void keep(int lane)
    {
        LaneProgram& of = *program[lane];
        fromLane(numbers.s, rays, lane, of.s);
        fromLane(numbers.z, rays, lane, of.z);
        fromLane(numbers.y, rows + 3, lane, of.y);
        of.alpha = alpha[lane];
    }

    static void toLane(const double* from, long count, int lane, double* to)
    {
        for (long index = 0; index < count; ++index)
        {
            to[lanes * index + lane] = from[index];
        }
    }

    static void fromLane(const double* from, long count, int lane, double* to)
    {
        for (long index = 0; index < count; ++index)
        {
            to[index] = from[lanes * index + lane];
        }
    }
};

} // namespace
} // namespace drystone
