// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The text of the lane kernels, sixth part: the iterations. They are those of interiorPoint/Loop.cpp, in the
/// plainest form that solves what ensembles have: every number of a lane is made of numbers of that lane
/// alone, with the same operations whatever the others do, so that an answer does not depend on them by a
/// single bit.
#pragma once

#include "conic/lanes/LaneStart.h"

namespace drystone
{
namespace
{

template<int lanes>
struct LaneLoop : LaneStart<lanes>
{
    using Base = LaneStart<lanes>;
    using Base::active;
    using Base::all;
    using Base::alpha;
    using Base::any;
    using Base::at;
    using Base::dual;
    using Base::every;
    using Base::larger;
    using Base::leastRounding;
    using Base::liveStiffness;
    using Base::missing;
    using Base::numbers;
    using Base::primal;
    using Base::program;
    using Base::rays;
    using Base::rounding;
    using Base::rows;
    using Base::sizeOf;
    using Base::smaller;
    using Base::takeLiveWork;
    using Base::task;
    using Base::weightS;
    using Base::weightZ;
    using typename Base::Mask;
    using typename Base::Number;
    using typename Base::Weighted;

    // As in interiorPoint/{Centring.h, Loop.cpp, Newton.cpp, State.h}, from where their reasons are.
    static constexpr double partOfCube = 0.25;
    static constexpr double aimOfCorrectors = 5;
    static constexpr double leastAim = 1e-3;
    static constexpr double relativeGrowth = 1.15;
    static constexpr double stepGrowth = 0.5;
    static constexpr double leastProduct = 0.2;
    static constexpr double largestProduct = 8;
    static constexpr double largestLoss = 0.3;
    static constexpr double longStep = 0.86;
    static constexpr double fullCorrection = 0.9;
    static constexpr double partOfWay = 0.99;
    static constexpr double cancellingComplementarity = 1e-6;
    static constexpr double firmComplementarity = 1e-7;
    static constexpr double evenFlexibility = 1e5;
    static constexpr double ofResiduals = 0.7;
    static constexpr int passesOfRepair = 6;
    static constexpr int mostRefinements = 1;

    static constexpr int correctors = 2;
    static constexpr int mostIterations = 30; ///< what has not ended then is left to the ordinary solver
    static constexpr double lost = 1e4;       ///< multiplier, as `possiblyUnlimited`
    /// Balance that is left to the repair at the end, relative to the loads.
    static constexpr double looseBalance = 1e-6;

    explicit LaneLoop(LaneTask& ofTask)
        : Base(ofTask),
          degree(2.0 * static_cast<double>(ofTask.graph.points)),
          tolerance(ofResiduals * ofTask.tolerance)
    {
    }

    void run()
    {
        for (int first = 0; first < task.programCount; first += lanes)
        {
            Base::giveLanes(first, task.programCount);
            rounding = Number{};
            task.isBegun ? Base::begin() : Base::start();
            keep(first);
            if (!task.isBegun)
            {
                iterate(first, smallerOf(first + lanes, task.programCount));
            }
        }
        if (task.isBegun)
        {
            iterate(0, task.programCount);
        }
        for (int first = 0; first < task.programCount && task.complementarity == 0; first += lanes)
        {
            repair(first);
        }
    }

private:
    static int smallerOf(int a, int b) { return a < b ? a : b; }

    /// \param first program in the lanes
    void keep(int first)
    {
        for (int lane = 0; lane < smallerOf(lanes, task.programCount - first); ++lane)
        {
            Base::keep(lane);
        }
    }

    /// All programs from `first` to `end`. A lane whose program has ended takes the next one at once.
    void iterate(int first, int end)
    {
        Base::giveLanes(first, end);
        for (int lane = 0; lane < lanes; ++lane)
        {
            enter(lane, 0);
        }
        int next = first + lanes;
        for (int iteration = 0;; ++iteration)
        {
            measure(iteration);
            while (giveFreeLanes(next, end, iteration))
            {
                measure(iteration); // the others stand still, and are what they were
            }
            if (!any(active))
            {
                return;
            }
            rounding = mu < cancellingComplementarity ? larger(rounding, all(leastRounding)) : rounding;
            Base::factoriseRaised();
            if (iteration <= 1 && !task.isBegun)
            {
                Base::seekRest(iteration == 0 ? 3 : 10);
            }
            step();
        }
    }

