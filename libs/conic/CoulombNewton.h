// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Newton's method for Coulomb's law without dilatancy: the last digits of a step, once a program has come
/// near.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

struct SymbolicAnalysis;

/// When Newton's method for Coulomb's law ends.
struct CoulombNewtonSettings
{
    double tolerance = 1e-12; ///< on the equations of motion relative to the largest load, and on gaps and
                              ///< slips relative to the largest displacement
    /// An error of gaps and slips that more turns do not lessen may be so large: where a locked group of
    /// blocks has gaps that no rigid motion gives, being linear predictions, nothing lessens it [m]
    double gapTolerance = 0;
    int maximumIterations = 100;
};

/// Solves, for a program with inertia, Coulomb's law in place of the associative one,
///
///     Mbar y + A c = f,    0 <= c_n  perpendicular to  g_n - (A'y)_n >= 0,    |c_t| <= mu c_n,
///     c_t along (A'y)_t - g_t, and at its limit where the point slides,
///
/// which is the program itself with g_n larger by mu |(A'y)_t - g_t| (Acary & Cadoux 2013). The law is
/// written with projections (Alart & Curnier 1991): with w = s + rho (A'y - g) and the strengths T and C,
/// which are 0 of dry joints,
///
///     c_n = max(-T, w_n),    c_t = the nearest to w_t with |c_t| <= C + mu c_n,
///
/// and the equations of motion are solved by Newton's method in y for fixed s, one sparse LU factorisation
/// for each new set of points that are open, stick, and slide - in space also as the directions of slip turn;
/// then s = c, and again: rho is so large that a few times suffice. Nothing makes it converge from afar, and
/// where Coulomb's law has several solutions it gives the one near the start.
///
/// \param start forces and displacements near the solution, sized as in the solution
/// \param symbolic kept from program to program (form/Form.h), not owned
/// \return `optimal` or `notConverged`; `iterations` and `factorisations` are those of Newton's method
/// \throws std::invalid_argument for a program without inertia, with a multiplier, with points that give way
/// or crush, or a start of another size
template<int Rows, int Forces>
ConeSolution solveCoulombNewton(const ConeProgram<Rows, Forces>& program, const ConeSolution& start,
                                const CoulombNewtonSettings& settings, SymbolicAnalysis& symbolic);

} // namespace drystone
