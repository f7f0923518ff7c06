// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of contact properties.
#include "contact/ContactProperties.h"

#include "assembly/CaseFile.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

const Registry<CoulombFriction>& frictionTypes()
{
    static const Registry<CoulombFriction> registry{
        "friction",
        {model<CoulombFriction, CoulombFriction>("Coulomb", "shear up to mu times the normal force",
                                                 [](CoulombFriction friction) { return friction; })}};
    return registry;
}

const std::vector<AbsentEffect>& absentEffects()
{
    static const std::vector<AbsentEffect> effects{
        {"rollingResistance",
         "a moment that resists rolling: blocks with corners touch at points and do not roll"},
    };
    return effects;
}

namespace
{

/// Beyond it a number is rather an angle in degrees; 10 serves to exclude sliding.
constexpr double steepestFriction = 10;
constexpr auto frictionNote =
    "dry stone has 0.3 to 1, and a friction angle of 31 degrees is tan(31 degrees) = 0.6";

} // namespace

void declare(Options& options, CoulombFriction& friction)
{
    options.required("mu", friction.mu, "friction coefficient")
        .unit("-")
        .atLeast(0)
        .atMost(1e6)
        .usual(0, steepestFriction, frictionNote)
        .example("0.65");
    options.optional("flowRule", friction.flowRule, "whether a joint that slides opens");
}

void declare(Options& options, Restitution& restitution)
{
    options
        .required("normal", restitution.normal,
                  "parting over closing velocity of an impact; less of it, as the log says, in impacts where "
                  "together with friction all of it would create energy")
        .unit("-")
        .atLeast(0)
        .atMost(1)
        .example("0.5");
}

void declare(Options& options, JointStrength& strength)
{
    options.required("strength", strength.strength, "of a joint over its area")
        .unit("Pa")
        .atLeast(0)
        .example("1e5");
}

void declare(Options& options, ContactModel& model)
{
    options.optional("formulation", model.formulation,
                     "forces at points of a joint, or the stress resultants N, T, M of the whole joint");
}

void declare(Options& options, PointGrid& grid)
{
    options.optional("perSide", grid.perSide, "points along each side of a joint").atLeast(2).atMost(100);
}

namespace
{

struct CornersAlone
{
};

void declare(Options&, CornersAlone&) {}

} // namespace

const Registry<std::optional<PointGrid>>& jointPointTypes()
{
    static const Registry<std::optional<PointGrid>> registry{
        "jointPoints",
        {model<std::optional<PointGrid>, CornersAlone>("corners", "the corners of each joint",
                                                       [](const CornersAlone&) -> std::optional<PointGrid>
                                                       { return std::nullopt; }),
         model<std::optional<PointGrid>, PointGrid>(
             "grid", "a grid of points over each joint, each with its part of the area",
             [](const PointGrid& grid) -> std::optional<PointGrid> { return grid; })}};
    return registry;
}

void declare(Options& options, JointFriction& friction)
{
    options.required("mu", friction.mu, "friction coefficient")
        .unit("-")
        .atLeast(0)
        .atMost(1e6)
        .usual(0, steepestFriction, frictionNote)
        .example("0.4");
}

void declare(Options& options, JointProperties& properties)
{
    options.optional("friction", properties.friction, "shear by normal force");
    options.optional("cohesion", properties.cohesion, "shear beside friction");
    options.optional("tension", properties.tension, "normal stress that holds the joint together");
    options.optional("crushing", properties.crushing, "pressure that the joint bears");
}

