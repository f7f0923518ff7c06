// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Coulomb friction: its keys, and the coefficient of each point.
#include "effects/Friction.h"

#include "contact/PointsOfPair.h"
#include "effects/JointLaws.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{
namespace
{

/// Beyond it a number is rather an angle in degrees; 10 serves to exclude sliding.
constexpr double steepestFriction = 10;
constexpr auto frictionNote =
    "dry stone has 0.3 to 1, and a friction angle of 31 degrees is tan(31 degrees) = 0.6";

/// Null where the pair is not there.
const double* find(const FrictionOfJoints& ofPairs, const std::pair<int, int>& pair)
{
    const auto at = std::lower_bound(ofPairs.begin(), ofPairs.end(), pair,
                                     [](const auto& entry, const auto& key) { return entry.first < key; });
    return at != ofPairs.end() && at->first == pair ? &at->second : nullptr;
}

void declareCoefficient(Options& options, double& mu, std::string_view example)
{
    options.required("mu", mu, "friction coefficient")
        .unit("-")
        .atLeast(0)
        .atMost(1e6)
        .usual(0, steepestFriction, frictionNote)
        .example(example);
}

} // namespace

void declare(Options& options, CoulombFriction& friction)
{
    declareCoefficient(options, friction.mu, "0.65");
    options.optional("flowRule", friction.flowRule, "whether a joint that slides opens");
}

void declare(Options& options, JointFriction& friction)
{
    declareCoefficient(options, friction.mu, "0.4");
}

const Registry<CoulombFriction>& frictionTypes()
{
    static const Registry<CoulombFriction> registry{
        "friction",
        {model<CoulombFriction, CoulombFriction>("Coulomb", "shear up to mu times the normal force",
                                                 [](CoulombFriction friction) { return friction; })}};
    return registry;
}

std::vector<double> frictionCoefficients(const ContactProperties& contact, std::size_t points)
{
    return std::vector<double>(points, contact.friction ? contact.friction->mu : 0);
}

template<int Dim>
FrictionOfJoints frictionOfJoints(const ContactProperties& contact, const Assembly<Dim>& assembly)
{
    FrictionOfJoints result;
    if (contact.joints.empty())
    {
        return result;
    }
    const std::vector<ContactPoint<Dim>> points = findContactPoints(assembly); // sorted by pairs
    const std::vector<PointLaw> laws = pointLaws(contact, assembly, points, NewJoints::possible);
    const double ofAll = contact.friction ? contact.friction->mu : 0;
    if (std::none_of(contact.joints.begin(), contact.joints.end(),
                     [ofAll](const auto& joint)
                     { return joint.second.friction && joint.second.friction->mu != ofAll; }))
    {
        return result;
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const std::pair pair(points[i].block, points[i].neighbour);
        if (result.empty() || result.back().first != pair)
        {
            result.emplace_back(pair, laws[i].mu);
        }
    }
    return result;
}

template<int Dim>
FrictionOfJoints frictionOfNewPairs(const ContactProperties& contact, const Assembly<Dim>& assembly,
                                    const FrictionOfJoints& known,
                                    const std::vector<ContactPoint<Dim>>& points)
{
    FrictionOfJoints result;
    if (known.empty())
    {
        return result;
    }
    const double ofAll = contact.friction ? contact.friction->mu : 0;
    std::function<const JointProperties*(int, int)> byName; // made where it is needed
    for (const ContactPoint<Dim>& point : points)
    {
        const std::pair<int, int> pair = pairOf(point);
        if ((!result.empty() && result.back().first == pair) || find(known, pair))
        {
            continue;
        }
        byName = byName ? byName : jointsByName(contact, assembly);
        const JointProperties* own = byName(pair.first, pair.second);
        result.emplace_back(pair, own && own->friction ? own->friction->mu : ofAll);
    }
    return result;
}

template<int Dim>
std::vector<double> frictionAt(const ContactProperties& contact, const Assembly<Dim>& assembly,
                               const FrictionOfJoints& known, const std::vector<ContactPoint<Dim>>& points)
{
    std::vector<double> friction = frictionCoefficients(contact, points.size());
    FrictionOfJoints ofNew; // made where a pair is not known
    for (std::size_t i = 0; !known.empty() && i < points.size(); ++i)
    {
        const std::pair<int, int> pair = pairOf(points[i]);
        if (i > 0 && pair == pairOf(points[i - 1]))
        {
            friction[i] = friction[i - 1];
            continue;
        }
        const double* ofPair = find(known, pair);
        if (!ofPair && ofNew.empty())
        {
            ofNew = frictionOfNewPairs(contact, assembly, known, points);
        }
        friction[i] = ofPair ? *ofPair : *find(ofNew, pair);
    }
    return friction;
}

std::string frictionText(const ContactProperties& contact)
{
    return !contact.friction ? std::string()
                             : fmt::format("Friction: mu {:g}, flow rule {}", contact.friction->mu,
                                           contact.friction->flowRule == FlowRule::associative
                                               ? "associative (a joint that slides opens)"
                                               : "nonAssociative (Coulomb)");
}

template<int Dim>
EffectType<Dim> frictionType()
{
    return jointEffectType<Dim>(
        "friction",
        [](Options& options, ContactProperties& contact)
        {
            options.optional("friction", contact.friction, frictionTypes(),
                             "shear at the contacts; absent: frictionless");
        },
        [](const ContactProperties& contact)
        { return contact.friction.has_value() || isInJoints(contact, &JointProperties::friction); },
        noEffect<Dim>,
        {[](Options& options, JointProperties& properties)
         { options.optional("friction", properties.friction, "shear by normal force"); },
         [](const JointOfCase& joint, double, PointLaw& law)
         {
             law.mu = joint.own.friction       ? joint.own.friction->mu
                      : joint.contact.friction ? joint.contact.friction->mu
                                               : 0;
         }});
}

template FrictionOfJoints frictionOfJoints(const ContactProperties& contact, const Assembly<2>& assembly);
template FrictionOfJoints frictionOfJoints(const ContactProperties& contact, const Assembly<3>& assembly);
template FrictionOfJoints frictionOfNewPairs(const ContactProperties& contact, const Assembly<2>& assembly,
                                             const FrictionOfJoints& known,
                                             const std::vector<ContactPoint<2>>& points);
template std::vector<double> frictionAt(const ContactProperties& contact, const Assembly<2>& assembly,
                                        const FrictionOfJoints& known,
                                        const std::vector<ContactPoint<2>>& points);
template FrictionOfJoints frictionOfNewPairs(const ContactProperties& contact, const Assembly<3>& assembly,
                                             const FrictionOfJoints& known,
                                             const std::vector<ContactPoint<3>>& points);
template std::vector<double> frictionAt(const ContactProperties& contact, const Assembly<3>& assembly,
                                        const FrictionOfJoints& known,
                                        const std::vector<ContactPoint<3>>& points);
template EffectType<2> frictionType<2>();
template EffectType<3> frictionType<3>();

} // namespace drystone