    /// The program of a lane begins at what was kept of it.
    void enter(int lane, int iteration)
    {
        Base::standAtKept(lane);
        beginning[lane] = iteration;
        rounding[lane] = 0;
        wasThere[lane] = 0;
        Base::stepS[lane] = Base::stepZ[lane] = weightS[lane] = weightZ[lane] = 0;
    }

    /// \param next program, those up to `end` are left \return whether any lane has got one
    bool giveFreeLanes(int& next, int end, int iteration)
    {
        bool isAny = false;
        for (int lane = 0; lane < lanes && next < end; ++lane)
        {
            if (!active[lane])
            {
                Base::give(lane, task.programs[next++]);
                active[lane] = -1;
                enter(lane, iteration);
                isAny = true;
            }
        }
        return isAny;
    }

    void measure(int iteration)
    {
        Base::moveAndMeasure();
        Base::stepS = Base::stepZ = Number{};
        mu = Base::complementarity / degree;
        takeEnds(iteration);
    }

    /// Lanes whose residuals meet the tolerance are kept as they are now; those that are lost are given up.
    void takeEnds(int iteration)
    {
        const LaneNumbers to = numbers;
        const Number size = sizeOf(alpha);
        const Number liveWork = at(to.liveWork, 0);
        const Number ofLoad = Base::product(to.load, to.y);
        objectiveSize = larger(liveWork * larger(all(1e-3), size), sizeOf(ofLoad));
        work = liveWork - Base::product(to.liveLoad, to.y);
        isThere = mu <= 4 * task.complementarity;
        const Mask isEnd = (isThere & wasThere)
                           | ((missing <= looseBalance * larger(all(1), size))
                              & (Base::misfit <= tolerance * Base::largest(to.y))
                              & (sizeOf(work) <= tolerance * larger(all(1), liveWork))
                              & (Base::complementarity <= tolerance * objectiveSize));
        for (int lane = 0; lane < lanes; ++lane)
        {
            const int iterations = iteration - beginning[lane];
            if (isEnd[lane] && active[lane])
            {
                Base::keep(lane);
                program[lane]->end.isAnswered = true;
                program[lane]->end.iterations = iterations;
            }
            active[lane] = iterations + 1 < mostIterations ? active[lane] : 0;
        }
        active &= ~isEnd & (mu > 0) & (mu < 1e300) & (size < lost);
    }

    /// The predictor with its corrections; it is gone at the next measurement.
    void step()
    {
        const LaneNumbers to = numbers;
        wasThere = isThere;
        Base::copyLiveLoad();
        Base::template solve<2>({to.step, to.liveSolution});
        liveStiffness = Base::product(to.liveLoad, to.liveSolution);
        Number change = (work - Base::product(to.liveLoad, to.step)) / liveStiffness;
        for (long row = 0; row < rows; ++row)
        {
            at(to.step, row) += change * at(to.liveSolution, row);
            at(to.target, row) = at(to.y, row) + at(to.step, row);
        }
        weightS = weightZ = Number{};
        const Number left = Base::predict() / Base::complementarity;
        const Number enough = 0.02 * task.tolerance * objectiveSize / Base::complementarity;
        const Number sigma = larger(partOfCube * left * left * left, smaller(all(1), enough));
        const Number least = all(task.complementarity);
        Base::pullToPath(larger(sigma * mu, least));
        correct(smaller(all(1), primal) * smaller(all(1), dual), every(), change);
        correctTowards(larger(larger(aimOfCorrectors * sigma, all(leastAim)) * mu, least), change);
        refine(change);
        const Number part = larger(all(partOfWay), 1 - mu);
        Base::stepS = smaller(all(1), part * primal);
        Base::stepZ = smaller(all(1), part * dual);
        alpha += Base::stepS * change;
        for (long row = 0; row < rows; ++row)
        {
            at(to.y, row) += Base::stepZ * at(to.step, row);
        }
    }

    /// Gondzio's correctors, in lanes with short steps.
    void correctTowards(Number aim, Number& change)
    {
        Mask going = active;
        for (int corrector = 0; corrector < correctors; ++corrector)
        {
            going &= smaller(primal, dual) < longStep;
            if (!any(going))
            {
                break;
            }
            const Number primalAsked = smaller(all(1), relativeGrowth * primal + stepGrowth);
            const Number dualAsked = smaller(all(1), relativeGrowth * dual + stepGrowth);
            Base::pullIntoBox(leastProduct * aim, largestProduct * aim, primalAsked, dualAsked);
            going = correct(smaller(all(fullCorrection), primalAsked * dualAsked), going, change);
        }
    }

