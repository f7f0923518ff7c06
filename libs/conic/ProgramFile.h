// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Cone programs as text files, so that a problem can be kept, sent and solved again: by `solveProgram`, or
/// by any program that reads a dictionary.
#pragma once

#include "conic/ConeProgram.h"
#include "conic/SolverChoice.h"

#include <filesystem>
#include <functional>
#include <string>
#include <variant>

namespace drystone
{

/// A program of the plane or of space.
using AnyConeProgram = std::variant<PlaneConeProgram, SpaceConeProgram>;

/// The program of ConeProgram.h in the grammar of dictionaries, with F = `dimensions` force components a
/// contact point and R = 3 (plane: ux uy rz) or 6 (space: ux uy uz rx ry rz) rows a body:
///
///     dimensions      2;
///     bodies          33;                 // numbered from 0; -1 is a body that does not move
///     contacts        174                 // A, the columns of each contact point:
///     (
///         (0 -1 (0 -1 -1 0 -0.1 0.2) (0 0 0 0 0 0))
///     );                                  // (first body, second body, (R F numbers on the first body,
///                                         // row by row; columns: normal, then shear), (on the second:
///                                         // opposite forces))
///     friction        174(0.65 0.65 ...); // mu of each point, at least 0
///     strength        174((0 0 inf) ...); // (cohesion tension crushing) of each point; optional
///     load            99(0 -1000 0 ...);  // f, R a body
///     liveLoad        99(1000 0 0 ...);   // L, R a body; absent: no multiplier alpha
///     inertia         33((...) ...);      // Mbar, R x R numbers a body, row by row; absent: no inertia
///     gap             348(0 0 ...);       // g, F a contact point; absent: zero
///     compliance      348(1e-8 1e-8 ...); // diagonal of C, F a contact point, at least 0; absent: rigid
///
/// Numbers are written with as many digits as it takes to read the same double back, so that a program that
/// has been written and read is the same, bit for bit. Units are the writer's own: the program has none.
template<int Rows, int Forces>
std::string programText(const ConeProgram<Rows, Forces>& program);

/// Writes `programText`. \throws FatalError when the file cannot be written
template<int Rows, int Forces>
void writeProgram(const std::filesystem::path& file, const ConeProgram<Rows, Forces>& program);

/// \throws FatalIOError with file and line for what is not as above: a missing or an unknown key, a list of
/// another length, a body that there is not, forces on two bodies that are not opposite, a friction below 0,
/// an inertia that is not symmetric and positive definite, a live load of zeros
AnyConeProgram readProgram(const std::filesystem::path& file);

/// What a solver calls after each program it is given, to write those that `when` names.
/// \param file where to; called for each program anew. A later program replaces an earlier one
SolveObserver programWriter(WriteProgram when, std::function<std::filesystem::path()> file);

} // namespace drystone
