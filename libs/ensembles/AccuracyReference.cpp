// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of the three types, read into plans; no value is computed yet.
#include "ensembles/AccuracyReference.h"

namespace drystone
{
namespace
{

struct HousnerSettings
{
};
void declare(Options&, HousnerSettings&) {}

struct ValueSettings
{
    double value = 0;
    std::string source;
};
void declare(Options& options, ValueSettings& settings)
{
    options.required("value", settings.value, "what the quantity is, in its unit").example("0.0849473");
    options.required("source", settings.source, "where the value comes from; the page says it")
        .example("\"closed form\"");
}

struct FinestSettings
{
    ReferencePlan plan;
};
void declare(Options& options, FinestSettings& settings)
{
    ReferencePlan& plan = settings.plan;
    declareSettings(
        options, plan,
        "step of the finest run; of a motion there are runs with twice and four times this too, from "
        "which the limit is extrapolated; absent, as of all below: the case's own");
    options.optional("phases", plan.phases, "of motion; their median counts").atLeast(1).atMost(1000);
}

} // namespace

const Registry<ReferencePlan>& referenceTypes()
{
    using Kind = ReferencePlan::Kind;
    static const Registry<ReferencePlan> registry{
        "reference",
        {model<ReferencePlan, FinestSettings>("finest",
                                              "the case's own finest run, extrapolated to steps of no length",
                                              [](const FinestSettings& settings, const Dictionary& dictionary)
                                              {
                                                  ReferencePlan plan = settings.plan;
                                                  plan.kind = Kind::finest;
                                                  plan.location = dictionary.location();
                                                  return plan;
                                              }),
         model<ReferencePlan, HousnerSettings>(
             "Housner",
             "Housner's equation with its impacts, integrated by GSL, of the one block of the case",
             [](const HousnerSettings&, const Dictionary& dictionary)
             {
                 ReferencePlan plan;
                 plan.kind = Kind::Housner;
                 plan.location = dictionary.location();
                 return plan;
             }),
         model<ReferencePlan, ValueSettings>("value", "a closed form, or a published figure",
                                             [](const ValueSettings& settings, const Dictionary& dictionary)
                                             {
                                                 ReferencePlan plan;
                                                 plan.kind = Kind::value;
                                                 plan.value = settings.value;
                                                 plan.source = settings.source;
                                                 plan.location = dictionary.location();
                                                 return plan;
                                             })}};
    return registry;
}

} // namespace drystone
