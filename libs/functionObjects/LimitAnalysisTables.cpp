// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lays out the tables of a limit analysis.
#include "functionObjects/LimitAnalysisTables.h"

#include "contact/Facing.h"
#include "core/WholeFile.h"
#include "functionObjects/EarlierResults.h"
#include "functionObjects/LoadMeaning.h"
#include "io/JointForces.h"
#include "quantities/LimitAnalysisFigures.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{
namespace
{

/// Joints that carry no more than this are not in the table [N].
template<int Dim>
double leastInTable(const std::vector<Vector<Dim>>& forces)
{
    double largest = 0;
    for (const Vector<Dim>& force : forces)
    {
        largest = std::max(largest, force.norm());
    }
    return 1e-6 * largest;
}

/// The middle between the ends of a joint: hinges of crushing add points near one of them, so that it is not
/// the mean of the points.
Vector<2> middleOfEnds(const std::vector<ContactPoint<2>>& points, const JointSum<2>& joint)
{
    const Vector<2>& first = points[joint.points.begin].position;
    const Vector<2> direction = tangent(points[joint.points.begin]);
    double lower = 0;
    double upper = 0;
    for (std::size_t i = joint.points.begin; i < joint.points.end; ++i)
    {
        const double along = direction.dot(points[i].position - first);
        lower = std::min(lower, along);
        upper = std::max(upper, along);
    }
    return first + (lower + upper) / 2 * direction;
}

Vector<3> meanPlace(const std::vector<ContactPoint<3>>& points, const JointSum<3>& joint)
{
    Vector<3> sum = Vector<3>::Zero();
    for (std::size_t i = joint.points.begin; i < joint.points.end; ++i)
    {
        sum += points[i].position;
    }
    return sum / static_cast<double>(joint.points.size());
}

} // namespace

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
    const double least = leastInTable(forces);
    std::string text =
        "# x[m] y[m] normalForce[N] shearForce[N] moment[Nm] eccentricity[m] block[-] neighbour[-]\n";
    for (const JointSum<2>& joint : jointSums(points, forces))
    {
        const Vector<2>& force = joint.inJoint;
        if (force.norm() <= least)
        {
            continue;
        }
        const Vector<2> direction = tangent(points[joint.points.begin]);
        const Vector<2> middle = middleOfEnds(points, joint);
        double moment = 0;
        for (std::size_t i = joint.points.begin; i < joint.points.end; ++i)
        {
            moment += forces[i].x() * direction.dot(points[i].position - middle);
        }
        const double eccentricity = joint.hasCentreOfPressure() ? moment / force.x() : 0;
        const Vector<2> pressure = middle + eccentricity * direction;
        text += fmt::format("{:.12g} {:.12g} {:.9g} {:.9g} {:.9g} {:.9g} {} {}\n", pressure.x(), pressure.y(),
                            force.x(), force.y(), moment, eccentricity, points[joint.points.begin].block,
                            points[joint.points.begin].neighbour);
    }
    return text;
}

std::string thrustText(const std::vector<ContactPoint<3>>& points, const std::vector<Vector<3>>& forces)
{
    const double least = leastInTable(forces);
    std::string text = "# x[m] y[m] z[m] fx[N] fy[N] fz[N] normalForce[N] shearForce[N] torsion[Nm] block[-] "
                       "neighbour[-]\n";
    for (const JointSum<3>& joint : jointSums(points, forces))
    {
        const Vector<3>& force = joint.force;
        if (force.norm() <= least)
        {
            continue;
        }
        const ContactPoint<3>& first = points[joint.points.begin];
        const Vector<3> centre =
            joint.hasCentreOfPressure() ? joint.centreOfPressure() : meanPlace(points, joint);
        double torsion = 0;
        for (std::size_t i = joint.points.begin; i < joint.points.end; ++i)
        {
            const Vector<3> arm = points[i].position - centre;
            const Vector<3> at = contactFrame(points[i]) * forces[i];
            torsion += first.normal.dot(momentOf(arm, at));
        }
        const double normalForce = force.dot(first.normal);
        const double shear = (force - normalForce * first.normal).norm();
        text += fmt::format("{:.12g} {:.12g} {:.12g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {} {}\n",
                            centre.x(), centre.y(), centre.z(), force.x(), force.y(), force.z(), normalForce,
                            shear, torsion, first.block, first.neighbour);
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
