// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Volumes, centroids and inertias of polyhedra against closed forms.
#include "../Polygons.h"

#include "geometry/Polygon.h"
#include "geometry/space/Polyhedron.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace drystone;

namespace
{

using test::randomStar;

std::vector<Vector<3>> atHeight(const Polygon& polygon, double z)
{
    std::vector<Vector<3>> corners;
    for (const Vector<2>& corner : polygon)
    {
        corners.emplace_back(corner.x(), corner.y(), z);
    }
    return corners;
}

Eigen::Matrix3d randomRotation(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
        .normalized()
        .toRotationMatrix();
}

TEST(Polyhedron, ABoxFarFromTheOriginKeepsItsMoments)
{
    const Vector<3> corner(1e6, -3e5, 2e5);
    const VolumeProperties box = volumeProperties(makeBox(corner, corner + Vector<3>(2, 0.5, 0.25)));
    EXPECT_DOUBLE_EQ(box.volume, 0.25);
    EXPECT_EQ(box.centroid, corner + Vector<3>(1, 0.25, 0.125));
    EXPECT_NEAR(box.inertia(0, 0), 0.25 * (0.25 + 0.0625) / 12, 1e-15);
    EXPECT_NEAR(box.inertia(1, 1), 0.25 * (4 + 0.0625) / 12, 1e-15);
    EXPECT_NEAR(box.inertia(2, 2), 0.25 * (4 + 0.25) / 12, 1e-15);
    EXPECT_NEAR(box.inertia(0, 1), 0, 1e-15);
}

TEST(Polyhedron, TheCornerTetrahedronHasItsClosedForm)
{
    const Polyhedron tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                 {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    const VolumeProperties properties = volumeProperties(tetrahedron);
    EXPECT_DOUBLE_EQ(properties.volume, 1.0 / 6);
    EXPECT_NEAR((properties.centroid - Vector<3>::Constant(0.25)).norm(), 0, 1e-16);
    // int x^2 = 1/60, int xy = 1/120 about the corner; less V/16 for the centroid.
    EXPECT_NEAR(properties.inertia(0, 0), 2 * (1.0 / 60 - 1.0 / 96), 1e-16);
    EXPECT_NEAR(properties.inertia(0, 1), -(1.0 / 120 - 1.0 / 96), 1e-16);
}

TEST(Polyhedron, AFrustumOfASquarePyramidHasItsClosedForm)
{
    // Half sides a below and b above, height h: volume 4 h (a^2 + a b + b^2)/3; the section at height s has
    // the area A(s) = 4 (a + (b - a) s/h)^2 and the moments A^2/6 about z, A^2/12 + A z^2 about x.
    const double a = 0.5;
    const double b = 0.2;
    const double h = 0.7;
    const auto square = [](double half, double z) -> std::vector<Vector<3>> {
        return {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
    };
    const VolumeProperties properties = volumeProperties(makePrism(square(a, 0), square(b, h)));
    const double volume = 4 * h * (a * a + a * b + b * b) / 3;
    const double height = h * (a * a + 2 * a * b + 3 * b * b) / (4 * (a * a + a * b + b * b));
    EXPECT_NEAR(properties.volume, volume, 1e-15);
    EXPECT_NEAR(properties.centroid.z(), height, 1e-15);
    const double fourth = 16 * h * (std::pow(b, 5) - std::pow(a, 5)) / (5 * (b - a)); // int A^2
    EXPECT_NEAR(properties.inertia(2, 2), fourth / 6, 1e-15);
    // int A z^2 = 4 h^3 (a^2/30 + a b/10 + b^2/5)
    const double second = 4 * h * h * h * (a * a / 30 + a * b / 10 + b * b / 5);
    EXPECT_NEAR(properties.inertia(0, 0), fourth / 12 + second - volume * height * height, 1e-15);
}

TEST(Polyhedron, RandomConcavePrismsHaveTheMomentsOfTheirSectionHoweverTheyAreTurned)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-3, 3);
    for (int i = 0; i < 100; ++i)
    {
        const Polygon section = randomStar(random, 3 + i % 20);
        const double height = 0.1 + 0.02 * i;
        Polyhedron prism = makePrism(atHeight(section, 0), atHeight(section, height));
        const Eigen::Matrix3d rotation = randomRotation(random);
        const Vector<3> shift(uniform(random), uniform(random), uniform(random));
        for (Vector<3>& vertex : prism.vertices)
        {
            vertex = (rotation * vertex + shift).eval();
        }
        const AreaProperties area = areaProperties(section);
        const VolumeProperties properties = volumeProperties(prism);
        EXPECT_NEAR(properties.volume, area.area * height, 1e-13) << i;
        const Vector<3> centroid(area.centroid.x(), area.centroid.y(), height / 2);
        EXPECT_NEAR((properties.centroid - rotation * centroid - shift).norm(), 0, 1e-13) << i;
        const Vector<3> axis = rotation.col(2);
        EXPECT_NEAR(axis.dot(properties.inertia * axis), area.polarMoment * height, 1e-13) << i;
        EXPECT_NEAR(properties.inertia.trace(),
                    2 * area.polarMoment * height + area.area * std::pow(height, 3) / 6, 1e-13)
            << i;
        EXPECT_NEAR((properties.inertia - properties.inertia.transpose()).norm(), 0, 1e-15) << i;
    }
}

TEST(Polyhedron, ASolidTurnedInsideOutHasANegativeVolumeAndTheSameCentroid)
{
    Polyhedron box = makeBox({1, 2, 3}, {2, 4, 6});
    for (std::vector<int>& face : box.faces)
    {
        std::reverse(face.begin(), face.end());
    }
    EXPECT_DOUBLE_EQ(volumeProperties(box).volume, -6);
    EXPECT_NEAR((volumeProperties(box).centroid - Vector<3>(1.5, 3, 4.5)).norm(), 0, 1e-15);
}

TEST(Polyhedron, AreaVectorsPointOutwardsAndCloseUp)
{
    const Polyhedron box = makeBox({0, 0, 0}, {1, 2, 3});
    const std::vector<Vector<3>> expected{{0, 0, -2}, {0, 0, 2}, {0, -3, 0},
                                          {6, 0, 0},  {0, 3, 0}, {-6, 0, 0}};
    for (std::size_t face = 0; face < expected.size(); ++face)
    {
        EXPECT_EQ(areaVector(box, box.faces[face]), expected[face]) << face;
    }
    std::mt19937 random(12);
    const Polygon star = randomStar(random, 17);
    const Polyhedron prism = makePrism(atHeight(star, 0), atHeight(star, 1));
    Vector<3> sum = Vector<3>::Zero();
    for (const std::vector<int>& face : prism.faces)
    {
        sum += areaVector(prism, face);
    }
    EXPECT_NEAR(sum.norm(), 0, 1e-14);
    EXPECT_NEAR(areaVector(prism, prism.faces[1]).z(), areaProperties(star).area, 1e-15);
}

} // namespace
