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

/// The list, or the value of the case.
template<class Value>
std::vector<Value> valuesOf(const std::vector<Value>& list, const Value& ofCase)
{
    return list.empty() ? std::vector<Value>{ofCase} : list;
}

template<class Value>
bool hasTwins(const std::vector<Value>& list)
{
    return std::set<Value>(list.begin(), list.end()).size() < list.size();
}

std::string twinsFault(bool hasThem)
{
    return hasThem ? "A value stands twice in this list: remove one of them." : "";
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
    options
        .optional("deltaT", sweep.deltaT,
                  "steps of a motion; absent, here and in all lists below: the value of the case")
        .unit("s")
        .above(0)
        .example("(0.02 0.01 0.005)");
    options.optional("theta", sweep.theta, "of a motion").atLeast(0.5).atMost(1).example("(0.5 1)");
    options.optional("flowRule", sweep.flowRule, "associative or nonAssociative")
        .example("(associative nonAssociative)");
    options
        .optional("solver", sweep.solver,
                  "of a motion: automatic, interiorPoint, augmentedLagrangian or gaussSeidel")
        .example("(interiorPoint augmentedLagrangian)");
    options.optional("tolerance", sweep.tolerance, "of the solver")
        .above(0)
        .atMost(1e-3)
        .example("(1e-4 1e-8)");
    options.optional("pointsPerJoint", sweep.pointsPerJoint, "of a multiplier: contact points a joint")
        .atLeast(2)
        .atMost(1000)
        .example("(2 5 21)");
    options.optional("displacements", sweep.displacements, "of a motion: large or small")
        .example("(large small)");
    options
        .optional("formulation", sweep.formulation,
                  "of a multiplier: contact by points, or by surface in the stress resultants of the joints")
        .example("(points surface)");
    options
        .optional("along", sweep.along,
                  "the setting that varies along one curve; absent: the first of deltaT, tolerance and "
                  "pointsPerJoint that has several values")
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
    { options.check(key, [&list] { return twinsFault(hasTwins(list)); }); };
    twins("deltaT", sweep.deltaT);
    twins("theta", sweep.theta);
    twins("flowRule", sweep.flowRule);
    twins("solver", sweep.solver);
    twins("tolerance", sweep.tolerance);
    twins("pointsPerJoint", sweep.pointsPerJoint);
    twins("displacements", sweep.displacements);
    twins("formulation", sweep.formulation);
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
        break;
    }
    return setting.pointsPerJoint;
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
    }
    return setting;
}

std::vector<RunSetting> settingsOf(const Sweep& sweep, const RunSetting& ofCase)
{
    std::vector<RunSetting> settings;
    for (const double theta : valuesOf(sweep.theta, ofCase.theta))
    {
        for (const FlowRule flowRule : valuesOf(sweep.flowRule, ofCase.flowRule))
        {
            for (const SolverType solver : valuesOf(sweep.solver, ofCase.solver))
            {
                for (const Displacements displacements : valuesOf(sweep.displacements, ofCase.displacements))
                {
                    for (const ContactFormulation formulation :
                         valuesOf(sweep.formulation, ofCase.formulation))
                    {
                        for (const int points : valuesOf(sweep.pointsPerJoint, ofCase.pointsPerJoint))
                        {
                            for (const double tolerance : valuesOf(sweep.tolerance, ofCase.tolerance))
                            {
                                for (const double deltaT : valuesOf(sweep.deltaT, ofCase.deltaT))
                                {
                                    settings.push_back({deltaT, theta, flowRule, solver, tolerance, points,
                                                        displacements, formulation});
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    return settings;
}

} // namespace drystone
