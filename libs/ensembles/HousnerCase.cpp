// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Tests one condition of Housner's equation after the other, and says what the case would need.
#include "ensembles/HousnerCase.h"

#include "core/Error.h"
#include "effects/GroundMotion.h"
#include "geometry/BroadPhase.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace drystone
{
namespace
{

/// The motion of the ground along x, times a factor.
class ScaledMotion final : public GroundAcceleration
{
public:
    ScaledMotion(std::shared_ptr<const GroundAcceleration> unscaled, double scale)
        : motion(std::move(unscaled)), factor(scale)
    {
    }
    double at(double time) const override { return factor * motion->at(time); }
    double integral(double from, double to) const override { return factor * motion->integral(from, to); }
    std::vector<double> kinks() const override { return motion->kinks(); }
    double peak() const override { return std::abs(factor) * motion->peak(); }

private:
    std::shared_ptr<const GroundAcceleration> motion;
    double factor;
};

[[noreturn]] void refuse(const std::string& reason)
{
    throw FatalError("Housner's equation is about another case: " + reason);
}

/// The block begins at rest, or turned and turning about the corner that it stands on.
void requireRocking(const HousnerCase& housner, const Placement<2>& placement, const Vector<2>& velocity)
{
    constexpr double share = 1e-6; // of sizes and velocities, as they are written in files
    const auto& [block, start, index] = housner;
    const double turns = start.rotation != 0 ? start.rotation : start.angularVelocity;
    const Vector<2> corner(turns < 0 ? block.width / 2 : -block.width / 2,
                           -block.height / 2); // from the centre
    const double size = std::hypot(block.width, block.height);
    const Vector<2> displacement = corner - Eigen::Rotation2Dd(start.rotation) * corner;
    if ((placement.translation - displacement).norm() > share * size)
    {
        refuse(
            fmt::format("its block stands on a corner, which a rotation of {:g} about it displaces by ({:g} "
                        "{:g}): give that in 0/motion, not ({:g} {:g}).",
                        start.rotation, displacement.x(), displacement.y(), placement.translation.x(),
                        placement.translation.y()));
    }
    const Vector<2> arm = Eigen::Rotation2Dd(start.rotation) * Vector<2>(-corner);
    const Vector<2> ofRocking = start.angularVelocity * Vector<2>(-arm.y(), arm.x());
    if ((velocity - ofRocking).norm() > share * std::max(velocity.norm(), ofRocking.norm()))
    {
        refuse(fmt::format(
            "its block turns about a corner, with a velocity of ({:g} {:g}) at the angular velocity "
            "{:g}: give that in 0/motion, not ({:g} {:g}).",
            ofRocking.x(), ofRocking.y(), start.angularVelocity, velocity.x(), velocity.y()));
    }
}

int onlyFreeBlock(const Assembly<2>& assembly)
{
    const std::vector<int> free = freeIndices(assembly);
    const auto freeBlocks = std::count_if(free.begin(), free.end(), [](int index) { return index >= 0; });
    if (freeBlocks != 1)
    {
        refuse(fmt::format("it has one free block, and this one has {}.", freeBlocks));
    }
    return static_cast<int>(std::find(free.begin(), free.end(), 0) - free.begin());
}

/// Of a block that is an upright rectangle.
Box<2> rectangleOf(const Polygon& outline)
{
    const Box<2> box = boundingBox(outline);
    const double size = (box.upper - box.lower).maxCoeff();
    for (const Vector<2>& corner : outline)
    {
        const Vector<2> fromSides = (corner - box.lower).cwiseAbs().cwiseMin((corner - box.upper).cwiseAbs());
        if (fromSides.maxCoeff() > 1e-9 * size)
        {
            refuse("its block is an upright rectangle.");
        }
    }
    if (outline.size() != 4)
    {
        refuse("its block is an upright rectangle of four corners.");
    }
    return box;
}

void requireGravityAlone(const DynamicCase<2>& scene)
{
    if (!(scene.gravity.y() < 0) || scene.gravity.x() != 0)
    {
        refuse("gravity is along -y.");
    }
    if (scene.contact.restitution || traitsOf(scene.effects).isCompliant
        || traitsOf(scene.effects).actsOnBlocks)
    {
        refuse("impacts are plastic and there is no damping: remove restitution, elasticity and damping.");
    }
}

void requireNoSliding(const RockingBlock& block, double friction)
{
    if (friction < block.width / block.height)
    {
        refuse(
            fmt::format("its block does not slide: give it a friction of at least its width over its height, "
                        "{:g}.",
                        block.width / block.height));
    }
}

} // namespace

std::unique_ptr<GroundAcceleration> housnerGround(const AccuracyCase<2>& study)
{
    const auto components = groundMotionOf(study.scene->effects).components;
    if (components.empty())
    {
        return std::make_unique<ConstantAcceleration>(0);
    }
    if (components.size() != 1 || std::abs(components.front().direction.y()) > 1e-12)
    {
        throw FatalError("Housner's equation is for a ground that moves along x alone.");
    }
    return std::make_unique<ScaledMotion>(components.front().acceleration, components.front().direction.x());
}

HousnerCase housnerCase(const AccuracyCase<2>& study)
{
    const DynamicCase<2>& scene = *study.scene;
    HousnerCase result;
    result.index = onlyFreeBlock(scene.assembly);
    const Box<2> box = rectangleOf(scene.assembly.blocks[static_cast<std::size_t>(result.index)].outline);
    requireGravityAlone(scene);
    result.block = {box.upper.x() - box.lower.x(), box.upper.y() - box.lower.y(), -scene.gravity.y()};
    requireNoSliding(result.block, scene.contact.friction ? scene.contact.friction->mu : 0);
    const Placement<2>& placement = study.start.placements[static_cast<std::size_t>(result.index)];
    result.start = {study.start.time, placement.rotation, study.start.velocity[2]};
    requireRocking(result, placement, study.start.velocity.head<2>());
    return result;
}

double housnerThreshold(const AccuracyCase<2>& study, const IntensityPlan& plan,
                        const Criterion<2>& criterion, double unit)
{
    const HousnerCase housner = housnerCase(study);
    const std::shared_ptr<const GroundAcceleration> ground = housnerGround(study);
    if (!(ground->peak() > 0))
    {
        throw FatalError("The threshold by Housner's equation is that of a motion of the ground along x.");
    }
    if (criterion.figure.name != "rotation")
    {
        throw FatalError(
            "By Housner's equation a block overturns: take `criterion { type rotation; limit 1; }`.");
    }
    if (criterion.limit < housner.block.slenderness())
    {
        throw FatalError(
            fmt::format("By Housner's equation a block overturns, which is to exceed {:g} rad: take "
                        "`criterion {{ type rotation; limit 1; }}`.",
                        housner.block.slenderness()));
    }
    if (housner.start.rotation != 0 || housner.start.angularVelocity != 0)
    {
        throw FatalError("The threshold by Housner's equation is that of a block at rest: remove 0/motion.");
    }
    const double perUnit = unit / ground->peak();
    const std::vector<double> first = plan.next({});
    const auto [low, high] = std::minmax_element(first.begin(), first.end());
    try
    {
        return overturningThreshold(
            housner.block,
            [&](double intensity) { return std::make_unique<ScaledMotion>(ground, intensity * perUnit); },
            *low, *high);
    }
    catch (const std::domain_error&)
    {
        throw FatalError(
            fmt::format("By Housner's equation the block stands, or overturns, at both {:g} and {:g}: "
                        "take other bounds of the intensity.",
                        *low, *high));
    }
}

} // namespace drystone
