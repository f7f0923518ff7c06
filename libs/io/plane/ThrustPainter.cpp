// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lines and arrows of forces; the lines of a large wall are few elements of the file.
#include "io/plane/ThrustPainter.h"

#include "io/plane/ThrustLine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

constexpr std::string_view thrustColour = "#1b4f8f";

/// \param share of the largest force
double thrustWidth(double share)
{
    return 0.8 + 3.2 * std::sqrt(share);
}

ShapeStyle thrustStyle(double share)
{
    return {.stroke = std::string(thrustColour), .strokeWidth = thrustWidth(share), .opacity = 0.85};
}

std::vector<bool> areFree(const Assembly<2>& assembly)
{
    std::vector<bool> free;
    for (const Block<2>& block : assembly.blocks)
    {
        free.push_back(block.support < 0);
    }
    return free;
}

/// The lines of a large wall would merge, and its file would be too large to open: the strongest are left.
void keepStrongest(std::vector<ThrustSegment>& segments)
{
    constexpr std::size_t most = 6000;
    if (segments.size() > most)
    {
        std::nth_element(segments.begin(), segments.begin() + most, segments.end(),
                         [](const ThrustSegment& a, const ThrustSegment& b) { return a.force > b.force; });
        segments.resize(most);
    }
}

/// Of many segments, those of about the same width are one element of the file.
void paintTogether(Canvas& drawing, const std::vector<ThrustSegment>& segments, double largest,
                   const PlaneView& view)
{
    constexpr int widths = 12;
    std::vector<std::vector<std::pair<Vector<2>, Vector<2>>>> ofWidth(widths);
    for (const ThrustSegment& segment : segments)
    {
        const double root = std::sqrt(segment.force / largest);
        ofWidth[static_cast<std::size_t>(std::lround(root * (widths - 1)))].emplace_back(view(segment.from),
                                                                                         view(segment.to));
    }
    for (std::size_t width = 0; width < ofWidth.size(); ++width)
    {
        if (!ofWidth[width].empty())
        {
            const double root = static_cast<double>(width) / (widths - 1);
            drawing.lines(ofWidth[width], thrustStyle(root * root));
        }
    }
}

void paintSegments(Canvas& drawing, const std::vector<ThrustSegment>& segments, double largest,
                   const PlaneView& view)
{
    if (segments.size() > 1000)
    {
        paintTogether(drawing, segments, largest, view);
        return;
    }
    for (const ThrustSegment& segment : segments)
    {
        drawing.line(view(segment.from), view(segment.to), thrustStyle(segment.force / largest));
    }
}

/// An arrow of the force of a support on the structure, its tip at the centre of pressure.
void paintReaction(Canvas& drawing, const Vector<2>& tip, const Vector<2>& direction, double length,
                   double width)
{
    const ShapeStyle style{.stroke = std::string(thrustColour), .strokeWidth = width};
    const Vector<2> across(-direction.y(), direction.x());
    const double head = 4 + 1.5 * width;
    drawing.line(tip - length * direction, tip - 0.6 * head * direction, style);
    drawing.polygon(
        {tip, tip - head * direction + 0.4 * head * across, tip - head * direction - 0.4 * head * across},
        {.fill = std::string(thrustColour)});
}

/// Force with three digits, for a legend.
std::string forceLabel(double force)
{
    return force >= 1e3 ? fmt::format("{:.3g} kN", force / 1e3) : fmt::format("{:.3g} N", force);
}

} // namespace

double paintThrust(Canvas& drawing, const Assembly<2>& assembly, const std::vector<JointForce<2>>& thrust,
                   const PlaneView& view, double blockSize)
{
    double largest = 0;
    for (const JointForce<2>& joint : thrust)
    {
        largest = std::max(largest, joint.force.norm());
    }
    const std::vector<bool> free = areFree(assembly);
    std::vector<ThrustSegment> segments = thrustSegments(thrust, free);
    keepStrongest(segments);
    paintSegments(drawing, segments, largest, view);
    for (const JointForce<2>& joint : thrust)
    {
        const double share = joint.force.norm() / largest;
        const bool isFree = free[static_cast<std::size_t>(joint.block)];
        if (isFree == free[static_cast<std::size_t>(joint.neighbour)] || !(share > 0.02))
        {
            continue;
        }
        // The force is that on the first block; the picture has y downwards.
        const Vector<2> onFree = (isFree ? 1.0 : -1.0) * joint.force.normalized();
        paintReaction(drawing, view(joint.centre), {onFree.x(), -onFree.y()},
                      0.7 * blockSize * view.scale * std::sqrt(share), thrustWidth(share));
    }
    return largest;
}

void paintThrustLegend(Canvas& drawing, double largestForce, const Vector<2>& corner)
{
    Vector<2> place = corner;
    for (const double share : {1.0, 0.1})
    {
        const std::string label = forceLabel(share * largestForce);
        drawing.line(place + Vector<2>(0, 7), place + Vector<2>(24, 7), thrustStyle(share));
        drawing.text(place + Vector<2>(30, 11), label, {.size = 12});
        place.x() += 30 + textWidth(label, 12) + 18;
    }
    drawing.text(place + Vector<2>(0, 11), "line of thrust, reactions", {.size = 12});
}

} // namespace drystone
