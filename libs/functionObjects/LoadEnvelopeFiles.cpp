// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The envelope of a moving load as a table and as a picture: it combines statics with output.
#include "functionObjects/LoadEnvelopeFiles.h"

#include "core/WholeFile.h"
#include "functionObjects/EarlierResults.h"
#include "functionObjects/LoadEnvelope.h"
#include "io/Plot.h"
#include "quantities/LimitAnalysisFigures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// A line a place.
template<int Dim>
std::string tableOf(const LimitAnalysisCase<Dim>& structure)
{
    std::string text =
        fmt::format("# distance[m] x[m] y[m] {}block[-] alpha[-] status[-]\n", Dim == 3 ? "z[m] " : "");
    for (std::size_t i = 0; i < structure.envelope.size(); ++i)
    {
        const LoadPosition<Dim>& position = structure.loads.positions[i];
        const PositionResult& result = structure.envelope[i];
        text += fmt::format("{:.9g} {:.12g} {} {:.12g} {}\n", position.distance,
                            fmt::join(position.place.data(), position.place.data() + Dim, " "),
                            position.blocks.front(), tabledAlpha(result.status, result.alpha),
                            static_cast<int>(result.status));
    }
    return text;
}

/// The curve in parts: a line ends where the multiplier is unbounded.
std::vector<PlotCurve> curvesOf(const std::vector<EnvelopePoint>& points)
{
    std::vector<PlotCurve> curves;
    PlotCurve curve;
    curve.name = "alpha";
    curve.colour = curveColour(0);
    curve.marker = CurveMarker::none;
    const auto finish = [&]
    {
        if (!curve.x.empty())
        {
            curves.push_back(curve);
            curve.name.clear();
        }
        curve.x.clear();
        curve.y.clear();
    };
    for (const EnvelopePoint& point : points)
    {
        if (!std::isfinite(point.alpha))
        {
            finish();
            continue;
        }
        curve.x.push_back(point.distance);
        curve.y.push_back(point.alpha);
    }
    finish();
    return curves;
}

PlotCurve markOf(const EnvelopePoint& worst)
{
    PlotCurve mark;
    mark.name = "worst place";
    mark.x = {worst.distance};
    mark.y = {worst.alpha};
    mark.line = CurveLine::none;
    mark.marker = CurveMarker::circle;
    mark.colour = curveColour(1);
    return mark;
}

template<int Dim>
Plot plotOf(const LimitAnalysisCase<Dim>& structure, const EnvelopePoint& worst, const std::string& caseName)
{
    const std::vector<EnvelopePoint> points = envelopeOf(structure);
    Plot plot;
    plot.title = fmt::format("Moving load on {}", caseName);
    plot.subtitle = fmt::format("worst place {:.4g} m along the path, from {}: alpha = {:.6g}",
                                worst.distance, placeText(structure, worst), worst.alpha);
    plot.x.label = "distance of the load along its path [m]";
    plot.y.label = "collapse multiplier alpha [-]";
    plot.y.lower = 0;
    // Near the supports it grows beyond all bounds, which would flatten the rest.
    constexpr double shown = 6;
    const bool isCut =
        std::any_of(points.begin(), points.end(),
                    [&](const EnvelopePoint& point) { return point.alpha > shown * worst.alpha; });
    if (isCut && worst.alpha > 0)
    {
        plot.y.upper = shown * worst.alpha;
    }
    plot.curves = curvesOf(points);
    plot.curves.push_back(markOf(worst));
    return plot;
}

} // namespace

template<int Dim>
void writeEnvelope(const std::filesystem::path& folder, const LimitAnalysisCase<Dim>& structure,
                   const std::string& caseName, const PictureFormats& formats)
{
    const std::filesystem::path table = folder / "movingLoad.dat";
    const std::filesystem::path picture = folder / "movingLoad";
    removePicture(picture);
    if (structure.envelope.empty())
    {
        writeOrRemove(table, "");
        return;
    }
    writeWholeFile(table, tableOf(structure));
    if (const std::optional<EnvelopePoint> worst = worstPlace(structure))
    {
        writePlot(picture, plotOf(structure, *worst, caseName), formats);
    }
}

template void writeEnvelope(const std::filesystem::path& folder, const LimitAnalysisCase<2>& structure,
                            const std::string& caseName, const PictureFormats& formats);
template void writeEnvelope(const std::filesystem::path& folder, const LimitAnalysisCase<3>& structure,
                            const std::string& caseName, const PictureFormats& formats);

} // namespace drystone
