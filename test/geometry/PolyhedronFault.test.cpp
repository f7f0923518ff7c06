// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/space/PolyhedronFault.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace drystone
{
namespace
{

using testing::HasSubstr;

Polyhedron cube()
{
    return makeBox({0, 0, 0}, {1, 1, 1});
}

std::string faultText(const Polyhedron& polyhedron)
{
    const auto fault = findFault(polyhedron);
    return fault ? fault->text : "";
}

TEST(PolyhedronFault, SolidsHaveNone)
{
    EXPECT_EQ(faultText(cube()), "");
    // Concave, and with the corners of a face on one line.
    const std::vector<Vector<3>> bottom{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                        {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    std::vector<Vector<3>> top = bottom;
    for (Vector<3>& corner : top)
    {
        corner.z() = 1;
    }
    EXPECT_EQ(faultText(makePrism(bottom, top)), "");
}

/// The faces of two solids, those of the second with their normals out of it or into it.
Polyhedron together(Polyhedron first, const Polyhedron& second, bool isSecondTurned)
{
    const auto offset = static_cast<int>(first.vertices.size());
    first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
    for (std::vector<int> face : second.faces)
    {
        for (int& vertex : face)
        {
            vertex += offset;
        }
        if (isSecondTurned)
        {
            std::reverse(face.begin(), face.end());
        }
        first.faces.push_back(face);
    }
    return first;
}

TEST(PolyhedronFault, ACavityIsNone)
{
    const Polyhedron inner = makeBox({0.25, 0.25, 0.25}, {0.75, 0.5, 0.75});
    EXPECT_EQ(faultText(together(cube(), inner, true)), "");
    EXPECT_NEAR(volumeProperties(together(cube(), inner, true)).volume, 1 - 0.0625, 1e-15);
    EXPECT_THAT(faultText(together(cube(), inner, false)), HasSubstr("solids apart from each other"));
}

TEST(PolyhedronFault, SolidsApartFromEachOtherAreNoBlock)
{
    const Polyhedron other = makeBox({1.5, 0, 0}, {2, 0.5, 1});
    EXPECT_THAT(faultText(together(cube(), other, false)),
                HasSubstr("solids apart from each other, with face 0 and with face 6"));
    // The volume of the smaller would be taken from that of the larger.
    EXPECT_THAT(faultText(together(cube(), other, true)), HasSubstr("face 6 are turned inside"));
}

TEST(PolyhedronFault, AFaceIsNamedThatIsTurnedInside)
{
    Polyhedron shape = cube();
    std::reverse(shape.faces[3].begin(), shape.faces[3].end());
    const auto fault = findFault(shape);
    ASSERT_TRUE(fault);
    EXPECT_THAT(fault->text, HasSubstr("turned inside"));
    EXPECT_THAT(fault->text, HasSubstr("3"));
    for (std::vector<int>& face : shape.faces)
    {
        std::reverse(face.begin(), face.end());
    }
    std::reverse(shape.faces[3].begin(), shape.faces[3].end());
    EXPECT_THAT(faultText(shape), HasSubstr("all its faces are turned inside"));
}

TEST(PolyhedronFault, AMissingFaceLeavesItOpen)
{
    Polyhedron shape = cube();
    shape.faces.pop_back();
    EXPECT_THAT(faultText(shape), HasSubstr("not closed"));
}

TEST(PolyhedronFault, AFaceIsNamedThatIsNotPlane)
{
    Polyhedron shape = cube();
    shape.vertices[6].z() += 1e-3;
    const auto fault = findFault(shape);
    ASSERT_TRUE(fault);
    EXPECT_THAT(fault->text, HasSubstr("not plane"));
    EXPECT_GE(fault->face, 0);
    // Six digits are enough.
    shape.vertices[6].z() = 1 + 5e-7;
    EXPECT_EQ(faultText(shape), "");
}

TEST(PolyhedronFault, IndicesAndVerticesAreChecked)
{
    Polyhedron shape = cube();
    shape.faces[2][1] = 8;
    EXPECT_THAT(faultText(shape),
                HasSubstr("face 2 has the vertex 8, but vertices are numbered from 0 to 7"));
    shape = cube();
    shape.faces[2][1] = shape.faces[2][0];
    EXPECT_THAT(faultText(shape), HasSubstr("more than once"));
    shape = cube();
    shape.vertices.emplace_back(0.5, 0.5, 2);
    EXPECT_THAT(faultText(shape), HasSubstr("vertex 8 belongs to no face"));
    shape = cube();
    shape.vertices[7] = shape.vertices[6];
    EXPECT_THAT(faultText(shape), HasSubstr("vertices 6 and 7 coincide"));
    shape = cube();
    shape.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(faultText(shape), HasSubstr("not finite"));
    EXPECT_THAT(faultText({}), HasSubstr("0 vertices"));
    shape = cube();
    shape.faces.resize(3);
    EXPECT_THAT(faultText(shape), HasSubstr("3 faces"));
}

TEST(PolyhedronFault, AFaceThatPassesThroughAnotherIsFound)
{
    // Two tetrahedra in one list of faces, the tip of one in the other.
    const auto tetrahedron = [](const Vector<3>& move)
    {
        Polyhedron shape;
        shape.vertices = {Vector<3>(0, 0, 0) + move, Vector<3>(1, 0, 0) + move, Vector<3>(0, 1, 0) + move,
                          Vector<3>(0.2, 0.2, 1) + move};
        shape.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        return shape;
    };
    Polyhedron both = tetrahedron({0, 0, 0});
    const Polyhedron other = tetrahedron({0.1, 0.1, -0.5});
    for (const Vector<3>& vertex : other.vertices)
    {
        both.vertices.push_back(vertex);
    }
    for (std::vector<int> face : other.faces)
    {
        for (int& index : face)
        {
            index += 4;
        }
        both.faces.push_back(face);
    }
    EXPECT_THAT(faultText(both), HasSubstr("passes through face"));
}

} // namespace
} // namespace drystone
