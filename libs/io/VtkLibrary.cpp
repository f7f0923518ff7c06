// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The only file that includes VTK: writes .vtp files by VTK's own writer.
#include "io/VtkLibrary.h"

#include "core/Error.h"
#include "core/WholeFile.h"
#include "geometry/Box.h"
#include "io/Frames.h"

#include <libdeflate.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{

namespace
{

/// zlib's format by libdeflate. A frame consists of many small arrays, and zlib allocates and clears its
/// memory for each, which dominates the time of a frame; libdeflate keeps its memory. VTK's reader is given
/// the name of the base class, and reads the result with zlib.
class Deflate final : public vtkZLibDataCompressor
{
public:
    static Deflate* New() { return new Deflate; }

    std::size_t GetMaximumCompressionSpace(std::size_t size) override
    {
        return libdeflate_zlib_compress_bound(compressor, size);
    }

protected:
    std::size_t CompressBuffer(const unsigned char* in, std::size_t size, unsigned char* out,
                               std::size_t room) override
    {
        return libdeflate_zlib_compress(compressor, in, size, out, room);
    }

private:
    // Digits of computed results are hardly compressible: higher levels cost time without smaller files.
    Deflate() : compressor(libdeflate_alloc_compressor(1)) {}
    ~Deflate() override { libdeflate_free_compressor(compressor); }

