// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The loads of a case, read from constant/loads.
#include "assembly/CaseFile.h"
#include "assembly/LoadTypes.h"

namespace drystone
{

namespace
{

/// The settings of the live load, where it is of this type.
template<class Settings>
std::optional<Settings> settingsOfLive(const Dictionary& loads, const std::string& typeName)
{
    const Entry* live = loads.findExact("live");
    const Entry* type = live ? live->dictionary().find("type") : nullptr;
    if (!type || type->as<std::string>() != typeName)
    {
        return std::nullopt;
    }
    Settings settings;
    Options options;
    options.readElsewhere({"type"});
    declare(options, settings);
    options.readFrom(live->dictionary());
    return settings;
}

/// The movement that a live load of type supportMovement requests.
template<int Dim>
std::optional<SupportMovement<Dim>> readMovement(const Dictionary& loads, const Assembly<Dim>& assembly)
{
    const auto settings = settingsOfLive<SupportMovementSettings<Dim>>(loads, "supportMovement");
    if (!settings)
    {
        return std::nullopt;
    }
    std::vector<std::string> names;
    for (const Support& support : assembly.supports)
    {
        if (support.name == settings->support)
        {
            return SupportMovement<Dim>{static_cast<int>(names.size()),
                                        settings->direction.stableNormalized()};
        }
        names.push_back(support.name);
    }
    throw FatalIOError(unknownWordMessage("support", settings->support, names),
                       loads.subDict("live").locationOf("support"));
}

/// The places of a live load of type moving, and those that are left out; none for others.
template<int Dim>
void readPositions(const Dictionary& loads, const Assembly<Dim>& assembly, CaseLoads<Dim>& result)
{
    const auto settings = settingsOfLive<MovingLoadSettings<Dim>>(loads, "moving");
    if (!settings)
    {
        return;
    }
    result.positions = movingLoad(assembly, *settings);
    if (result.positions.empty())
    {
        throw FatalIOError(
            fmt::format("The moving load meets no free block: from nowhere between {} and {} does its force "
                        "point at one. VTK/assembly.vtp shows where the blocks are.",
                        asWritten<Dim>(settings->from), asWritten<Dim>(settings->to)),
            loads.subDict("live").locationOf("from"));
    }
    result.placesLeftOut = placesWithoutLoad(result.positions, *settings);
}

/// The loads that `cases` names, as load vectors.
std::vector<std::pair<std::string, Eigen::VectorXd>>
rowsOf(const std::vector<std::pair<std::string, Load>>& cases)
{
    std::vector<std::pair<std::string, Eigen::VectorXd>> rows;
    for (const auto& [name, load] : cases)
    {
        rows.emplace_back(name, load.rows);
    }
    return rows;
}

void setDead(LoadVectors& loads, Load load)
{
    loads.dead = std::move(load.rows);
    loads.firstMomentsOfDead = std::move(load.firstMoments);
}

/// Blocks without weight hold each other by nothing but the live load.
void questionDeadLoad(const Eigen::VectorXd& dead, const SourceLocation& place)
{
    if (dead.isZero(0))
    {
        printWarningOnce(
            "The dead load is zero on every block, as where gravity (constant/g) is zero: friction "
            "has nothing to act on but the live load. Give gravity, or a dead load of another type.",
            place);
    }
}

void setLive(LoadVectors& loads, Load load)
{
    loads.live = std::move(load.rows);
    loads.firstMomentsOfLive = std::move(load.firstMoments);
}

/// What constant/loads says.
template<int Dim>
LoadCases<Dim> readCases(const Dictionary& dictionary)
{
    // Of a copy, where nothing counts as read that was only looked at: a key that nothing reads is refused.
    requireParts<Dim>(Dictionary(dictionary));
    return readOptions<LoadCases<Dim>>(dictionary);
}

/// The context with the loads that `cases` names.
template<int Dim>
LoadContext<Dim> withCases(const LoadContext<Dim>& context, const LoadCases<Dim>& cases)
{
    LoadContext<Dim> with = context;
    for (const auto& [name, load] : cases.cases)
    {
        with.cases.emplace_back(name, load(context));
    }
    return with;
}

/// Refuses combinations, and cases that lack a live load where one is required.
template<int Dim>
void requireOneLive(const LoadCases<Dim>& cases, const Dictionary& dictionary, LiveLoad liveLoad)
{
    if (!cases.combinations.empty())
    {
        throw FatalIOError("combinations are for limitAnalysis. Write for instance `dead { type gravity; }` "
                           "instead.",
                           dictionary.locationOf("combinations"));
    }
    if (!cases.live && liveLoad == LiveLoad::required)
    {
        throw FatalIOError(
            "There is no live load to find the multiplier of. Add, for instance, \n\n    live { type "
            "inertial; direction (1 0 0); }",
            dictionary.location());
    }
}

/// Refuses a live load that acts on no block. \param example of a reason, for the message
void requireNonZero(const Eigen::VectorXd& live, std::string_view example, const SourceLocation& place)
{
    if (live.isZero(0))
    {
        throw FatalIOError(fmt::format("The live load is zero on every block{}: there is nothing to find the "
                                       "multiplier of. Give gravity, or a live load of type force.",
                                       example),
                           place);
    }
}

} // namespace

template<int Dim>
CaseLoads<Dim> readLoads(const std::filesystem::path& caseDirectory, const LoadContext<Dim>& context,
                         LiveLoad liveLoad)
{
    constexpr std::string_view file = "constant/loads";
    if (liveLoad == LiveLoad::optional && !std::filesystem::exists(caseDirectory / file))
    {
        CaseLoads<Dim> weight;
        weight.dead = gravityLoad(context.assembly, context.masses, context.gravity);
        return weight;
    }
    const Dictionary dictionary = readCaseFile(
        caseDirectory, file, "dead { type gravity; } live { type inertial; direction (1 0 0); }");
    const auto cases = readCases<Dim>(dictionary);
    requireOneLive(cases, dictionary, liveLoad);
    CaseLoads<Dim> loads;
    loads.locations = EntryLocations(dictionary);
    loads.multiplier = cases.multiplier;
    const LoadContext<Dim> with = withCases(context, cases);
    loads.cases = rowsOf(with.cases);
    setDead(loads, cases.dead(with));
    if (liveLoad == LiveLoad::required)
    {
        questionDeadLoad(loads.dead, dictionary.locationOf("dead"));
    }
    loads.movement = readMovement(dictionary, context.assembly);
    readPositions(dictionary, context.assembly, loads);
    if (!loads.positions.empty())
    {
        loads.live = loads.positions.front().live;
    }
    else if (cases.live && !loads.movement)
    {
        setLive(loads, (*cases.live)(with));
    }
    if (liveLoad == LiveLoad::required && !loads.movement)
    {
        requireNonZero(loads.live, ", as where gravity (constant/g) is zero or pressures cancel",
                       dictionary.locationOf("live"));
    }
    return loads;
}

template<int Dim>
std::vector<std::pair<std::string, LoadVectors>>
readLoadCombinations(const std::filesystem::path& caseDirectory, const LoadContext<Dim>& context)
{
    constexpr std::string_view file = "constant/loads";
    std::vector<std::pair<std::string, LoadVectors>> result;
    if (!std::filesystem::exists(caseDirectory / file))
    {
        return result;
    }
    const Dictionary dictionary = Dictionary::readFile(caseDirectory / file);
    const auto cases = readCases<Dim>(dictionary);
    if (cases.combinations.empty())
    {
        return result;
    }
    const LoadContext<Dim> with = withCases(context, cases);
    for (const auto& [name, combination] : cases.combinations)
    {
        LoadVectors loads;
        loads.cases = rowsOf(with.cases);
        loads.multiplier = combination.multiplier;
        setDead(loads, combination.dead(with));
        questionDeadLoad(loads.dead, dictionary.subDict("combinations").subDict(name).locationOf("dead"));
        setLive(loads, combination.live(with));
        requireNonZero(loads.live, "", dictionary.subDict("combinations").subDict(name).locationOf("live"));
        result.emplace_back(name, std::move(loads));
    }
    return result;
}

template CaseLoads<2> readLoads(const std::filesystem::path&, const LoadContext<2>&, LiveLoad);
template std::vector<std::pair<std::string, LoadVectors>> readLoadCombinations(const std::filesystem::path&,
                                                                               const LoadContext<2>&);
template CaseLoads<3> readLoads(const std::filesystem::path&, const LoadContext<3>&, LiveLoad);
template std::vector<std::pair<std::string, LoadVectors>> readLoadCombinations(const std::filesystem::path&,
                                                                               const LoadContext<3>&);

} // namespace drystone
