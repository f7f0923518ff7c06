// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Follows what steps call for, and draws it.
#include "functionObjects/EffectHistory.h"

#include "core/WholeFile.h"
#include "dynamics/EffectCalls.h"
#include "functionObjects/ColumnFile.h"
#include "io/Plot.h"

#include <algorithm>

namespace drystone
{
namespace
{

constexpr std::size_t mostRows = 800;
constexpr double percent = 100;

} // namespace

template<int Dim>
EffectHistory<Dim>::EffectHistory(const DynamicCase<Dim>& dynamicCase)
    : scene(dynamicCase), effects(namesOfEffects(dynamicCase))
{
}

template<int Dim>
void EffectHistory<Dim>::observe(const Motion<Dim>& motion)
{
    if (sums.empty() || sums.back().steps == stepsOfEach)
    {
        if (sums.size() == mostRows)
        {
            halve();
        }
        sums.push_back({});
        sums.back().shares.assign(2 + effects.size(), 0);
    }
    Sums& last = sums.back();
    const auto all = static_cast<double>(std::max<Eigen::Index>(1, scene.mass.size() / freedomCount<Dim>));
    last.time = motion.state.time;
    ++last.steps;
    last.shares[0] += static_cast<double>(awakeBlocks(motion)) / all;
    last.shares[1] += static_cast<double>(simulatedBodies(motion)) / all;
    for (std::size_t i = 0; i < motion.effectCalls.size() && i < effects.size(); ++i)
    {
        last.shares[2 + i] += motion.effectCalls[i];
    }
}

template<int Dim>
void EffectHistory<Dim>::halve()
{
    for (std::size_t i = 0; 2 * i + 1 < sums.size(); ++i)
    {
        Sums both = sums[2 * i + 1];
        both.steps += sums[2 * i].steps;
        for (std::size_t k = 0; k < both.shares.size(); ++k)
        {
            both.shares[k] += sums[2 * i].shares[k];
        }
        sums[i] = std::move(both);
    }
    sums.resize(sums.size() / 2);
    stepsOfEach *= 2;
}

template<int Dim>
std::vector<std::string> EffectHistory<Dim>::names() const
{
    std::vector<std::string> all{"blocks", "bodies"};
    all.insert(all.end(), effects.begin(), effects.end());
    return all;
}

template<int Dim>
double EffectHistory<Dim>::meanShare(const Sums& row, std::size_t column)
{
    return percent * row.shares[column] / static_cast<double>(row.steps);
}

template<int Dim>
void EffectHistory<Dim>::writeTable(const std::filesystem::path& folder) const
{
    constexpr int digits = 6;
    std::vector<std::string> columns{"Time[s]"};
    for (const std::string& name : names())
    {
        columns.push_back(name + "[%]");
    }
    std::string text = columnTitles(columns);
    for (const Sums& row : sums)
    {
        std::vector<double> values{row.time};
        for (std::size_t k = 0; k < row.shares.size(); ++k)
        {
            values.push_back(meanShare(row, k));
        }
        text += columnRow(values, digits);
    }
    writeWholeFile(folder / "effects.dat", text);
}

template<int Dim>
void EffectHistory<Dim>::writePicture(const std::filesystem::path& folder, const std::string& title,
                                      const PictureFormats& formats) const
{
    Plot plot;
    plot.title = title;
    plot.subtitle = "blocks simulated and the bodies they were, of all blocks; where each effect acted, of "
                    "the points or blocks";
    plot.x.label = "time [s]";
    plot.y = {"share [%]", AxisScale::linear, 0, percent};
    for (const std::string& name : names())
    {
        const std::size_t column = plot.curves.size();
        PlotCurve curve;
        curve.name = name;
        curve.marker = CurveMarker::none;
        for (const Sums& row : sums)
        {
            curve.x.push_back(row.time);
            curve.y.push_back(meanShare(row, column));
        }
        if (column >= 2)
        {
            curve.line = CurveLine::dashed;
        }
        plot.curves.push_back(std::move(curve));
    }
    writePlot(folder / "effects", plot, formats);
}

template class EffectHistory<2>;
template class EffectHistory<3>;

} // namespace drystone
