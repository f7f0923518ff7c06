// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Laws of contact points, joint by joint.
#include "effects/JointLaws.h"

#include "effects/EffectList.h"

#include <fmt/format.h>

#include <utility>

namespace drystone
{
namespace
{

using NamedJoint = std::pair<NamePattern, JointProperties>;

/// The name with the blocks in the other order. A support's name may hold hyphens, the number of a block,
/// which comes first, does not.
std::string turnedRound(const std::string& name)
{
    const std::size_t hyphen = name.find('-');
    return name.substr(hyphen + 1) + "-" + name.substr(0, hyphen);
}

/// The entry that a joint takes: the last of the exact ones (0-1 and 1-0 are the same joint), or the last
/// pattern that matches.
const NamedJoint* entryOf(const ContactProperties& properties, const std::string& name,
                          std::vector<char>& isMatched)
{
    const std::string turned = turnedRound(name);
    const auto isExact = [&](const NamedJoint& candidate)
    { return candidate.first.text == name || candidate.first.text == turned; };
    const NamedJoint* chosen = nullptr;
    for (std::size_t i = 0; i < properties.joints.size(); ++i)
    {
        const NamedJoint& candidate = properties.joints[i];
        if (candidate.first.matches(name) || candidate.first.matches(turned))
        {
            isMatched[i] = true;
            if (!(chosen && isExact(*chosen)) || isExact(candidate))
            {
                chosen = &candidate;
            }
        }
    }
    return chosen;
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

} // namespace

std::optional<double> stressOf(const std::optional<JointStrength>& ofJoint,
                               const std::optional<JointStrength>& ofAll)
{
    return ofJoint ? std::optional(ofJoint->strength) : ofAll ? std::optional(ofAll->strength) : std::nullopt;
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
                                const std::vector<double>& areas)
{
    const std::vector<JointLaw> effects = lawsOfEffects();
    std::vector<PointLaw> laws(points.size());
    std::vector<char> isMatched(contact.joints.size(), false);
    const JointProperties none;
    for (std::size_t first = 0, last = 0; first < points.size(); first = last)
    {
        const ContactPoint<Dim>& point = points[first];
        const std::string name = jointName(assembly, point.block, point.neighbour);
        const NamedJoint* entry = entryOf(contact, name, isMatched);
        const JointOfCase joint{contact, entry ? entry->second : none, name, entry ? entry->first.text : ""};
        for (; last < points.size() && points[last].joint == point.joint; ++last)
        {
            for (const JointLaw& effect : effects)
            {
                effect.limit(joint, areas[last], laws[last]);
            }
        }
    }
    for (std::size_t i = 0; i < contact.joints.size(); ++i)
    {
        if (!isMatched[i])
        {
            const std::string& name = contact.joints[i].first.text;
            throw FatalIOError(
                fmt::format("There is no joint {}. Joints are named by their blocks, as {}, in either order.",
                            name,
                            points.empty() ? std::string("3-7")
                                           : jointName(assembly, points[0].block, points[0].neighbour)),
                contact.locations.of("joints/" + name));
        }
    }
    return laws;
}

template std::string jointName(const Assembly<2>& assembly, int block, int neighbour);
template std::vector<PointLaw> pointLaws(const ContactProperties& contact, const Assembly<2>& assembly,
                                         const std::vector<ContactPoint<2>>& points,
                                         const std::vector<double>& areas);
template std::string jointName(const Assembly<3>& assembly, int block, int neighbour);
template std::vector<PointLaw> pointLaws(const ContactProperties& contact, const Assembly<3>& assembly,
                                         const std::vector<ContactPoint<3>>& points,
                                         const std::vector<double>& areas);

} // namespace drystone
