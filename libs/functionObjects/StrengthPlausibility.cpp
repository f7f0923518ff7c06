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

/// The least crushing strength that constant/contactProperties gives, and the path of its entry.
std::optional<std::pair<double, std::string>> leastCrushing(const ContactProperties& contact)
{
    std::optional<std::pair<double, std::string>> least;
    const auto take = [&least](const std::optional<JointStrength>& crushing, const std::string& path)
    {
        if (crushing && (!least || crushing->strength < least->first))
        {
            least.emplace(crushing->strength, path + "crushing/strength");
        }
    };
    take(contact.crushing, "");
    for (const auto& [name, properties] : contact.joints)
    {
        take(properties.crushing, "joints/" + name.text + "/");
    }
    return least;
}

} // namespace

template<int Dim>
std::vector<Doubt> doubtsAboutCrushing(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    const auto least = leastCrushing(structure.contact);
    if (result.status != CollapseStatus::unstable || !least)
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

template std::vector<Doubt> doubtsAboutCrushing(const LimitAnalysisCase<2>& structure,
                                                const LimitAnalysis& result);
template std::vector<Doubt> doubtsAboutCrushing(const LimitAnalysisCase<3>& structure,
                                                const LimitAnalysis& result);

} // namespace drystone
