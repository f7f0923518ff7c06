// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a multiplier means in forces, for logs and reports: an engineer wants 49.0 kN, not for alpha
/// = 48.9996.
#pragma once

#include "io/MechanismPicture.h"
#include "statics/LimitAnalysisCase.h"

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// A force with four digits in the unit that suits it: `312 N`, `49 kN`, `1.204 MN`. \param force [N]
std::string forceText(double force);

/// The resultant of the force rows of a load vector [N]. \param load rows ux uy rz (ux uy uz rx ry rz) of
/// each free block
template<int Dim>
Vector<Dim> resultantOf(const Eigen::VectorXd& load);

/// The loads that an answer belongs to: those of its combination, or of the case.
template<int Dim>
const LoadVectors& loadsOf(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result);

/// Sentences on an answer: dead and live load in all; where there is a multiplier, the live load at collapse
/// and as a part of the dead load; of a settling support its reaction. A live load without resultant, such as
/// a couple, is said to have none.
template<int Dim>
std::vector<std::string> loadMeaning(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result);

/// A sentence on the force of each load that `cases` of constant/loads names.
template<int Dim>
std::vector<std::string> caseMeaning(const LoadVectors& loads);

/// The same for a picture: the resultant of the live load, at collapse where there is one, or the movement of
/// a settling support. None where the live load has no resultant.
template<int Dim>
std::optional<LoadArrow> loadArrow(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result);

} // namespace drystone
