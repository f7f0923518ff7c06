// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lays out the tables of a limit analysis.
#include "functionObjects/LimitAnalysisTables.h"

#include "contact/Facing.h"
#include "core/WholeFile.h"
#include "functionObjects/EarlierResults.h"
#include "functionObjects/LoadMeaning.h"
#include "io/MechanismPicture.h"
#include "quantities/LimitAnalysisFigures.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

template<int Dim>
std::string tableText(const LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results,
                      double cpuTime)
{
    std::string text = fmt::format("# {}\n", fmt::join(limitAnalysisHeadings(), " "));
    for (const LimitAnalysis& result : results)
    {
        std::string row;
        for (const TabledFigure& figure : limitAnalysisFigures(structure, result, cpuTime))
        {
            row += (row.empty() ? "" : " ") + figure.text;
        }
        text += row + "\n";
    }
    return text;
}

std::string thrustText(const std::vector<ContactPoint<2>>& points, const std::vector<Vector<2>>& forces)
{
    double largest = 0;
    for (const Vector<2>& force : forces)
    {
        largest = std::max(largest, force.norm());
    }
    std::string text =
        "# x[m] y[m] normalForce[N] shearForce[N] moment[Nm] eccentricity[m] block[-] neighbour[-]\n";
    for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end)
    {
        // The middle is that of the ends: between them hinges of crushing add points near one of them.
        const Vector<2> direction = tangent(points[begin]);
        const auto along = [&](std::size_t i, const Vector<2>& from)
        { return direction.dot(points[i].position - from); };
        const Vector<2> first = points[begin].position;
        Vector<2> force = Vector<2>::Zero();
        double size = 0;
        double lower = 0;
        double upper = 0;
        for (end = begin; end < points.size() && points[end].joint == points[begin].joint; ++end)
        {
            force += forces[end];
            size += forces[end].norm();
            lower = std::min(lower, along(end, first));
            upper = std::max(upper, along(end, first));
        }
        const Vector<2> middle = first + (lower + upper) / 2 * direction;
        double moment = 0;
        for (std::size_t i = begin; i < end; ++i)
        {
            moment += forces[i].x() * along(i, middle);
        }
        if (force.norm() <= 1e-6 * largest)
        {
            continue;
        }
        const double eccentricity = hasCentreOfPressure(force.x(), size) ? moment / force.x() : 0;
        const Vector<2> pressure = middle + eccentricity * direction;
        text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {} {}\n", pressure.x(), pressure.y(),
                            force.x(), force.y(), moment, eccentricity, points[begin].block,
                            points[begin].neighbour);
    }
    return text;
}

std::string thrustText(const std::vector<ContactPoint<3>>& points, const std::vector<Vector<3>>& forces)
{
    double largest = 0;
    for (const Vector<3>& force : forces)
    {
        largest = std::max(largest, force.norm());
    }
    std::string text = "# x[m] y[m] z[m] fx[N] fy[N] fz[N] normalForce[N] shearForce[N] torsion[Nm] block[-] "
                       "neighbour[-]\n";
    for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end)
    {
        Vector<3> force = Vector<3>::Zero();
        Vector<3> centre = Vector<3>::Zero();
        Vector<3> middle = Vector<3>::Zero();
        double pressure = 0;
        double size = 0;
        for (end = begin; end < points.size() && points[end].joint == points[begin].joint; ++end)
        {
            force += contactFrame(points[end]) * forces[end];
            centre += forces[end].x() * points[end].position;
            middle += points[end].position;
            pressure += forces[end].x();
            size += forces[end].norm();
        }
        if (force.norm() <= 1e-6 * largest)
        {
            continue;
        }
        centre = hasCentreOfPressure(pressure, size) ? Vector<3>(centre / pressure)
                                                     : Vector<3>(middle / static_cast<double>(end - begin));
        double torsion = 0;
        for (std::size_t i = begin; i < end; ++i)
        {
            const Vector<3> arm = points[i].position - centre;
            const Vector<3> at = contactFrame(points[i]) * forces[i];
            torsion += points[begin].normal.dot(momentOf(arm, at));
        }
        const double normalForce = force.dot(points[begin].normal);
        const double shear = (force - normalForce * points[begin].normal).norm();
        text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {} {}\n",
                            centre.x(), centre.y(), centre.z(), force.x(), force.y(), force.z(), normalForce,
                            shear, torsion, points[begin].block, points[begin].neighbour);
    }
    return text;
}

std::string alphaText(double alpha)
{
    std::string text = fmt::format("{:.6f}", alpha);
    return text == "-0.000000" ? text.substr(1) : text;
}

std::string coulombText(const CoulombRange& range)
{
    return fmt::format(
        "# lowest[-] highest[-] associative[-] starts[-] converged[-] fall[-]{}\n{:.12g} {:.12g} {:.12g} "
        "{} {} {:.12g}{}\n",
        range.cutShortAfter ? " cutShortAfter[s]" : "", range.lowest + 0.0, range.highest + 0.0,
        range.associative + 0.0, range.starts, range.converged,
        range.fall + 0.0, // adding 0 turns -0 into 0
        range.cutShortAfter ? fmt::format(" {:.6g}", *range.cutShortAfter) : "");
}

template<int Dim>
void writeLoadCases(const std::filesystem::path& file, const LoadVectors& loads)
{
    if (loads.cases.empty())
    {
        writeOrRemove(file, "");
        return;
    }
    std::string text = fmt::format("# case fx[N] fy[N]{}\n", Dim == 3 ? " fz[N]" : "");
    for (const auto& [name, load] : loads.cases)
    {
        const Vector<Dim> force = resultantOf<Dim>(load);
        text += fmt::format("{} {:.9g}\n", name, fmt::join(force.data(), force.data() + Dim, " "));
    }
    writeWholeFile(file, text);
}

template std::string tableText(const LimitAnalysisCase<2>& structure,
                               const std::vector<LimitAnalysis>& results, double cpuTime);
template std::string tableText(const LimitAnalysisCase<3>& structure,
                               const std::vector<LimitAnalysis>& results, double cpuTime);
template void writeLoadCases<2>(const std::filesystem::path& file, const LoadVectors& loads);
template void writeLoadCases<3>(const std::filesystem::path& file, const LoadVectors& loads);

} // namespace drystone
