// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Frames are written directly: VTK's own reader makes of each kind of them what it makes of the file that
/// VTK's own writer forms of the same data.
#include "Scene.h"
#include "core/WholeFile.h"
#include "io/Frames.h"
#include "io/VtkLibrary.h"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace drystone
{

namespace
{

vtkSmartPointer<vtkPolyData> readBack(const std::filesystem::path& file)
{
    vtkNew<vtkXMLPolyDataReader> reader;
    EXPECT_EQ(reader->CanReadFile(file.c_str()), 1);
    reader->SetFileName(file.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), 0U);
    return reader->GetOutput();
}

std::string nameOf(vtkAbstractArray* array)
{
    return array == nullptr || array->GetName() == nullptr ? "" : array->GetName();
}

/// Name, type, shape and, bit for bit, values.
void expectSame(vtkDataArray* written, vtkDataArray* byVtk)
{
    ASSERT_NE(written, nullptr);
    ASSERT_NE(byVtk, nullptr);
    EXPECT_EQ(nameOf(written), nameOf(byVtk));
    EXPECT_STREQ(written->GetDataTypeAsString(), byVtk->GetDataTypeAsString());
    EXPECT_EQ(written->GetNumberOfComponents(), byVtk->GetNumberOfComponents());
    ASSERT_EQ(written->GetNumberOfValues(), byVtk->GetNumberOfValues());
    if (written->GetNumberOfValues() > 0)
    {
        const auto bytes =
            static_cast<std::size_t>(written->GetNumberOfValues() * written->GetDataTypeSize());
        EXPECT_EQ(std::memcmp(written->GetVoidPointer(0), byVtk->GetVoidPointer(0), bytes), 0)
            << nameOf(written);
    }
}

void expectSame(vtkDataSetAttributes* written, vtkDataSetAttributes* byVtk)
{
    ASSERT_EQ(written->GetNumberOfArrays(), byVtk->GetNumberOfArrays());
    for (int i = 0; i < written->GetNumberOfArrays(); ++i)
    {
        expectSame(written->GetArray(i), byVtk->GetArray(i));
    }
    EXPECT_EQ(nameOf(written->GetScalars()), nameOf(byVtk->GetScalars()));
    EXPECT_EQ(nameOf(written->GetVectors()), nameOf(byVtk->GetVectors()));
}

void expectSame(vtkCellArray* written, vtkCellArray* byVtk)
{
    ASSERT_EQ(written->GetNumberOfCells(), byVtk->GetNumberOfCells());
    for (vtkIdType i = 0; i < written->GetNumberOfCells(); ++i)
    {
        vtkNew<vtkIdList> points;
        vtkNew<vtkIdList> pointsByVtk;
        written->GetCellAtId(i, points);
        byVtk->GetCellAtId(i, pointsByVtk);
        ASSERT_EQ(points->GetNumberOfIds(), pointsByVtk->GetNumberOfIds());
        for (vtkIdType k = 0; k < points->GetNumberOfIds(); ++k)
        {
            EXPECT_EQ(points->GetId(k), pointsByVtk->GetId(k));
        }
    }
}

/// What a file states of its fields and points before ParaView reads them: their ranges.
std::vector<double> ranges(std::string bytes)
{
    bytes.resize(bytes.find("<Verts>") == std::string::npos
                     ? bytes.find("<Polys>")
                     : std::min(bytes.find("<Verts>"), bytes.find("<Polys>")));
    std::vector<double> found;
    for (std::size_t at = 0; (at = bytes.find("RangeM", at)) != std::string::npos; ++at)
    {
        found.push_back(std::strtod(bytes.c_str() + bytes.find('"', at) + 1, nullptr)); // denormal ones too
    }
    return found;
}

template<int Dim>
void expectAsVtkWrites(const PolyData<Dim>& data)
{
    const test::ScratchFolder folder;
    writeVtp(folder / "written.vtp", data);
    writeWholeFile(folder / "byVtk.vtp", vtpBytesOfVtk(data));
    const auto written = readBack(folder / "written.vtp");
    const auto byVtk = readBack(folder / "byVtk.vtp");
    ASSERT_EQ(written->GetNumberOfPoints(), byVtk->GetNumberOfPoints());
    ASSERT_EQ(written->GetNumberOfPoints(), static_cast<vtkIdType>(data.points.size()));
    expectSame(written->GetPoints()->GetData(), byVtk->GetPoints()->GetData());
    expectSame(written->GetVerts(), byVtk->GetVerts());
    expectSame(written->GetPolys(), byVtk->GetPolys());
    EXPECT_EQ(written->GetNumberOfLines() + written->GetNumberOfStrips(), 0);
    expectSame(written->GetCellData(), byVtk->GetCellData());
    expectSame(written->GetPointData(), byVtk->GetPointData());
    if (!data.points.empty())
    {
        const std::vector<double> stated = ranges(test::content(folder / "written.vtp"));
        const std::vector<double> statedByVtk = ranges(test::content(folder / "byVtk.vtp"));
        ASSERT_EQ(stated.size(), statedByVtk.size());
        ASSERT_FALSE(stated.empty());
        for (std::size_t i = 0; i < stated.size(); ++i)
        {
            EXPECT_DOUBLE_EQ(stated[i], statedByVtk[i]);
        }
    }
}

Field field(const std::string& name, int components, std::size_t count, FieldType type = FieldType::real)
{
    Field result{name, components, {}, type};
    for (std::size_t i = 0; i < count * static_cast<std::size_t>(components); ++i)
    {
        const double value = 1e-3 * std::sin(1.7 * static_cast<double>(i));
        result.values.push_back(type == FieldType::integer ? std::floor(1e5 * value) : value);
    }
    return result;
}

/// What a run with effects adds to its blocks: velocities, damage, whether they move.
template<int Dim>
std::vector<Field> fieldsOfEffects(std::size_t blocks)
{
    return {field("velocity[m/s]", Dim, blocks), field("angularVelocity[rad/s]", Dim == 2 ? 1 : 3, blocks),
            field("groundForce[N]", 1, blocks), field("awake", 1, blocks, FieldType::integer)};
}

TEST(VtkFile, BlocksOfThePlaneAreAsVtkWritesThem)
{
    const Assembly<2> wall = test::wall(5, 6);
    std::vector<Placement<2>> placements(wall.blocks.size());
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        placements[i] = {{1e-3 * static_cast<double>(i), -2e-4}, 0.01 * static_cast<double>(i)};
    }
    expectAsVtkWrites(blockFrame(wall));
    expectAsVtkWrites(blockFrame(wall, placements));
    expectAsVtkWrites(blockFrame(wall, placements, fieldsOfEffects<2>(wall.blocks.size())));
}

