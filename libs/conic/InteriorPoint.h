// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Primal-dual interior-point solver for the cone program: the one that starts from nothing and ends with a
/// proof.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

struct SymbolicAnalysis;
struct IterationTrace;

/// The numbers that iterations are done in.
enum class Arithmetic
{
    adaptive, ///< double precision; where rounding ends the iterations they are done again with twice as many
              ///< digits, if the program is small enough for that to take seconds
    standard  ///< double precision only
};

/// Keys of `solver interiorPoint;`, but for the last and `arithmetic`.
struct InteriorPointSettings
{
    double tolerance = 1e-9;     ///< on every figure of the certificate
    int maximumIterations = 200; ///< from each start, a factorisation each
    int correctors = 8;          ///< higher-order corrections tried with one factorisation; half of them
                                 ///< where it is cheap compared with its solves
    Arithmetic arithmetic = Arithmetic::adaptive;
    bool writeIterations =
        false; ///< a line for each into the log, why they ended, and the time of each phase
    IterationTrace* trace = nullptr; ///< the same for the caller (interiorPoint/Trace.h); not owned
};

/// Solves a program of the plane or of space from a cold start (Mehrotra 1992 predictor-corrector with
/// multiple correctors of Gondzio 1996, weighted as by Colombo & Gondzio 2008; round friction cones in the
/// symmetric scaling of Nesterov & Todd 1997, of which the step of a linear program is the case of rays;
/// proximal regularisation of the Schur system with iterative refinement; a balance that rounding loses near
/// the optimum is repaired by a factorisation of its own; where rounding ends the iterations they are done
/// again in extended precision, see Arithmetic). The solution's status is `optimal`, `infeasible` or
/// `unbounded` only when the certificate of Certificate.h, computed from the problem data, meets the
/// tolerance; otherwise `notConverged` with the best iterate.
/// \param kept of the last program, to be used where the same bodies touch (form/Form.h); not owned
/// \param near what may be nearly the solution of a program with inertia, such as what solved the last step:
/// iterations begin there if it is near enough, else, or if they do not end, from its `interior` moved on to
/// its displacements, and if there is none, or they do not end either, from nothing; not owned
/// \return with an `interior` where iterations came from there or from nothing
/// \throws std::invalid_argument for a program with compliance
template<int Rows, int Forces>
ConeSolution solveInteriorPoint(const ConeProgram<Rows, Forces>& program,
                                const InteriorPointSettings& settings = {}, SymbolicAnalysis* kept = nullptr,
                                const ConeSolution* near = nullptr);

} // namespace drystone
