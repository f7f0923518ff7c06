// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `arch` from its settings.
#include "texture/Arch.h"

#include "texture/Limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace drystone
{

namespace
{

Vector<2> mirrored(const Vector<2>& point)
{
    return {-point.x(), point.y()};
}

/// A joint: its points are centre + r direction for r from `inner` to `outer`.
struct Joint
{
    Vector<2> centre = Vector<2>::Zero(); ///< [m]
    Vector<2> direction{0, 1};            ///< unit vector, out of the arch
    double inner = 0;                     ///< [m]
    double outer = 0;                     ///< [m]

    Vector<2> at(double radius) const { return centre + radius * direction; }
};

Joint mirroredJoint(const Joint& joint)
{
    return {mirrored(joint.centre), mirrored(joint.direction), joint.inner, joint.outer};
}

/// Unit vectors along the joints of a circular arch, from the left springing to the right one.
std::vector<Vector<2>> jointDirections(const Arch& arch)
{
    const int count = arch.voussoirs;
    const double step = arch.angle / 180 * EIGEN_PI / count;
    std::vector<Vector<2>> directions(count + 1);
    for (int k = 0; 2 * k <= count; ++k)
    {
        // From the crown down to the right: sine and cosine of the angle from the vertical. The springings of
        // a semicircle are set level, which rounding would miss.
        const double fromCrown = step * (0.5 * count - k);
        const bool isLevel = k == 0 && arch.angle == 180;
        const Vector<2> right =
            isLevel ? Vector<2>(1, 0) : Vector<2>(std::sin(fromCrown), std::cos(fromCrown));
        directions[count - k] = right;
        directions[k] = 2 * k == count ? Vector<2>(0, 1) : mirrored(right);
    }
    return directions;
}

std::vector<Joint> circularJoints(const Arch& arch)
{
    std::vector<Joint> joints;
    for (const Vector<2>& direction : jointDirections(arch))
    {
        joints.push_back(
            {{0, 0}, direction, arch.radius - arch.thickness / 2, arch.radius + arch.thickness / 2});
    }
    return joints;
}

/// The joints of an arch that springs level, from the half between the crown and the right springing.
std::vector<Joint> symmetricJoints(const std::vector<Joint>& rightHalf, int voussoirs)
{
    std::vector<Joint> joints(static_cast<std::size_t>(voussoirs) + 1);
    for (int k = 0; 2 * k <= voussoirs; ++k)
    {
        joints[voussoirs - k] = rightHalf[k];
        joints[k] = mirroredJoint(rightHalf[k]);
    }
    return joints;
}

/// Turned by equal angles from the level one at the springing to that where the centreline meets the axis.
std::vector<Joint> pointedJoints(const Arch& arch)
{
    const double inner = arch.radius - arch.thickness / 2;
    const double outer = arch.radius + arch.thickness / 2;
    const double toCrown = std::acos(arch.offset / arch.radius);
    const int half = arch.voussoirs / 2;
    std::vector<Joint> joints;
    for (int k = 0; k < half; ++k)
    {
        const double angle = toCrown * k / half;
        joints.push_back({{-arch.offset, 0}, {std::cos(angle), std::sin(angle)}, inner, outer});
    }
    const auto heightAtAxis = [&](double radius)
    { return std::sqrt(radius * radius - arch.offset * arch.offset); };
    joints.push_back({{0, 0}, {0, 1}, heightAtAxis(inner), heightAtAxis(outer)});
    return symmetricJoints(joints, arch.voussoirs);
}

/// The normal of the ellipse (a cos p, b sin p) has the direction (b cos p, a sin p): turned by psi from the
/// level where tan p = b/a tan psi.
std::vector<Joint> ellipticJoints(const Arch& arch)
{
    std::vector<Joint> joints;
    for (int k = 0; 2 * k <= arch.voussoirs; ++k)
    {
        const double angle = EIGEN_PI * k / arch.voussoirs;
        const bool isCrown = 2 * k == arch.voussoirs;
        const Vector<2> direction = isCrown ? Vector<2>(0, 1) : Vector<2>(std::cos(angle), std::sin(angle));
        const Vector<2> scaled(arch.radius * direction.x(), arch.rise * direction.y());
        const Vector<2> centre(arch.radius * scaled.x() / scaled.norm(),
                               arch.rise * scaled.y() / scaled.norm());
        joints.push_back({centre, direction, -arch.thickness / 2, arch.thickness / 2});
    }
    return symmetricJoints(joints, arch.voussoirs);
}

std::vector<Joint> jointsOf(const Arch& arch)
{
    switch (arch.profile)
    {
    case ArchProfile::pointed:
        return pointedJoints(arch);
    case ArchProfile::elliptic:
        return ellipticJoints(arch);
    case ArchProfile::circular:
        break;
    }
    return circularJoints(arch);
}

/// What the profile requires of the other keys.
std::string profileFault(const Arch& arch)
{
    const bool isCircular = arch.profile == ArchProfile::circular;
    if (!isCircular && arch.angle != 180)
    {
        return "Only a circular arch has an angle: others spring level. Remove it.";
    }
    if (arch.profile != ArchProfile::pointed && arch.offset != 0)
    {
        return "Only a pointed arch has an offset of its centres: remove it, or choose profile pointed.";
    }
    if (arch.profile != ArchProfile::elliptic && arch.rise != 0)
    {
        return "Only an elliptic arch has a rise of its own: remove it, or choose profile elliptic.";
    }
    if (arch.profile == ArchProfile::pointed)
    {
        if (arch.voussoirs % 2 != 0)
        {
            return "A pointed arch has a joint at the crown: give an even number of voussoirs.";
        }
        if (arch.offset <= 0 || arch.offset >= arch.radius - arch.thickness / 2)
        {
            return fmt::format(
                "A pointed arch has its centres beside its axis: give an offset above 0 and below the inner "
                "radius, {:g} m, such as `offset {:.3g};`.",
                arch.radius - arch.thickness / 2, arch.radius / 5);
        }
    }
    if (arch.profile == ArchProfile::elliptic)
    {
        const double least =
            std::min(arch.radius * arch.radius / arch.rise, arch.rise * arch.rise / arch.radius);
        if (arch.rise <= 0)
        {
            return "An elliptic arch has a rise above 0: give it.";
        }
        if (least <= arch.thickness / 2)
        {
            return fmt::format(
                "The ellipse is curved to a radius of {:g} m at its sharpest: half the thickness must be "
                "below it.",
                least);
        }
    }
    return {};
}

/// Of a pointed arch the intrados meets the axis before the centreline does: the joints next to the crown
/// must not, or they cross it.
std::string crownFault(const Arch& arch)
{
    const double inner = arch.radius - arch.thickness / 2;
    if (arch.profile != ArchProfile::pointed || !(arch.offset < inner))
    {
        return {};
    }
    const double toCrown = std::acos(arch.offset / arch.radius);
    const double toIntrados = std::acos(arch.offset / inner);
    const double most = 2 * (std::ceil(toCrown / (toCrown - toIntrados)) - 1);
    return arch.voussoirs > most ? fmt::format(
               "The joints beside the crown of this pointed arch would meet within its thickness: "
               "give at most {:.0f} voussoirs, or a smaller thickness or offset.",
               most)
                                 : "";
}

/// Voussoirs like sheets of paper are a typing error, and each would have thousands of others within its
/// bounding box.
std::string voussoirsFault(const Arch& arch)
{
    constexpr double thinnest = 1e-3; // of the arch's thickness
    if (arch.angle / arch.voussoirs >= 180)
    {
        return "A single voussoir cannot span 180 degrees or more: give more voussoirs.";
    }
    const double length = std::max(arch.radius, arch.rise) * arch.angle / 180 * EIGEN_PI; // at most
    const double least = thinnest * arch.thickness;
    if (length < least)
    {
        return fmt::format("The arch is {:.2g} m long and {:g} m thick: correct radius, angle or thickness.",
                           length, arch.thickness);
    }
    return length < least * arch.voussoirs
               ? fmt::format("{} voussoirs are {:.2g} m thin, in an arch that is {:g} m thick: give at most "
                             "{:.0f}.",
                             arch.voussoirs, length / arch.voussoirs, arch.thickness,
                             std::floor(length / least))
               : "";
}

} // namespace

void declare(Options& options, Arch& arch)
{
    declareSection(options, arch);
    options.optional("depth", arch.depth, "out of plane").unit("m").above(0);
    options.check("voussoirs", [&arch] { return crownFault(arch); });
}

void declareSection(Options& options, Arch& arch)
{
    options.optional("profile", arch.profile, "shape of the centreline");
    options.required("radius", arch.radius, "of the centreline; of an elliptic one half the span")
        .unit("m")
        .above(0)
        .example("1");
    options.optional("offset", arch.offset, "of the centres of a pointed arch from its axis: above 0 for one")
        .unit("m")
        .atLeast(0);
    options.optional("rise", arch.rise, "of an elliptic arch, its centreline: above 0 for one")
        .unit("m")
        .atLeast(0);
    options.required("thickness", arch.thickness, "in the radial direction")
        .unit("m")
        .above(0)
        .example("0.15");
    options.required("voussoirs", arch.voussoirs, "their number; of a pointed arch even")
        .atLeast(1)
        .atMost(maximumBlocks)
        .example("27");
    options.optional("angle", arch.angle, "of a circular arch from springing to springing, in degrees")
        .above(0)
        .atMost(270);
    options.check("profile", [&arch] { return profileFault(arch); });
    options.check("thickness",
                  [&arch]() -> std::string
                  {
                      constexpr double thinnest = 1e-6; // of the radius: joints are closed to a rounding
                      if (arch.thickness >= 2 * arch.radius)
                      {
                          return fmt::format(
                              "An arch of radius {:g} m cannot be {:g} m thick: the thickness must be "
                              "below twice the radius.",
                              arch.radius, arch.thickness);
                      }
                      return arch.thickness < thinnest * arch.radius
                                 ? fmt::format("An arch of radius {:g} m has no shape that is {:g} m thick: "
                                               "give a thickness of at least {:g} m.",
                                               arch.radius, arch.thickness, thinnest * arch.radius)
                                 : "";
                  });
    options.check("voussoirs", [&arch] { return voussoirsFault(arch); });
}

Assembly<2> makeAssembly(const Arch& arch, Abutments abutments)
{
    const std::vector<Joint> joints = jointsOf(arch);

    Assembly<2> assembly;
    for (int i = 0; i < arch.voussoirs; ++i)
    {
        const Joint& left = joints[i];
        const Joint& right = joints[i + 1];
        assembly.blocks.push_back(
            {{left.at(left.inner), right.at(right.inner), right.at(right.outer), left.at(left.outer)},
             arch.depth});
    }
    if (abutments == Abutments::none)
    {
        return assembly;
    }
    // On the inner side the face ends before the middle of the span, where it would meet the face of the
    // other abutment.
    const Joint& springing = joints.back();
    const double halfSpan =
        arch.profile == ArchProfile::circular ? springing.inner : springing.at(springing.inner).x();
    const double margin = std::min(arch.thickness, halfSpan / 2);
    const double inner = springing.inner - margin;
    const double outer = springing.outer + arch.thickness;
    // Along the centreline, out of the arch; under a horseshoe they end before the middle, too.
    const Vector<2> outwards = -perpendicular(springing.direction);
    const double depth = outwards.x() < 0
                             ? std::min(arch.thickness, springing.at(inner).x() / (2 * -outwards.x()))
                             : arch.thickness;
    const Vector<2> away = depth * outwards;
    const Polygon right{springing.at(inner), springing.at(inner) + away, springing.at(outer) + away,
                        springing.at(outer)};
    Polygon left;
    std::transform(right.rbegin(), right.rend(), std::back_inserter(left), mirrored);
    assembly.supports = {{"left", "abutments"}, {"right", "abutments"}};
    assembly.blocks.push_back({std::move(left), arch.depth, 0});
    assembly.blocks.push_back({right, arch.depth, 1});
    return assembly;
}

} // namespace drystone
