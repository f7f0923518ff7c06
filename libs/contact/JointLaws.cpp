// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limits to the forces of points.
#include "contact/JointLaws.h"

#include "geometry/PolygonShape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

using NamedJoint = std::pair<NamePattern, JointProperties>;

/// An entry of constant/contactProperties, for a message.
SourceLocation locationOf(const std::filesystem::path& caseDirectory, const std::string& joint,
                          const std::string& effect)
{
    const Dictionary dictionary = Dictionary::readFile(caseDirectory / "constant/contactProperties");
    if (joint.empty())
    {
        return dictionary.locationOf(effect);
    }
    const Dictionary joints = dictionary.subDict("joints");
    for (const Entry& entry : joints.entries())
    {
        if (entry.keyword() == joint)
        {
            return entry.location();
        }
    }
    return joints.location();
}

/// The entry that a joint takes: the exact one, or the last pattern that matches.
const NamedJoint* entryOf(const ContactProperties& properties, const std::string& name,
                          std::vector<char>& isMatched)
{
    const NamedJoint* chosen = nullptr;
    for (std::size_t i = 0; i < properties.joints.size(); ++i)
    {
        const NamedJoint& candidate = properties.joints[i];
        if (candidate.first.matches(name))
        {
            isMatched[i] = true;
            if (!(chosen && chosen->first.text == name))
            {
                chosen = &candidate;
            }
        }
    }
    return chosen;
}

} // namespace

template<int Dim>
std::string jointName(const Assembly<Dim>& assembly, int block, int neighbour)
{
    const auto isFixed = [&](int index) { return assembly.blocks[index].support >= 0; };
    const auto nameOf = [&](int index) {
        return isFixed(index) ? assembly.supports[assembly.blocks[index].support].name
                              : std::to_string(index);
    };
    if (isFixed(block) != isFixed(neighbour) ? isFixed(block) : block > neighbour)
    {
        std::swap(block, neighbour);
    }
    return nameOf(block) + "-" + nameOf(neighbour);
}

std::vector<double> pointAreas(const Assembly<2>& assembly, const std::vector<ContactPoint<2>>& points)
{
    std::vector<double> areas(points.size(), 0);
    const auto thicknessOf = [&](const ContactPoint<2>& point)
    {
        const Block<2>& block = assembly.blocks[point.block];
        const Block<2>& neighbour = assembly.blocks[point.neighbour];
        if (block.support >= 0)
        {
            return neighbour.thickness;
        }
        return neighbour.support >= 0 ? block.thickness : std::min(block.thickness, neighbour.thickness);
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
    {
        if (points[i].joint == points[i + 1].joint)
        {
            const double half =
                thicknessOf(points[i]) * (points[i + 1].position - points[i].position).norm() / 2;
            areas[i] += half;
            areas[i + 1] += half;
        }
    }
    return areas;
}

namespace
{

/// Adds the areas of the corners [first, last) of one patch.
void addPatchAreas(const std::vector<ContactPoint<3>>& points, std::size_t first, std::size_t last,
                   std::vector<double>& areas)
{
    const Eigen::Matrix3d frame = contactFrame(points[first]);
    std::vector<std::size_t> corners;
    Polygon outline;
    for (std::size_t i = first; i < last; ++i)
    {
        const Vector<3> arm = points[i].position - points[first].position;
        outline.emplace_back(frame.col(1).dot(arm), frame.col(2).dot(arm));
        corners.push_back(i);
    }
    if (areaProperties(outline).area < 0)
    {
        std::reverse(outline.begin(), outline.end());
        std::reverse(corners.begin(), corners.end());
    }
    if (isConvex(outline))
    {
        const Vector<2> centroid = areaProperties(outline).centroid;
        for (std::size_t i = 0; i < outline.size(); ++i)
        {
            const std::size_t next = (i + 1) % outline.size();
            const double part = cross(outline[i] - centroid, outline[next] - centroid) / 2;
            areas[corners[i]] += part / 2;
            areas[corners[next]] += part / 2;
        }
        return;
    }
    for (const auto& triangle : triangulate(outline))
    {
        const double part = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) / 2;
        for (const Vector<2>& corner : triangle)
        {
            const auto at = std::find(outline.begin(), outline.end(), corner) - outline.begin();
            areas[corners[static_cast<std::size_t>(at)]] += part / 3;
        }
    }
}

} // namespace

