// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Follows a capacity curve and writes it as table, picture and animation.
#include "functionObjects/PushoverResults.h"

#include "contact/AlmostJoints.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "functionObjects/LimitAnalysisResults.h"
#include "io/Frames.h"
#include "io/Plot.h"
#include "io/VtkSeries.h"
#include "runControl/CaseFiles.h"
#include "statics/SolveCase.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{
namespace
{

std::string endText(PushoverEnd end)
{
    switch (end)
    {
    case PushoverEnd::overturned:
        return "alpha has decreased to zero: the structure overturns by itself";
    case PushoverEnd::falling:
        return "blocks have lost their support: the structure collapses by itself";
    case PushoverEnd::meeting:
        return "blocks meet where a corner or an edge alone touches the other, which pushover in space does "
               "not follow: the curve is incomplete";
    case PushoverEnd::stepsUsedUp:
        return "maximumSteps has been reached, and the structure still stands";
    case PushoverEnd::unbounded:
        return "no live load of this direction makes it move";
    case PushoverEnd::unstable:
        return "the blocks cannot carry the dead load as built";
    case PushoverEnd::notConverged:
        break;
    }
    return "not converged: the curve is incomplete. Try another step";
}

/// Solves the pushover and writes frames of it: at most a hundred along a mean block size.
template<int Dim>
Pushover pushoverWithFrames(const std::filesystem::path& caseDirectory,
                            const LimitAnalysisCase<Dim>& structure)
{
    constexpr double frames = 100;
    const double between = std::max(structure.pushover->step, meanBlockSize(structure.assembly) / frames);
    VtkSeries series(caseDirectory / "VTK", "pushover", 0, "limitAnalysis");
    double next = 0;
    return solvePushover<Dim>(structure,
                              [&](const CapacityPoint& point, const std::vector<Placement<Dim>>& placements)
                              {
                                  if (point.displacement >= next || point.alpha == 0)
                                  {
                                      series.write(point.displacement,
                                                   blockFrame(structure.assembly, placements));
                                      next = point.displacement + between;
                                  }
                              });
}

void writeCapacity(const std::filesystem::path& caseDirectory, const Pushover& pushover,
                   const PictureFormats& formats)
{
    std::string table = "# displacement[m] alpha[-] largestDisplacement[m] certificate[-] iterations[-]\n";
    PlotCurve curve;
    for (const CapacityPoint& point : pushover.curve)
    {
        table += fmt::format("{:.9g} {:.9g} {:.9g} {:.3e} {}\n", point.displacement, point.alpha,
                             point.largest, point.worst, point.iterations);
        curve.x.push_back(point.displacement);
        curve.y.push_back(point.alpha);
    }
    const auto file = [&](const char* name)
    { return limitAnalysisTable(caseDirectory).replace_filename(name); };
    writeWholeFile(file("capacity.dat"), table);
    if (pushover.curve.size() > 1)
    {
        Plot plot;
        plot.title = "Capacity curve of " + caseName(caseDirectory);
        plot.subtitle = endText(pushover.end);
        plot.x.label = "displacement of the live load [m]";
        plot.y.label = "alpha [-]";
        plot.curves.push_back(std::move(curve));
        writePlot(file("capacity"), plot, formats);
    }
}

template<int Dim>
void printPushover(const Assembly<Dim>& assembly, const Pushover& pushover)
{
    info("Pushover: {} positions; {}{}\n", pushover.curve.size(), endText(pushover.end),
         pushover.curve.empty() ? "" : fmt::format(", at d = {:.6g} m", pushover.curve.back().displacement));
    if (pushover.stepsToFirstOrder > 0)
    {
        printWarning(fmt::format("{} of {} steps were taken to first order, by the motion at their "
                                 "beginning: that of their middle was not found within maximumIterations and "
                                 "the tolerance. Another `step` may do.",
                                 pushover.stepsToFirstOrder, pushover.curve.size()));
    }
    if (pushover.end == PushoverEnd::meeting)
    {
        info("{} and {} would be {:.3g} m in each other\n", blockName(assembly, pushover.overlap.block),
             blockName(assembly, pushover.overlap.neighbour), pushover.overlap.depth);
    }
}

} // namespace

template<int Dim>
bool runPushover(const std::filesystem::path& caseDirectory, const LimitAnalysisCase<Dim>& structure,
                 const PictureFormats& formats)
{
    const Pushover pushover = pushoverWithFrames(caseDirectory, structure);
    writeCapacity(caseDirectory, pushover, formats);
    printPushover(structure.assembly, pushover);
    return pushover.end != PushoverEnd::notConverged && pushover.end != PushoverEnd::meeting;
}

template bool runPushover(const std::filesystem::path& caseDirectory, const LimitAnalysisCase<2>& structure,
                          const PictureFormats& formats);
template bool runPushover(const std::filesystem::path& caseDirectory, const LimitAnalysisCase<3>& structure,
                          const PictureFormats& formats);

} // namespace drystone
