// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registry of statistics, and what all of them take from the table of samples.
#include "ensembles/Statistic.h"

#include "dictionary/Expression.h"
#include "ensembles/Arithmetic.h"
#include "ensembles/StatisticTypes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace drystone
{

const Registry<Statistic>& statisticTypes()
{
    static const Registry<Statistic> registry{
        "statistic",
        {distributionStatistic(), fractilesStatistic(), fragilityStatistic(), sensitivityStatistic()}};
    return registry;
}

double fractile(const std::vector<double>& sorted, double part)
{
    const double place = part * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    const double share = place - static_cast<double>(below);
    // Not of infinities, whose difference is no number.
    return share == 0 || sorted[below] == sorted[above] || std::isinf(sorted[below])
               ? sorted[below]
               : sorted[below] + share * (sorted[above] - sorted[below]);
}

std::vector<double> valuesOf(const std::string& expression, const SampleTable& table)
{
    const auto named = std::find(table.names.begin(), table.names.end(), expression);
    if (named != table.names.end())
    {
        return table.columns[static_cast<std::size_t>(named - table.names.begin())];
    }
    // A comparison with what is not a number would be false, not unknown: look at the names that are used.
    const std::vector<std::size_t> used = usedNames(expression, table.names);
    std::vector<double> values;
    std::map<std::string, double> names;
    for (std::size_t row = 0; row < table.rows(); ++row)
    {
        bool isKnown = true;
        for (const std::size_t k : used)
        {
            names[table.names[k]] = table.columns[k][row];
            isKnown = isKnown && !std::isnan(table.columns[k][row]);
        }
        if (!isKnown)
        {
            values.push_back(std::nan(""));
            continue;
        }
        try
        {
            values.push_back(evaluateExpressionOfDefined(expression, names));
        }
        catch (const std::invalid_argument&)
        {
            values.push_back(std::nan("")); // not defined, or not finite, with these values
        }
    }
    return values;
}

void requireVariable(const std::string& name, const std::vector<std::string>& names,
                     const SourceLocation& location)
{
    if (std::find(names.begin(), names.end(), name) == names.end())
    {
        throw FatalIOError(unknownWordMessage("variable", name, names), location);
    }
}

void requireExpression(const std::string& expression, const std::vector<std::string>& names,
                       const SourceLocation& location)
{
    if (const std::string fault = faultOfDependent(expression, names); !fault.empty())
    {
        throw FatalIOError(fault, location);
    }
}

void requireCondition(const std::string& expression, const std::vector<std::string>& names,
                      const SourceLocation& location)
{
    if (const std::string fault = faultOfCondition(expression, names); !fault.empty())
    {
        throw FatalIOError(fault, location);
    }
}

} // namespace drystone
