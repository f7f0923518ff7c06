// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts in motion within time steps: a plain Gauss-Seidel stepper, made for these tests alone, shows what
/// the choice of corners and edges does to velocities, overlaps and energy, and how contacts join along a
/// path.
#include "../Polygons.h"

#include "contact/MovingContacts.h"
#include "contact/Penetration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace drystone;

namespace
{

using test::rectangle;

constexpr double gravity = 9.81;

/// Blocks of unit density in motion. Fixed blocks have support 0.
struct Scene
{
    Assembly<2> assembly;
    std::vector<Placement<2>> placements;
    std::vector<Vector<3>> velocities; // ux uy rz
};

void add(Scene& scene, const Polygon& outline, int support, const Placement<2>& placement = {},
         const Vector<3>& velocity = Vector<3>::Zero())
{
    scene.assembly.blocks.push_back({outline, 1, support});
    scene.placements.push_back(placement);
    scene.velocities.push_back(velocity);
}

/// Kinetic and potential energy of the free blocks, and the deepest overlap after each step.
struct History
{
    std::vector<double> energy;
    std::vector<double> overlap;
    std::vector<Placement<2>> path; // of the last block
};

class Stepper
{
public:
    Stepper(Scene scene, double friction)
        : scene_(std::move(scene)), contacts_(scene_.assembly), friction_(friction)
    {
        for (const Block<2>& block : scene_.assembly.blocks)
        {
            mass_.push_back(areaProperties(block.outline));
        }
    }

    /// Implicit Euler with impulses at the contact points. The gaps are corrected by their exact measure at
    /// the end of the step and the impulses solved again, `passes` times in all.
    void advance(double timeStep, int passes, History& history)
    {
        auto& blocks = scene_.assembly.blocks;
        const std::vector<Placement<2>> ahead = moved(timeStep);
        const auto& points = contacts_.update(
            scene_.placements, ahead, contacts_.marginFor(scene_.velocities, timeStep, gravity) + 1e-4);
        std::vector<Vector<3>> free = scene_.velocities;
        for (std::size_t b = 0; b < blocks.size(); ++b)
        {
            free[b].y() -= blocks[b].support < 0 ? gravity * timeStep : 0;
        }
        std::vector<double> correction(points.size(), 0);
        std::vector<ContactPoint<2>> measured;
        for (int pass = 0; pass < passes; ++pass)
        {
            scene_.velocities = free;
            std::vector<double> normal(points.size(), 0);
            std::vector<double> shear(points.size(), 0);
            double change = 1;
            for (int sweep = 0; sweep < 2000 && change > 1e-12; ++sweep)
            {
                change = 0;
                for (std::size_t i = 0; i < points.size(); ++i)
                {
                    const double gap = points[i].gap + correction[i];
                    change = std::max(change,
                                      push(points[i], points[i].normal, gap / timeStep, 0, 1e300, normal[i]));
                    const double limit = friction_ * normal[i];
                    change =
                        std::max(change, push(points[i], tangent(points[i]), 0, -limit, limit, shear[i]));
                }
            }
            if (pass + 1 < passes)
            {
                contacts_.measure(moved(timeStep), measured);
                for (std::size_t i = 0; i < points.size(); ++i)
                {
                    correction[i] =
                        measured[i].gap - points[i].gap - timeStep * closing(points[i], points[i].normal);
                }
            }
        }
        scene_.placements = moved(timeStep);
        double energy = 0;
        for (std::size_t b = 0; b < blocks.size(); ++b)
        {
            if (blocks[b].support < 0)
            {
                const Vector<3>& v = scene_.velocities[b];
                const double height = mass_[b].centroid.y() + scene_.placements[b].translation.y();
                energy += mass_[b].area * (v.head<2>().squaredNorm() / 2 + gravity * height)
                          + mass_[b].polarMoment * v[2] * v[2] / 2;
            }
        }
        history.energy.push_back(energy);
        history.overlap.push_back(penetration(scene_.assembly, scene_.placements).depth);
        history.path.push_back(scene_.placements.back());
    }

private:
    std::vector<Placement<2>> moved(double timeStep) const
    {
        std::vector<Placement<2>> placements = scene_.placements;
        for (std::size_t b = 0; b < placements.size(); ++b)
        {
            placements[b].translation += timeStep * scene_.velocities[b].head<2>();
            placements[b].rotation += timeStep * scene_.velocities[b][2];
        }
        return placements;
    }

    double arm(const ContactPoint<2>& point, int block, const Vector<2>& direction) const
    {
        const Vector<2> centre = mass_[block].centroid + scene_.placements[block].translation;
        return cross(Vector<2>(point.position - centre), direction);
    }

