// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The answers of a limit analysis as the case requests them: ends of the range, positions of a load,
/// combinations, more points where joints need them, the capacity curve.
#pragma once

#include "statics/LimitAnalysisCase.h"

namespace drystone
{

/// Collapse by the flow rule of the case, for a positive multiplier; for a support that moves, settlement.
///
/// Joints that crush turn about points within them. Unless the case says how many points they have
/// (`pointsPerJoint`, in space `jointPoints`), points are added to where the hinges are, until no joint bears
/// a resultant nearer to its edge than it can, to 1e-7 of its length or ten times the tolerance of the solver
/// (CrushingHinges.h); in space then where joints are twisted, until the multiplier exceeds the bound of its
/// mechanism over whole joints by no more than 1e-3 of itself, or what `jointPoints { type adaptive; }` says
/// (JointDissipation.h). \param structure gets these points
template<int Dim>
LimitAnalysis solveLimitAnalysis(LimitAnalysisCase<Dim>& structure);

/// The capacity curve of a case that requests one.
template<int Dim>
Pushover solvePushover(const LimitAnalysisCase<Dim>& structure, const PushoverObserver<Dim>& observe);

/// One answer for each end of the range that the case requests, the positive one first; for each combination
/// of loads in turn. Multipliers of the negative end have their sign. Of a moving load the answer of its
/// worst position alone: the lowest multiplier, of equal ones the first; one without an answer, if there is
/// any. \param structure gets points where joints crush, see solveLimitAnalysis; with a moving load the
/// envelope and, as live load, that of the worst position
/// \param kept of the last case, to be used where the same bodies touch (form/Form.h), which changes no digit
/// of an answer; not owned
template<int Dim>
std::vector<LimitAnalysis> solveLimitAnalyses(LimitAnalysisCase<Dim>& structure,
                                              SymbolicAnalysis* kept = nullptr);

} // namespace drystone