Assembly<3> stackInSpace(int blocks)
{
    Assembly<3> assembly;
    for (int i = 0; i < blocks; ++i)
    {
        Block<3> block;
        block.shape.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
        for (Vector<3>& vertex : block.shape.vertices)
        {
            vertex.z() += i;
        }
        block.shape.faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
        assembly.blocks.push_back(block);
    }
    return assembly;
}

TEST(VtkFile, BlocksOfSpaceAreAsVtkWritesThem)
{
    const Assembly<3> stack = stackInSpace(20);
    std::vector<Placement<3>> placements(stack.blocks.size());
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        placements[i].translation = Vector<3>(1e-3 * static_cast<double>(i), -2e-4, 0);
        placements[i].rotation = Vector<3>(0.01, 0.02 * static_cast<double>(i), 0);
    }
    expectAsVtkWrites(blockFrame(stack));
    expectAsVtkWrites(blockFrame(stack, placements, fieldsOfEffects<3>(stack.blocks.size())));
}

template<int Dim>
PolyData<Dim> contactsOf(std::size_t count)
{
    std::vector<ContactPoint<Dim>> points(count);
    std::vector<Vector<Dim>> forces(count);
    std::vector<ContactState> states(count, ContactState::sticking);
    for (std::size_t i = 0; i < count; ++i)
    {
        points[i].position = Vector<Dim>::Constant(0.1 * static_cast<double>(i));
        points[i].normal = Vector<Dim>::Unit(static_cast<int>(i) % Dim);
        points[i].gap = 1e-5 * static_cast<double>(i);
        forces[i] = Vector<Dim>::Constant(std::sin(static_cast<double>(i)));
    }
    return contactFrame(points, forces, states, {field("bonded", 1, count, FieldType::integer)});
}

