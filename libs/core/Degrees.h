// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Angles that were probably written in degrees. In this library since more than one file of a case has
/// angles.
#pragma once

#include <string>

namespace drystone
{

/// What it would be in radians. \param angle as it was given \param before, after of the angle, as it is to
/// be written
std::string doubtAboutDegrees(double angle, const std::string& before, const std::string& after);

} // namespace drystone
