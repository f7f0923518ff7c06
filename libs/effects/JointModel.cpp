// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declares the keys of joints, and the types of `contact` and `jointPoints`.
#include "effects/JointModel.h"

#include "effects/ContactProperties.h"

namespace drystone
{
void declare(Options& options, ContactModel& model)
{
    options.optional("formulation", model.formulation,
                     "forces at points of a joint, or the stress resultants N, T, M of the whole joint");
}

void declare(Options& options, PointGrid& grid)
{
    options.optional("perSide", grid.perSide, "points along each side of a joint").atLeast(2).atMost(100);
}

void declare(Options& options, AdaptivePoints& points)
{
    options
        .optional("tolerance", points.tolerance,
                  "by how much of itself the multiplier may exceed what the whole faces of joints make of "
                  "its mechanism")
        .atLeast(1e-5)
        .atMost(1);
}

namespace
{

struct CornersAlone
{
};

void declare(Options&, CornersAlone&) {}

} // namespace

const Registry<std::optional<MorePoints>>& jointPointTypes()
{
    using Choice = std::optional<MorePoints>;
    static const Registry<Choice> registry{
        "jointPoints",
        {model<Choice, CornersAlone>("corners", "the corners of each joint, and with crushing as adaptive",
                                     [](const CornersAlone&) -> Choice { return std::nullopt; }),
         model<Choice, PointGrid>("grid", "a grid of points over each joint, each with its part of the area",
                                  [](const PointGrid& grid) -> Choice { return grid; }),
         model<Choice, AdaptivePoints>("adaptive", "more points where twisting and crushing make them count",
                                       [](const AdaptivePoints& points) -> Choice { return points; })}};
    return registry;
}

template<int Dim>
EffectType<Dim> jointModelType()
{
    return jointEffectType<Dim>(
        "surfaceContact",
        [](Options& options, ContactProperties& contact)
        {
            options.optional("contact", contact.contact,
                             "what limitAnalysis knows of a joint; absent: points");
            options
                .optional("pointsPerJoint", contact.pointsPerJoint,
                          "contact points along each joint of the plane, of limitAnalysis; absent: its ends, "
                          "and where it crushes as many as that takes")
                .atLeast(2)
                .atMost(1000)
                .example("11");
            options.optional("jointPoints", contact.jointPoints, jointPointTypes(),
                             "contact points of each joint in space, of limitAnalysis; absent: its corners, "
                             "and with crushing as adaptive. Twisting a joint with cohesion takes more at "
                             "its corners than over its face: then write adaptive");
            options.optional(
                "joints", contact.joints,
                "what some joints have instead: by name, as 3-7 for that of blocks 3 and 7, "
                "12-ground for that of block 12 and the support ground, by the zones of both "
                "blocks, as footing-shaft, or by quoted pattern; in motion blocks that come "
                "to touch later have the friction of their name, zones or pattern, else that of all");
        },
        [](const ContactProperties& contact)
        { return contact.contact && contact.contact->formulation == ContactFormulation::surface; },
        [](const EffectSource<Dim>& source) -> std::shared_ptr<const Effect<Dim>>
        {
            const ContactProperties& contact = source.contact;
            const bool isOfCorners = !contact.jointPoints;
            const bool isOfPoints =
                contact.contact && contact.contact->formulation == ContactFormulation::points;
            for (const auto& [key, isOfMotion] :
                 {std::pair("pointsPerJoint", false), std::pair("jointPoints", isOfCorners),
                  std::pair("contact", isOfPoints)})
            {
                if (!isOfMotion) // which has the corners of joints, and points
                {
                    refuseEffect(contact, "contactDynamics", key);
                }
            }
            return nullptr;
        },
        {});
}

template EffectType<2> jointModelType<2>();
template EffectType<3> jointModelType<3>();

} // namespace drystone
