// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A phrase for each key; those that do not differ, or mean nothing for the quantity, are left out.
#include "ensembles/AccuracyWords.h"

namespace drystone
{

std::vector<std::string> wordsOf(const RunSetting& setting, const ShownKeys& shown)
{
    std::vector<std::string> parts;
    if (shown.deltaT)
    {
        parts.push_back(fmt::format("deltaT {:g}", setting.deltaT));
    }
    if (shown.theta)
    {
        parts.push_back(fmt::format("theta {:g}", setting.theta));
    }
    if (shown.flowRule)
    {
        parts.push_back(wordOf(setting.flowRule));
    }
    if (shown.solver)
    {
        parts.push_back(wordOf(setting.solver));
    }
    if (shown.tolerance)
    {
        parts.push_back(fmt::format("tolerance {:g}", setting.tolerance));
    }
    if (shown.pointsPerJoint)
    {
        parts.push_back(fmt::format("{} points a joint", setting.pointsPerJoint));
    }
    if (shown.pointsPerSide)
    {
        parts.push_back(fmt::format("{} points a side", setting.pointsPerSide));
    }
    if (shown.displacements)
    {
        parts.push_back(wordOf(setting.displacements) + " displacements");
    }
    if (shown.formulation)
    {
        parts.push_back(setting.formulation == ContactFormulation::points ? "by points" : "by surfaces");
    }
    if (shown.contactOverlap)
    {
        parts.push_back(fmt::format("overlap {:g}", setting.contactOverlap));
    }
    if (shown.effects)
    {
        parts.emplace_back(setting.effects == EffectSelection::automatic    ? "automatic effects"
                           : setting.effects == EffectSelection::everything ? "everything on"
                                                                            : "effects as given");
    }
    return parts;
}

std::string textOf(const RunSetting& setting, const ShownKeys& shown)
{
    return fmt::format("{}", fmt::join(wordsOf(setting, shown), ", "));
}

ShownKeys keysOf(const RunSetting& setting, QuantityKind kind)
{
    const bool isMotion = kind == QuantityKind::motion;
    ShownKeys shown;
    shown.deltaT = isMotion;
    shown.theta = isMotion;
    shown.flowRule = true;
    shown.solver = isMotion;
    shown.tolerance = true;
    shown.pointsPerJoint = setting.pointsPerJoint > 0;
    shown.pointsPerSide = setting.pointsPerSide > 0;
    shown.displacements = isMotion;
    shown.formulation = setting.formulation == ContactFormulation::surface;
    shown.contactOverlap = isMotion && setting.contactOverlap != Schemes().contactOverlap;
    shown.effects = setting.effects != EffectSelection::asGiven;
    return shown;
}

ShownKeys withoutAxis(ShownKeys shown, std::optional<SweepAxis> axis)
{
    shown.deltaT = shown.deltaT && axis != SweepAxis::deltaT;
    shown.tolerance = shown.tolerance && axis != SweepAxis::tolerance;
    shown.pointsPerJoint = shown.pointsPerJoint && axis != SweepAxis::pointsPerJoint;
    shown.pointsPerSide = shown.pointsPerSide && axis != SweepAxis::pointsPerSide;
    shown.contactOverlap = shown.contactOverlap && axis != SweepAxis::contactOverlap;
    return shown;
}

ShownKeys differingKeys(const std::vector<RunSetting>& settings, std::optional<SweepAxis> axis)
{
    ShownKeys shown;
    for (const RunSetting& other : settings)
    {
        forEachKey([](bool& isShown, const auto& value, const auto& first)
                   { isShown = isShown || value != first; },
                   shown, other, settings.front());
    }
    return withoutAxis(shown, axis);
}

std::string settingText(const RunSetting& setting, QuantityKind kind)
{
    return textOf(setting, keysOf(setting, kind));
}

std::string settingText(const RunSetting& setting, const std::vector<RunSetting>& among)
{
    const std::string text = textOf(setting, differingKeys(among, {}));
    return text.empty() ? "all" : text;
}

std::string percentText(double level)
{
    return fmt::format("{:g}%", 100 * level);
}

std::string axisName(SweepAxis axis)
{
    return axis == SweepAxis::pointsPerJoint   ? "points a joint"
           : axis == SweepAxis::pointsPerSide  ? "points a side"
           : axis == SweepAxis::deltaT         ? "deltaT [s]"
           : axis == SweepAxis::contactOverlap ? "overlap [block]"
                                               : "tolerance";
}

} // namespace drystone
