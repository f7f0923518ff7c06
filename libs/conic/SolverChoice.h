// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which solver a case requests: the sub-dictionary of an application in system/solution.
#pragma once

#include "conic/AugmentedLagrangian.h"
#include "conic/GaussSeidel.h"
#include "conic/InteriorPoint.h"
#include "dictionary/Options.h"

#include <functional>
#include <string>
#include <string_view>
#include <type_traits>

namespace drystone
{

/// The solvers of cone programs that a dictionary can choose.
enum class SolverType
{
    automatic,           ///< the first of the others that suits; another one when it does not converge
    interiorPoint,       ///< from a cold start; statics and motion
    augmentedLagrangian, ///< from the last step; motion only
    gaussSeidel,         ///< from the last step, for tolerances of 1e-3 to 1e-5; motion only
};

inline std::array<std::pair<std::string_view, SolverType>, 4> namesOf(SolverType)
{
    return {{{"automatic", SolverType::automatic},
             {"interiorPoint", SolverType::interiorPoint},
             {"augmentedLagrangian", SolverType::augmentedLagrangian},
             {"gaussSeidel", SolverType::gaussSeidel}}};
}

/// Which cone programs are written as files (ProgramFile.h), for someone else to solve them again.
enum class WriteProgram
{
    never,
    unsolved, ///< those that were not solved to the tolerance
    always    ///< each; of the programs of one step in time the last stays
};

inline std::array<std::pair<std::string_view, WriteProgram>, 3> namesOf(WriteProgram)
{
    return {{{"never", WriteProgram::never},
             {"unsolved", WriteProgram::unsolved},
             {"always", WriteProgram::always}}};
}

/// Sees each program that has been solved, and what came of it. Made from anything that can be called with
/// a program of the plane, of space, or of either.
struct SolveObserver
{
    std::function<void(const PlaneConeProgram&, const ConeSolution&)> ofPlane;
    std::function<void(const SpaceConeProgram&, const ConeSolution&)> ofSpace;

    SolveObserver() = default;
    template<class Function>
    requires(!std::is_same_v<std::remove_cvref_t<Function>, SolveObserver>)
        SolveObserver(const Function& function)
    {
        if constexpr (std::is_invocable_v<Function, const PlaneConeProgram&, const ConeSolution&>)
        {
            ofPlane = function;
        }
        if constexpr (std::is_invocable_v<Function, const SpaceConeProgram&, const ConeSolution&>)
        {
            ofSpace = function;
        }
    }

    explicit operator bool() const { return ofPlane || ofSpace; }

    void operator()(const PlaneConeProgram& program, const ConeSolution& solution) const
    {
        if (ofPlane)
        {
            ofPlane(program, solution);
        }
    }
    void operator()(const SpaceConeProgram& program, const ConeSolution& solution) const
    {
        if (ofSpace)
        {
            ofSpace(program, solution);
        }
    }
};

/// `<application> { solver automatic; tolerance 1e-9; }`. The file and each key may be absent.
struct SolverChoice
{
    SolverType solver = SolverType::automatic;
    double tolerance = 1e-9;     ///< on every figure of the certificate
    int maximumIterations = 200; ///< of each solver
    int correctors = 8;          ///< of interiorPoint
    int maximumSweeps = 10000;   ///< of gaussSeidel, which needs many and cheap ones
    int maximumFactorisations =
        5000; ///< of one step in time, all its programs and attempts (dynamics/StepWork.h)
    WriteProgram writeProgram = WriteProgram::never;
    bool writeIterations = false; ///< of interiorPoint, into the log
    bool isNearTried = true; ///< whether `automatic` goes on from a start that is nearly the solution; no key
    SolveObserver observer =
        {}; ///< called by solveConeProgram; no key: applications set it, or leave it empty
};
void declare(Options& options, SolverChoice& choice);

/// Solves a program of the plane or of space as chosen. \param start of augmentedLagrangian and gaussSeidel;
/// may be empty \param kept of the last program, to be used where the same bodies touch (form/Form.h); not
/// owned \return the solution; with `automatic` and a first solver that did not converge, that of the second
/// one, the iterations of both counted
template<int Rows, int Forces>
ConeSolution solveConeProgram(const ConeProgram<Rows, Forces>& program, const SolverChoice& choice,
                              const ConeSolution& start = {}, SymbolicAnalysis* kept = nullptr);

/// Whether a solver needs inertia, so that limit analysis cannot be solved with it.
bool solvesMotionOnly(SolverType solver);

/// Name of a solver, as dictionaries have it.
std::string nameOf(SolverType solver);

/// What the interior point takes over of a choice.
InteriorPointSettings interiorPointSettings(const SolverChoice& choice);

} // namespace drystone
