// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Two steps beyond the onset, with stiffer points in stages, extrapolated back to where motion begins.
#include "statics/StepFromRest.h"

#include "conic/coulomb/ContactPath.h"

#include <array>
#include <cmath>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// How far beyond where motion begins the live load of a step is, as a share of it: nearer each time it is
/// estimated anew. Directions of slip turn with how far it is, and what points give way by is a part of the
/// way.
constexpr std::array<double, 14> beyondRest{1e-3, 1e-4, 1e-5, 3e-6, 1e-6, 1e-4, 1e-5,
                                            3e-6, 1e-6, 1e-4, 1e-5, 3e-6, 1e-6, 3e-7};

/// Stiffnesses of the points relative to the inertia; the solution for each is the start for the next. Where
/// one begins with stiffer points the way is another.
constexpr std::array<double, 11> stiffnesses{1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e10, 1e12, 1e14};
constexpr std::array<std::size_t, 2> firstStages{2, 0};

/// From there on a step is taken as it is where the next is not reached.
constexpr double stiffEnough = 1e10;

/// What the live load's work grows by where points creep as they give way, at most, as a share of that of
/// motion.
constexpr double creep = 1e-3;

constexpr double pathTolerance = 1e-12;
constexpr int mostChanges = 4; ///< of states on the way, times the number of points

template<int Rows, int Forces>
class Steps
{
public:
    Steps(const ConeProgram<Rows, Forces>& structure, const VectorXd& forces,
          const std::function<bool()>& over)
        : given(structure), moving(structure), isOver(over)
    {
        moving.liveLoad.resize(0);
        moving.gap = VectorXd::Zero(Forces * given.points());
        moving.inertia = inertiaOfPoints(given);
        start.displacement = VectorXd::Zero(given.load.size());
        start.contactForce = forces;
    }

    /// None where it is not reached, or the time for it is over.
    std::optional<ConeSolution> under(double alpha, std::size_t firstStage)
    {
        moving.load = given.load + alpha * given.liveLoad;
        ConeSolution step = start;
        for (std::size_t stage = firstStage; stage < stiffnesses.size(); ++stage)
        {
            if (isOver && isOver())
            {
                return std::nullopt;
            }
            ContactPath<Rows, Forces> path(moving, step,
                                           {.stiffness = stiffnesses[stage],
                                            .tolerance = pathTolerance,
                                            .maximumPivots = mostChanges * given.points(),
                                            .isOver = isOver},
                                           symbolic);
            const bool isReached = path.follow(moving);
            factorisations += path.factorisations();
            if (!isReached)
            {
                return stiffnesses[stage] > stiffEnough ? std::optional(step) : std::nullopt;
            }
            step.displacement = path.displacement();
            step.contactForce = path.contactForce();
        }
        return step;
    }

    int factorisations = 0;

private:
    const ConeProgram<Rows, Forces>& given;
    ConeProgram<Rows, Forces> moving;
    ConeSolution start;
    SymbolicAnalysis symbolic;
    const std::function<bool()>& isOver;
};

template<int Rows, int Forces>
std::optional<CoulombPair> pairFrom(Steps<Rows, Forces>& steps, std::size_t firstStage,
                                    const VectorXd& liveLoad, double begins,
                                    const std::function<bool(CoulombPair&)>& isPair)
{
    double stands = -std::numeric_limits<double>::infinity();
    double moves = begins;
    double slope = 0; // of the live load's work, where there is motion
    for (const double share : beyondRest)
    {
        const double far = begins + share * std::abs(begins);
        const double near = 0.5 * (begins + far);
        const std::optional<ConeSolution> first = steps.under(near, firstStage);
        const std::optional<ConeSolution> second = first ? steps.under(far, firstStage) : std::nullopt;
        if (!second)
        {
            return std::nullopt;
        }
        const double work = liveLoad.dot(first->displacement);
        const double furtherWork = liveLoad.dot(second->displacement) - work;
        if (!(furtherWork > creep * slope * (far - near)) || !(work > 0))
        {
            stands = near;
            begins = 0.5 * (stands + moves);
            continue;
        }
        slope = furtherWork / (far - near);
        moves = near;
        const double back = work / furtherWork;
        CoulombPair pair{near - back * (far - near),
                         first->contactForce - back * (second->contactForce - first->contactForce),
                         first->displacement / work,
                         {}};
        if (isPair(pair))
        {
            return pair;
        }
        begins = pair.alpha > stands ? pair.alpha : 0.5 * (stands + moves);
    }
    return std::nullopt;
}

} // namespace

template<int Rows, int Forces>
std::optional<CoulombPair> pairFromRest(const ConeProgram<Rows, Forces>& given, double begins,
                                        const VectorXd& forces,
                                        const std::function<bool(CoulombPair&)>& isPair, int& factorisations,
                                        const std::function<bool()>& isOver)
{
    Steps<Rows, Forces> steps(given, forces, isOver);
    std::optional<CoulombPair> pair;
    for (const std::size_t firstStage : firstStages)
    {
        if (!pair)
        {
            pair = pairFrom(steps, firstStage, given.liveLoad, begins, isPair);
        }
    }
    factorisations += steps.factorisations;
    return pair;
}

template std::optional<CoulombPair> pairFromRest(const PlaneConeProgram& given, double begins,
                                                 const VectorXd& forces,
                                                 const std::function<bool(CoulombPair&)>& isPair,
                                                 int& factorisations, const std::function<bool()>& isOver);
template std::optional<CoulombPair> pairFromRest(const SpaceConeProgram& given, double begins,
                                                 const VectorXd& forces,
                                                 const std::function<bool(CoulombPair&)>& isPair,
                                                 int& factorisations, const std::function<bool()>& isOver);

} // namespace drystone
