// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces in pieces against areas known by hand.
#include "assembly/BlockSurface.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace drystone;

namespace
{

/// An L of the plane, 2 m by 2 m less the upper right quarter, 0.5 m thick.
Assembly<2> plainL()
{
    return {{{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0.5}}, {}};
}

/// The same upright in space.
Assembly<3> solidL()
{
    const std::vector<Vector<3>> front{{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {1, 0, 2}, {0, 0, 2}};
    std::vector<Vector<3>> back = front;
    for (Vector<3>& corner : back)
    {
        corner.y() = 0.5;
    }
    // Counter-clockwise seen from the top of the prism, which is the front.
    return {{{makePrism(back, front), -1}}, {}};
}

template<int Dim>
double sumOfAreas(const std::vector<SurfacePiece<Dim>>& pieces)
{
    return std::accumulate(pieces.begin(), pieces.end(), 0.0,
                           [](double sum, const auto& piece) { return sum + areaOf(piece); });
}

/// Sum of area times normal: zero over a closed surface.
template<int Dim>
Vector<Dim> sumOfNormals(const std::vector<SurfacePiece<Dim>>& pieces)
{
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const SurfacePiece<Dim>& piece : pieces)
    {
        sum += areaOf(piece) * piece.normal;
    }
    return sum;
}

TEST(BlockSurface, OfAConcaveBlockIsClosedAndHasItsArea)
{
    const auto plane = surfaceOf(plainL(), 0);
    EXPECT_NEAR(sumOfAreas(plane), 8 * 0.5, 1e-14);
    EXPECT_LT(sumOfNormals(plane).norm(), 1e-14);
    const auto space = surfaceOf(solidL(), 0);
    EXPECT_NEAR(sumOfAreas(space), 8 * 0.5 + 2 * 3, 1e-13);
    EXPECT_LT(sumOfNormals(space).norm(), 1e-13);
}

TEST(BlockSurface, IsCutByAPlane)
{
    // Below z = 1.5: the upper arm loses its top and half a metre of its sides.
    const auto plane = partBelow(surfaceOf(plainL(), 0), {0, 1}, 1.5);
    EXPECT_NEAR(sumOfAreas(plane), (8 - 2) * 0.5, 1e-14);
    const auto space = partBelow(surfaceOf(solidL(), 0), {0, 0, 1}, 1.5);
    EXPECT_NEAR(sumOfAreas(space), (8 - 2) * 0.5 + 2 * 2.5, 1e-13);
    // Obliquely: what is below and what is above are the whole.
    const Vector<3> oblique = Vector<3>(1, 2, 3).normalized();
    const auto below = partBelow(surfaceOf(solidL(), 0), oblique, 1.1);
    const auto above = partBelow(surfaceOf(solidL(), 0), -oblique, -1.1);
    EXPECT_GT(sumOfAreas(below), 1);
    EXPECT_GT(sumOfAreas(above), 1);
    EXPECT_NEAR(sumOfAreas(below) + sumOfAreas(above), 10, 1e-13);
}

TEST(BlockSurface, QuadratureIsExactForQuadraticFunctions)
{
    const SurfacePiece<2> edge{0, {0, -1}, {Vector<2>(1, 0), Vector<2>(4, 0)}, 2};
    double integral = 0;
    for (const auto& [place, weight] : quadratureOf(edge))
    {
        integral += weight * place.x() * place.x();
    }
    EXPECT_NEAR(integral, 2 * (64 - 1) / 3.0, 1e-12);

    const SurfacePiece<3> triangle{
        0, {0, 0, 1}, {Vector<3>(0, 0, 0), Vector<3>(1, 0, 0), Vector<3>(0, 1, 0)}, -1};
    integral = 0;
    for (const auto& [place, weight] : quadratureOf(triangle))
    {
        integral += weight * place.x() * place.y();
    }
    EXPECT_NEAR(integral, -1 / 24.0, 1e-15);
}

} // namespace
