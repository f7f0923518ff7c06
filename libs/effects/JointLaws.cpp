// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Laws of contact points, joint by joint.
#include "effects/JointLaws.h"

#include "contact/PointsOfJoints.h"
#include "dictionary/DictionaryPattern.h"
#include "effects/EffectList.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace drystone
{
namespace
{

using NamedJoint = std::pair<NamePattern, JointProperties>;

/// What a joint goes by: `own` the indices of its blocks or the names of their supports, `ofZones` the zones
/// that they are in and their supports, each in either order (0-1 and 1-0 are the same joint).
struct JointNames
{
    std::vector<std::string> own;
    std::vector<std::string> ofZones;
};

/// The names of the zones of each block, ascending by zone.
template<int Dim>
std::vector<std::vector<std::string>> zonesOfBlocks(const Assembly<Dim>& assembly)
{
    std::vector<std::vector<std::string>> names(assembly.blocks.size());
    for (const Zone& zone : assembly.zones)
    {
        for (const int block : zone.blocks)
        {
            names[block].push_back(zone.name);
        }
    }
    return names;
}

template<int Dim>
JointNames jointNames(const Assembly<Dim>& assembly, const std::vector<std::vector<std::string>>& zones,
                      int block, int neighbour)
{
    const auto add = [](std::vector<std::string>& names, const std::string& one, const std::string& other)
    {
        names.push_back(one + "-" + other);
        names.push_back(other + "-" + one);
    };
    const auto groupsOf = [&](int index)
    {
        const int support = assembly.blocks[index].support;
        std::vector<std::string> groups = zones[index];
        if (support >= 0)
        {
            const std::string& name = assembly.supports[support].name;
            if (std::find(groups.begin(), groups.end(), name) == groups.end())
            {
                groups.push_back(name);
            }
        }
        return groups;
    };
    const auto nameOf = [&](int index)
    {
        const int support = assembly.blocks[index].support;
        return support >= 0 ? assembly.supports[support].name : std::to_string(index);
    };
    JointNames names;
    add(names.own, nameOf(block), nameOf(neighbour));
    for (const std::string& one : groupsOf(block))
    {
        for (const std::string& other : groupsOf(neighbour))
        {
            add(names.ofZones, one, other);
        }
    }
    return names;
}

/// How closely an entry names a joint; of equally close ones the last counts.
enum class Match
{
    none,
    pattern,
    zones,
    blocks
};

Match matchOf(const NamePattern& pattern, const JointNames& names)
{
    const auto isAmong = [&](const std::vector<std::string>& list)
    { return std::find(list.begin(), list.end(), pattern.text) != list.end(); };
    const auto matches = [&](const std::vector<std::string>& list)
    { return std::any_of(list.begin(), list.end(), pattern.matches); };
    return isAmong(names.own)                             ? Match::blocks
           : isAmong(names.ofZones)                       ? Match::zones
           : matches(names.own) || matches(names.ofZones) ? Match::pattern
                                                          : Match::none;
}

/// Whether two names are one name in either order. Names of a list stand in pairs, one in each order.
bool areOneName(const std::vector<std::string>& names, const std::string& one, const std::string& other)
{
    const auto at = std::find(names.begin(), names.end(), one);
    return one != other && at != names.end()
           && names[static_cast<std::size_t>(at - names.begin()) ^ 1] == other;
}

/// The first alternative of a pattern that is no name, as of 3-7|base-shfat, or of (base|shfat)-ground with
/// the names of the blocks on either side; empty where there is none.
std::string alternativeWithoutJoint(const std::string& pattern, const std::vector<std::string>& names,
                                    const std::vector<std::string>& sides)
{
    std::string mistyped = alternativeWithoutName(pattern, names);
    std::vector<std::string> namesAndSides = names; // brackets may stand around either
    namesAndSides.insert(namesAndSides.end(), sides.begin(), sides.end());
    for (std::size_t begin = pattern.find('('); mistyped.empty() && begin != std::string::npos;
         begin = pattern.find('(', begin + 1))
    {
        const std::size_t end = pattern.find_first_of("()", begin + 1);
        if (end != std::string::npos && pattern[end] == ')')
        {
            mistyped = alternativeWithoutName(pattern.substr(begin + 1, end - begin - 1), namesAndSides);
        }
    }
    return mistyped;
}

/// Warns of a name within a pattern that no joint has: it matches nothing while the others do.
/// \param names of all joints \param sides of supports, zones and blocks
void questionAlternatives(const ContactProperties& properties, const std::vector<std::string>& names,
                          const std::vector<std::string>& sides)
{
    for (const auto& [pattern, joint] : properties.joints)
    {
        const std::string mistyped = alternativeWithoutJoint(pattern.text, names, sides);
        if (mistyped.empty())
        {
            continue;
        }
        const std::string nearest =
            nearestWord(mistyped, mistyped.find('-') == std::string::npos ? sides : names);
        printWarningOnce(fmt::format("In the pattern {}: there is no joint {}.{}", pattern.text, mistyped,
                                     nearest.empty() ? "" : fmt::format(" Did you mean {}?", nearest)),
                         properties.locations.of("joints/" + pattern.text));
    }
}

template<int Dim>
std::vector<std::string> sidesOfJoints(const Assembly<Dim>& assembly)
{
    std::vector<std::string> sides;
    for (const Support& support : assembly.supports)
    {
        sides.push_back(support.name);
    }
    for (const Zone& zone : assembly.zones)
    {
        sides.push_back(zone.name);
    }
    for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
    {
        sides.push_back(std::to_string(block));
    }
    return sides;
}

/// Says which of two entries counts that name a joint by zones in which its blocks are both.
void questionZones(const ContactProperties& properties, const NamedJoint& before, const NamedJoint& chosen)
{
    const std::string path = "joints/";
    const std::string& name = chosen.first.text;
    printWarningOnce(
        fmt::format("Joints are named twice by the zones of their blocks, as {} at line {} and as {} "
                    "at line {}: {}, which comes later, counts. Names of two blocks, as 3-7, come "
                    "before both.",
                    before.first.text, properties.locations.of(path + before.first.text).line, name,
                    properties.locations.of(path + name).line, name),
        properties.locations.of(path + name));
}

/// The entry that a joint takes: the one that names it most closely.
/// \throws FatalIOError where two entries are one name in either order: neither is the last by intention
const NamedJoint* entryOf(const ContactProperties& properties, const JointNames& names,
                          std::vector<char>& isMatched)
{
    const NamedJoint* chosen = nullptr;
    const NamedJoint* equallyClose = nullptr; // before the chosen one
    Match best = Match::none;
    for (std::size_t i = 0; i < properties.joints.size(); ++i)
    {
        const Match match = matchOf(properties.joints[i].first, names);
        if (match != Match::none)
        {
            isMatched[i] = true;
            if (match >= best)
            {
                const std::string& name = properties.joints[i].first.text;
                const std::string before = chosen ? chosen->first.text : "";
                if (areOneName(names.own, before, name) || areOneName(names.ofZones, before, name))
                {
                    const std::string path = "joints/";
                    throw FatalIOError(
                        fmt::format("The joint {} is named twice, as {} at line {} and as {} at "
                                    "line {}: names are the same in either order.\n\n"
                                    "Remove one of the two.",
                                    name, before, properties.locations.of(path + before).line, name,
                                    properties.locations.of(path + name).line),
                        properties.locations.of(path + name));
                }
                equallyClose = match == best ? chosen : nullptr;
                chosen = &properties.joints[i];
                best = match;
            }
        }
    }
    if (best == Match::zones && equallyClose)
    {
        questionZones(properties, *equallyClose, *chosen);
    }
    return chosen;
}

/// Whether an entry gives a friction alone to two blocks, one of them free, that it names exactly: where they
/// do not touch as built they may come to.
template<int Dim>
bool isOfLaterJoint(const NamedJoint& entry, const Assembly<Dim>& assembly,
                    const std::vector<std::vector<std::string>>& zones)
{
    const auto& [pattern, joint] = entry;
    if (!joint.friction || joint.cohesion || joint.tension || joint.crushing)
    {
        return false;
    }
    const auto blocksOf = [&](const std::string& side)
    {
        std::vector<int> blocks;
        for (int block = 0; block < static_cast<int>(assembly.blocks.size()); ++block)
        {
            const auto& in = zones[static_cast<std::size_t>(block)];
            const int support = assembly.blocks[static_cast<std::size_t>(block)].support;
            if ((support < 0 ? std::to_string(block) : assembly.supports[support].name) == side
                || std::find(in.begin(), in.end(), side) != in.end())
            {
                blocks.push_back(block);
            }
        }
        return blocks;
    };
    for (std::size_t dash = pattern.text.find('-'); dash != std::string::npos;
         dash = pattern.text.find('-', dash + 1))
    {
        const std::vector<int> others = blocksOf(pattern.text.substr(dash + 1));
        for (const int block : blocksOf(pattern.text.substr(0, dash)))
        {
            for (const int other : others)
            {
                const bool areFixed = assembly.blocks[static_cast<std::size_t>(block)].support >= 0
                                      && assembly.blocks[static_cast<std::size_t>(other)].support >= 0;
                if (block != other && !areFixed
                    && matchOf(pattern, jointNames(assembly, zones, block, other)) >= Match::zones)
                {
                    return true;
                }
            }
        }
    }
    return false;
}

std::vector<JointLaw> lawsOfEffects()
{
    std::vector<JointLaw> laws;
    for (const EffectType<2>& type : effectTypes<2>()) // the laws are the same in space
    {
        if (JointLaw law = type().ofJoints; law.limit)
        {
            laws.push_back(std::move(law));
        }
    }
    return laws;
}

/// \param points of the assembly, from which the example is taken
template<int Dim>
FatalIOError noSuchJoint(const ContactProperties& contact, const std::string& name,
                         const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points)
{
    return FatalIOError(
        fmt::format("There is no joint {}. Joints are named by their blocks, as {}, or by the zones of both, "
                    "in either order.",
                    name,
                    points.empty() ? std::string("3-7")
                                   : jointName(assembly, points[0].block, points[0].neighbour)),
        contact.locations.of("joints/" + name));
}

} // namespace

std::optional<double> stressOf(const std::optional<JointStrength>& ofJoint,
                               const std::optional<JointStrength>& ofAll)
{
    return ofJoint ? std::optional(ofJoint->strength) : ofAll ? std::optional(ofAll->strength) : std::nullopt;
}

template<int Dim>
std::function<const JointProperties*(int block, int neighbour)> jointsByName(const ContactProperties& contact,
                                                                             const Assembly<Dim>& assembly)
{
    return [&contact, &assembly, zones = zonesOfBlocks(assembly)](int block, int neighbour)
    {
        std::vector<char> isMatched(contact.joints.size(), false);
        const NamedJoint* entry = entryOf(contact, jointNames(assembly, zones, block, neighbour), isMatched);
        return entry ? &entry->second : nullptr;
    };
}

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

template<int Dim>
std::vector<PointLaw> pointLaws(const ContactProperties& contact, const Assembly<Dim>& assembly,
                                const std::vector<ContactPoint<Dim>>& points,
                                const std::vector<double>& areas, NewJoints newJoints)
{
    const std::vector<JointLaw> effects = lawsOfEffects();
    std::vector<PointLaw> laws(points.size());
    std::vector<char> isMatched(contact.joints.size(), false);
    const bool hasAlternatives =
        std::any_of(contact.joints.begin(), contact.joints.end(),
                    [](const NamedJoint& joint) { return joint.first.text.find('|') != std::string::npos; });
    std::set<std::string> allNames;
    const JointProperties none;
    const std::string noEntry;
    const std::vector<std::vector<std::string>> zones = zonesOfBlocks(assembly);
    for (const PointRange& range : pointsOfJoints(points))
    {
        const ContactPoint<Dim>& point = points[range.begin];
        const JointNames names =
            contact.joints.empty() ? JointNames() : jointNames(assembly, zones, point.block, point.neighbour);
        if (hasAlternatives)
        {
            allNames.insert(names.own.begin(), names.own.end());
            allNames.insert(names.ofZones.begin(), names.ofZones.end());
        }
        const NamedJoint* entry = contact.joints.empty() ? nullptr : entryOf(contact, names, isMatched);
        const JointOfCase joint{contact, entry ? entry->second : none, entry ? entry->first.text : noEntry,
                                [&] { return jointName(assembly, point.block, point.neighbour); }};
        for (std::size_t i = range.begin; i < range.end; ++i)
        {
            for (const JointLaw& effect : effects)
            {
                effect.limit(joint, areas[i], laws[i]);
            }
        }
    }
    for (std::size_t i = 0; i < contact.joints.size(); ++i)
    {
        const bool isLater = newJoints == NewJoints::possible && !points.empty() && !isMatched[i]
                             && isOfLaterJoint(contact.joints[i], assembly, zones);
        if (!isMatched[i] && !isLater)
        {
            throw noSuchJoint(contact, contact.joints[i].first.text, assembly, points);
        }
    }
    if (hasAlternatives)
    {
        questionAlternatives(contact, {allNames.begin(), allNames.end()}, sidesOfJoints(assembly));
    }
    return laws;
}

template std::function<const JointProperties*(int block, int neighbour)>
jointsByName(const ContactProperties& contact, const Assembly<2>& assembly);
template std::string jointName(const Assembly<2>& assembly, int block, int neighbour);
template std::vector<PointLaw> pointLaws(const ContactProperties& contact, const Assembly<2>& assembly,
                                         const std::vector<ContactPoint<2>>& points,
                                         const std::vector<double>& areas, NewJoints newJoints);
template std::function<const JointProperties*(int block, int neighbour)>
jointsByName(const ContactProperties& contact, const Assembly<3>& assembly);
template std::string jointName(const Assembly<3>& assembly, int block, int neighbour);
template std::vector<PointLaw> pointLaws(const ContactProperties& contact, const Assembly<3>& assembly,
                                         const std::vector<ContactPoint<3>>& points,
                                         const std::vector<double>& areas, NewJoints newJoints);

} // namespace drystone