    /// Rate at which the block moves off its neighbour along a direction.
    double closing(const ContactPoint<2>& point, const Vector<2>& direction) const
    {
        const auto rate = [&](int block)
        {
            const Vector<3>& v = scene_.velocities[block];
            return direction.dot(v.head<2>()) + arm(point, block, direction) * v[2];
        };
        return rate(point.block) - rate(point.neighbour);
    }

    /// One Gauss-Seidel update of an impulse within its bounds; returns its change.
    double push(const ContactPoint<2>& point, const Vector<2>& direction, double bias, double low,
                double high, double& impulse)
    {
        double mobility = 0;
        for (const int block : {point.block, point.neighbour})
        {
            if (scene_.assembly.blocks[block].support < 0)
            {
                const double lever = arm(point, block, direction);
                mobility += 1 / mass_[block].area + lever * lever / mass_[block].polarMoment;
            }
        }
        const double updated = std::clamp(impulse - (closing(point, direction) + bias) / mobility, low, high);
        const double step = updated - impulse;
        impulse = updated;
        for (const int block : {point.block, point.neighbour})
        {
            if (scene_.assembly.blocks[block].support < 0)
            {
                const double signedStep = block == point.block ? step : -step;
                scene_.velocities[block].head<2>() += signedStep / mass_[block].area * direction;
                scene_.velocities[block][2] +=
                    signedStep * arm(point, block, direction) / mass_[block].polarMoment;
            }
        }
        return std::abs(step);
    }

    Scene scene_;
    MovingContacts<2> contacts_;
    double friction_;
    std::vector<AreaProperties> mass_;
};

/// A slider of 0.8 x 0.5 m that starts tilted on its lowest corner, at 3 m/s, over the given ground.
History slide(const std::vector<Polygon>& ground, double friction, double tilt, double spin)
{
    Scene scene;
    for (const Polygon& block : ground)
    {
        add(scene, block, 0);
    }
    const Polygon slider = rectangle(0, 1, 0.8, 1.5);
    double lowest = 2;
    for (const Vector<2>& corner : placed(slider, areaProperties(slider).centroid, {Vector<2>::Zero(), tilt}))
    {
        lowest = std::min(lowest, corner.y());
    }
    add(scene, slider, -1, {{0.03, 1 - lowest}, tilt}, {3, 0, spin});
    Stepper stepper(std::move(scene), friction);
    History history;
    for (int step = 0; step < 700; ++step)
    {
        stepper.advance(0.002, 1, history);
    }
    return history;
}

} // namespace

TEST(MovingContactsStep, ACourseOfFlushBlocksSlidesLikeOneBlock)
{
    std::vector<Polygon> course;
    for (int i = -2; i < 8; ++i)
    {
        course.push_back(rectangle(i, 0, i + 1, 1));
    }
    for (const double friction : {0.0, 0.3})
    {
        for (const double tilt : {0.0, 1e-6, 0.05, 0.5, 0.9, 1.3})
        {
            for (const double spin : {0.0, -3.0})
            {
                const History overCourse = slide(course, friction, tilt, spin);
                const History overOne = slide({rectangle(-2, 0, 8, 1)}, friction, tilt, spin);
                double difference = 0;
                for (std::size_t i = 0; i < overCourse.path.size(); ++i)
                {
                    const Vector<2> apart = overCourse.path[i].translation - overOne.path[i].translation;
                    difference = std::max({difference, apart.norm(),
                                           std::abs(overCourse.path[i].rotation - overOne.path[i].rotation)});
                    EXPECT_LT(overCourse.overlap[i], 1e-6);
                }
                // A face that lands meets the head joints' corners at the tilt of the step's beginning, which
                // differs from the flat ground's normal by the rotation of a step: first order in dt, at
                // landings alone.
                EXPECT_LT(difference, tilt == 0 && spin == 0 ? 1e-10 : 0.01)
                    << "friction " << friction << " tilt " << tilt << " spin " << spin;
            }
        }
    }
}

