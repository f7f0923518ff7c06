// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Loads made of single ones: sums, load cases and their combinations, and what else a live load may be.
#include "assembly/LoadTypes.h"

#include "assembly/MovingLoad.h"
#include "core/Log.h"

#include <algorithm>
#include <array>

namespace drystone
{

namespace
{

template<int Dim>
struct SumSettings
{
    std::vector<Named<LoadMaker<Dim>>> loads;
};

template<int Dim>
void declare(Options& options, SumSettings<Dim>& settings)
{
    options.required("loads", settings.loads, singleLoadTypes<Dim>(),
                     "that act together; each has a name of yours");
}

template<int Dim>
LoadMaker<Dim> makeSum(const SumSettings<Dim>& settings, const Dictionary& dictionary)
{
    if (settings.loads.empty())
    {
        throw FatalIOError("A sum needs loads. Write for instance `loads { weight { type gravity; } }`.",
                           dictionary.locationOf("loads"));
    }
    return [loads = settings.loads](const LoadContext<Dim>& context)
    {
        SumOfLoads<Dim> sum(context.assembly);
        for (const auto& [name, load] : loads)
        {
            sum.add(load(context));
        }
        return sum.sum();
    };
}

struct CombinedSettings
{
    std::vector<std::pair<double, std::string>> terms;
};

void declare(Options& options, CombinedSettings& settings)
{
    options
        .required("terms", settings.terms, "factor and name of each of `cases` that acts; the others do not")
        .example("((1.35 selfWeight) (1.5 snow))");
}

template<int Dim>
LoadMaker<Dim> makeCombined(const CombinedSettings& settings, const Dictionary& dictionary)
{
    const SourceLocation place = dictionary.locationOf("terms");
    if (settings.terms.empty())
    {
        throw FatalIOError("A combined load needs terms. Write for instance `terms ((1.35 selfWeight));`.",
                           place);
    }
    for (auto term = settings.terms.begin(); term != settings.terms.end(); ++term)
    {
        const auto isSame = [term](const auto& other) { return other.second == term->second; };
        if (std::any_of(settings.terms.begin(), term, isSame))
        {
            printWarningOnce(
                fmt::format("The load case {} is there twice in these terms: its factors add up. "
                            "Usual is one term a case.",
                            term->second),
                place);
        }
    }
    return [terms = settings.terms, place](const LoadContext<Dim>& context) -> Load
    {
        SumOfLoads<Dim> sum(context.assembly);
        for (const auto& [factor, name] : terms)
        {
            std::vector<std::string> names;
            for (const auto& [known, load] : context.cases)
            {
                if (known == name)
                {
                    sum.add(load, factor);
                }
                names.push_back(known);
            }
            if (names.empty())
            {
                throw FatalIOError("A combined load refers to `cases` of constant/loads, and there are none. "
                                   "Write for instance `cases { selfWeight { type gravity; } }`.",
                                   place);
            }
            if (std::find(names.begin(), names.end(), name) == names.end())
            {
                throw FatalIOError(unknownWordMessage("load case", name, names), place);
            }
        }
        return sum.sum();
    };
}

/// Types of loads that can only be the live load, and what is said where they are something else.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> aloneTypes{
    {{"supportMovement", "supportMovement can only be the live load, by itself and without combinations: its "
                         "answer is a reaction in N, which no multiplier compares with."},
     {"moving", "A moving load can only be the live load, by itself and without combinations."}}};

/// What is said of such a type; empty: it is none.
std::string_view refusalOf(std::string_view type)
{
    const auto* const found = std::find_if(aloneTypes.begin(), aloneTypes.end(),
                                           [type](const auto& alone) { return alone.first == type; });
    return found == aloneTypes.end() ? std::string_view() : found->second;
}

/// \throws FatalIOError always. \param others of which some can stand where this one is
template<int Dim>
[[noreturn]] void refuse(std::string_view type, const Registry<LoadMaker<Dim>>& others,
                         const SourceLocation& place)
{
    std::vector<std::string_view> names;
    for (const auto& load : others.models)
    {
        if (refusalOf(load.name).empty())
        {
            names.push_back(load.name);
        }
    }
    std::sort(names.begin(), names.end());
    throw FatalIOError(
        fmt::format("{} Loads that can stand here: {}.", refusalOf(type), fmt::join(names, " ")), place);
}

/// What makes a load of such a type, where it is read as one that makes a load vector.
template<int Dim>
LoadMaker<Dim> refusing(std::string_view type, const Dictionary& dictionary)
{
    return [type, place = dictionary.locationOf("type")](const LoadContext<Dim>&) -> Load
    { refuse(type, loadTypes<Dim>(), place); };
}

} // namespace

