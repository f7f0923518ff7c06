// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Places from the middle of the structure in six digits, since a page has many thousands of them.
#include "report/ViewerData.h"

#include "core/WholeFile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// A block of the plane as the prism that it is.
Polyhedron solidOf(const Block<2>& block)
{
    std::vector<Vector<3>> back;
    std::vector<Vector<3>> front;
    for (const Vector<2>& corner : block.outline)
    {
        back.emplace_back(corner.x(), corner.y(), -block.thickness / 2);
        front.emplace_back(corner.x(), corner.y(), block.thickness / 2);
    }
    return makePrism(back, front);
}

const Polyhedron& solidOf(const Block<3>& block)
{
    return block.shape;
}

template<int Dim>
Vector<3> inSpace(const Vector<Dim>& point)
{
    Vector<3> placed = Vector<3>::Zero();
    placed.template head<Dim>() = point;
    return placed;
}

std::string number(double value)
{
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : "null";
}

/// Numbers of a matrix, column by column.
std::string list(const Eigen::Ref<const Eigen::Matrix3Xd>& values)
{
    std::vector<std::string> numbers;
    for (const double value : values.reshaped())
    {
        numbers.push_back(number(value));
    }
    return fmt::format("[{}]", fmt::join(numbers, ","));
}

/// What centres are relative to: the mean of those of the free blocks, or of all where none is free.
Vector<3> middleOf(const std::vector<Vector<3>>& centres, const std::vector<bool>& isFixed)
{
    const bool isAll = std::find(isFixed.begin(), isFixed.end(), false) == isFixed.end();
    Vector<3> sum = Vector<3>::Zero();
    double count = 0;
    for (std::size_t block = 0; block < centres.size(); ++block)
    {
        if (isAll || !isFixed[block])
        {
            sum += centres[block];
            ++count;
        }
    }
    return sum / std::max(1.0, count);
}

std::string blockJson(const Polyhedron& solid, const Vector<3>& centre, const Vector<3>& middle, bool isFixed)
{
    Eigen::Matrix3Xd vertices(3, static_cast<Eigen::Index>(solid.vertices.size()));
    for (std::size_t i = 0; i < solid.vertices.size(); ++i)
    {
        vertices.col(static_cast<Eigen::Index>(i)) = solid.vertices[i] - centre;
    }
    std::vector<std::string> faces;
    for (const std::vector<int>& face : solid.faces)
    {
        faces.push_back(fmt::format("[{}]", fmt::join(face, ",")));
    }
    return fmt::format(R"({{"vertices":{},"faces":[{}],"centre":{},"fixed":{}}})", list(vertices),
                       fmt::join(faces, ","), list(centre - middle), isFixed);
}

} // namespace

template<int Dim>
std::string viewerJson(const Assembly<Dim>& assembly, const std::vector<BlockFrame>& frames,
                       const AnimationTime& time)
{
    std::vector<Vector<3>> centres;
    std::vector<bool> isFixed;
    for (const Block<Dim>& block : assembly.blocks)
    {
        centres.push_back(inSpace<Dim>(blockMass<Dim>(block).centroid));
        isFixed.push_back(block.support >= 0);
    }
    const Vector<3> middle = middleOf(centres, isFixed);
    std::vector<std::string> blocks;
    for (std::size_t i = 0; i < centres.size(); ++i)
    {
        blocks.push_back(blockJson(solidOf(assembly.blocks[i]), centres[i], middle, isFixed[i]));
    }
    std::vector<std::string> moments;
    for (const BlockFrame& frame : frames)
    {
        moments.push_back(fmt::format(R"({{"time":{},"displacement":{},"rotation":{}}})", number(frame.time),
                                      list(frame.displacement), list(frame.rotation)));
    }
    return fmt::format(
        R"({{"dimensions":{},"timeName":"{}","timeUnit":"{}","magnification":{},"blocks":[{}],"frames":[{}]}})",
        Dim, time.name, time.unit, number(time.magnification), fmt::join(blocks, ",\n"),
        fmt::join(moments, ",\n"));
}

std::optional<std::string> viewerScript()
{
    const std::string script = contentOfFile(sharedFolder() / "viewer.js");
    if (script.empty())
    {
        return std::nullopt;
    }
    // The end of the element that the script stands in must not stand in the script.
    const std::string_view closing = "</script";
    std::string text;
    std::size_t from = 0;
    for (std::size_t at = script.find(closing); at != std::string::npos; at = script.find(closing, from))
    {
        text.append(script, from, at - from).append("<\\/script");
        from = at + closing.size();
    }
    return text.append(script, from);
}

std::string viewerMarkup(std::string_view json, std::string_view id)
{
    return fmt::format(R"(<div class="viewer" data-motion="{1}">
<canvas></canvas>
<div class="controls">
<button name="play" type="button">Play</button>
<label>moment <input name="frame" type="range" min="0" max="0" step="any" value="0"></label>
<label>magnification <input name="magnification" type="number" min="0" step="any" value="1" size="8"></label>
<label>colour <select name="quantity"><option value="none">none</option><option>displacement</option>
<option>rotation</option></select></label>
<span class="scale" style="white-space:nowrap" hidden></span>
</div>
<p class="readout"></p>
</div>
<script id="{1}" type="application/json">{0}</script>
)",
                       json, id);
}

template std::string viewerJson(const Assembly<2>& assembly, const std::vector<BlockFrame>& frames,
                                const AnimationTime& time);
template std::string viewerJson(const Assembly<3>& assembly, const std::vector<BlockFrame>& frames,
                                const AnimationTime& time);

} // namespace drystone
