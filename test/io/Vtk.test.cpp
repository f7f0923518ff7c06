// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// .vtp files and their series, read back with VTK's own reader.
#include "Scene.h"
#include "assembly/BlockShape.h"
#include "contact/Facing.h"
#include "core/Error.h"
#include "core/WholeFile.h"
#include "io/FrameReader.h"
#include "io/Frames.h"
#include "io/Mechanism.h"
#include "io/VtkLibrary.h"
#include "io/VtkSeries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

namespace drystone
{

namespace
{

using test::contact;
using test::content;
using test::ScratchFolder;
using testing::ElementsAre;
using testing::HasSubstr;

vtkSmartPointer<vtkPolyData> readBack(const std::filesystem::path& file)
{
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
}

TEST(Vtp, BlocksAreReadBackByVtkWithTheirFields)
{
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(5, 6);
    std::vector<Placement<2>> placements(wall.blocks.size());
    placements[20] = {{0.01, -0.02}, 0.125};
    Field speed{"speed", 1, std::vector<double>(wall.blocks.size(), 1.0 / 3), FieldType::real};
    writeVtp(folder / "blocks.vtp", blockFrame(wall, placements, {speed}));

    const auto data = readBack(folder / "blocks.vtp");
    ASSERT_EQ(data->GetNumberOfPolys(), static_cast<vtkIdType>(wall.blocks.size()));
    vtkCellData* fields = data->GetCellData();
    EXPECT_EQ(fields->GetArray("blockId")->GetTuple1(20), 20);
    EXPECT_EQ(fields->GetArray("support")->GetTuple1(0), 0);
    EXPECT_EQ(fields->GetArray("support")->GetTuple1(20), -1);
    EXPECT_EQ(fields->GetArray("displacement[m]")->GetNumberOfComponents(), 3);
    EXPECT_EQ(fields->GetArray("displacement[m]")->GetTuple3(20)[0], 0.01); // bit for bit: fields are double
    EXPECT_EQ(fields->GetArray("displacement[m]")->GetTuple3(20)[1], -0.02);
    EXPECT_EQ(fields->GetArray("displacement[m]")->GetTuple3(20)[2], 0);
    EXPECT_EQ(fields->GetArray("rotation[rad]")->GetTuple1(20), 0.125);
    EXPECT_EQ(fields->GetArray("speed")->GetTuple1(7), 1.0 / 3);
    vtkDataArray* moved = data->GetPointData()->GetArray("pointDisplacement[m]");
    ASSERT_NE(moved, nullptr);
    EXPECT_EQ(moved->GetNumberOfTuples(), data->GetNumberOfPoints());
    EXPECT_EQ(moved->GetTuple3(0)[0], 0);

    vtkNew<vtkIdList> corners;
    data->GetCellPoints(20, corners);
    const Polygon outline = placedOutline(wall.blocks[20], placements[20]);
    ASSERT_EQ(corners->GetNumberOfIds(), 4);
    for (int k = 0; k < 4; ++k)
    {
        const double* point = data->GetPoint(corners->GetId(k));
        EXPECT_NEAR(point[0], outline[static_cast<std::size_t>(k)].x(), 1e-6); // single precision of 2 m
        EXPECT_NEAR(point[1], outline[static_cast<std::size_t>(k)].y(), 1e-6);
        EXPECT_EQ(point[2], 0);
    }
}

TEST(Vtp, ABlockTurnsAboutItsCentroidAsARigidBody)
{
    const Block<2> block{{{10, 5}, {12, 5}, {12, 6}, {10, 6}}, 1, -1};
    const Polygon turned = placedOutline(block, {{1, 2}, std::acos(-1.0) / 2});
    // Centroid (11, 5.5) moves to (12, 7.5); the corner at (-1, -0.5) from it turns to (0.5, -1).
    EXPECT_NEAR((turned[0] - Vector<2>(12.5, 6.5)).norm(), 0, 1e-14);
    EXPECT_NEAR((turned[2] - Vector<2>(11.5, 8.5)).norm(), 0, 1e-14);
}

/// Area painted by a viewer for cell i: a fan of triangles, none of which may be turned over.
double paintedArea(const PolyData<2>& data, std::size_t cell)
{
    std::size_t first = 0;
    for (std::size_t i = 0; i < cell; ++i)
    {
        first += static_cast<std::size_t>(data.cellSizes[i]);
    }
    double area = 0;
    for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(data.cellSizes[cell]); ++k)
    {
        const double part = 0.5
                            * cross(data.points[first + k] - data.points[first],
                                    data.points[first + k + 1] - data.points[first]);
        EXPECT_GE(part, 0) << "cell " << cell;
        area += part;
    }
    return area;
}

TEST(Vtp, ConcaveBlocksArePaintedAsTheyAre)
{
    Assembly<2> assembly;
    assembly.blocks = {
        {{{0, 1}, {0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 1, -1},                     // L
        {{{3, 0}, {4, 2}, {3, 0.5}, {2, 2}}, 1, -1},                                           // arrowhead
        {{{5, 0}, {7, 0}, {7, 2}, {6.5, 2}, {6.5, 0.5}, {5.5, 0.5}, {5.5, 2}, {5, 2}}, 1, -1}, // U
        {{{8, 0}, {9, 0.8}, {10, 0}, {9.3, 1}, {10, 2}, {9, 1.2}, {8, 2}, {8.7, 1}}, 1, -1},   // star
        {{{0, 5}, {1, 5}, {2, 5}, {2, 6}, {1, 6}, {0, 6}}, 1, -1},                             // flat corners
    };
    Field area{"area", 1, {}, FieldType::real};
    for (const Block<2>& block : assembly.blocks)
    {
        area.values.push_back(areaProperties(block.outline).area);
    }
    std::vector<Placement<2>> placements(assembly.blocks.size());
    placements[2].rotation = 1;
    const PolyData<2> data = blockFrame(assembly, placements, {area});

    std::vector<double> painted(assembly.blocks.size());
    std::vector<int> cells(assembly.blocks.size());
    const std::vector<double>& blockId = data.fields[0].values;
    ASSERT_EQ(blockId.size(), cellCount(data));
    for (std::size_t cell = 0; cell < cellCount(data); ++cell)
    {
        const auto block = static_cast<std::size_t>(blockId[cell]);
        painted[block] += paintedArea(data, cell);
        ++cells[block];
        EXPECT_EQ(data.fields.back().values[cell], area.values[block]);
    }
    for (std::size_t i = 0; i < painted.size(); ++i)
    {
        EXPECT_NEAR(painted[i], area.values[i], 1e-14) << "block " << i;
    }
    EXPECT_THAT(cells, ElementsAre(1, 1, 6, 1, 1)); // triangles only where they are needed
    EXPECT_NO_THROW(vtpBytes(data));
}

/// Every point less its displacement is a corner of the block as built.
template<int Dim>
void expectPointsComeFromBuiltCorners(const Assembly<Dim>& assembly, const PolyData<Dim>& data)
{
    ASSERT_EQ(data.pointFields.size(), 1);
    EXPECT_EQ(data.pointFields[0].name, "pointDisplacement[m]");
    ASSERT_EQ(data.pointFields[0].values.size(), Dim * data.points.size());
    std::size_t point = 0;
    for (std::size_t cell = 0; cell < cellCount(data); ++cell)
    {
        const auto block = static_cast<std::size_t>(data.fields[0].values[cell]);
        const std::vector<Vector<Dim>> built = cornersOf(assembly.blocks[block]);
        for (int k = 0; k < data.cellSizes[cell]; ++k, ++point)
        {
            const Vector<Dim> from =
                data.points[point] - Eigen::Map<const Vector<Dim>>(&data.pointFields[0].values[Dim * point]);
            double nearest = 1;
            for (const Vector<Dim>& corner : built)
            {
                nearest = std::min(nearest, (corner - from).norm());
            }
            EXPECT_LT(nearest, 1e-14) << "cell " << cell << ", corner " << k;
        }
    }
}

TEST(Vtp, PointsCarryTheirDisplacementFromWhereTheyWereBuilt)
{
    Assembly<2> plane;
    plane.blocks = {{{{0, 1}, {0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 1, -1},
                    // a U, which is painted as triangles
                    {{{5, 0}, {7, 0}, {7, 2}, {6.5, 2}, {6.5, 0.5}, {5.5, 0.5}, {5.5, 2}, {5, 2}}, 1, -1}};
    expectPointsComeFromBuiltCorners(plane, blockFrame(plane, {{{0.5, 0.25}, 1}, {{-1, 2}, 0.3}}));

    Assembly<3> space;
    Block<3> prism; // of the same U
    std::vector<Vector<3>> below;
    std::vector<Vector<3>> above;
    for (const Vector<2>& corner : plane.blocks[1].outline)
    {
        below.emplace_back(corner.x(), corner.y(), 0);
        above.emplace_back(corner.x(), corner.y(), 1);
    }
    prism.shape = makePrism(below, above);
    space.blocks = {prism};
    const PolyData<3> data = blockFrame(space, {{{0.5, 0.25, -1}, {0.3, 1, -0.5}}});
    EXPECT_GT(cellCount(data), prism.shape.faces.size()); // both faces of the U are triangles
    expectPointsComeFromBuiltCorners(space, data);
    EXPECT_NO_THROW(vtpBytes(data));

    PolyData<3> wrong = data;
    wrong.pointFields[0].values.pop_back();
    EXPECT_THAT(reportOf([&] { vtpBytes(wrong); }), HasSubstr("pointDisplacement[m]"));
}

TEST(Vtp, GroundIsShownAsFarAsTheStructureReaches)
{
    Assembly<2> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks = {{test::rectangle(0, 0, 2, 4), 1, -1},
                       {test::rectangle(-50, -1, 0.5, 0), 1, 0},
                       {test::rectangle(0.5, -1, 50, 0), 1, 0},
                       {test::rectangle(50, -1, 51, 0), 1, 0}};
    const auto xRange = [&](double displacement)
    {
        std::vector<Placement<2>> placements(assembly.blocks.size());
        placements[0].translation.x() = displacement;
        const PolyData<2> data = blockFrame(assembly, placements);
        EXPECT_EQ(data.cellSizes.size(),
                  assembly.blocks.size()); // also those out of view: one cell per block
        std::pair range{0.0, 0.0};
        for (const Vector<2>& point : data.points)
        {
            range = {std::min(range.first, point.x()), std::max(range.second, point.x())};
        }
        return range;
    };
    EXPECT_EQ(xRange(0), std::pair(-1.0, 3.0));
    EXPECT_EQ(xRange(10), std::pair(-3.0, 15.0)); // follows what falls
}

TEST(Vtp, ContactsCarryForcesGapsAndStates)
{
    const ScratchFolder folder;
    std::vector<ContactPoint<2>> points(3);
    points[0] = contact(0, 1, 0, {0.5, 0.25}, {0, 1});
    points[1] = contact(0, 1, 0, {1, 0.25}, {0, 1});
    points[1].gap = 1e-9;
    points[2] = contact(1, 2, 1, {0.5, 0.5}, {1, 0});
    const std::vector<Vector<2>> forces{{10, 6.5}, {0, 0}, {4, -1}};
    const std::vector<ContactState> states{ContactState::sliding, ContactState::open, ContactState::sticking};
    writeVtp(folder / "contacts.vtp", contactFrame(points, forces, states));
    const auto data = readBack(folder / "contacts.vtp");
    ASSERT_EQ(data->GetNumberOfVerts(), 3);
    vtkPointData* fields = data->GetPointData();
    // Normal (0 1): the tangent is (1 0); normal (1 0): the tangent is (0 -1).
    EXPECT_EQ(fields->GetArray("contactForce[N]")->GetTuple3(0)[0], 6.5);
    EXPECT_EQ(fields->GetArray("contactForce[N]")->GetTuple3(0)[1], 10);
    EXPECT_EQ(fields->GetArray("contactForce[N]")->GetTuple3(2)[0], 4);
    EXPECT_EQ(fields->GetArray("contactForce[N]")->GetTuple3(2)[1], 1);
    EXPECT_EQ(fields->GetArray("normalForce[N]")->GetTuple1(2), 4);
    EXPECT_EQ(fields->GetArray("tangentialForce[N]")->GetTuple1(2), -1);
    EXPECT_EQ(fields->GetArray("gap[m]")->GetTuple1(1), 1e-9);
    EXPECT_EQ(fields->GetArray("state")->GetTuple1(0), 2);
    EXPECT_EQ(fields->GetArray("state")->GetTuple1(1), 0);
    EXPECT_EQ(fields->GetArray("neighbour")->GetTuple1(2), 2);
}

TEST(Vtp, AnEmptyAssemblyGivesAFileThatVtkReads)
{
    const ScratchFolder folder;
    writeAssembly(folder / "VTK/assembly.vtp", Assembly<2>{});
    EXPECT_EQ(readBack(folder / "VTK/assembly.vtp")->GetNumberOfCells(), 0);
    writeVtp(folder / "contacts.vtp", contactFrame<2>({}, {}, {}));
    EXPECT_EQ(readBack(folder / "contacts.vtp")->GetNumberOfCells(), 0);
}

TEST(Vtp, TheFileHasItsArraysInItsElementsByZlib)
{
    const std::string bytes = vtpBytes(blockFrame(test::wall(5, 6)));
    EXPECT_THAT(bytes, HasSubstr("compressor=\"vtkZLibDataCompressor\""));
    // What VTK 9.1 and ParaView 5.11 cannot read with the expat of an up-to-date Debian 12.
    EXPECT_THAT(bytes, testing::Not(HasSubstr("AppendedData")));
    EXPECT_THAT(vtpBytesOfVtk(blockFrame(test::wall(5, 6))), testing::Not(HasSubstr("AppendedData")));
}

TEST(Vtp, ManyBlocksSurviveTheCompressorsBlocks)
{
    // 20,000 blocks: arrays of several compression blocks of 32 kB, with an odd rest.
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(100, 200);
    std::vector<Placement<2>> placements(wall.blocks.size());
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        placements[i].translation.x() = std::sin(static_cast<double>(i));
    }
    writeVtp(folder / "blocks.vtp", blockFrame(wall, placements));
    const auto data = readBack(folder / "blocks.vtp");
    vtkDataArray* displacement = data->GetCellData()->GetArray("displacement[m]");
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        ASSERT_EQ(displacement->GetTuple3(static_cast<vtkIdType>(i))[0], placements[i].translation.x());
    }
}

TEST(Vtp, ValuesThatAreNotFiniteAreRefusedByName)
{
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(2, 2);
    std::vector<Placement<2>> placements(wall.blocks.size());
    placements[3].rotation = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(reportOf([&] { writeVtp(folder / "a.vtp", blockFrame(wall, placements)); }),
                HasSubstr("not a finite number"));

    Field field{"speed", 1, std::vector<double>(wall.blocks.size(), 0.0), FieldType::real};
    field.values[4] = std::numeric_limits<double>::infinity();
    EXPECT_THAT(reportOf([&] { writeVtp(folder / "a.vtp", blockFrame(wall, {}, {field})); }),
                HasSubstr("speed of cell 4"));
    field.values.pop_back();
    EXPECT_THAT(reportOf([&] { writeVtp(folder / "a.vtp", blockFrame(wall, {}, {field})); }),
                HasSubstr("speed"));
    field.values = std::vector<double>(wall.blocks.size(), 0.5);
    field.type = FieldType::integer;
    EXPECT_THAT(reportOf([&] { writeVtp(folder / "a.vtp", blockFrame(wall, {}, {field})); }),
                HasSubstr("not a whole number"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Vtp, AFolderThatCannotBeWrittenIsNamedWithTheReason)
{
    const ScratchFolder folder;
    std::ofstream(folder / "file") << "in the way";
    const std::string message =
        reportOf([&] { writeAssembly(folder / "file/VTK/assembly.vtp", test::wall(2, 2)); });
    EXPECT_THAT(message, HasSubstr("file/VTK/assembly.vtp"));
    EXPECT_THAT(message, HasSubstr("Not a directory"));

    std::filesystem::create_directories(folder / "taken.vtp/inside");
    EXPECT_THAT(reportOf([&] { writeAssembly(folder / "taken.vtp", test::wall(2, 2)); }),
                HasSubstr("Is a directory"));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    {
        EXPECT_NE(entry.path().extension(), ".tmp");
    }
}

TEST(WholeFile, AsksBeforehandWhetherAFolderCanBeWritten)
{
    const ScratchFolder folder;
    EXPECT_NO_THROW(requireWritable(folder.path()));
    EXPECT_NO_THROW(requireWritable(folder / "not/yet/there"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    std::ofstream(folder / "file") << "in the way";
    EXPECT_THAT(reportOf([&] { requireWritable(folder / "file/VTK"); }), HasSubstr("Not a directory"));
    EXPECT_THAT(reportOf([&] { requireWritable("/proc/self/VTK"); }),
                HasSubstr("Cannot write into /proc/self/VTK"));
}

TEST(VtkSeries, ListsItsFramesAsParaViewExpects)
{
    const ScratchFolder folder;
    VtkSeries series(folder / "VTK", "blocks", 0);
    const Assembly<2> wall = test::wall(2, 2);
    const std::string expected[] = {
        "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n"
        "    { \"name\" : \"blocks_000000.vtp\", \"time\" : 0 }\n  ]\n}\n",
        "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n"
        "    { \"name\" : \"blocks_000000.vtp\", \"time\" : 0 },\n"
        "    { \"name\" : \"blocks_000001.vtp\", \"time\" : 0.1 }\n  ]\n}\n",
        "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n"
        "    { \"name\" : \"blocks_000000.vtp\", \"time\" : 0 },\n"
        "    { \"name\" : \"blocks_000001.vtp\", \"time\" : 0.1 },\n"
        "    { \"name\" : \"blocks_000002.vtp\", \"time\" : 0.2 }\n  ]\n}\n",
    };
    for (int frame = 0; frame < 3; ++frame)
    {
        series.write(0.1 * frame, blockFrame(wall));
        EXPECT_EQ(content(folder / "VTK/blocks.vtp.series"), expected[frame]);
    }
    EXPECT_EQ(readBack(folder / "VTK/blocks_000002.vtp")->GetNumberOfPolys(),
              static_cast<vtkIdType>(wall.blocks.size()));
}

TEST(VtkSeries, ARestartReplacesFramesFromItsTimeOn)
{
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(2, 2);
    {
        VtkSeries series(folder.path(), "blocks", 0);
        for (int frame = 0; frame <= 5; ++frame)
        {
            series.write(frame, blockFrame(wall));
        }
    }
    VtkSeries series(folder.path(), "blocks",
                     3); // as after a run that was killed after writing its state at 3
    EXPECT_THAT(series.times(), ElementsAre(0, 1, 2, 3));
    EXPECT_TRUE(series.hasFrameAt(3));
    EXPECT_FALSE(series.hasFrameAt(4));
    EXPECT_TRUE(std::filesystem::exists(folder / "blocks_000004.vtp")) << "a dry run removes nothing";
    series.begin();
    EXPECT_FALSE(std::filesystem::exists(folder / "blocks_000004.vtp"));
    EXPECT_THAT(content(series.listFile()), testing::Not(HasSubstr("blocks_000004")));
    series.write(3, blockFrame(wall));
    series.write(3.5, blockFrame(wall));
    series.write(4, blockFrame(wall));
    EXPECT_THAT(series.times(), ElementsAre(0, 1, 2, 3, 3.5, 4));

    const std::string list = content(series.listFile());
    EXPECT_THAT(list, HasSubstr("\"blocks_000005.vtp\", \"time\" : 4 }\n  ]"));
    EXPECT_THAT(VtkSeries(folder.path(), "blocks", 10).times(), ElementsAre(0, 1, 2, 3, 3.5, 4));
}

// The animation of a motion that was continued after a limit analysis began with the mechanism.
TEST(VtkSeries, FramesOfAnotherApplicationAreReplacedAll)
{
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(2, 2);
    {
        VtkSeries mechanism(folder.path(), "blocks", 0, "limitAnalysis");
        for (const double part : {0.0, 0.5, 1.0})
        {
            mechanism.write(part, blockFrame(wall));
        }
    }
    EXPECT_EQ(readSeries(folder.path(), "blocks").application, "limitAnalysis");
    VtkSeries motion(folder.path(), "blocks", 0.75, "contactDynamics");
    EXPECT_FALSE(motion.hasFrameAt(0.5));
    motion.write(0.75, blockFrame(wall));
    EXPECT_THAT(motion.times(), ElementsAre(0.75));
    EXPECT_EQ(readSeries(folder.path(), "blocks").application, "contactDynamics");
    EXPECT_FALSE(std::filesystem::exists(folder / "blocks_000001.vtp"));
    EXPECT_THAT(VtkSeries(folder.path(), "blocks", 1, "contactDynamics").times(), ElementsAre(0.75));
}

TEST(VtkSeries, AListThatIsAFolderIsNamed)
{
    const ScratchFolder folder;
    std::filesystem::create_directories(folder / "blocks.vtp.series");
    EXPECT_THAT(reportOf([&] { readSeries(folder.path(), "blocks"); }),
                testing::AllOf(HasSubstr("This is no file"), HasSubstr("blocks.vtp.series")));
}

TEST(VtkSeries, ANewRunFromZeroLeavesNoFrameOfTheOldOne)
{
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(2, 2);
    {
        VtkSeries series(folder.path(), "blocks", 0);
        for (int frame = 0; frame < 4; ++frame)
        {
            series.write(frame, blockFrame(wall));
        }
    }
    VtkSeries series(folder.path(), "blocks", 0);
    series.write(0, blockFrame(wall));
    EXPECT_THAT(series.times(), ElementsAre(0));
    EXPECT_FALSE(std::filesystem::exists(folder / "blocks_000001.vtp"));
    EXPECT_FALSE(std::filesystem::exists(folder / "blocks_000003.vtp"));
}

TEST(VtkSeries, FramesThatWereRemovedByHandAreNotListedAgain)
{
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(2, 2);
    {
        VtkSeries series(folder.path(), "blocks", 0);
        for (int frame = 0; frame < 4; ++frame)
        {
            series.write(frame, blockFrame(wall));
        }
    }
    std::filesystem::remove(folder / "blocks_000001.vtp");
    VtkSeries series(folder.path(), "blocks", 3);
    EXPECT_THAT(series.times(), ElementsAre(0, 2, 3));
    series.write(4, blockFrame(wall));
    EXPECT_THAT(content(series.listFile()), HasSubstr("\"blocks_000004.vtp\", \"time\" : 4 "));
    EXPECT_THAT(content(series.listFile()), testing::Not(HasSubstr("blocks_000001")));
}

TEST(VtkSeries, AFrameThatNoFileCanHaveTheNameOfIsNotListed)
{
    const ScratchFolder folder;
    std::ofstream(folder.path() / "blocks.vtp.series")
        << "{\"files\": [{\"name\": \"" << std::string(300, 'x') << "\", \"time\": 0}]}\n";
    EXPECT_THAT(VtkSeries(folder.path(), "blocks", 1).times(), testing::IsEmpty());
}

TEST(VtkSeries, AListLaidOutByAnotherProgramIsRead)
{
    const ScratchFolder folder;
    std::ofstream(folder / "x.vtp") << "a frame";
    std::ofstream(folder / "blocks.vtp.series") << "{\"files\": [\n{\"time\": 0.5, \"name\": \"x.vtp\"}]}\n";
    EXPECT_THAT(VtkSeries(folder.path(), "blocks", 1).times(), ElementsAre(0.5));
}

TEST(VtkSeries, WhatIsNoListOfFramesIsRefused)
{
    const ScratchFolder folder;
    const auto read = [&](const std::string& text)
    {
        std::ofstream(folder / "blocks.vtp.series") << text;
        return reportOf([&] { VtkSeries(folder.path(), "blocks", 0); });
    };
    EXPECT_THAT(read("{\"files\": [\n{\"name\": \"x.vtp\", \"time\" 0}]}\n"),
                HasSubstr("blocks.vtp.series at line 2"));
    EXPECT_THAT(read("[1]"), HasSubstr("no array"));
    EXPECT_THAT(read("{\"files\": [{\"name\": \"x.vtp\"}]}"), HasSubstr("entry 0"));
    EXPECT_THAT(read("{\"files\": [{\"name\": \"../x.vtp\", \"time\": 0}]}"), HasSubstr("entry 0"));
    EXPECT_THAT(read("{\"files\": [{\"name\": \"x.vtp\", \"time\": 1e999}]}"), HasSubstr("too large"));
}

/// A frame of one triangle. \param turns components of its rotation
PolyData<3> frameOfTriangle(double block, int turns, std::vector<double> rotation)
{
    PolyData<3> frame;
    frame.cellSizes = {3};
    frame.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    frame.fields = {{"blockId", 1, {block}, FieldType::integer},
                    {"displacement[m]", 3, {1, 2, 3}},
                    {"rotation[rad]", turns, std::move(rotation)}};
    return frame;
}

/// A folder with one frame, which is read as one of one block.
class BlockFrames : public testing::Test
{
protected:
    void SetUp() override
    {
        std::ofstream(folder / "blocks.vtp.series")
            << "{\"files\": [\n{\"time\": 0.5, \"name\": \"x.vtp\"}]}\n";
    }

    BlockFrame read(const std::string& frame) const
    {
        std::ofstream(folder / "x.vtp", std::ios::binary) << frame;
        return readBlockFrames(folder.path(), "blocks", 1, 1).front();
    }

    ScratchFolder folder;
};

TEST_F(BlockFrames, AreReadAsTheyWereWritten)
{
    const BlockFrame plane = read(vtpBytes(frameOfTriangle(0, 1, {4})));
    EXPECT_EQ(plane.time, 0.5);
    EXPECT_EQ(plane.displacement, Vector<3>(1, 2, 3));
    EXPECT_EQ(plane.rotation, Vector<3>(0, 0, 4));
    EXPECT_EQ(read(vtpBytes(frameOfTriangle(0, 3, {4, 5, 6}))).rotation, Vector<3>(4, 5, 6));
}

TEST_F(BlockFrames, OfOtherFieldsAreRefused)
{
    PolyData<3> frame = frameOfTriangle(0, 1, {4});
    frame.fields[1] = {"displacement[m]", 1, {1}};
    EXPECT_THAT(reportOf([&] { read(vtpBytes(frame)); }),
                testing::AllOf(HasSubstr("x.vtp is no frame"), HasSubstr("1 and 1 components, not 1 and 3")));
    frame.fields.pop_back();
    EXPECT_THAT(reportOf([&] { read(vtpBytes(frame)); }), HasSubstr("missing"));
    for (const double block : {1.0, -1.0, 1e9})
    {
        EXPECT_THAT(reportOf([&] { read(vtpBytes(frameOfTriangle(block, 1, {0}))); }),
                    HasSubstr("it shows block"))
            << block;
    }
}

// VTK's own reader ended the process for counts below zero and for elements without contents.
TEST_F(BlockFrames, ThatAreDamagedAreRefusedOrReadButNeverCrash)
{
    const std::string whole = vtpBytes(frameOfTriangle(0, 3, {4, 5, 6}));
    std::mt19937 random(11);
    int refused = 0;
    const auto attempt = [&](const std::string& damaged)
    {
        try
        {
            read(damaged);
        }
        catch (const FatalError&)
        {
            ++refused;
        }
    };
    for (std::size_t size = 0; size < whole.size(); size += 7)
    {
        attempt(whole.substr(0, size));
    }
    for (int i = 0; i < 3000; ++i)
    {
        std::string damaged = whole;
        for (int k = 0; k < 2; ++k)
        {
            damaged[random() % damaged.size()] = static_cast<char>(random());
        }
        attempt(damaged);
    }
    EXPECT_GT(refused, 1000);
}

TEST_F(BlockFrames, OfManyBlocksAreReadFromSeveralPackedPieces)
{
    constexpr int cells = 20000;
    PolyData<3> frame;
    Field block{"blockId", 1, {}, FieldType::integer};
    Field displacement{"displacement[m]", 3, {}};
    Field rotation{"rotation[rad]", 1, {}};
    for (int cell = 0; cell < cells; ++cell)
    {
        frame.cellSizes.push_back(3);
        frame.points.insert(frame.points.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        block.values.push_back(cell);
        displacement.values.insert(displacement.values.end(), {0.1 * cell, -cell / 3.0, 1e-9 * cell});
        rotation.values.push_back(std::sin(cell));
    }
    frame.fields = {block, displacement, rotation};
    std::ofstream(folder / "x.vtp", std::ios::binary) << vtpBytes(frame);
    const BlockFrame back = readBlockFrames(folder.path(), "blocks", cells, 1).front();
    for (int cell = 0; cell < cells; ++cell)
    {
        ASSERT_EQ(back.displacement.col(cell), Vector<3>(0.1 * cell, -cell / 3.0, 1e-9 * cell));
        ASSERT_EQ(back.rotation(2, cell), std::sin(cell));
    }
}

TEST(VtkSeries, ADamagedListIsRefusedOrReadButNeverCrashes)
{
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(2, 2);
    {
        VtkSeries series(folder.path(), "blocks", 0);
        for (int frame = 0; frame < 3; ++frame)
        {
            series.write(frame, blockFrame(wall));
        }
    }
    const std::string list = content(folder / "blocks.vtp.series");
    std::mt19937 random(7);
    int refused = 0;
    for (int i = 0; i < 500; ++i)
    {
        std::string damaged = list;
        for (int k = 0; k < 3; ++k)
        {
            damaged[random() % damaged.size()] = static_cast<char>(random());
        }
        std::ofstream(folder / "blocks.vtp.series") << damaged;
        try
        {
            for (const double time : VtkSeries(folder.path(), "blocks", 1e9).times())
            {
                EXPECT_TRUE(std::isfinite(time));
            }
        }
        catch (const FatalError&)
        {
            ++refused;
        }
    }
    EXPECT_GT(refused, 0);
}

TEST(VtkSeries, ARefusedFrameLeavesTheListAsItWas)
{
    const ScratchFolder folder;
    VtkSeries series(folder.path(), "blocks", 0);
    const Assembly<2> wall = test::wall(2, 2);
    series.write(0, blockFrame(wall));
    const std::string before = content(series.listFile());
    PolyData<2> bad = blockFrame(wall);
    bad.points[0].x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(series.write(1, bad), FatalError);
    EXPECT_THROW(series.write(std::numeric_limits<double>::quiet_NaN(), blockFrame(wall)), FatalError);
    EXPECT_EQ(content(series.listFile()), before);
    EXPECT_FALSE(std::filesystem::exists(folder / "blocks_000001.vtp"));
}

TEST(Mechanism, GrowsFromAsBuiltToHalfAMeanBlock)
{
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(5, 6);
    const Eigen::Matrix3Xd rates = 1e-7 * test::turningRates(wall, 2); // of any size
    VtkSeries series(folder.path(), "blocks", 0);
    writeMechanism(series, wall, rates, {}, 5);
    EXPECT_THAT(series.times(), ElementsAre(0, 0.25, 0.5, 0.75, 1));

    const auto first = readBack(folder / "blocks_000000.vtp");
    const auto last = readBack(folder / "blocks_000004.vtp");
    double largest = 0;
    double rate = 0;
    for (vtkIdType i = 0; i < first->GetNumberOfPoints(); ++i)
    {
        double a[3];
        double b[3];
        first->GetPoint(i, a);
        last->GetPoint(i, b);
        largest = std::max(largest, std::hypot(a[0] - b[0], a[1] - b[1]));
    }
    for (vtkIdType i = 0; i < first->GetNumberOfCells(); ++i)
    {
        EXPECT_EQ(first->GetCellData()->GetArray("displacement[m]")->GetTuple3(i)[0], 0);
        rate =
            std::max(rate, std::abs(first->GetCellData()->GetArray("displacementRate[-]")->GetTuple3(i)[0]));
    }
    const double amplitude = 0.5 * meanBlockSize(wall);
    EXPECT_NEAR(largest, amplitude, 0.02 * amplitude); // finite rotation of 0.09 rad against first order
    EXPECT_GT(rate, 0.1);
    EXPECT_LE(rate, 1);
}

TEST(Mechanism, OfNoMotionLeavesTheBlocksAsBuilt)
{
    const Assembly<2> wall = test::wall(2, 2);
    const Eigen::Matrix3Xd still = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(wall.blocks.size()));
    const ScratchFolder folder;
    VtkSeries series(folder.path(), "blocks", 0);
    writeMechanism(series, wall, still);
    EXPECT_THAT(series.times(), ElementsAre(0));
    for (const Placement<2>& placement : mechanismPlacements(wall, still, 1))
    {
        EXPECT_EQ(placement.translation.norm(), 0);
        EXPECT_EQ(placement.rotation, 0);
    }
}

TEST(Mechanism, RatesOfFreeBlocksGoToTheirBlocks)
{
    Assembly<2> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks = {{test::rectangle(0, 0, 1, 1), 1, -1},
                       {test::rectangle(0, -1, 1, 0), 1, 0},
                       {test::rectangle(0, 1, 1, 2), 1, -1}};
    Eigen::VectorXd freeRates(6);
    freeRates << 1, 2, 3, 4, 5, 6;
    const Eigen::Matrix3Xd rates = ratesOfAllBlocks(assembly, freeRates);
    EXPECT_EQ(rates.col(0), Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(rates.col(1), Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(rates.col(2), Eigen::Vector3d(4, 5, 6));
    EXPECT_THROW(ratesOfAllBlocks(assembly, Eigen::VectorXd::Zero(9)), FatalError);
}

// The limit is loose, for slow and busy machines; the measured time is printed
// (test/benchmark/results/TUNING.md).
TEST(VtkSeries, AFrameOf146BlocksAnd702ContactsTakesNoLongerThanAStepOrTwo)
{
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(7, 19);
    const std::size_t blocks = wall.blocks.size();
    std::vector<ContactPoint<2>> points(702);
    std::vector<Vector<2>> forces(702);
    std::vector<Placement<2>> placements(blocks);
    Field velocity{"velocity", 2, std::vector<double>(2 * blocks), FieldType::real};
    Field angularVelocity{"angularVelocity", 1, std::vector<double>(blocks), FieldType::real};
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        points[i].position =
            Vector<2>(std::sin(0.1 * static_cast<double>(i)), std::cos(7.0 * static_cast<double>(i)));
        points[i].normal = Vector<2>(0, 1);
        forces[i] = Vector<2>(1 + std::sin(static_cast<double>(i)), std::cos(static_cast<double>(i)));
    }
    const auto states = contactStates(forces, std::vector<double>(points.size(), 0.65));

    VtkSeries blockSeries(folder.path(), "blocks", 0);
    VtkSeries contactSeries(folder.path(), "contacts", 0);
    constexpr int frames = 200;
    std::vector<double> milliseconds;
    for (int frame = 0; frame < frames; ++frame)
    {
        for (std::size_t i = 0; i < blocks; ++i)
        {
            placements[i] = {
                {1e-3 * std::sin(static_cast<double>(i) + frame), 1e-4 / (1.0 + static_cast<double>(i))},
                1e-3 * std::cos(static_cast<double>(i) * frame)};
            velocity.values[2 * i] = std::sin(static_cast<double>(i) * frame);
            angularVelocity.values[i] = std::cos(static_cast<double>(i) + frame);
        }
        const auto begin = std::chrono::steady_clock::now();
        blockSeries.write(frame, blockFrame(wall, placements, {velocity, angularVelocity}));
        contactSeries.write(frame, contactFrame(points, forces, states));
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
        milliseconds.push_back(time.count());
    }
    std::sort(milliseconds.begin(), milliseconds.end());
    const double median = milliseconds[frames / 2];
    RecordProperty("millisecondsPerFrame", std::to_string(median));
    std::printf("one frame of %zu blocks and %zu contacts: median %.3f ms, least %.3f ms\n", blocks,
                points.size(), median, milliseconds.front());
    EXPECT_LT(median, 20);
}

} // namespace

} // namespace drystone
