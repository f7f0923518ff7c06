// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Curves over an axis as a picture, the common output of studies and benchmarks.
#pragma once

#include "io/PictureFile.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

enum class AxisScale
{
    linear,
    logarithmic,
};

struct PlotAxis
{
    std::string label; ///< with its unit: "CPU time [s]"
    AxisScale scale = AxisScale::linear;
    std::optional<double> lower; ///< end of the axis; chosen from the data when absent
    std::optional<double> upper;
};

enum class CurveLine
{
    solid,
    dashed,
    dotted,
    none, ///< markers only
};

enum class CurveMarker
{
    automatic, ///< a different one for each curve
    none,
    circle,
    square,
    diamond,
    triangle,
};
/// Those that differ, in the order in which curves get them.
inline constexpr std::array curveMarkers{CurveMarker::circle, CurveMarker::square, CurveMarker::diamond,
                                         CurveMarker::triangle};

struct PlotCurve
{
    std::string name; ///< in the legend; a curve without a name is left out of it
    std::vector<double> x;
    std::vector<double> y;
    CurveLine line = CurveLine::solid;
    CurveMarker marker = CurveMarker::automatic;
    std::string colour; ///< CSS colour; a different one for each curve when empty
};

enum class ReferenceDirection
{
    horizontal,
    vertical,
};

/// A published value or a limit: a thin line across the plot with its name in the legend.
struct PlotReference
{
    std::string name;
    ReferenceDirection direction = ReferenceDirection::horizontal;
    double value = 0;
};

struct Plot
{
    std::string title;
    std::string subtitle; ///< conditions of the measurement: machine, tolerance, repeats
    PlotAxis x;
    PlotAxis y;
    std::vector<PlotCurve> curves;
    std::vector<PlotReference> references;
    double width = 760;  ///< [px]
    double height = 440; ///< [px]
};

/// Positions of the labelled ticks of an axis from lower to upper: round numbers for a linear axis, powers of
/// ten (and, over less than two and a half decades, 2 and 5 times them) for a logarithmic one.
std::vector<double> axisTicks(double lower, double upper, AxisScale scale);

/// The colour of a curve without a colour of its own, by its index.
std::string curveColour(std::size_t index);

/// The drawing. The legend is placed outside the axes, so that it never covers data.
/// \throws FatalError when x and y of a curve differ in number, a value is not finite, or a logarithmic axis
/// is to show a value that is not positive; the message names the curve and the point
Canvas drawnPlot(const Plot& plot);

/// The same as text of an SVG file.
std::string plotSvg(const Plot& plot);

/// The same as files `<name>.svg`, `.png`, `.pdf`, as writePicture writes them.
void writePlot(const std::filesystem::path& name, const Plot& plot, const PictureFormats& formats);

} // namespace drystone
