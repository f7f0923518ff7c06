// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Cells of patches: they stay convex, make up the patch, and share its area out to their vertices.
#include "../Polygons.h"

#include "contact/space/PatchCells.h"

#include "geometry/PolygonShape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace drystone
{
namespace
{

using test::letterL;

std::vector<ContactPoint<3>> cornersOf(const Polygon& outline, const Vector<3>& normal)
{
    std::vector<ContactPoint<3>> corners;
    const Eigen::Matrix3d frame = frameOf(normal);
    for (const Vector<2>& corner : outline)
    {
        corners.push_back({0, 1, 0,
                           Vector<3>(3, -1, 2) + corner.x() * frame.col(1) + corner.y() * frame.col(2),
                           normal, 0, ContactFeature{}});
    }
    return corners;
}

/// Area and first moment of the points are those of the outline; all cells are convex.
void expectWhole(const PatchCells& patch, const Polygon& outline)
{
    const std::vector<double> areas = vertexAreas(patch);
    const AreaProperties whole = areaProperties(outline);
    double area = 0;
    Vector<2> moment = Vector<2>::Zero();
    for (std::size_t i = 0; i < areas.size(); ++i)
    {
        EXPECT_GT(areas[i], 0);
        area += areas[i];
        moment += areas[i] * (patch.vertices[i] - patch.vertices[0]);
    }
    EXPECT_NEAR(area, std::abs(whole.area), 1e-9);
    EXPECT_LE((moment / area - (whole.centroid - outline[0])).norm(), 1e-9);
    for (const std::vector<int>& cell : patch.cells)
    {
        Polygon polygon;
        for (const int vertex : cell)
        {
            polygon.push_back(patch.vertices[vertex]);
        }
        const std::size_t size = polygon.size();
        for (std::size_t i = 0; i < size; ++i)
        {
            EXPECT_GE(cross(polygon[(i + 1) % size] - polygon[i], polygon[(i + 2) % size] - polygon[i]),
                      -1e-9);
        }
    }
}

const Polygon letterE{{0, 0}, {3, 0}, {3, 1},   {1, 1},   {1, 2}, {2.5, 2.2},
                      {2, 3}, {1, 3}, {1, 4.5}, {3, 4.4}, {3, 5}, {0, 5}};

TEST(PatchCells, OfConvexPatchesAreOneAndOfConcaveOnesConvexParts)
{
    EXPECT_EQ(patchCells(cornersOf({{0, 0}, {1, 0}, {2, 1}, {0, 1}}, {0, 0, 1})).front().cells.size(), 1U);
    EXPECT_EQ(patchCells(cornersOf(letterL, {0, 0, 1})).front().cells.size(), 2U);
    for (Polygon outline : {letterL, letterE})
    {
        expectWhole(patchCells(cornersOf(outline, {0, 0, 1})).front(), outline);
        std::reverse(outline.begin(), outline.end());
        expectWhole(patchCells(cornersOf(outline, Vector<3>(1, 2, 3).normalized())).front(), outline);
    }
}

TEST(PatchCells, CutAnywhereMakeUpThePatch)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> chance(-1, 1);
    for (const Polygon& outline : {letterL, letterE, Polygon{{0, 0}, {4, 0}, {4, 1e-3}, {0, 1e-3}}})
    {
        PatchCells patch = patchCells(cornersOf(outline, {0, 0, -1})).front();
        for (int i = 0; i < 12; ++i)
        {
            const Vector<2> normal = Vector<2>(chance(random), chance(random)).normalized();
            cutAlong(patch, normal, normal.dot(patch.vertices[2]) * std::abs(chance(random)));
        }
        Polygon inFrame(patch.vertices.begin(), patch.vertices.begin() + static_cast<int>(outline.size()));
        expectWhole(patch, inFrame);
    }
}

TEST(PatchCells, CutAlongTheirEdgesStayAsTheyAre)
{
    PatchCells patch = patchCells(cornersOf({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 0, 1})).front();
    EXPECT_FALSE(cutAlong(patch, {1, 0}, 1));
    EXPECT_FALSE(cutAlong(patch, {1, 0}, 1e-12));
    EXPECT_TRUE(cutAlong(patch, {1, 0}, 0.5));
    EXPECT_FALSE(cutAlong(patch, {-1, 0}, -0.5));
    EXPECT_EQ(patch.vertices.size(), 6U);
    EXPECT_TRUE(cutAlong(patch, Vector<2>(1, 1).normalized(), std::sqrt(0.5)));
    // From corner to corner, through the middle of the edge that the halves share.
    EXPECT_EQ(patch.vertices.size(), 7U);
    EXPECT_EQ(patch.cells.size(), 4U);
}

TEST(PatchCells, DividedMakeUpThePatchWhereverTheyAreCutAfterwards)
{
    std::mt19937 random(8);
    std::uniform_real_distribution<double> chance(-1, 1);
    for (const Polygon& outline :
         {letterL, letterE, Polygon{{0, 0}, {4, 0}, {4, 1e-2}, {0, 1e-2}}, Polygon{{0, 0}, {1, 0}, {0, 1}}})
    {
        PatchCells patch = patchCells(cornersOf(outline, {0, 0, 1})).front();
        const Polygon inFrame(patch.vertices.begin(),
                              patch.vertices.begin() + static_cast<int>(outline.size()));
        for (int i = 0; i < 3; ++i)
        {
            std::vector<char> isDivided;
            std::size_t cells = 0; // afterwards
            for (std::size_t k = 0; k < patch.cells.size(); ++k)
            {
                isDivided.push_back(k % 2 == 0);
                cells += k % 2 == 0 ? patch.cells[k].size() : 1;
            }
            divideCells(patch, isDivided);
            EXPECT_EQ(patch.cells.size(), cells);
            expectWhole(patch, inFrame);
            cutAlong(patch, Vector<2>(chance(random), chance(random)).normalized(),
                     0.5 * std::abs(chance(random)));
            expectWhole(patch, inFrame);
        }
    }
    // Two that share an edge share its middle.
    PatchCells patch = patchCells(cornersOf({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {0, 0, 1})).front();
    cutAlong(patch, {1, 0}, 1);
    divideCells(patch, {true, true});
    EXPECT_EQ(patch.vertices.size(), 15U);
}

TEST(PatchCells, OfAGridHaveItsPointsAndTheirShares)
{
    PatchCells patch = patchCells(cornersOf({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {0, 0, 1})).front();
    cutIntoGrid(patch, 3);
    const std::vector<double> areas = vertexAreas(patch);
    ASSERT_EQ(areas.size(), 9U);
    EXPECT_NEAR(*std::max_element(areas.begin(), areas.end()), 0.5, 1e-14);
    EXPECT_NEAR(*std::min_element(areas.begin(), areas.end()), 0.125, 1e-14);
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 2, 1e-14);
}

} // namespace
} // namespace drystone
