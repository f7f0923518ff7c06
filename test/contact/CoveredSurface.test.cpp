// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What of a face another block leaves bare.
#include "contact/CoveredSurface.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

/// Area that is left of a block, of all its faces.
template<int Dim>
double bareArea(const Assembly<Dim>& assembly, int block)
{
    double sum = 0;
    for (const SurfacePiece<Dim>& piece : surfaceOf(assembly, block))
    {
        sum += areaOf(piece);
    }
    for (const SurfacePiece<Dim>& piece : coveredSurface(assembly))
    {
        sum += piece.block == block ? areaOf(piece) : 0;
    }
    return sum;
}

TEST(CoveredSurface, OfThePlaneTakesTheThinnerBlockOrTheOneOnASupport)
{
    const auto rectangle = [](double x0, double y0, double x1, double y1) {
        return Polygon{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    };
    const Assembly<2> assembly{
        {{rectangle(-9, -1, 9, 0), 0.1, 0}, {rectangle(0, 0, 2, 1), 1, -1}, {rectangle(1, 1, 3, 2), 0.5, -1}},
        {{"ground", "ground"}}};
    EXPECT_NEAR(bareArea(assembly, 1), 6 - 2 - 0.5, 1e-12);
    EXPECT_NEAR(bareArea(assembly, 2), 3 - 0.5, 1e-12);
}

TEST(CoveredSurface, OfSpaceIsThePatchAndHasTheNormalOfTheFace)
{
    const Assembly<3> assembly{{{makeBox({0, 0, 0}, {2, 2, 1}), -1}, {makeBox({1, 1, 1}, {3, 3, 2}), -1}},
                               {}};
    EXPECT_NEAR(bareArea(assembly, 0), 16 - 1, 1e-12);
    EXPECT_NEAR(bareArea(assembly, 1), 16 - 1, 1e-12);
    for (const SurfacePiece<3>& piece : coveredSurface(assembly))
    {
        EXPECT_EQ(piece.normal, Vector<3>(0, 0, piece.block == 0 ? 1 : -1));
    }
}

TEST(CoveredSurface, OfAConcavePatch)
{
    // An L on a slab: the patch is the L.
    const std::vector<Vector<3>> foot{{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}};
    std::vector<Vector<3>> head = foot;
    for (Vector<3>& corner : head)
    {
        corner.z() = 2;
    }
    const Assembly<3> assembly{{{makeBox({0, 0, 0}, {2, 2, 1}), -1}, {makePrism(foot, head), -1}}, {}};
    EXPECT_NEAR(bareArea(assembly, 0), 16 - 3, 1e-12);
    EXPECT_NEAR(bareArea(assembly, 1), 2 * 3 + 8 - 3, 1e-12);
}

} // namespace
