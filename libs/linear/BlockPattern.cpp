// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Each column of the factor joins the rows of its children in the elimination tree.
#include "linear/BlockPattern.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace drystone
{

int BlockPattern::slot(int first, int second) const
{
    const int column = std::min(first, second);
    const int wanted = std::max(first, second);
    const auto begin = row.begin() + columnStart[column];
    const auto end = row.begin() + columnStart[column + 1];
    const auto found = std::lower_bound(begin, end, wanted);
    if (found == end || *found != wanted)
    {
        throw std::out_of_range("BlockPattern::slot: no such pair in the pattern");
    }
    return static_cast<int>(found - row.begin());
}

BlockPattern makeBlockPattern(int bodies, const std::vector<Coupling>& couplings)
{
    std::vector<Coupling> pairs; // (column, row), row >= column
    pairs.reserve(couplings.size() + bodies);
    for (int body = 0; body < bodies; ++body)
    {
        pairs.push_back({body, body});
    }
    for (const Coupling& pair : couplings)
    {
        pairs.push_back({std::min(pair[0], pair[1]), std::max(pair[0], pair[1])});
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    BlockPattern pattern;
    pattern.columnStart.assign(bodies + 1, 0);
    pattern.row.reserve(pairs.size());
    for (const Coupling& pair : pairs)
    {
        pattern.row.push_back(pair[1]);
        ++pattern.columnStart[pair[0] + 1];
    }
    std::partial_sum(pattern.columnStart.begin(), pattern.columnStart.end(), pattern.columnStart.begin());
    return pattern;
}

double FactorPattern::operations(int rows) const
{
    double count = 0;
    for (int column = 0; column < factor.columns(); ++column)
    {
        const double below = factor.columnStart[column + 1] - factor.columnStart[column] - 1;
        count += below * (below + 1) / 2 + below + 1.0 / 6;
    }
    return rows * rows * rows * count;
}

namespace
{

/// The pattern of the factor: column j of L has the rows of S joined with those of j's children in the
/// elimination tree, less the children themselves; j's parent is the first row below its diagonal.
BlockPattern factorOf(const BlockPattern& matrix)
{
    const int columns = matrix.columns();
    BlockPattern factor;
    std::vector<int>& start = factor.columnStart;
    std::vector<int>& row = factor.row;
    start.assign(columns + 1, 0);
    std::vector<std::vector<int>> children(columns);
    std::vector<int> mark(columns, -1);
    for (int column = 0; column < columns; ++column)
    {
        const auto begin = static_cast<std::ptrdiff_t>(row.size());
        mark[column] = column;
        row.push_back(column);
        const auto join = [&](int candidate)
        {
            if (candidate > column && mark[candidate] != column)
            {
                mark[candidate] = column;
                row.push_back(candidate);
            }
        };
        for (int entry = matrix.columnStart[column]; entry < matrix.columnStart[column + 1]; ++entry)
        {
            join(matrix.row[entry]);
        }
        for (const int child : children[column])
        {
            for (int entry = start[child]; entry < start[child + 1]; ++entry)
            {
                join(row[entry]);
            }
        }
        std::sort(row.begin() + begin, row.end());
        start[column + 1] = static_cast<int>(row.size());
        if (static_cast<std::ptrdiff_t>(row.size()) > begin + 1)
        {
            children[row[begin + 1]].push_back(column);
        }
    }
    return factor;
}

/// Fills in the updates of each column: the entries of its row of the factor, left of the diagonal.
void findUpdates(FactorPattern& pattern)
{
    const int columns = pattern.factor.columns();
    const std::vector<int>& start = pattern.factor.columnStart;
    const std::vector<int>& row = pattern.factor.row;
    std::vector<int>& updateStart = pattern.updateStart;
    updateStart.assign(columns + 1, 0);
    for (int column = 0; column < columns; ++column)
    {
        for (int entry = start[column] + 1; entry < start[column + 1]; ++entry)
        {
            ++updateStart[row[entry] + 1];
        }
    }
    std::partial_sum(updateStart.begin(), updateStart.end(), updateStart.begin());
    pattern.updatePosition.resize(updateStart[columns]);
    pattern.columnOf.resize(updateStart[columns]);
    std::vector<int> next(updateStart.begin(), updateStart.end() - 1);
    for (int column = 0; column < columns; ++column)
    {
        for (int entry = start[column] + 1; entry < start[column + 1]; ++entry)
        {
            const int update = next[row[entry]]++;
            pattern.updatePosition[update] = entry;
            pattern.columnOf[update] = column;
        }
    }
}

} // namespace

FactorPattern makeFactorPattern(const BlockPattern& matrix)
{
    FactorPattern pattern;
    pattern.factor = factorOf(matrix);
    findUpdates(pattern);
    return pattern;
}

} // namespace drystone