    libdeflate_compressor* compressor;
};

/// An array that determines its range (VTK writes it into the file) by a plain loop. VTK's own method uses
/// its thread pools even on one thread and opens a system file for each array, which takes as long as the
/// compression.
template<typename Base>
class PlainRange final : public Base
{
public:
    static PlainRange* New()
    {
        auto* result = new PlainRange;
        result->InitializeObjectBase();
        return result;
    }

protected:
    /// \param component -1 for the length of a vector
    void ComputeRange(double range[2], int component) override
    {
        const int components = this->GetNumberOfComponents();
        range[0] = std::numeric_limits<double>::max();
        range[1] = std::numeric_limits<double>::lowest();
        const auto* value = this->GetPointer(0);
        for (vtkIdType i = 0; i < this->GetNumberOfTuples(); ++i, value += components)
        {
            double size = static_cast<double>(value[std::max(component, 0)]);
            if (component < 0 && components > 1)
            {
                size = 0;
                for (int c = 0; c < components; ++c)
                {
                    size += static_cast<double>(value[c]) * static_cast<double>(value[c]);
                }
                size = std::sqrt(size);
            }
            range[0] = std::min(range[0], size);
            range[1] = std::max(range[1], size);
        }
    }
};

template<typename Array>
vtkSmartPointer<vtkDataArray> array(const Field& field)
{
    const int components = field.components == 2 ? 3 : field.components;
    const auto tuples = static_cast<vtkIdType>(field.values.size()) / field.components;
    vtkNew<PlainRange<Array>> result;
    result->SetName(field.name.c_str());
    result->SetNumberOfComponents(components);
    result->SetNumberOfTuples(tuples);
    auto* out = result->GetPointer(0);
    const double* in = field.values.data();
    for (vtkIdType i = 0; i < tuples; ++i)
    {
        for (int c = 0; c < field.components; ++c)
        {
            *out++ = static_cast<typename Array::ValueType>(*in++);
        }
        if (components != field.components)
        {
            *out++ = 0;
        }
    }
    return result;
}

template<int Dim>
vtkSmartPointer<vtkCellArray> cells(const PolyData<Dim>& data)
{
    // Every cell owns its points, so that the connectivity just counts them.
    const auto count = static_cast<vtkIdType>(cellCount(data));
    vtkNew<PlainRange<vtkTypeInt32Array>> offsets;
    vtkNew<PlainRange<vtkTypeInt32Array>> connectivity;
    offsets->SetNumberOfValues(count + 1);
    connectivity->SetNumberOfValues(static_cast<vtkIdType>(data.points.size()));
    int end = 0;
    offsets->SetValue(0, 0);
    for (vtkIdType i = 0; i < count; ++i)
    {
        offsets->SetValue(
            i + 1, end += data.kind == CellKind::point ? 1 : data.cellSizes[static_cast<std::size_t>(i)]);
    }
    for (vtkIdType i = 0; i < connectivity->GetNumberOfValues(); ++i)
    {
        connectivity->SetValue(i, static_cast<vtkTypeInt32>(i));
    }
    vtkNew<vtkCellArray> result;
    result->SetData(offsets, connectivity);
    return result;
}

/// \param Array of the numbers
template<class Array, int Dim>
vtkSmartPointer<vtkPoints> pointsIn(const std::vector<Vector<Dim>>& places)
{
    vtkNew<PlainRange<Array>> coordinates;
    coordinates->SetNumberOfComponents(3);
    coordinates->SetNumberOfTuples(static_cast<vtkIdType>(places.size()));
    using Number = typename Array::ValueType;
    Number* out = coordinates->GetPointer(0);
    for (const Vector<Dim>& place : places)
    {
        for (int i = 0; i < 3; ++i)
        {
            *out++ = i < Dim ? static_cast<Number>(place[i]) : Number{0};
        }
    }
    vtkNew<vtkPoints> points;
    points->SetData(coordinates);
    return points;
}

/// The places of the corners; z = 0 in the plane.
template<int Dim>
vtkSmartPointer<vtkPoints> pointsOfVtk(const std::vector<Vector<Dim>>& places)
{
    return isFarFromOrigin(boxAround<Dim>(places)) ? pointsIn<vtkDoubleArray, Dim>(places)
                                                   : pointsIn<vtkFloatArray, Dim>(places);
}

/// Adds fields to those of cells or points: the first number and the first vector are what ParaView shows
/// first when it opens the file.
void addArrays(vtkDataSetAttributes& attributes, const std::vector<Field>& fields)
{
    for (const Field& field : fields)
    {
        attributes.AddArray(field.type == FieldType::integer ? array<vtkIntArray>(field)
                                                             : array<vtkDoubleArray>(field));
        if (field.components == 1 && attributes.GetScalars() == nullptr)
        {
            attributes.SetActiveScalars(field.name.c_str());
        }
        if (field.components > 1 && attributes.GetVectors() == nullptr)
        {
            attributes.SetActiveVectors(field.name.c_str());
        }
    }
}

std::string writtenByVtk(vtkPolyData* poly)
{
    vtkNew<vtkXMLPolyDataWriter> writer;
    vtkNew<Deflate> compressor;
    writer->SetInputData(poly);
    writer->SetDataModeToBinary(); // not appended: see VtkFile.cpp
    writer->SetCompressor(compressor);
    writer->SetHeaderTypeToUInt32();
    writer->WriteToOutputStringOn();
    if (writer->Write() == 0)
    {
        throw FatalError("VTK could not generate a .vtp file.");
    }
    return writer->GetOutputString();
}

} // namespace

template<int Dim>
std::string vtpBytesOfVtk(const PolyData<Dim>& data)
{
    checkPolyData(data);
    vtkNew<vtkPolyData> poly;
    poly->SetPoints(pointsOfVtk<Dim>(data.points));
    if (data.kind == CellKind::polygon)
    {
        poly->SetPolys(cells(data));
        addArrays(*poly->GetCellData(), data.fields);
    }
    else
    {
        poly->SetVerts(cells(data));
        addArrays(*poly->GetPointData(), data.fields);
    }
    for (const Field& field : data.pointFields)
    {
        poly->GetPointData()->AddArray(array<vtkFloatArray>(field));
    }
    return writtenByVtk(poly);
}

template<int Dim>
void writeAssembly(const std::filesystem::path& file, const Assembly<Dim>& assembly)
{
    writeWholeFile(file, vtpBytesOfVtk(blockFrame(assembly)));
}

template std::string vtpBytesOfVtk(const PolyData<2>& data);
template void writeAssembly(const std::filesystem::path& file, const Assembly<2>& assembly);
template std::string vtpBytesOfVtk(const PolyData<3>& data);
template void writeAssembly(const std::filesystem::path& file, const Assembly<3>& assembly);

} // namespace drystone