    /// Solves for a correction and adds it with the weights that let the step go farthest. \param which
    /// lanes; in others the step stays as it is \return those in which it was worth it
    Mask correct(Number least, Mask which, Number& change)
    {
        const LaneNumbers to = numbers;
        Base::template solve<1>({to.correction});
        const Number ofLive = takeLiveWork(to.correction);
        Weighted forces;
        Weighted openings;
        Base::weighCorrection(least, forces, openings);
        const Mask isGood = which & ~(forces.step < largestLoss * smaller(all(1), primal))
                            & ~(openings.step < largestLoss * smaller(all(1), dual));
        weightS = isGood ? forces.weight : Number{};
        weightZ = isGood ? openings.weight : Number{};
        primal = isGood ? forces.step : primal;
        dual = isGood ? openings.step : dual;
        change += weightS * ofLive;
        for (long row = 0; row < rows; ++row)
        {
            at(to.step, row) += weightZ * at(to.correction, row);
        }
        return isGood;
    }

    /// What rounding leaves of the balance of the whole step, where flexibilities are uneven, is solved for
    /// once more.
    void refine(Number& change)
    {
        const LaneNumbers to = numbers;
        Mask needed = active & (mu < firmComplementarity);
        for (int refinement = 0; refinement < mostRefinements && any(needed); ++refinement)
        {
            for (long row = 0; row < rows; ++row)
            {
                at(to.correction, row) = at(to.balance, row) + change * at(to.liveLoad, row);
            }
            Base::takeStepFrom(to.correction);
            const Number left = Base::largest(to.correction);
            needed &= left > larger(0.1 * task.tolerance * larger(all(1), sizeOf(alpha)), 1e-2 * missing);
            for (long row = 0; row < rows; ++row)
            {
                at(to.correction, row) = needed ? at(to.correction, row) : Number{};
            }
            Base::template solve<1>({to.correction});
            change += takeLiveWork(to.correction);
            for (long row = 0; row < rows; ++row)
            {
                at(to.step, row) += at(to.correction, row);
            }
            Base::addRefinement(needed);
        }
    }

    /// The balance of the answers from `first` on, as many as there are lanes, by the least change in the
    /// metric of min(D, constant), as NewtonSystem::repairBalance has it.
    void repair(int first)
    {
        const LaneNumbers to = numbers;
        Base::giveLanes(first, task.programCount);
        for (int lane = 0; lane < lanes; ++lane)
        {
            Base::standAtKept(lane);
            active[lane] = program[lane]->end.isAnswered ? active[lane] : 0;
        }
        if (!any(active))
        {
            return;
        }
        for (long ray = 0; ray < rays; ++ray)
        {
            const Number s = at(to.s, ray);
            at(to.inverseZ, ray) = smaller(s / at(to.z, ray), all(evenFlexibility)) / s;
        }
        bool isFactorised = false;
        for (int pass = 0; pass < passesOfRepair; ++pass)
        {
            Base::setLoads(to.correction);
            Base::forForces(to.correction, [&](long ray) { return -at(to.s, ray); });
            active &= Base::largest(to.correction) > 0.1 * task.tolerance * larger(all(1), sizeOf(alpha));
            if (!any(active))
            {
                break;
            }
            if (!isFactorised)
            {
                factoriseRepair();
                isFactorised = true;
            }
            for (long row = 0; row < rows; ++row)
            {
                at(to.correction, row) = active ? at(to.correction, row) : Number{};
            }
            Base::template solve<1>({to.correction});
            alpha += takeLiveWork(to.correction);
            Base::forClosings(to.correction,
                              [&](long ray, Number closing)
                              {
                                  const Number s = at(to.s, ray);
                                  at(to.s, ray) = larger(s + s * at(to.inverseZ, ray) * closing, 0.1 * s);
                              });
        }
        keep(first);
    }

    void factoriseRepair()
    {
        rounding = Number{};
        Base::factoriseRaised();
        Base::copyLiveLoad();
        Base::template solve<1>({numbers.liveSolution});
        liveStiffness = Base::product(numbers.liveLoad, numbers.liveSolution);
    }

    const double degree;
    const double tolerance;
    int beginning[lanes] = {}; ///< iteration at which the program in a lane began
    Number mu = {};
    /// Whether an iterate that is sought has been reached, and was before the last step: what has come there
    /// is one step from the path, and correctors that ask for more than they get end at some times what they
    /// aim at, so that it ends there the second time.
    Mask isThere = {};
    Mask wasThere = {};
    Number work = {}; ///< w - L'y
    Number objectiveSize = {};
};

} // namespace
} // namespace drystone
