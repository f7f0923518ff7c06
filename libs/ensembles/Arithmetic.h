// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Arithmetic of the variables and results of a study: objectives, constraints, statistics.
#pragma once

#include <string>
#include <vector>

namespace drystone
{

/// Places in the list of the names that occur in an expression, as often as they do.
std::vector<std::size_t> usedNames(const std::string& expression, const std::vector<std::string>& names);

/// What is wrong with arithmetic of these names, in sentences for a user; empty when nothing is. It may be
/// undefined for some values of the names.
std::string faultOfArithmetic(const std::string& expression, const std::vector<std::string>& names);

/// Likewise of arithmetic that has to depend on one of the names.
std::string faultOfDependent(const std::string& expression, const std::vector<std::string>& names);

/// Likewise of what has to be either true or false, 1 or 0: a comparison, or the name of what is one or the
/// other.
std::string faultOfCondition(const std::string& expression, const std::vector<std::string>& names);

} // namespace drystone