std::vector<double> pointAreas(const Assembly<3>&, const std::vector<ContactPoint<3>>& points)
{
    std::vector<double> areas(points.size(), 0);
    for (std::size_t first = 0, last = 0; first < points.size(); first = last)
    {
        while (last < points.size() && points[last].joint == points[first].joint)
        {
            ++last;
        }
        addPatchAreas(points, first, last, areas);
    }
    return areas;
}

template<int Dim>
std::vector<PointLaw> pointLaws(const std::filesystem::path& caseDirectory,
                                const ContactProperties& properties, const Assembly<Dim>& assembly,
                                const std::vector<ContactPoint<Dim>>& points,
                                const std::vector<double>& areas)
{
    std::vector<PointLaw> laws(points.size());
    std::vector<char> isMatched(properties.joints.size(), false);
    const NamedJoint* entry = nullptr;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (!properties.joints.empty() && (i == 0 || points[i].joint != points[i - 1].joint))
        {
            entry = entryOf(properties, jointName(assembly, points[i].block, points[i].neighbour), isMatched);
        }
        const JointProperties own = entry ? entry->second : JointProperties{};
        const auto stress = [](const std::optional<JointStrength>& ofJoint,
                               const std::optional<JointStrength>& ofAll, double absent) {
            return ofJoint ? ofJoint->strength : ofAll ? ofAll->strength : absent;
        };
        PointLaw& law = laws[i];
        law.mu = own.friction ? own.friction->mu : properties.friction ? properties.friction->mu : 0;
        const double cohesion = stress(own.cohesion, properties.cohesion, 0);
        const double tension = stress(own.tension, properties.tension, 0);
        // The surface |t| = cohesion + mu n ends where it meets the axis.
        if (tension * law.mu > cohesion * (1 + 1e-12))
        {
            throw FatalIOError(
                fmt::format("Joint {} has a tension of {:g} Pa, but its cohesion of {:g} Pa and its friction "
                            "coefficient of {:g} end at {:g} Pa. Give cohesion {{ strength {:g}; }} or more.",
                            jointName(assembly, points[i].block, points[i].neighbour), tension, cohesion,
                            law.mu, cohesion / law.mu, tension * law.mu),
                locationOf(caseDirectory, own.tension ? entry->first.text : "", "tension"));
        }
        law.cohesion = cohesion * areas[i];
        law.tension = tension * areas[i];
        law.crushing =
            areas[i] * stress(own.crushing, properties.crushing, std::numeric_limits<double>::infinity());
        if (law.crushing == 0)
        {
            throw FatalIOError(
                fmt::format("Joint {} bears no pressure: give crushing {{ strength ...; }} above 0.",
                            jointName(assembly, points[i].block, points[i].neighbour)),
                locationOf(caseDirectory, own.crushing ? entry->first.text : "", "crushing"));
        }
    }
    for (std::size_t i = 0; i < properties.joints.size(); ++i)
    {
        if (!isMatched[i])
        {
            const std::string& name = properties.joints[i].first.text;
            throw FatalIOError(
                fmt::format("There is no joint {}. Joints are named by their blocks, as {}.", name,
                            points.empty() ? std::string("3-7")
                                           : jointName(assembly, points[0].block, points[0].neighbour)),
                locationOf(caseDirectory, name, ""));
        }
    }
    return laws;
}

template std::string jointName(const Assembly<2>& assembly, int block, int neighbour);
template std::string jointName(const Assembly<3>& assembly, int block, int neighbour);
template std::vector<PointLaw> pointLaws(const std::filesystem::path& caseDirectory,
                                         const ContactProperties& properties, const Assembly<2>& assembly,
                                         const std::vector<ContactPoint<2>>& points,
                                         const std::vector<double>& areas);
template std::vector<PointLaw> pointLaws(const std::filesystem::path& caseDirectory,
                                         const ContactProperties& properties, const Assembly<3>& assembly,
                                         const std::vector<ContactPoint<3>>& points,
                                         const std::vector<double>& areas);

} // namespace drystone
