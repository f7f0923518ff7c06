// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Checks arithmetic of variables and results by its values for some numbers.
#include "ensembles/Arithmetic.h"

#include "dictionary/Expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <stdexcept>
#include <string_view>

namespace drystone
{
namespace
{

/// \throws std::invalid_argument as evaluateExpression does
double valueWhereAllAre(double number, const std::string& expression, const std::vector<std::string>& names)
{
    std::map<std::string, double> values;
    for (const std::string& name : names)
    {
        values[name] = number;
    }
    return evaluateExpression(expression, values);
}

bool isUndefined(const std::invalid_argument& error)
{
    return std::string_view(error.what()).find("finite") != std::string_view::npos;
}

} // namespace

std::vector<std::size_t> usedNames(const std::string& expression, const std::vector<std::string>& names)
{
    std::vector<std::size_t> used;
    const auto isPart = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t begin = 0; begin < expression.size();)
    {
        std::size_t end = begin;
        while (end < expression.size() && isPart(expression[end]))
        {
            ++end;
        }
        const auto found = std::find(names.begin(), names.end(), expression.substr(begin, end - begin));
        if (found != names.end())
        {
            used.push_back(static_cast<std::size_t>(found - names.begin()));
        }
        begin = std::max(end, begin + 1);
    }
    return used;
}

std::string faultOfArithmetic(const std::string& expression, const std::vector<std::string>& names)
{
    constexpr double plain = 0.5123; // at which hardly any expression is undefined
    try
    {
        valueWhereAllAre(plain, expression, names);
    }
    catch (const std::invalid_argument& error)
    {
        if (!isUndefined(error))
        {
            std::string reason = error.what();
            reason.erase(reason.find_last_not_of('.') + 1);
            return fmt::format(
                "`{}` is not arithmetic of variables and results: {}.\n\nVariables and results: {}",
                expression, reason, fmt::join(names, " "));
        }
    }
    return {};
}

std::string faultOfDependent(const std::string& expression, const std::vector<std::string>& names)
{
    std::string fault = faultOfArithmetic(expression, names);
    if (fault.empty() && usedNames(expression, names).empty())
    {
        fault = fmt::format("`{}` is the same for all: it depends on no variable and on no result.\n\n"
                            "Variables and results: {}",
                            expression, fmt::join(names, " "));
    }
    return fault;
}

std::string faultOfCondition(const std::string& expression, const std::vector<std::string>& names)
{
    std::string fault = faultOfDependent(expression, names);
    for (const double number : {0.0, 1.0})
    {
        try
        {
            const double value = fault.empty() ? valueWhereAllAre(number, expression, names) : 0;
            if (value != 0 && value != 1)
            {
                fault = fmt::format("`{0}` is a number, not a condition: compare it, as in \"{0} > 0.05\".",
                                    expression);
            }
        }
        catch (const std::invalid_argument&) // undefined there; it may be defined elsewhere
        {
        }
    }
    return fault;
}

} // namespace drystone
