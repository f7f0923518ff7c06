// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes .vtp files directly: VTK's writer takes several times as long for a frame, and loading its
/// libraries longer than a limit analysis (test/benchmark/results/TUNING.md).
#include "io/VtkFile.h"

#include "core/Base64.h"
#include "core/Error.h"
#include "core/MarkupText.h"
#include "core/WholeFile.h"
#include "geometry/Box.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <string_view>

namespace drystone
{

namespace
{

/// \param carrier of a value: "cell" or "point"
void check(const std::vector<Field>& fields, std::size_t count, std::string_view carrier)
{
    for (const Field& field : fields)
    {
        const auto components = static_cast<std::size_t>(field.components);
        if (field.components < 1 || field.components > 3 || field.values.size() != count * components)
        {
            throw FatalError(fmt::format("Field {} of a .vtp file has {} values in {} components for {} {}s.",
                                         field.name, field.values.size(), field.components, count, carrier));
        }
        for (std::size_t i = 0; i < field.values.size(); ++i)
        {
            const double value = field.values[i];
            if (!std::isfinite(value))
            {
                throw FatalError(
                    fmt::format("{} of {} {} to be written to a .vtp file is not a finite number.",
                                field.name, carrier, i / components));
            }
            if (field.type == FieldType::integer
                && (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max()))
            {
                throw FatalError(
                    fmt::format("{} of {} {} to be written to a .vtp file is {}, not a whole number.",
                                field.name, carrier, i / components, value));
            }
        }
    }
}

struct CompressorRelease
{
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};
using Compressor = std::unique_ptr<libdeflate_compressor, CompressorRelease>;

/// Arrays as they stand within their elements, in base 64: a header of sizes, then the values, compressed in
/// blocks. Data at the end of the file would be a quarter smaller, but VTK 9.1 and ParaView 5.11, those of
/// Debian 12, read none since expat, which parses the rest for them, got its security update (+deb12u5).
class ArrayEncoder
{
public:
    std::string operator()(std::string_view array)
    {
        const std::size_t blocks = (array.size() + blockSize - 1) / blockSize;
        // Number of blocks, size of a whole one, size of the last one where it is not whole, compressed
        // sizes.
        const std::size_t remainder = array.size() % blockSize;
        std::vector<std::uint32_t> header(3 + blocks, 0);
        header[0] = static_cast<std::uint32_t>(blocks);
        header[1] = static_cast<std::uint32_t>(blockSize);
        header[2] = static_cast<std::uint32_t>(remainder);
        bytes.clear();
        for (std::size_t block = 0; block < blocks; ++block)
        {
            const std::string_view part = array.substr(block * blockSize, blockSize);
            libdeflate_compressor* compressor = of(part.size());
            const std::size_t at = bytes.size();
            bytes.resize(at + libdeflate_zlib_compress_bound(compressor, part.size()));
            const std::size_t size = libdeflate_zlib_compress(compressor, part.data(), part.size(),
                                                              bytes.data() + at, bytes.size() - at);
            if (size == 0)
            {
                throw FatalError("An array of a .vtp file could not be compressed.");
            }
            bytes.resize(at + size);
            header[3 + block] = static_cast<std::uint32_t>(size);
        }
        return base64({reinterpret_cast<const char*>(header.data()), header.size() * sizeof(std::uint32_t)})
               + base64(bytes);
    }

private:
    /// Small arrays are stored in zlib's format without being compressed: a code of their own costs more time
    /// than all the rest of a frame, for files that take as many sectors of a disk.
    libdeflate_compressor* of(std::size_t size)
    {
        Compressor& compressor = size < worthCompressing ? storing : compressing;
        if (!compressor)
        {
            // Digits of computed results are hardly compressible: higher levels cost time without smaller
            // files.
            compressor.reset(libdeflate_alloc_compressor(size < worthCompressing ? 0 : 1));
            if (!compressor)
            {
                throw std::bad_alloc();
            }
        }
        return compressor.get();
    }

