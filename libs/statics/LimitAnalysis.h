// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis: the load at which a structure of rigid blocks becomes a mechanism.
#pragma once

#include "assembly/Loads.h"
#include "conic/Certificate.h"
#include "contact/Equilibrium.h"
#include "statics/StaticProgram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

struct SymbolicAnalysis;

/// The program of Portioli, Cascini & Landolfo 2017, eq. 10: max alpha with A0 c = fD + alpha fL and |t| <=
/// mu n, in space with the Euclidean norm of the two components of t. \param friction mu of each contact
/// point \param loads dead and live, 3 rows a free block, in space 6
template<int Dim>
StaticProgram<Dim> limitAnalysisProgram(int freeBlocks, const std::vector<ContactColumns<Dim>>& columns,
                                        const std::vector<double>& friction, const LoadVectors& loads);

/// What a structure does under dead + alpha live load.
enum class CollapseStatus
{
    optimal = 0,      ///< it collapses at alpha
    unstable = 1,     ///< it cannot carry the dead load
    unbounded = 2,    ///< no load of this direction makes it collapse; by Coulomb's law see isProvedUnbounded
    notConverged = 3, ///< the solver did not reach its tolerance: there is no answer
    upperBound = 4 ///< it collapses at alpha or less, by Coulomb's law, but no such collapse was found; alpha
                   ///< is infinite where the associative law has no collapse and the search was cut short:
                   ///< whether it has one is not known
};

/// With Coulomb's law collapse is not unique: what a search from several starts has met (NonAssociative.h).
struct CoulombRange
{
    double associative =
        0; ///< multiplier of the associative law, never below; infinite when that is unbounded
    /// Multiplier below which nothing collapses, found where no collapse was met or the associative law has
    /// none: the largest of joints whose shear is cohesion alone; minus infinity where these stand with none,
    /// infinity where they carry the live load alone.
    double safe = -std::numeric_limits<double>::infinity();
    double lowest = 0;  ///< of the collapses met; infinite where there is none
    double highest = 0; ///< of the collapses met
    /// Lowest multiplier met at which blocks fall under the dead load alone, without work of the live load;
    /// infinite where there is none.
    double fall = std::numeric_limits<double>::infinity();
    int starts = 0;    ///< tried
    int converged = 0; ///< that led to a collapse within the tolerance
    /// Clock after which it had to end, before all was tried, so that there may be lower collapses [s]; else
    /// none.
    std::optional<double> cutShortAfter = {};
};

/// Multipliers that a structure carries; the ends may be infinite.
struct MultiplierRange
{
    double least = 0;
    double largest = 0;
};

struct LimitAnalysis : SolverWork
{
    CollapseStatus status = CollapseStatus::notConverged;
    double alpha = 0; ///< collapse load multiplier, for `optimal`, or a bound on it, for `upperBound`; of a
                      ///< settlement the base reaction [N]
    Eigen::VectorXd contactForce; ///< (n, t), in space (n, t1, t2), of each contact point at collapse [N];
                                  ///< zero for `unstable`
    Eigen::VectorXd mechanism;    ///< (ux uy rz), in space (ux uy uz rx ry rz), of each free block, largest
                                  ///< entry 1, but of a settlement for a unit movement; zero for `unbounded`
    Certificate certificate;      ///< of what the status claims
    int variables = 0;            ///< forces and the multiplier
    /// Of each free block, where those that were not provably stay at rest (ReachedPart.h); empty: all were.
    std::vector<char> isSimulated;
    /// For `unstable`, where the live load holds the structure up: the multipliers with which it stands by
    /// the associative law, all of one sign.
    std::optional<MultiplierRange> held;
    /// Where joints crush: what else they have to bear for this answer, (n, t) of each contact point [N]. The
    /// forces of the dead load alone, and those at the ends of `held`.
    std::vector<Eigen::VectorXd> otherForces;
    std::string combination; ///< of loads that this is the answer for; empty where there is one only
    int position = -1;       ///< of a moving load, index into CaseLoads::positions; -1: it does not move
    /// Of the live load reversed, as `multiplier negative;` requests. Multipliers have the sign of the live
    /// load as given, so that a collapse is mostly below zero, and bounds are bounds from the other side.
    bool isReversed = false;
    std::optional<CoulombRange>
        coulomb; ///< for the non-associative flow rule; the rest is of its lowest collapse
};

/// Whether it says anything about the multiplier.
inline bool hasAnswer(const LimitAnalysis& analysis)
{
    return analysis.status != CollapseStatus::notConverged
           && (analysis.status != CollapseStatus::upperBound || std::isfinite(analysis.alpha));
}

/// Whether the search for collapses by Coulomb's law had to end before all was tried.
inline bool isCutShort(const LimitAnalysis& analysis)
{
    return analysis.coulomb && analysis.coulomb->cutShortAfter;
}

/// Whether `unbounded` is proved. By either law some forces carry any multiple of the live load then; by
/// Coulomb's, where other forces may let blocks slide out, there is a proof if joints without friction carry
/// it, and else a search that has found no collapse.
inline bool isProvedUnbounded(const LimitAnalysis& analysis)
{
    const double sign = analysis.isReversed ? -1 : 1;
    return analysis.status == CollapseStatus::unbounded
           && (!analysis.coulomb || sign * analysis.coulomb->safe == std::numeric_limits<double>::infinity());
}

/// How many blocks were simulated where not all were.
inline int simulatedBlocks(const LimitAnalysis& result)
{
    return static_cast<int>(std::count(result.isSimulated.begin(), result.isSimulated.end(), true));
}

/// Solves the program and checks the dead load by itself: the multipliers that a structure can carry are an
/// interval, and `optimal` means that 0 lies in it and alpha is its upper end. `unstable` carries a mechanism
/// that the dead load alone sets going, `unbounded` contact forces that balance the live load alone; both are
/// verified by Certificate.h. \param kept of the last program, to be used where the same bodies touch
/// (form/Form.h), which changes no digit of the answer; not owned
template<int Rows, int Forces>
LimitAnalysis solveLimitAnalysis(const ConeProgram<Rows, Forces>& program,
                                 const InteriorPointSettings& settings = {},
                                 SymbolicAnalysis* kept = nullptr);

/// The multipliers with which a structure stands that may be `unstable` without its live load: both ends of
/// the interval, by one program each. \param forces gets those of both ends, of each that is finite
/// \return nothing where it stands with none, or the solver has no answer
template<int Rows, int Forces>
std::optional<MultiplierRange>
multipliersThatHold(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                    SymbolicAnalysis& kept, std::vector<Eigen::VectorXd>* forces = nullptr);

} // namespace drystone
