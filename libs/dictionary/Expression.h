// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Arithmetic in dictionaries: `#calc "2*$length"`, `#eval { sin(degToRad(30)) }`.
#pragma once

#include <map>
#include <string>

namespace drystone
{

/// Value of an arithmetic expression: + - * / ^ ( ), comparisons, && || !, `condition ? a : b`, pi (also
/// pi()), e, and the functions sin cos tan asin acos atan atan2 sinh cosh tanh exp log (natural) ln log2
/// log10 sqrt cbrt sqr pow hypot abs mag sign floor ceil round fmod min max sum avg degToRad radToDeg.
/// Nothing is compiled or executed. \throws std::invalid_argument saying what is wrong, also when the value
/// is not finite
double evaluateExpression(const std::string& expression);

/// The same with names that stand for numbers: letters, digits and _.
double evaluateExpression(const std::string& expression, const std::map<std::string, double>& names);

/// The same where no part may be undefined, as the logarithm of a negative number: compared with anything
/// that is false, and the whole has a value all the same. Found by the flag of IEEE 754 for invalid
/// operations.
double evaluateExpressionOfDefined(const std::string& expression, const std::map<std::string, double>& names);

} // namespace drystone