    static constexpr std::size_t blockSize = 1U << 15U; // what VTK's readers are used to
    static constexpr std::size_t worthCompressing = 1U << 14U;
    static thread_local Compressor storing; // kept: their memory is cleared when it is taken
    static thread_local Compressor compressing;
    std::string bytes;
};

thread_local Compressor ArrayEncoder::storing;
thread_local Compressor ArrayEncoder::compressing;

/// Bytes of an array; vectors of the plane get z = 0.
template<typename Number>
std::string bytesOf(const double* values, std::size_t tuples, int components)
{
    const int written = components == 2 ? 3 : components;
    std::string bytes(tuples * static_cast<std::size_t>(written) * sizeof(Number), '\0');
    char* out = bytes.data();
    for (std::size_t i = 0; i < tuples; ++i)
    {
        for (int c = 0; c < components; ++c, out += sizeof(Number))
        {
            const auto number = static_cast<Number>(*values++);
            std::memcpy(out, &number, sizeof(Number));
        }
        out += static_cast<std::size_t>(written - components) * sizeof(Number);
    }
    return bytes;
}

/// Least and largest value of what is written, of vectors their length: readers take them from the file.
template<typename Number>
std::array<double, 2> rangeOf(const double* values, std::size_t tuples, int components)
{
    std::array<double, 2> range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for (std::size_t i = 0; i < tuples; ++i, values += components)
    {
        double size = static_cast<Number>(*values);
        if (components > 1)
        {
            size = 0;
            for (int c = 0; c < components; ++c)
            {
                const double value = static_cast<Number>(values[c]);
                size += value * value;
            }
            size = std::sqrt(size);
        }
        range = {std::min(range[0], size), std::max(range[1], size)};
    }
    return range;
}

/// The elements of a file.
struct VtpText
{
    template<typename Number>
    void array(std::string_view type, std::string_view name, const double* values, std::size_t tuples,
               int components)
    {
        const std::array<double, 2> range = rangeOf<Number>(values, tuples, components);
        fmt::format_to(std::back_inserter(elements),
                       "        <DataArray type=\"{}\" Name=\"{}\"{} format=\"binary\" RangeMin=\"{}\" "
                       "RangeMax=\"{}\">{}</DataArray>\n",
                       type, markupText(name), components > 1 ? " NumberOfComponents=\"3\"" : "", range[0],
                       range[1], encoded(bytesOf<Number>(values, tuples, components)));
    }

    void array(const Field& field, std::size_t tuples)
    {
        field.type == FieldType::integer
            ? array<std::int32_t>("Int32", field.name, field.values.data(), tuples, field.components)
            : array<double>("Float64", field.name, field.values.data(), tuples, field.components);
    }

    void indices(std::string_view name, const std::vector<std::int32_t>& values)
    {
        fmt::format_to(
            std::back_inserter(elements),
            "        <DataArray type=\"Int32\" Name=\"{}\" format=\"binary\">{}</DataArray>\n", name,
            encoded({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(std::int32_t)}));
    }

