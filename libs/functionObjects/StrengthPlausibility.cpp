// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Largest forces of the points on supports against the resultant of the dead load, as the log states both.
#include "functionObjects/StrengthPlausibility.h"

#include "functionObjects/LoadMeaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace drystone
{
namespace
{

/// Strengths that a number in MPa has: from weak brick to hard stone.
constexpr double weakestInMegapascal = 0.1;
constexpr double hardestInMegapascal = 1000;

/// The largest force in any direction that a point bears [N].
double largestForce(const Strength& strength, double mu)
{
    const double pressed = std::hypot(strength.crushing, strength.cohesion + mu * strength.crushing);
    const double pulled = std::hypot(strength.tension, strength.cohesion);
    return std::max(pressed, pulled);
}

/// What the points between free and fixed blocks bear at most [N].
template<int Dim>
double borneBySupports(const LimitAnalysisCase<Dim>& structure)
{
    double sum = 0;
    for (std::size_t i = 0; i < structure.points.size(); ++i)
    {
        const ContactPoint<Dim>& point = structure.points[i];
        const auto isFixed = [&](int block) { return structure.assembly.blocks[block].support >= 0; };
        if (isFixed(point.block) != isFixed(point.neighbour))
        {
            sum += largestForce(structure.program.strengthOf(i), structure.program.friction[i]);
        }
    }
    return sum;
}

/// A strength in constant/contactProperties, with the path of its entry.
using GivenStrength = std::pair<double, std::string>;

/// Those of one kind, of all joints and of some.
std::vector<GivenStrength> strengthsOf(const ContactProperties& contact, const std::string& kind,
                                       std::optional<JointStrength> ContactProperties::*ofAll,
                                       std::optional<JointStrength> JointProperties::*ofSome)
{
    std::vector<GivenStrength> given;
    const auto take = [&](const std::optional<JointStrength>& strength, const std::string& path)
    {
        if (strength)
        {
            given.emplace_back(strength->strength, path + kind + "/strength");
        }
    };
    take(contact.*ofAll, "");
    for (const auto& [name, properties] : contact.joints)
    {
        take(properties.*ofSome, "joints/" + name.text + "/");
    }
    return given;
}

std::vector<GivenStrength> crushingStrengths(const ContactProperties& contact)
{
    return strengthsOf(contact, "crushing", &ContactProperties::crushing, &JointProperties::crushing);
}

} // namespace

template<int Dim>
std::vector<Doubt> doubtsAboutCrushing(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    const std::vector<GivenStrength> given = crushingStrengths(structure.contact);
    const auto least = std::min_element(given.begin(), given.end());
    if (result.status != CollapseStatus::unstable || least == given.end())
    {
        return {};
    }
    const double borne = borneBySupports(structure);
    const double dead = resultantOf<Dim>(loadsOf(structure, result).dead).norm();
    if (borne == 0 || borne >= dead) // nothing touches a support: another cause
    {
        return {};
    }
    const bool isRatherMegapascal =
        least->first >= weakestInMegapascal && least->first <= hardestInMegapascal;
    return {
        {fmt::format("strength = {:g} [Pa] is little beside the dead load: of its {} the joints on supports "
                     "bear {} at most. Strengths are in Pa{}. It is used as it stands.",
                     least->first, forceText(dead), forceText(borne),
                     isRatherMegapascal
                         ? fmt::format("; were it meant in MPa, write `strength {:g};`", 1e6 * least->first)
                         : ""),
         structure.contact.locations.of(least->second)}};
}

std::vector<Doubt> doubtsAboutLargeStrengths(const ContactProperties& contact, const LimitAnalysis& result)
{
    if (result.status != CollapseStatus::notConverged)
    {
        return {};
    }
    std::vector<GivenStrength> given = crushingStrengths(contact);
    for (const auto& others :
         {strengthsOf(contact, "cohesion", &ContactProperties::cohesion, &JointProperties::cohesion),
          strengthsOf(contact, "tension", &ContactProperties::tension, &JointProperties::tension)})
    {
        given.insert(given.end(), others.begin(), others.end());
    }
    std::vector<Doubt> doubts;
    for (const auto& [strength, path] : given)
    {
        if (strength > 1e6 * hardestInMegapascal)
        {
            doubts.push_back(
                {fmt::format("strength = {:g} [Pa] is above that of the hardest stone, {:g}, and "
                             "may be why there is no answer: compared with it the loads are "
                             "lost in rounding. Strengths are in Pa.",
                             strength, 1e6 * hardestInMegapascal),
                 contact.locations.of(path)});
        }
    }
    return doubts;
}

template std::vector<Doubt> doubtsAboutCrushing(const LimitAnalysisCase<2>& structure,
                                                const LimitAnalysis& result);
template std::vector<Doubt> doubtsAboutCrushing(const LimitAnalysisCase<3>& structure,
                                                const LimitAnalysis& result);

} // namespace drystone
