// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The text of the lane kernels, fifth part: where iterations begin, and forces of the load alone.
#pragma once

#include "conic/lanes/LanePrograms.h"

namespace drystone
{
namespace
{

template<int lanes>
struct LaneStart : LanePrograms<lanes>
{
    using Base = LanePrograms<lanes>;
    using Base::active;
    using Base::all;
    using Base::alpha;
    using Base::any;
    using Base::at;
    using Base::larger;
    using Base::numbers;
    using Base::program;
    using Base::rays;
    using Base::rows;
    using Base::smaller;
    using Base::task;
    using typename Base::Mask;
    using typename Base::Number;

    static constexpr double leastRounding = 1e-15; ///< as in interiorPoint/Newton.h
    static constexpr double largestRounding = 1e-6;

    using Base::Base;

    Number rounding = {};      ///< share that pivots are raised by
    Number liveStiffness = {}; ///< L'S^-1 L

    /// Of lanes with a pivot that is not positive every pivot is raised; where that is of no use they are
    /// given up.
    void factoriseRaised()
    {
        for (;;)
        {
            Base::assemble();
            const Mask failed = Base::factorise(rounding) & active;
            if (!any(failed))
            {
                return;
            }
            rounding = failed ? larger(all(leastRounding), 10 * rounding) : rounding;
            active &= ~(rounding > largestRounding);
        }
    }

    /// Moves displacements that balance loads to where the live load does no work. \return the change of
    /// alpha
    Number takeLiveWork(double* y)
    {
        const Number share = -Base::product(numbers.liveLoad, y) / liveStiffness;
        for (long row = 0; row < rows; ++row)
        {
            at(y, row) += share * at(numbers.liveSolution, row);
        }
        return share;
    }

    void copyLiveLoad()
    {
        for (long row = 0; row < rows; ++row)
        {
            at(numbers.liveSolution, row) = at(numbers.liveLoad, row);
        }
    }

    /// Least squares and pushed inside, as in Starts.cpp.
    void start()
    {
        const LaneNumbers to = numbers;
        Base::setZero(to.step);
        Base::setZero(to.target);
        for (long ray = 0; ray < rays; ++ray)
        {
            at(to.s, ray) = all(1);
            at(to.inverseZ, ray) = all(1);
        }
        factoriseRaised();
        alpha = Number{};
        Base::setLoads(to.step);
        copyLiveLoad();
        Base::template solve<2>({to.step, to.liveSolution});
        liveStiffness = Base::product(to.liveLoad, to.liveSolution);
        alpha = takeLiveWork(to.step);
        const Number share = at(to.liveWork, 0) / liveStiffness;
        for (long row = 0; row < rows + 3; ++row)
        {
            at(to.y, row) = share * at(to.liveSolution, row);
        }
        Number leastS = all(1e300);
        Number leastZ = all(1e300);
        Base::forClosings(to.step,
                          [&](long ray, Number closing)
                          {
                              at(to.s, ray) = closing;
                              leastS = smaller(leastS, closing);
                          });
        Base::forClosings(to.y,
                          [&](long ray, Number closing)
                          {
                              at(to.z, ray) = -closing;
                              leastZ = smaller(leastZ, -closing);
                          });
        pushInside(larger(Number{}, -1.5 * leastS), larger(Number{}, -1.5 * leastZ));
    }

    /// From iterates of other programs. With the normal forces and shears of those their loads are balanced
    /// whatever the friction, and their openings follow their motion.
    void begin()
    {
        const LaneNumbers to = numbers;
        beginRest();
        for (int lane = 0; lane < lanes; ++lane)
        {
            const LaneBegin& from = program[lane]->begin;
            alpha[lane] = from.alpha;
            for (long row = 0; row < rows; ++row)
            {
                to.y[lanes * row + lane] = from.openings * from.y[row];
            }
            beginRays(from, from.s, from.forces, lane, to.s, ofForces);
            beginRays(from, from.z, from.openings, lane, to.z, ofOpenings);
        }
        for (long row = rows; row < rows + 3; ++row)
        {
            at(to.y, row) = Number{};
        }
    }

    /// Forces that carry the load alone, from those of the other programs, in the metric of these.
    void beginRest()
    {
        const LaneNumbers to = numbers;
        for (int lane = 0; lane < lanes; ++lane)
        {
            const LaneBegin& from = program[lane]->begin;
            if (from.resting)
            {
                beginRays(from, from.resting, from.forces, lane, to.s, ofForces);
                continue;
            }
            for (long ray = 0; ray < rays; ++ray)
            {
                to.s[lanes * ray + lane] = 1;
            }
        }
        seekRest(1); // mostly they carry it
        if (!any(withoutRest()))
        {
            return;
        }
        for (long ray = 0; ray < rays; ++ray)
        {
            at(to.inverseZ, ray) = at(to.s, ray);
        }
        factoriseRaised();
        seekRest(10);
    }

