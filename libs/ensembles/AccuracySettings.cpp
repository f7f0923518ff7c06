// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declares the keys of system/accuracyCostDict and expands its sweeps.
#include "ensembles/AccuracySettings.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace drystone
{
namespace
{

/// Each setting with each of the values, the first setting first; as they are where there is no value.
template<class Value>
std::vector<RunSetting> combined(const std::vector<RunSetting>& settings, const std::vector<Value>& values,
                                 Value RunSetting::*key)
{
    if (values.empty())
    {
        return settings;
    }
    std::vector<RunSetting> all;
    for (const RunSetting& setting : settings)
    {
        for (const Value& value : values)
        {
            all.push_back(setting);
            all.back().*key = value;
        }
    }
    return all;
}

template<class Value>
std::string twinsFault(const std::vector<Value>& list)
{
    const bool hasTwins = std::set<Value>(list.begin(), list.end()).size() < list.size();
    return hasTwins ? "A value stands twice in this list: remove one of them." : "";
}

bool isFileName(const std::string& name)
{
    return !name.empty()
           && std::all_of(name.begin(), name.end(),
                          [](char c)
                          { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
}

} // namespace

void declare(Options& options, Sweep& sweep)
{
    options.required("quantity", sweep.quantity, "one of the names under `quantities`").example("return");
    declareSettings(options, sweep,
                    "steps of a motion; absent, here and in all lists below: the value of the case");
    options
        .optional("along", sweep.along,
                  "the setting that varies along one curve; absent: the first of deltaT, tolerance, "
                  "pointsPerJoint, pointsPerSide and contactOverlap that has several values")
        .example("deltaT");
    options
        .optional("phases", sweep.phases,
                  "runs of a motion for each setting, each with another first step, so that impacts occur at "
                  "all phases of a step")
        .atLeast(1)
        .atMost(1000);
    options.optional("repeats", sweep.repeats, "of a multiplier for each setting, for the CPU time")
        .atLeast(1)
        .atMost(1000);
    const auto twins = [&options](const std::string& key, const auto& list)
    { options.check(key, [&list] { return twinsFault(list); }); };
    twins("deltaT", sweep.deltaT);
    twins("theta", sweep.theta);
    twins("flowRule", sweep.flowRule);
    twins("solver", sweep.solver);
    twins("tolerance", sweep.tolerance);
    twins("pointsPerJoint", sweep.pointsPerJoint);
    twins("pointsPerSide", sweep.pointsPerSide);
    twins("displacements", sweep.displacements);
    twins("formulation", sweep.formulation);
    twins("contactOverlap", sweep.contactOverlap);
    twins("effects", sweep.effects);
}

void declare(Options& options, AccuracySettings& settings)
{
    options
        .required("quantities", settings.quantities, quantityTypes(),
                  "figures of the case whose errors are measured; any names")
        .example("return");
    options
        .required("sweeps", settings.sweeps,
                  "all combinations of the lists in each; any names, also used for files")
        .example("schemes");
    options.check(
        "quantities", [&settings]
        { return settings.quantities.empty() ? "There is no quantity to be measured: add one." : ""; });
    options.check("sweeps",
                  [&settings]() -> std::string
                  {
                      if (settings.sweeps.empty())
                      {
                          return "There is no sweep: name one.";
                      }
                      for (const auto& [name, sweep] : settings.sweeps)
                      {
                          if (!isFileName(name))
                          {
                              return fmt::format(
                                  "The name {} of a sweep cannot be that of a file: take letters, "
                                  "digits and _.",
                                  name);
                          }
                      }
                      return "";
                  });
}

SweepAxis axisOf(const Sweep& sweep, QuantityKind kind)
{
    if (sweep.along)
    {
        return *sweep.along;
    }
    if (sweep.deltaT.size() > 1)
    {
        return SweepAxis::deltaT;
    }
    if (sweep.tolerance.size() > 1)
    {
        return SweepAxis::tolerance;
    }
    if (sweep.pointsPerJoint.size() > 1)
    {
        return SweepAxis::pointsPerJoint;
    }
    if (sweep.pointsPerSide.size() > 1)
    {
        return SweepAxis::pointsPerSide;
    }
    if (sweep.contactOverlap.size() > 1)
    {
        return SweepAxis::contactOverlap;
    }
    return kind == QuantityKind::motion ? SweepAxis::deltaT : SweepAxis::tolerance;
}

double alongAxis(const RunSetting& setting, SweepAxis axis)
{
    switch (axis)
    {
    case SweepAxis::deltaT:
        return setting.deltaT;
    case SweepAxis::tolerance:
        return setting.tolerance;
    case SweepAxis::pointsPerJoint:
        return setting.pointsPerJoint;
    case SweepAxis::pointsPerSide:
        return setting.pointsPerSide;
    case SweepAxis::contactOverlap:
        break;
    }
    return setting.contactOverlap;
}

RunSetting curveOf(RunSetting setting, SweepAxis axis)
{
    switch (axis)
    {
    case SweepAxis::deltaT:
        setting.deltaT = 0;
        break;
    case SweepAxis::tolerance:
        setting.tolerance = 0;
        break;
    case SweepAxis::pointsPerJoint:
        setting.pointsPerJoint = 0;
        break;
    case SweepAxis::pointsPerSide:
        setting.pointsPerSide = 0;
        break;
    case SweepAxis::contactOverlap:
        setting.contactOverlap = 0;
        break;
    }
    return setting;
}

RunSetting asComputed(RunSetting setting)
{
    if (setting.effects == EffectSelection::everything)
    {
        setting.displacements = Displacements::large;
        setting.flowRule = FlowRule::nonAssociative;
    }
    return setting;
}

std::vector<RunSetting> settingsOf(const Sweep& sweep, const RunSetting& ofCase)
{
    // The last key changes first.
    std::vector<RunSetting> settings = combined({ofCase}, sweep.theta, &RunSetting::theta);
    settings = combined(settings, sweep.flowRule, &RunSetting::flowRule);
    settings = combined(settings, sweep.solver, &RunSetting::solver);
    settings = combined(settings, sweep.displacements, &RunSetting::displacements);
    settings = combined(settings, sweep.formulation, &RunSetting::formulation);
    settings = combined(settings, sweep.effects, &RunSetting::effects);
    settings = combined(settings, sweep.contactOverlap, &RunSetting::contactOverlap);
    settings = combined(settings, sweep.pointsPerJoint, &RunSetting::pointsPerJoint);
    settings = combined(settings, sweep.pointsPerSide, &RunSetting::pointsPerSide);
    settings = combined(settings, sweep.tolerance, &RunSetting::tolerance);
    settings = combined(settings, sweep.deltaT, &RunSetting::deltaT);
    std::vector<RunSetting> computed;
    for (const RunSetting& setting : settings)
    {
        if (std::find(computed.begin(), computed.end(), asComputed(setting)) == computed.end())
        {
            computed.push_back(asComputed(setting));
        }
    }
    return computed;
}

} // namespace drystone