void declare(Options& options, ContactProperties& properties)
{
    options.optional("friction", properties.friction, frictionTypes(),
                     "shear at the contacts; absent: frictionless");
    options.optional("restitution", properties.restitution, "rebound after an impact; absent: none");
    options.optional("cohesion", properties.cohesion,
                     "shear of the joints beside friction, in motion until they break; absent: none");
    options.optional(
        "tension", properties.tension,
        "normal stress that holds joints together, at most cohesion over mu, in motion until they "
        "break; absent: none");
    options.optional("crushing", properties.crushing, "pressure that the joints bear; absent: any");
    options.optional("contact", properties.contact, "what limitAnalysis knows of a joint; absent: points");
    options
        .optional(
            "pointsPerJoint", properties.pointsPerJoint,
            "contact points along each joint of the plane, of limitAnalysis; absent: its ends, and where it "
            "crushes as many as that takes")
        .atLeast(2)
        .atMost(1000)
        .example("11");
    options.optional(
        "jointPoints", properties.jointPoints, jointPointTypes(),
        "contact points of each joint in space, of limitAnalysis; absent: its corners, and where it "
        "crushes as many as that takes. Twisting a joint with cohesion, or one that crushes, takes "
        "more at its corners than over its face: then compare grids");
    options.optional(
        "joints", properties.joints,
        "what some joints have instead: by name, as 3-7 for that of blocks 3 and 7, 12-ground for "
        "that of block 12 and the support ground, or by quoted pattern");
}

EffectNames effectNames(const ContactProperties& properties, const EffectNames& ofMotion)
{
    EffectNames names;
    const auto tell = [&names](bool isThere, const char* name)
    { (isThere ? names.simulated : names.absent).emplace_back(name); };
    const auto inJoints = [&properties](std::optional<JointStrength> JointProperties::*effect)
    {
        return std::any_of(properties.joints.begin(), properties.joints.end(),
                           [effect](const auto& joint) { return (joint.second.*effect).has_value(); });
    };
    const bool hasFriction =
        properties.friction
        || std::any_of(properties.joints.begin(), properties.joints.end(),
                       [](const auto& joint) { return joint.second.friction.has_value(); });
    tell(hasFriction, "friction");
    tell(properties.restitution.has_value(), "restitution");
    tell(properties.cohesion || inJoints(&JointProperties::cohesion), "cohesion");
    tell(properties.tension || inJoints(&JointProperties::tension), "tension");
    tell(properties.crushing || inJoints(&JointProperties::crushing), "crushing");
    tell(properties.contact && properties.contact->formulation == ContactFormulation::surface,
         "surfaceContact");
    names.simulated.insert(names.simulated.end(), ofMotion.simulated.begin(), ofMotion.simulated.end());
    names.absent.insert(names.absent.end(), ofMotion.absent.begin(), ofMotion.absent.end());
    for (const AbsentEffect& effect : absentEffects())
    {
        names.absent.emplace_back(effect.name);
    }
    return names;
}

void refuseEffects(const std::filesystem::path& caseDirectory, const std::string& application,
                   const std::vector<std::string>& names)
{
    const Dictionary dictionary = Dictionary::readFile(caseDirectory / "constant/contactProperties");
    for (const std::string& name : names)
    {
        if (const Entry* entry = dictionary.findExact(name))
        {
            throw FatalIOError(fmt::format("{} does not simulate {}. Remove the entry to compute without it.",
                                           application, name),
                               entry->location());
        }
    }
}

Dictionary readContactDictionary(const std::filesystem::path& caseDirectory)
{
    Dictionary dictionary = readCaseFile(caseDirectory, "constant/contactProperties",
                                         "friction { type Coulomb; mu 0.65; flowRule associative; }");
    for (const AbsentEffect& effect : absentEffects())
    {
        if (const Entry* entry = dictionary.findExact(effect.name))
        {
            throw FatalIOError(
                fmt::format("This version does not simulate {} ({}). Remove the entry to compute "
                            "without it; simulated are: friction restitution cohesion tension crushing "
                            "elasticity damping deletion.",
                            effect.name, effect.summary),
                entry->location());
        }
    }
    return dictionary;
}

ContactProperties readContactProperties(const std::filesystem::path& caseDirectory)
{
    return readOptions<ContactProperties>(readContactDictionary(caseDirectory));
}

std::vector<double> frictionCoefficients(const ContactProperties& properties, std::size_t points)
{
    return std::vector<double>(points, properties.friction ? properties.friction->mu : 0);
}

} // namespace drystone
