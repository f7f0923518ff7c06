// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Arithmetic in dictionaries, by muParser.
#include "dictionary/Expression.h"

#include <cfenv>
#include <cmath>
#include <fmt/format.h>
#include <muParser.h>
#include <numbers>
#include <stdexcept>

namespace drystone
{

namespace
{

/// Longer than any arithmetic that a person writes into a dictionary.
constexpr std::size_t longestExpression = 10000;
/// The most brackets open at once.
constexpr int deepestExpression = 100;

/// `pi()` is what OpenFOAM has, `pi` what everyone else writes; muParser takes one meaning of a name.
std::string withPlainConstants(const std::string& expression)
{
    std::string result;
    for (std::size_t i = 0; i < expression.size();)
    {
        const bool startsName =
            i == 0
            || (std::isalnum(static_cast<unsigned char>(expression[i - 1])) == 0 && expression[i - 1] != '_');
        if (startsName && expression.compare(i, 4, "pi()") == 0)
        {
            result += "pi";
            i += 4;
            continue;
        }
        const char c = expression[i++];
        result += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
    }
    return result;
}

void refuseDeepNesting(const std::string& expression)
{
    int depth = 0;
    int operatorsInARow = 0;
    for (const char c : expression)
    {
        if (c == '(' && ++depth > deepestExpression)
        {
            throw std::invalid_argument(
                fmt::format("more than {} brackets are open at once", deepestExpression));
        }
        if (c == ')')
        {
            --depth;
        }
        if (c == '?')
        {
            ++operatorsInARow;
        }
    }
    if (operatorsInARow > deepestExpression)
    {
        throw std::invalid_argument(fmt::format("more than {} conditions", deepestExpression));
    }
}

void defineFunctions(mu::Parser& parser)
{
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    parser.DefineFun(
        "pow", +[](double base, double exponent) { return std::pow(base, exponent); });
    parser.DefineFun(
        "hypot", +[](double a, double b) { return std::hypot(a, b); });
    parser.DefineFun(
        "fmod", +[](double a, double b) { return std::fmod(a, b); });
    parser.DefineFun(
        "sqr", +[](double a) { return a * a; });
    parser.DefineFun(
        "cbrt", +[](double a) { return std::cbrt(a); });
    parser.DefineFun(
        "mag", +[](double a) { return std::abs(a); });
    parser.DefineFun(
        "floor", +[](double a) { return std::floor(a); });
    parser.DefineFun(
        "ceil", +[](double a) { return std::ceil(a); });
    parser.DefineFun(
        "round", +[](double a) { return std::round(a); });
    parser.DefineFun(
        "degToRad", +[](double a) { return a * std::numbers::pi / 180; });
    parser.DefineFun(
        "radToDeg", +[](double a) { return a * 180 / std::numbers::pi; });
    parser.DefineInfixOprt(
        "!", +[](double a) { return a == 0 ? 1.0 : 0.0; });
}

} // namespace

double evaluateExpression(const std::string& expression)
{
    return evaluateExpression(expression, {});
}

double evaluateExpressionOfDefined(const std::string& expression, const std::map<std::string, double>& names)
{
    std::feclearexcept(FE_INVALID);
    const double result = evaluateExpression(expression, names);
    if (std::fetestexcept(FE_INVALID) != 0)
    {
        throw std::invalid_argument("a part of it is not a finite number");
    }
    return result;
}

double evaluateExpression(const std::string& expression, const std::map<std::string, double>& names)
{
    if (expression.find_first_not_of(" \t\r\n") == std::string::npos)
    {
        throw std::invalid_argument("the expression is empty");
    }
    if (expression.size() > longestExpression)
    {
        throw std::invalid_argument(
            fmt::format("the expression is longer than {} characters", longestExpression));
    }
    refuseDeepNesting(expression);
    double result = 0;
    try
    {
        mu::Parser parser;
        defineFunctions(parser);
        for (const auto& [name, value] : names)
        {
            parser.DefineConst(name, value);
        }
        parser.SetExpr(withPlainConstants(expression));
        int count = 0;
        const double* results = parser.Eval(count);
        if (count != 1)
        {
            throw std::invalid_argument(fmt::format("one value is expected, not {}", count));
        }
        result = results[0];
    }
    catch (const mu::ParserError& error)
    {
        throw std::invalid_argument(error.GetMsg());
    }
    if (!std::isfinite(result))
    {
        throw std::invalid_argument("its value is not a finite number");
    }
    return result;
}

} // namespace drystone