    std::string elements;
    ArrayEncoder encoded;
};

/// Fields of cells or points. What ParaView shows first when it opens the file are the first scalar and the
/// first vector.
void addFields(VtpText& text, std::string_view element, const std::vector<Field>& fields, std::size_t tuples)
{
    const auto first = [&](std::string_view shown, const auto& isShown) -> std::string
    {
        const auto field = std::find_if(fields.begin(), fields.end(), isShown);
        return field == fields.end() ? "" : fmt::format(" {}=\"{}\"", shown, markupText(field->name));
    };
    text.elements += fmt::format("      <{}{}{}>\n", element,
                                 first("Scalars", [](const Field& field) { return field.components == 1; }),
                                 first("Vectors", [](const Field& field) { return field.components > 1; }));
    for (const Field& field : fields)
    {
        text.array(field, tuples);
    }
    text.elements += fmt::format("      </{}>\n", element);
}

/// Fields of the points of polygons, in single precision.
void addPointFields(VtpText& text, const std::vector<Field>& fields, std::size_t points)
{
    text.elements += "      <PointData>\n";
    for (const Field& field : fields)
    {
        text.array<float>("Float32", field.name, field.values.data(), points, field.components);
    }
    text.elements += "      </PointData>\n";
}

/// Which points the cells have: every cell owns its points, so that the connectivity just counts them.
template<int Dim>
void addCells(VtpText& text, const PolyData<Dim>& data)
{
    std::vector<std::int32_t> connectivity(data.points.size());
    std::iota(connectivity.begin(), connectivity.end(), 0);
    std::vector<std::int32_t> ends(connectivity);
    if (data.kind == CellKind::polygon)
    {
        ends.assign(data.cellSizes.begin(), data.cellSizes.end());
        std::partial_sum(ends.begin(), ends.end(), ends.begin());
    }
    else
    {
        std::for_each(ends.begin(), ends.end(), [](std::int32_t& end) { ++end; });
    }
    const std::string_view element = data.kind == CellKind::polygon ? "Polys" : "Verts";
    text.elements += fmt::format("      <{}>\n", element);
    text.indices("connectivity", connectivity);
    text.indices("offsets", ends);
    text.elements += fmt::format("      </{}>\n", element);
}

} // namespace

template<int Dim>
void checkPolyData(const PolyData<Dim>& data)
{
    std::size_t points = data.points.size();
    if (data.kind == CellKind::polygon)
    {
        points = 0;
        for (const int size : data.cellSizes)
        {
            points += static_cast<std::size_t>(size);
        }
    }
    if (points != data.points.size())
    {
        throw FatalError(fmt::format("A .vtp file got {} points for polygons with {} vertices.",
                                     data.points.size(), points));
    }
    for (std::size_t i = 0; i < data.points.size(); ++i)
    {
        if (!data.points[i].allFinite())
        {
            throw FatalError(fmt::format(
                "The position of point {} to be written to a .vtp file is not a finite number.", i));
        }
    }

    check(data.fields, cellCount(data), "cell");
    check(data.pointFields, data.points.size(), "point");
}

template<int Dim>
std::size_t cellCount(const PolyData<Dim>& data)
{
    return data.kind == CellKind::point ? data.points.size() : data.cellSizes.size();
}

template<int Dim>
std::string vtpBytes(const PolyData<Dim>& data)
{
    checkPolyData(data);
    static_assert(sizeof(Vector<Dim>) == Dim * sizeof(double));

    VtpText text;
    const bool isPolygons = data.kind == CellKind::polygon;
    const std::size_t cells = cellCount(data);
    const std::size_t points = data.points.size();
    if (isPolygons)
    {
        addPointFields(text, data.pointFields, points);
        addFields(text, "CellData", data.fields, cells);
    }
    else
    {
        addFields(text, "PointData", data.fields, cells);
    }
    text.elements += "      <Points>\n";
    const double* places = points > 0 ? data.points.front().data() : nullptr;
    isFarFromOrigin(boxAround<Dim>(data.points))
        ? text.array<double>("Float64", "Points", places, points, Dim)
        : text.array<float>("Float32", "Points", places, points, Dim);
    text.elements += "      </Points>\n";
    addCells(text, data);

    constexpr std::string_view order =
        std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"{}\" "
        "header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n  <PolyData>\n    <Piece "
        "NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"{}\">\n{}    </Piece>\n  </PolyData>\n</VTKFile>\n",
        order, points, isPolygons ? 0 : cells, isPolygons ? cells : 0, text.elements);
}

template<int Dim>
void writeVtp(const std::filesystem::path& file, const PolyData<Dim>& data)
{
    writeWholeFile(file, vtpBytes(data));
}

template void checkPolyData(const PolyData<2>& data);
template std::size_t cellCount(const PolyData<2>& data);
template std::string vtpBytes(const PolyData<2>& data);
template void writeVtp(const std::filesystem::path& file, const PolyData<2>& data);
template void checkPolyData(const PolyData<3>& data);
template std::size_t cellCount(const PolyData<3>& data);
template std::string vtpBytes(const PolyData<3>& data);
template void writeVtp(const std::filesystem::path& file, const PolyData<3>& data);

} // namespace drystone
