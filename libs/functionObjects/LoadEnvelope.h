// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Multipliers of a moving load over its places, and what the log says of them.
#pragma once

#include "io/MechanismPicture.h"
#include "statics/LimitAnalysisCase.h"

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// One place of the load, the lower multiplier where it acts on either side of a joint.
struct EnvelopePoint
{
    double distance = 0;      ///< along the path [m]
    std::size_t position = 0; ///< index into CaseLoads::positions
    double alpha = 0;         ///< inf where unbounded, nan where unstable
};

/// The places in their order. \param structure solved, see solveLimitAnalyses
template<int Dim>
std::vector<EnvelopePoint> envelopeOf(const LimitAnalysisCase<Dim>& structure);

/// Where the multiplier is least, of equal ones the first; nothing without a moving load, or where none is
/// finite.
template<int Dim>
std::optional<EnvelopePoint> worstPlace(const LimitAnalysisCase<Dim>& structure);

/// `(-0.1 3)`: the place on the path.
template<int Dim>
std::string placeText(const LimitAnalysisCase<Dim>& structure, const EnvelopePoint& point);

/// `2 m along the path, from (-0.1 3)`.
template<int Dim>
std::string pathText(const LimitAnalysisCase<Dim>& structure, const EnvelopePoint& point);

/// Sentences on how many places there are and at how many of them no load makes the structure collapse and,
/// where there is one, the worst. None without a moving load.
template<int Dim>
std::vector<std::string> envelopeMeaning(const LimitAnalysisCase<Dim>& structure);

/// Where the axles of the worst place of a moving load meet the structure; of a live load on one block alone
/// where its line of action enters it; none of others.
template<int Dim>
std::vector<LoadPlace> loadPlaces(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result);

/// What envelopeMeaning says, places that are left out and places without an answer, for the log. Nothing
/// without a moving load.
template<int Dim>
void printEnvelope(const LimitAnalysisCase<Dim>& structure);

} // namespace drystone
