// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Loads on faces against hand calculations.
#include "assembly/SurfaceLoads.h"
#include "../MadeStructure.h"
#include "assembly/FillFromAbove.h"
#include "dictionary/Dictionary.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace drystone;

namespace
{

/// A trapezium, 3 m wide at its foot and 1 m at its top, 2 m high, 0.5 m thick; the right side slopes.
Assembly<2> plainWall()
{
    return {{{{{0, 0}, {3, 0}, {1, 2}, {0, 2}}, 0.5}}, {}};
}

/// The same in space.
Assembly<3> solidWall()
{
    const std::vector<Vector<3>> front{{0, 0, 0}, {3, 0, 0}, {1, 0, 2}, {0, 0, 2}};
    std::vector<Vector<3>> back = front;
    for (Vector<3>& corner : back)
    {
        corner.y() = 0.5;
    }
    return {{{makePrism(back, front), -1}}, {}};
}

/// Force and moment (about y in space) as of the plane.
Vector<3> asOfPlane(const Eigen::VectorXd& load)
{
    return load.size() == 3 ? Vector<3>(load) : Vector<3>(load[0], load[2], -load[4]);
}

template<int Dim, class Settings>
Vector<3> pressure(const Assembly<Dim>& assembly, const Settings& settings)
{
    return asOfPlane(pressureLoad(assembly, exposedSurface<Dim>(assembly, {}, settings), settings).rows);
}

template<int Dim>
Vector<3> backfill(const Assembly<Dim>& assembly, const BackfillSettings<Dim>& settings)
{
    return asOfPlane(backfillLoad(assembly, exposedSurface<Dim>(assembly, {}, settings), settings).rows);
}

TEST(SurfaceLoads, WindPressesOnTheFacesThatItMeets)
{
    PressureSettings<2> plane;
    plane.value = 600;
    plane.normal = {-1, 0};
    // 600 Pa on 2 m x 0.5 m, at mid height; the centroid is at y = (3 x 1 + 2 x 2/2 x 2/3 ...) below.
    const double area = 4;
    const double height = (1 * 2 * 1 + 0.5 * 2 * 2 * (2.0 / 3)) / area;
    const Vector<3> expected(600, 0, -600 * (1 - height));
    EXPECT_LT((pressure(plainWall(), plane) - expected).norm(), 1e-10);
    PressureSettings<3> space;
    space.value = 600;
    space.normal = {-1e-300, 0, 0}; // its length does not matter
    EXPECT_LT((pressure(solidWall(), space) - expected).norm(), 1e-10);
}

TEST(SurfaceLoads, APressureAllRoundHasNoResultant)
{
    PressureSettings<3> settings;
    settings.value = 1e4;
    settings.normal = {1, 0, 0};
    settings.within = 180;
    const Assembly<3> wall = solidWall();
    EXPECT_LT(pressureLoad(wall, exposedSurface<3>(wall, {}, settings), settings).rows.norm(), 1e-9);
}

TEST(SurfaceLoads, OfADirectionPressTheWholeAreaThatWay)
{
    PressureSettings<2> settings;
    settings.value = 100;
    settings.normal = {1, 1}; // the sloping side, sqrt 8 m long
    settings.within = 1;
    settings.direction = {0, -3};
    const Vector<3> load = pressure(plainWall(), settings);
    EXPECT_NEAR(load[0], 0, 1e-12);
    EXPECT_NEAR(load[1], -100 * std::sqrt(8.0) * 0.5, 1e-10);
}

TEST(SurfaceLoads, ABoxCutsFaces)
{
    PressureSettings<2> settings;
    settings.value = 600;
    settings.normal = {-1, 0};
    settings.box = {{-1, 0.5}, {1, 1.25}};
    EXPECT_NEAR(pressure(plainWall(), settings)[0], 600 * 0.75 * 0.5, 1e-10);
}

TEST(SurfaceLoads, OtherBlocksAndFixedOnesAreLeftOut)
{
    Assembly<2> two = plainWall();
    two.blocks.push_back(two.blocks.front());
    two.zones = {{"second", {1}}};
    PressureSettings<2> settings;
    settings.value = 600;
    settings.normal = {-1, 0};
    settings.blocks = {0};
    Eigen::VectorXd load = pressureLoad(two, exposedSurface<2>(two, {}, settings), settings).rows;
    EXPECT_NEAR(load[0], 600, 1e-10);
    EXPECT_EQ(load[3], 0);
    settings.blocks.clear();
    settings.zones = {{"second", [](const std::string& name) { return name == "second"; }}};
    load = pressureLoad(two, exposedSurface<2>(two, {}, settings), settings).rows;
    EXPECT_EQ(load[0], 0);
    EXPECT_NEAR(load[3], 600, 1e-10);
    two.blocks[1].support = 0;
    EXPECT_TRUE(exposedSurface<2>(two, {}, settings).empty());
}

TEST(SurfaceLoads, WhatOthersLieOnIsNotLoaded)
{
    const Assembly<2> wall = plainWall();
    PressureSettings<2> settings;
    settings.value = 600;
    settings.normal = {-1, 0};
    // The lower half of the left side.
    const SurfacePiece<2> covered{0, {-1, 0}, {Vector<2>(0, 0), Vector<2>(0, 1)}, -0.5};
    const Eigen::VectorXd load =
        pressureLoad(wall, exposedSurface<2>(wall, {covered}, settings), settings).rows;
    EXPECT_NEAR(load[0], 300, 1e-10);
}

TEST(SurfaceLoads, ABackfillWeighsWhatLiesOnTheFaces)
{
    // Up to y = 3: 1 m on the top, 1 m to 3 m over the slope; 20 kN/m3, 0.5 m thick.
    BackfillSettings<2> settings;
    settings.unitWeight = 20000;
    settings.level = 3;
    const double top = 1 * 1 * 10000.0;
    const double slope = 2 * (1 + 3) / 2.0 * 10000.0;
    Vector<3> load = backfill(plainWall(), settings);
    EXPECT_NEAR(load[0], 0, 1e-9);
    EXPECT_NEAR(load[1], -(top + slope), 1e-8);
    // Moment about the centroid: over the slope a rectangle about x = 2 and a triangle about x = 7/3.
    const double centroid = (2 * 0.5 + 2 * (1 + 2.0 / 3)) / 4;
    const double moment = -top * (0.5 - centroid) - 20000 * (2 - centroid) - 20000 * (7.0 / 3 - centroid);
    EXPECT_NEAR(load[2], moment, 1e-8);

    BackfillSettings<3> space;
    space.unitWeight = 20000;
    space.level = 3;
    EXPECT_LT((backfill(solidWall(), space) - load).norm(), 1e-7);
    // Its surcharge: 5 kPa on 3 m x 0.5 m, wherever the level is.
    settings.unitWeight = 0;
    settings.surcharge = 5000;
    EXPECT_NEAR(backfill(plainWall(), settings)[1], -7500, 1e-9);
    settings.level.reset();
    EXPECT_NEAR(backfill(plainWall(), settings)[1], -7500, 1e-9);
    settings.level = 1; // half of the slope is above the fill
    EXPECT_NEAR(backfill(plainWall(), settings)[1], -2500, 1e-9);
    settings.level = 2; // of the top itself, which lies under it
    EXPECT_NEAR(backfill(plainWall(), settings)[1], -7500, 1e-9);
    settings.level = 2 - 2e-16;
    EXPECT_NEAR(backfill(plainWall(), settings)[1], -7500, 1e-9);
    space.unitWeight = 0;
    space.surcharge = 5000;
    space.level = 2;
    EXPECT_NEAR(backfill(solidWall(), space)[1], -7500, 1e-9);
}

TEST(SurfaceLoads, EarthPressureGrowsWithDepth)
{
    BackfillSettings<2> settings;
    settings.unitWeight = 18000;
    settings.level = 2;
    settings.lateralCoefficient = 1 / 3.0;
    settings.box = {{-1, 0}, {0.5, 2}}; // the left side alone
    // Rankine: K gamma h^2 / 2, h/3 above the foot.
    const double force = 18000 / 3.0 * 4 / 2 * 0.5;
    const Vector<3> load = backfill(plainWall(), settings);
    EXPECT_NEAR(load[0], force, 1e-9);
    EXPECT_NEAR(load[1], 0, 1e-9);
    const double height = (2 + 4.0 / 3) / 4;
    EXPECT_NEAR(load[2], -force * (2.0 / 3 - height), 1e-9);
}

TEST(SurfaceLoads, EarthPressureActsOnABackThatLeansOverTheFill)
{
    // 1.6 x 3 m; its back, on the left, leans outwards by a rounding error, by a tenth and by 45 degrees.
    for (const double lean : {0.0, 1e-12, 1e-6, 0.3, 3.0})
    {
        const Assembly<2> plane{{{{{0, 0}, {1.6, 0}, {1.6, 3}, {-lean, 3}}, 1}}, {}};
        const Assembly<3> space{{{makePrism({{0, 1, 0}, {1.6, 1, 0}, {1.6, 1, 3}, {-lean, 1, 3}},
                                            {{0, 0, 0}, {1.6, 0, 0}, {1.6, 0, 3}, {-lean, 0, 3}}),
                                  -1}},
                                {}};
        BackfillSettings<2> settings;
        settings.unitWeight = 18000;
        settings.level = 3;
        settings.lateralCoefficient = 1 / 3.0;
        settings.box = {{-5, 0}, {0.5, 3}};
        BackfillSettings<3> ofSpace;
        static_cast<LoadedFaces<3>&>(ofSpace).box = {{-5, -1, 0}, {0.5, 2, 3}};
        ofSpace.unitWeight = 18000;
        ofSpace.level = 3;
        ofSpace.lateralCoefficient = 1 / 3.0;
        // K gamma h2/2 on the vertical projection, and no weight: nothing lies on a face that looks down.
        const Vector<3> load = backfill(plane, settings);
        EXPECT_NEAR(load[0], 18000 / 3.0 * 9 / 2, 1e-6) << lean;
        EXPECT_NEAR(load[1], 0, 1e-4) << lean;
        EXPECT_LT((backfill(space, ofSpace) - load).head<2>().norm(), 1e-6) << lean;
    }
}

TEST(SurfaceLoads, EarthPressureIsLeftOutWhereTheFillWouldHaveToRise)
{
    // Two piers that lean to each other by a little or not at all, and a lintel upon them.
    for (const double lean : {-0.05, -1e-7, 0.0, 1e-7, 0.05})
    {
        const auto piers = [&](double lintel)
        {
            Assembly<2> frame{
                {{{{0, 0}, {1, 0}, {1 + lean, 2}, {0, 2}}, 1}, {{{3, 0}, {4, 0}, {4, 2}, {3 - lean, 2}}, 1}},
                {}};
            if (lintel > 0)
            {
                frame.blocks.push_back({{{0, 2}, {4, 2}, {4, 2 + lintel}, {0, 2 + lintel}}, 1});
            }
            return frame;
        };
        BackfillSettings<2> settings;
        settings.unitWeight = 20000;
        settings.level = 2;
        settings.lateralCoefficient = 0.5;
        const auto sideways = [&](const Assembly<2>& assembly, int block) {
            return backfillLoad(assembly, exposedSurface<2>(assembly, {}, settings), settings)
                .rows[3 * block];
        };
        // Without a lintel the fill between them presses back.
        EXPECT_NEAR(sideways(piers(0), 0), 0, 1e-6) << lean;
        EXPECT_NEAR(sideways(piers(0), 1), 0, 1e-6) << lean;
        EXPECT_NEAR(sideways(piers(0.5), 0), 0.5 * 20000 * 2, 1e-6) << lean;
        EXPECT_NEAR(sideways(piers(0.5), 1), -0.5 * 20000 * 2, 1e-6) << lean;
        // Nor does a fill get in there whose surface is below the lintel.
        settings.level = 1.5;
        EXPECT_NEAR(sideways(piers(0.5), 0), 0.5 * 20000 * 1.5 * 1.5 / 2, 1e-6) << lean;
        EXPECT_NEAR(sideways(piers(0.5), 1), -0.5 * 20000 * 1.5 * 1.5 / 2, 1e-6) << lean;
    }
}

TEST(FillFromAbove, AFaceIsShelteredBelowABlockThatIsApartFromIt)
{
    // A ledge of 1 m beside a stem, on which a slab reaches over half of it; in space all of it 1 m deep.
    const Assembly<2> plane{{{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 1},
                             {{{0, 1}, {1, 1}, {1, 2}, {0, 2}}, 1},
                             {{{0, 2}, {1.5, 2}, {1.5, 2.5}, {0, 2.5}}, 1}},
                            {}};
    const SurfacePiece<2> ledge{0, {0, 1}, {Vector<2>(2, 1), Vector<2>(0, 1)}, 1};
    const SurfacePiece<2> top{2, {0, 1}, {Vector<2>(1.5, 2.5), Vector<2>(0, 2.5)}, 1};
    EXPECT_TRUE(FillFromAbove<2>(plane, std::nullopt).isSheltered({ledge}));
    EXPECT_TRUE(FillFromAbove<2>(plane, 3).isSheltered({ledge}));
    EXPECT_FALSE(FillFromAbove<2>(plane, 2).isSheltered({ledge}));  // the slab stands on the fill
    EXPECT_TRUE(FillFromAbove<2>(plane, 1.5).isSheltered({ledge})); // it is above the fill
    EXPECT_FALSE(FillFromAbove<2>(plane, 3).isSheltered({top}));
    const auto box = [](const Vector<3>& from, const Vector<3>& to) -> Block<3>
    {
        return {makePrism({{from[0], to[1], from[2]},
                           {to[0], to[1], from[2]},
                           {to[0], to[1], to[2]},
                           {from[0], to[1], to[2]}},
                          {{from[0], from[1], from[2]},
                           {to[0], from[1], from[2]},
                           {to[0], from[1], to[2]},
                           {from[0], from[1], to[2]}}),
                -1};
    };
    const Assembly<3> space{
        {box({0, 0, 0}, {2, 1, 1}), box({0, 0, 1}, {1, 1, 2}), box({0, 0, 2}, {1.5, 1, 2.5})}, {}};
    const SurfacePiece<3> half{0, {0, 0, 1}, {Vector<3>(0, 0, 1), Vector<3>(2, 0, 1), Vector<3>(2, 1, 1)}, 1};
    EXPECT_TRUE(FillFromAbove<3>(space, 3).isSheltered({half}));
    EXPECT_FALSE(FillFromAbove<3>(space, 2).isSheltered({half}));
    EXPECT_TRUE(FillFromAbove<3>(space, 1.5).isSheltered({half}));
}

// One of two faces that are mirror images was pressed and the other was not: places on their borders, where
// other walls stand, decided.
TEST(FillFromAbove, ReachesAlikeWhatIsAlikeInAMirror)
{
    for (const double roof : {0.6, 0.8, 1.3533760517635307, 1.5})
    {
        // Four walls round a room of 1.4 x 1.4 m, whose roof covers a part of it, from x = 0.
        const Assembly<3> room{{{makeBox({0, 0, 0}, {0.3, 2, 1}), -1},
                                {makeBox({1.7, 0, 0}, {2, 2, 1}), -1},
                                {makeBox({0.3, 0, 0}, {1.7, 0.3, 1}), -1},
                                {makeBox({0.3, 1.7, 0}, {1.7, 2, 1}), -1},
                                {makeBox({0, 0, 1}, {roof, 2, 1.2}), -1}},
                               {}};
        const auto isReached = [&](int block, const Vector<3>& normal)
        {
            std::vector<SurfacePiece<3>> face;
            for (const SurfacePiece<3>& piece : surfaceOf(room, block))
            {
                if (piece.normal.dot(normal) > 0.5)
                {
                    face.push_back(piece);
                }
            }
            return FillFromAbove<3>(room, 0.63).reaches(face);
        };
        EXPECT_TRUE(isReached(2, {0, 1, 0})) << roof;
        EXPECT_TRUE(isReached(3, {0, -1, 0})) << roof;
    }
}

// Upwards from the middle of the span a ray runs within the joint at the crown, and met neither stone: in
// space the fill came to soffits, to those of one side more than to those of the other.
TEST(FillFromAbove, ComesThroughNoJointToASoffit)
{
    for (const int voussoirs : {8, 10, 12, 16, 20, 28})
    {
        const std::string arch = fmt::format(
            "type arch; profile circular; radius 1; thickness 0.2; voussoirs {}; angle 180;", voussoirs);
        const auto structure = [](const std::string& texture)
        { return Dictionary::readString(texture + " supports { ground { type ground; } }"); };
        const auto plane = madeStructure<2>(structure("dimensions 2; texture { " + arch + " depth 1; }"));
        const auto space = madeStructure<3>(
            structure("dimensions 3; texture { type extrusion; of { " + arch + " depth 1; } thickness 1; }"));
        BackfillSettings<2> settings;
        settings.unitWeight = 18000;
        settings.level = 1.3;
        settings.lateralCoefficient = 0.5;
        BackfillSettings<3> ofSpace;
        ofSpace.unitWeight = settings.unitWeight;
        ofSpace.level = settings.level;
        ofSpace.lateralCoefficient = settings.lateralCoefficient;
        const Eigen::VectorXd expected =
            backfillLoad(plane, exposedSurface<2>(plane, {}, settings), settings).rows;
        const Eigen::VectorXd rows = backfillLoad(space, exposedSurface<3>(space, {}, ofSpace), ofSpace).rows;
        ASSERT_EQ(rows.size(), 2 * expected.size());
        for (Eigen::Index block = 0; 3 * block < expected.size(); ++block)
        {
            EXPECT_LT((asOfPlane(rows.segment<6>(6 * block)) - expected.segment<3>(3 * block)).norm(), 1e-6)
                << block << " of " << voussoirs;
        }
    }
}

TEST(SurfaceLoads, WhatIsTakenAwayIsPressedAsItsFaceIs)
{
    // A pier under a lintel: the fill does not reach its right side, of which a neighbour covers a part; the
    // joint is turned by 1e-3 against the side.
    const Assembly<2> frame{{{{{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 1},
                             {{{3, 0}, {4, 0}, {4, 2}, {3, 2}}, 1},
                             {{{0, 2}, {4, 2}, {4, 2.5}, {0, 2.5}}, 1}},
                            {}};
    const SurfacePiece<2> covered{0, {1, 0}, {Vector<2>(1.0005, 0.5), Vector<2>(0.9995, 1)}, -1};
    BackfillSettings<2> settings;
    settings.unitWeight = 20000;
    settings.level = 2;
    settings.lateralCoefficient = 0.5;
    const Eigen::VectorXd load =
        backfillLoad(frame, exposedSurface<2>(frame, {covered}, settings), settings).rows;
    EXPECT_NEAR(load[0], 0.5 * 20000 * 2, 1e-6);
}

/// The load that constant/loads describes, on a wall without other blocks.
template<int Dim>
Eigen::VectorXd loadOf(const std::string& text, const Assembly<Dim>& assembly,
                       const std::vector<SurfacePiece<Dim>>& covered = {})
{
    const Dictionary dictionary = Dictionary::readString(text);
    const std::vector<double> masses(assembly.blocks.size(), 1.0);
    LoadContext<Dim> context{assembly, masses, Vector<Dim>::Unit(Dim - 1) * -9.81,
                             [&covered] { return covered; }};
    return Registry<LoadMaker<Dim>>{"load", surfaceLoadTypes<Dim>()}.select(dictionary)(context).rows;
}

TEST(SurfaceLoads, OfFillsOnBothSidesCancelAndAreNoFault)
{
    const Assembly<2> plane{{{{{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 1}}, {}};
    const Assembly<3> space{{{makePrism({{0, 1, 0}, {1, 1, 0}, {1, 1, 2}, {0, 1, 2}},
                                        {{0, 0, 0}, {1, 0, 0}, {1, 0, 2}, {0, 0, 2}}),
                              -1}},
                            {}};
    const std::string fill = "type backfill; unitWeight 18000; level 1.5; lateralCoefficient 0.4;";
    // To the last bit: a live load of rounding alone would have a multiplier.
    EXPECT_EQ(loadOf(fill, plane), Eigen::VectorXd::Zero(3));
    EXPECT_EQ(loadOf(fill, space), Eigen::VectorXd::Zero(6));
    // Also where a side leans by less than its pressure is rounded to.
    const Assembly<3> leaning{{{makePrism({{0, 1, 0}, {1.2, 1, 0}, {1.2, 1, 3}, {-1e-7, 1, 3}},
                                          {{0, 0, 0}, {1.2, 0, 0}, {1.2, 0, 3}, {-1e-7, 0, 3}}),
                                -1}},
                              {}};
    const Eigen::VectorXd ends =
        loadOf("type backfill; unitWeight 18000; level 3; lateralCoefficient 0.333; box ((0 -9 0) (2 9 3));",
               leaning);
    EXPECT_EQ(ends[1], 0);
    EXPECT_LT(loadOf("type pressure; value 1e-9; normal (1 0); within 180;", plane).cwiseAbs().maxCoeff(),
              1e-15);
}

TEST(SurfaceLoads, APressureOfZeroIsWarnedOf)
{
    const Assembly<2> wall{{{{{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 1}}, {}};
    testing::internal::CaptureStderr();
    EXPECT_EQ(loadOf("type pressure; value 0; normal (1 0);", wall), Eigen::VectorXd::Zero(3));
    EXPECT_NE(testing::internal::GetCapturedStderr().find("A pressure of 0 is no load."), std::string::npos);
    EXPECT_THROW(loadOf("type pressure; value 0; normal (1 0); box ((50 0) (60 1));", wall), FatalIOError);
}

TEST(SurfaceLoads, AFillWithoutHeightOrFarAboveAllBlocksIsWarnedOf)
{
    // Three courses of 0.1 m: the top is at 0.30000000000000004 m.
    const Assembly<2> wall{{{{{0, 0}, {1, 0}, {1, 3 * 0.1}, {0, 3 * 0.1}}, 1}}, {}};
    const auto warningOf = [&](const std::string& fill)
    {
        testing::internal::CaptureStderr();
        loadOf("type backfill; unitWeight 18000; " + fill, wall);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_NE(
        warningOf("level 0.3;").find("A fill up to 0.3 m is no load: the faces that it lies on are as high."),
        std::string::npos);
    EXPECT_NE(warningOf("level 1500;")
                  .find("The fill is 1500 m high above the highest block, and all blocks "
                        "together are 0.3 m high: `level` is a height in metres."),
              std::string::npos);
    for (const std::string fill :
         {"level 0.3; surcharge 10;", "level 0.3; lateralCoefficient 0.5;", "level 20;"})
    {
        EXPECT_EQ(warningOf(fill), "") << fill;
    }
}

TEST(SurfaceLoads, OnNoFaceAreRefused)
{
    const Assembly<2> wall{{{{{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 1}}, {}};
    // Walls all along both sides, and a fill without earth pressure.
    const std::vector<SurfacePiece<2>> covered{{0, {-1, 0}, {Vector<2>(0, 0), Vector<2>(0, 2)}, -1},
                                               {0, {1, 0}, {Vector<2>(1, 0), Vector<2>(1, 2)}, -1}};
    EXPECT_THROW(loadOf("type backfill; unitWeight 18000; level 1.5; lateralCoefficient 0.4;", wall, covered),
                 FatalIOError);
    EXPECT_THROW(loadOf("type backfill; unitWeight 18000; level 1.5;", wall), FatalIOError);
    EXPECT_THROW(loadOf("type pressure; value 600; normal (1 0); box ((50 0) (60 1));", wall), FatalIOError);
}

} // namespace