    /// What becomes of the difference of the two rays of a point as friction grows by a ratio: of forces it
    /// is the shear over friction, of openings the slip times friction.
    static double ofForces(double ratio) { return 1 / ratio; }
    static double ofOpenings(double ratio) { return ratio; }

    /// Rays of another program in a lane. \param shareOf one of the two above
    template<class ShareOf>
    void beginRays(const LaneBegin& from, const double* others, double unit, int lane, double* to,
                   const ShareOf& shareOf)
    {
        for (int index = 0; index < Base::graph.faces; ++index)
        {
            const LaneFace& face = Base::graph.face[index];
            const double share =
                shareOf(numbers.friction[lanes * face.friction + lane] / from.friction[index]);
            for (long ray = 2L * face.begin; ray < 2L * face.end; ray += 2)
            {
                beginPair(others + ray, unit, share, to + lanes * ray + lane);
            }
        }
    }

    /// The two rays of a point. \param unit of all \param share of their difference
    static void beginPair(const double* from, double unit, double share, double* to)
    {
        constexpr double leastPart = 0.1;
        const double sum = 0.5 * (from[0] + from[1]);
        const double difference = 0.5 * share * (from[0] - from[1]);
        const double one = sum + difference;
        const double other = sum - difference;
        to[0] = unit * (one > leastPart * from[0] ? one : leastPart * from[0]);
        to[lanes] = unit * (other > leastPart * from[1] ? other : leastPart * from[1]);
    }

    void pushInside(Number ofS, Number ofZ)
    {
        const LaneNumbers to = numbers;
        Number products = {}, sumS = {}, sumZ = {}, largestS = all(-1e300), largestZ = all(-1e300);
        for (long ray = 0; ray < rays; ++ray)
        {
            const Number s = at(to.s, ray) + ofS;
            const Number z = at(to.z, ray) + ofZ;
            products += s * z;
            sumS += s;
            sumZ += z;
            largestS = larger(largestS, s);
            largestZ = larger(largestZ, z);
        }
        ofS += larger(sumZ > 0 ? 0.5 * products / sumZ : Number{}, 1e-2 * largestS + 1e-2);
        ofZ += larger(sumS > 0 ? 0.5 * products / sumS : Number{}, sumZ > 0 ? 1e-2 * largestZ : all(1));
        for (long ray = 0; ray < rays; ++ray)
        {
            at(to.s, ray) += ofS;
            at(to.z, ray) += ofZ;
        }
    }

    Mask withoutRest() const
    {
        Mask sought = active;
        for (int lane = 0; lane < lanes; ++lane)
        {
            sought[lane] = program[lane]->end.isResting ? 0 : sought[lane];
        }
        return sought;
    }

    /// What is in `correctionS` carries the load alone. \param which lanes
    void keepRest(Mask which)
    {
        for (int lane = 0; lane < lanes; ++lane)
        {
            if (which[lane])
            {
                Base::fromLane(numbers.correctionS, rays, lane, program[lane]->resting);
                program[lane]->end.isResting = true;
            }
        }
    }

    /// Forces that carry the load alone, as NewtonSystem::forcesOfLoadAlone finds them.
    void seekRest(int passes)
    {
        const LaneNumbers to = numbers;
        Mask sought = withoutRest();
        if (!any(sought))
        {
            return;
        }
        for (long ray = 0; ray < rays; ++ray)
        {
            at(to.correctionS, ray) = at(to.s, ray);
        }
        for (int pass = 0; pass < passes; ++pass)
        {
            for (long row = 0; row < rows + 3; ++row)
            {
                at(to.correction, row) = -at(to.load, row);
            }
            Base::forForces(to.correction,
                            [&](long ray)
                            {
                                const Number force = at(to.correctionS, ray);
                                const Number inside = force < 0 ? -2 * force : force;
                                at(to.correctionS, ray) = inside;
                                return inside;
                            });
            const Mask found = (Base::largest(to.correction) <= 0.1 * task.tolerance) & sought;
            keepRest(found);
            sought &= ~found;
            if (pass + 1 == passes || !any(sought))
            {
                break;
            }
            Base::template solve<1>({to.correction});
            Base::forClosings(to.correction, [&](long ray, Number closing)
                              { at(to.correctionS, ray) -= at(to.s, ray) * at(to.inverseZ, ray) * closing; });
        }
    }
};

} // namespace
} // namespace drystone