template<int Dim>
void declare(Options& options, SupportMovementSettings<Dim>& settings)
{
    options.required("support", settings.support, "name of the support that moves").example("right");
    options.required("direction", settings.direction, "of its movement; its length does not matter")
        .example(downwards<Dim>("1"));
    options.check("direction",
                  [&settings]() -> std::string
                  {
                      return settings.direction.isZero(0) ? fmt::format(
                                 "A direction cannot be (0 0 0). Write for instance `direction {};`.",
                                 downwards<Dim>("1"))
                                                          : "";
                  });
}

template<int Dim>
const Registry<LoadMaker<Dim>>& loadTypes()
{
    static const Registry<LoadMaker<Dim>> registry = []
    {
        Registry<LoadMaker<Dim>> all = singleLoadTypes<Dim>();
        all.models.push_back(
            model<LoadMaker<Dim>, SumSettings<Dim>>("sum", "several loads that act together", makeSum<Dim>));
        all.models.push_back(model<LoadMaker<Dim>, CombinedSettings>(
            "combined", "loads of `cases`, each times a factor", makeCombined<Dim>));
        all.models.push_back(model<LoadMaker<Dim>, SupportMovementSettings<Dim>>(
            "supportMovement", "settlement of a support, of limitAnalysis, in place of the live load only",
            [](const SupportMovementSettings<Dim>&, const Dictionary& dictionary)
            { return refusing<Dim>("supportMovement", dictionary); }));
        all.models.push_back(model<LoadMaker<Dim>, MovingLoadSettings<Dim>>(
            "moving",
            "a load that moves over the structure, of limitAnalysis, as the live load only: a multiplier for "
            "each place",
            [](const MovingLoadSettings<Dim>&, const Dictionary& dictionary)
            { return refusing<Dim>("moving", dictionary); }));
        return all;
    }();
    return registry;
}

template<int Dim>
void requireParts(const Dictionary& loads)
{
    for (const Entry& entry : loads.entries())
    {
        if (!entry.isDictionary())
        {
            continue;
        }
        const bool hasParts = entry.keyword() == "cases" || entry.keyword() == "loads";
        for (const Entry& part : entry.dictionary().entries())
        {
            const Entry* type = hasParts && part.isDictionary() ? part.dictionary().find("type") : nullptr;
            if (type && !refusalOf(type->valueText()).empty())
            {
                refuse(type->valueText(), singleLoadTypes<Dim>(), part.dictionary().locationOf("type"));
            }
        }
        requireParts<Dim>(entry.dictionary());
    }
}

template<int Dim>
void declare(Options& options, LoadCombination<Dim>& combination)
{
    options.required("dead", combination.dead, loadTypes<Dim>(), "load that acts in full");
    options.required("live", combination.live, loadTypes<Dim>(), "load that the multiplier alpha makes grow");
    options.optional("multiplier", combination.multiplier, "of the live load that limitAnalysis looks for");
}

template<int Dim>
void declare(Options& options, LoadCases<Dim>& cases)
{
    options
        .optional("cases", cases.cases, singleLoadTypes<Dim>(),
                  "loads by names of yours, which `type combined;` takes with factors; the log states the "
                  "force of each")
        .example("selfWeight");
    options.optional("dead", cases.dead, loadTypes<Dim>(),
                     "load that acts in full; required without combinations");
    options.optional("live", cases.live, loadTypes<Dim>(), "load that the multiplier alpha makes grow");
    options.optional("multiplier", cases.multiplier, "of the live load that limitAnalysis looks for");
    options.optional("combinations", cases.combinations,
                     "instead, of limitAnalysis: several pairs of dead and live load, each with a name of "
                     "yours and an answer of its own");
    options.check("dead",
                  [&cases]() -> std::string
                  {
                      const bool isSingle = cases.dead || cases.live;
                      if (!isSingle && cases.combinations.empty())
                      {
                          return "The dead load is missing. Write for instance `dead { type gravity; }`.";
                      }
                      return isSingle && !cases.combinations.empty()
                                 ? "Give either dead and live, or combinations: each of them has its own."
                             : cases.live && !cases.dead
                                 ? "The dead load is missing. Write for instance `dead { type gravity; }`."
                                 : "";
                  });
}

template void declare(Options&, SupportMovementSettings<2>&);
template const Registry<LoadMaker<2>>& loadTypes();
template void requireParts<2>(const Dictionary& loads);
template void declare(Options&, LoadCombination<2>&);
template void declare(Options&, LoadCases<2>&);

template void declare(Options&, SupportMovementSettings<3>&);
template const Registry<LoadMaker<3>>& loadTypes();
template void requireParts<3>(const Dictionary& loads);
template void declare(Options&, LoadCombination<3>&);
template void declare(Options&, LoadCases<3>&);

} // namespace drystone
