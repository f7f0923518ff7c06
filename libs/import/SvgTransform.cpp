// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The transforms of SVG 1.1, section 7.6.
#include "import/SvgTransform.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

namespace drystone
{
namespace
{

/// The numbers in the brackets of a transform.
std::vector<double> valuesOf(SvgScanner& scanner, std::string_view name)
{
    if (scanner.letter() != '(')
    {
        scanner.fail(fmt::format("The transform `{}` has no `(`.", shown(name)));
    }
    std::vector<double> values;
    while (scanner.isNumber() && values.size() < 6)
    {
        values.push_back(scanner.number());
    }
    if (scanner.letter() != ')')
    {
        scanner.fail(fmt::format("The transform `{}` has no `)` after its numbers.", shown(name)));
    }
    return values;
}

SvgTransform transformOf(std::string_view name, const std::vector<double>& values, const SvgScanner& scanner)
{
    const auto has = [&](std::string_view wanted, std::initializer_list<std::size_t> counts)
    { return name == wanted && std::find(counts.begin(), counts.end(), values.size()) != counts.end(); };
    SvgTransform transform;
    if (has("matrix", {6}))
    {
        transform.matrix << values[0], values[2], values[1], values[3];
        transform.shift = {values[4], values[5]};
    }
    else if (has("translate", {1, 2}))
    {
        transform.shift = {values[0], values.size() > 1 ? values[1] : 0};
    }
    else if (has("scale", {1, 2}))
    {
        transform.matrix = Vector<2>(values[0], values.back()).asDiagonal();
    }
    else if (has("rotate", {1, 3}))
    {
        const double angle = values[0] * std::numbers::pi / 180;
        transform.matrix << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
        const Vector<2> centre = values.size() > 1 ? Vector<2>(values[1], values[2]) : Vector<2>::Zero();
        transform.shift = centre - transform.matrix * centre;
    }
    else if (has("skewX", {1}) || has("skewY", {1}))
    {
        transform.matrix(name == "skewX" ? 0 : 1, name == "skewX" ? 1 : 0) =
            std::tan(values[0] * std::numbers::pi / 180);
    }
    else
    {
        scanner.fail(
            fmt::format("The transform `{}` with {} numbers is not known.", shown(name), values.size()));
    }
    return transform;
}

} // namespace

SvgTransform operator*(const SvgTransform& outer, const SvgTransform& inner)
{
    return {outer.matrix * inner.matrix, outer.matrix * inner.shift + outer.shift};
}

SvgTransform svgTransform(SvgScanner attribute)
{
    SvgTransform whole;
    while (!attribute.isEnd())
    {
        const std::string_view name = attribute.word();
        whole = whole * transformOf(name, valuesOf(attribute, name), attribute);
    }
    return whole;
}

} // namespace drystone