TEST(MovingContactsStep, BlocksThatTumbleIntoABoxComeToRestWithoutOverlapOrGainOfEnergy)
{
    const Polygon fork{{-0.4, -0.3}, {0.4, -0.3},  {0.4, 0.3},  {0.2, 0.3},
                       {0.2, -0.1},  {-0.2, -0.1}, {-0.2, 0.3}, {-0.4, 0.3}};
    for (const int seed : {1, 2})
    {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> symmetric(-1, 1);
        Scene scene;
        for (int i = 0; i < 6; ++i)
        {
            const Polygon outline = i % 3 == 0   ? fork
                                    : i % 3 == 1 ? rectangle(-0.15, -0.1, 0.15, 0.1)
                                                 : Polygon{{-0.2, -0.15}, {0.3, -0.1}, {0.1, 0.2}};
            const Placement<2> start{{0.3 * symmetric(random), 0.7 + 0.9 * i}, 3 * symmetric(random)};
            add(scene, outline, -1, start, {symmetric(random), 0, 3 * symmetric(random)});
        }
        add(scene, rectangle(-3, -1, 3, 0), 0);
        add(scene, rectangle(-2, 0, -1, 20), 0);
        add(scene, rectangle(1, 0, 2, 20), 0);
        Stepper stepper(std::move(scene), 0.4);
        History history;
        for (int step = 0; step < 800; ++step)
        {
            stepper.advance(0.002, 4, history);
        }
        // Blocks of 0.5 m that hit each other at up to 10 m/s. No gain beyond what the sweeps leave unsolved.
        EXPECT_LT(*std::max_element(history.overlap.begin(), history.overlap.end()), 1e-4) << seed;
        double gain = 0;
        for (std::size_t i = 1; i < history.energy.size(); ++i)
        {
            gain = std::max(gain, history.energy[i] - history.energy[i - 1]);
        }
        EXPECT_LT(gain, 1e-5) << seed;
        EXPECT_LT(history.energy.back(), 0.35 * history.energy.front()) << seed;
    }
}

TEST(MovingContactsStep, ActivePointsAndTheDeepestGapAreContinuousAlongASmoothPath)
{
    // A block is led over three others on a random path, in small steps, dipping into them by up to 2 mm. In
    // a step the deepest gap changes by no more than the block's points move, and a point that overlaps by
    // more than that has one beside it in the step before.
    const Assembly<2> assembly{{{rectangle(0, 0, 1, 1)},
                                {rectangle(1, 0, 2, 1)},
                                {{{2, 0}, {3.2, 0}, {2.9, 1.1}, {2.3, 1}}},
                                {rectangle(-0.25, -0.15, 0.25, 0.15)}},
                               {}};
    MovingContacts<2> contacts(assembly);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    int active = 0;
    for (int path = 0; path < 5; ++path)
    {
        const double first = symmetric(random);
        const double second = symmetric(random);
        const double turn = 3 * symmetric(random);
        const double start = symmetric(random);
        std::vector<ContactPoint<2>> before;
        Placement<2> placementBefore;
        double deepestBefore = 0;
        for (int step = 0; step < 4000; ++step)
        {
            const double t = step / 4000.0;
            std::vector<Placement<2>> placements(4);
            Placement<2>& guided = placements[3];
            guided.rotation = start + turn * t;
            guided.translation.x() = 0.2 + 2.3 * t + 0.1 * first * std::sin(6 * t);
            // The height at which it dips into the others by a wavering depth.
            const double wanted = 0.001 + 0.001 * std::sin(20 * t + 3 * second);
            double low = 1;
            double high = 2;
            double depth = 0;
            for (int bisection = 0; bisection < 45; ++bisection)
            {
                guided.translation.y() = (low + high) / 2;
                depth = penetration(assembly, placements).depth;
                (depth > wanted ? low : high) = guided.translation.y();
            }
            const auto& points = contacts.update(placements, 0.01);
            double deepest = 0;
            for (const ContactPoint<2>& point : points)
            {
                deepest = point.neighbour == 3 ? std::min(deepest, point.gap) : deepest;
            }
            EXPECT_NEAR(depth, wanted, 1e-9);
            EXPECT_LE(deepest, -0.9 * depth) << path << " " << step;
            EXPECT_GE(deepest, -2 * depth - 1e-9) << path << " " << step;
            if (step > 0)
            {
                const double motion = (guided.translation - placementBefore.translation).norm()
                                      + 0.3 * std::abs(guided.rotation - placementBefore.rotation);
                EXPECT_NEAR(deepest, deepestBefore, 1.5 * motion) << path << " " << step;
                for (const ContactPoint<2>& point : points)
                {
                    if (point.neighbour == 3 && point.gap < -motion)
                    {
                        ++active;
                        EXPECT_TRUE(std::any_of(before.begin(), before.end(),
                                                [&](const ContactPoint<2>& other) {
                                                    return (other.position - point.position).norm()
                                                           < 3 * (motion + depth);
                                                }))
                            << path << " " << step;
                    }
                }
            }
            before = points;
            placementBefore = guided;
            deepestBefore = deepest;
        }
    }
    EXPECT_GT(active, 1000);
}
