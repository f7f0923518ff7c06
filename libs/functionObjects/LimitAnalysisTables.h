// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of a limit analysis as text, for its files.
#pragma once

#include "statics/LimitAnalysisCase.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// limitAnalysis.dat: a row of figures (quantities/LimitAnalysisFigures.h) for each answer.
/// \param cpuTime of the solution [s]
template<int Dim>
std::string tableText(const LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results,
                      double cpuTime);

/// thrust.dat: stress resultants of each joint about its middle, normal and shear force on the first block,
/// moment (positive where the pressure lies towards the joint's tangent), and the centre of pressure, where
/// the line of thrust passes; the middle of a joint without normal force. Joints that carry nothing are left
/// out.
/// \param points those of one joint follow each other \param forces (normal, tangent) of each [N]
std::string thrustText(const std::vector<ContactPoint<2>>& points, const std::vector<Vector<2>>& forces);

/// The same in space: force on the first block at the centre of pressure, or of pull, its parts normal and
/// tangential to the joint, and the moment about the normal through the centre. Without normal force it is at
/// the mean of the joint's points, and what bends the joint is not in the table.
std::string thrustText(const std::vector<ContactPoint<3>>& points, const std::vector<Vector<3>>& forces);

/// A multiplier with six decimals; one that is rounded to zero has no sign.
std::string alphaText(double alpha);

/// coulomb.dat: the range of collapses found by Coulomb's law, and the clock after which its search had to
/// end, where that was before all was tried.
std::string coulombText(const CoulombRange& range);

/// loadCases.dat, the force of each named load; without any removes the table of an earlier run.
template<int Dim>
void writeLoadCases(const std::filesystem::path& file, const LoadVectors& loads);

} // namespace drystone