TEST(VtkFile, ContactsAreAsVtkWritesThem)
{
    expectAsVtkWrites(contactsOf<2>(174));
    expectAsVtkWrites(contactsOf<3>(97));
}

TEST(VtkFile, FilesWithoutCellsAreAsVtkWritesThem)
{
    expectAsVtkWrites(blockFrame(Assembly<2>{}));
    expectAsVtkWrites(blockFrame(Assembly<3>{}));
    expectAsVtkWrites(contactsOf<2>(0));
    expectAsVtkWrites(contactsOf<3>(0));
}

// Arrays are compressed in blocks of 32,768 bytes and stored below 16,384: sizes below, at and above these,
// with whole and with partial last blocks. 4096 numbers of 64 bits are one block.
TEST(VtkFile, ArraysOfEverySizeAreAsVtkWritesThem)
{
    for (const std::size_t count : {1, 2047, 2048, 2049, 4095, 4096, 4097, 8192, 12289})
    {
        SCOPED_TRACE(count);
        expectAsVtkWrites(contactsOf<2>(count));
    }
    expectAsVtkWrites(
        blockFrame(test::wall(40, 40), {}, fieldsOfEffects<2>(test::wall(40, 40).blocks.size())));
}

// VTK 9.1 itself writes what its reader refuses where such a name is that of the first scalar or vector.
TEST(VtkFile, NamesMayHaveWhatXmlReserves)
{
    PolyData<2> data = contactsOf<2>(5);
    const Field vector = field("first & <vector>", 2, 5);
    data.fields = {vector, field("a<b> & \"c\"", 1, 5)};
    const test::ScratchFolder folder;
    writeVtp(folder / "written.vtp", data);
    const auto read = readBack(folder / "written.vtp");
    vtkPointData* fields = read->GetPointData();
    ASSERT_EQ(fields->GetNumberOfArrays(), 2);
    EXPECT_EQ(nameOf(fields->GetVectors()), "first & <vector>");
    EXPECT_EQ(nameOf(fields->GetScalars()), "a<b> & \"c\"");
    EXPECT_EQ(fields->GetVectors()->GetTuple3(4)[1], vector.values[9]);
}

// In coordinates of a map single precision leaves half a metre of a wall.
TEST(VtkFile, PlacesFarFromTheOriginKeepTheirDigits)
{
    PolyData<2> data = contactsOf<2>(6);
    const Vector<2> map(-512345.25, 4649876.5);
    for (Vector<2>& place : data.points)
    {
        place += map;
    }
    expectAsVtkWrites(data);
    const test::ScratchFolder folder;
    writeVtp(folder / "written.vtp", data);
    const auto read = readBack(folder / "written.vtp");
    for (std::size_t i = 0; i < data.points.size(); ++i)
    {
        const double* place = read->GetPoints()->GetPoint(static_cast<vtkIdType>(i));
        EXPECT_EQ(Vector<2>(place[0], place[1]), data.points[i]);
    }
}

TEST(VtkFile, ExtremeValuesAreAsVtkWritesThem)
{
    PolyData<2> data = contactsOf<2>(6);
    data.fields.push_back({"extremes", 1, {0, -0.0, 5e-324, -1e300, 1.7976931348623157e308, 0.1}});
    data.fields.push_back({"integers", 1, {0, 1, -1, 2147483647, -2147483647, 7}, FieldType::integer});
    expectAsVtkWrites(data);
}

} // namespace

} // namespace drystone
