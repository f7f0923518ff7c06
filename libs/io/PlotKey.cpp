// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Shares colours, lines and markers out among the settings of curves.
#include "io/PlotKey.h"

#include <algorithm>
#include <array>

namespace drystone
{
namespace
{

constexpr std::size_t mostColours = 7; // of the palette
constexpr std::array lines{CurveLine::solid, CurveLine::dashed, CurveLine::dotted};
constexpr const char* neutral = "#444444";

/// The value of each curve, of one setting or of several together, and the values there are, in the order of
/// the curves.
struct Values
{
    std::vector<std::string> ofCurve;
    std::vector<std::string> all;

    std::size_t indexOf(std::size_t curve) const
    {
        return static_cast<std::size_t>(std::find(all.begin(), all.end(), ofCurve[curve]) - all.begin());
    }
};

Values valuesOf(const std::vector<std::vector<std::string>>& words, const std::vector<std::size_t>& settings)
{
    Values values;
    for (const std::vector<std::string>& curve : words)
    {
        std::string text;
        for (const std::size_t setting : settings)
        {
            text += (text.empty() ? "" : ", ") + curve[setting];
        }
        if (std::find(values.all.begin(), values.all.end(), text) == values.all.end())
        {
            values.all.push_back(text);
        }
        values.ofCurve.push_back(std::move(text));
    }
    return values;
}

} // namespace

bool lookBySettings(std::vector<PlotCurve>& curves, const std::vector<std::vector<std::string>>& words)
{
    if (curves.empty() || words.size() != curves.size() || words.front().size() < 2)
    {
        return false;
    }
    std::vector<std::size_t> settings;
    for (std::size_t setting = 0; setting < words.front().size(); ++setting)
    {
        settings.push_back(setting);
    }
    std::stable_sort(settings.begin(), settings.end(),
                     [&](std::size_t a, std::size_t b)
                     { return valuesOf(words, {a}).all.size() > valuesOf(words, {b}).all.size(); });
    const Values colours = valuesOf(words, {settings.front()});
    const Values dashes = valuesOf(words, {settings.back()});
    const Values shapes = valuesOf(words, {settings.begin() + 1, settings.end() - 1});
    if (colours.all.size() > mostColours || dashes.all.size() > lines.size()
        || shapes.all.size() > curveMarkers.size())
    {
        return false;
    }
    for (std::size_t i = 0; i < curves.size(); ++i)
    {
        curves[i].name.clear();
        curves[i].colour = curveColour(colours.indexOf(i));
        curves[i].line = lines[dashes.indexOf(i)];
        curves[i].marker = curveMarkers[shapes.indexOf(i)];
    }
    for (std::size_t i = 0; i < colours.all.size(); ++i)
    {
        curves.push_back({colours.all[i], {}, {}, CurveLine::solid, CurveMarker::none, curveColour(i)});
    }
    for (std::size_t i = 0; i < dashes.all.size(); ++i)
    {
        curves.push_back({dashes.all[i], {}, {}, lines[i], CurveMarker::none, neutral});
    }
    for (std::size_t i = 0; i < shapes.all.size() && shapes.all.size() > 1; ++i)
    {
        curves.push_back({shapes.all[i], {}, {}, CurveLine::none, curveMarkers[i], neutral});
    }
    return true;
}

} // namespace drystone
