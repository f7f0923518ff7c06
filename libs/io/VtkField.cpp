// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One element of VTK's XML, and its array in base 64 of zlib's format. All sizes in it are checked before
/// they are used.
#include "io/VtkField.h"

#include "core/Base64.h"
#include "core/MarkupText.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>

namespace drystone
{

namespace
{

/// What an element has: its attributes as they are written, and what stands between its ends.
struct Element
{
    std::string_view attributes;
    std::string_view content;
};

/// The first element with attributes that contain a text.
std::optional<Element> findElement(std::string_view text, std::string_view name, std::string_view attribute)
{
    const std::string begin = fmt::format("<{}", name);
    const std::string end = fmt::format("</{}>", name);
    for (std::size_t at = text.find(begin); at != std::string_view::npos; at = text.find(begin, at + 1))
    {
        const std::size_t close = text.find('>', at);
        const std::size_t last = text.find(end, at);
        if (close == std::string_view::npos || last == std::string_view::npos || last < close)
        {
            return std::nullopt;
        }
        const std::string_view attributes = text.substr(at + begin.size(), close - at - begin.size());
        if (attributes.find(attribute) != std::string_view::npos)
        {
            return Element{attributes, text.substr(close + 1, last - close - 1)};
        }
    }
    return std::nullopt;
}

std::vector<std::uint32_t> wordsOf(std::string_view bytes)
{
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
    return words;
}

struct DecompressorRelease
{
    void operator()(libdeflate_decompressor* decompressor) const
    {
        libdeflate_free_decompressor(decompressor);
    }
};

/// The bytes of an array: a header (number of blocks, size of a whole one, of the last one where it is not
/// whole, compressed sizes), then the blocks, both in base 64.
std::optional<std::string> arrayOf(std::string_view content)
{
    constexpr std::size_t beginOfHeader = 16; // digits, of three words
    constexpr std::size_t largestBlock = 1U << 24U;
    const auto digitsOf = [](std::size_t bytes) { return (bytes + 2) / 3 * 4; };
    const std::optional<std::string> sizes = bytesOfBase64(content.substr(0, beginOfHeader));
    if (!sizes || sizes->size() != 3 * sizeof(std::uint32_t))
    {
        return std::nullopt;
    }
    const std::vector<std::uint32_t> first = wordsOf(*sizes);
    const std::size_t blocks = first[0];
    const std::size_t size = first[1];
    const std::size_t headerDigits = digitsOf((3 + blocks) * sizeof(std::uint32_t));
    if (size == 0 || size > largestBlock || first[2] >= size || headerDigits > content.size())
    {
        return std::nullopt;
    }
    const std::optional<std::string> header = bytesOfBase64(content.substr(0, headerDigits));
    const std::optional<std::string> compressed = bytesOfBase64(content.substr(headerDigits));
    if (!header || !compressed)
    {
        return std::nullopt;
    }
    const std::vector<std::uint32_t> words = wordsOf(*header);
    const std::unique_ptr<libdeflate_decompressor, DecompressorRelease> decompressor(
        libdeflate_alloc_decompressor());
    if (!decompressor)
    {
        throw std::bad_alloc();
    }
    std::string bytes;
    std::size_t read = 0;
    for (std::size_t block = 0; block < blocks; ++block)
    {
        const std::size_t own = block + 1 == blocks && first[2] > 0 ? first[2] : size;
        const std::size_t packed = words[3 + block];
        const std::size_t at = bytes.size();
        if (packed > compressed->size() - read)
        {
            return std::nullopt;
        }
        bytes.resize(at + own);
        if (libdeflate_zlib_decompress(decompressor.get(), compressed->data() + read, packed,
                                       bytes.data() + at, own, nullptr)
            != LIBDEFLATE_SUCCESS)
        {
            return std::nullopt;
        }
        read += packed;
    }
    return read == compressed->size() ? std::optional(std::move(bytes)) : std::nullopt;
}

template<typename Number>
std::vector<double> valuesOf(std::string_view bytes)
{
    std::vector<double> values(bytes.size() / sizeof(Number));
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        Number number;
        std::memcpy(&number, bytes.data() + i * sizeof(Number), sizeof(Number));
        values[i] = static_cast<double>(number);
    }
    return values;
}

/// Whether a file says of itself what VtkFile.cpp says of all that it writes, on a machine of this order of
/// bytes.
bool isOwn(std::string_view bytes)
{
    constexpr bool isLittle = std::endian::native == std::endian::little;
    const std::optional<Element> file = findElement(bytes, "VTKFile", "type=\"PolyData\"");
    const std::array<std::string_view, 3> said{
        isLittle ? "byte_order=\"LittleEndian\"" : "byte_order=\"BigEndian\"", "header_type=\"UInt32\"",
        "compressor=\"vtkZLibDataCompressor\""};
    return file
           && std::all_of(said.begin(), said.end(),
                          [&](std::string_view each)
                          { return file->attributes.find(each) != std::string_view::npos; });
}

} // namespace

std::optional<Field> cellField(std::string_view bytes, const std::string& name)
{
    const std::optional<Element> cells =
        isOwn(bytes) ? findElement(bytes, "CellData", "") : std::optional<Element>();
    const std::optional<Element> element =
        cells ? findElement(cells->content, "DataArray", fmt::format(" Name=\"{}\"", markupText(name)))
              : cells;
    const auto has = [&](std::string_view attribute)
    { return element->attributes.find(attribute) != std::string_view::npos; };
    if (!element || !has("format=\"binary\"") || has("type=\"Int32\"") == has("type=\"Float64\""))
    {
        return std::nullopt;
    }
    const std::optional<std::string> array = arrayOf(element->content);
    Field field;
    field.name = name;
    field.components = has("NumberOfComponents=\"3\"") ? 3 : 1;
    field.type = has("type=\"Int32\"") ? FieldType::integer : FieldType::real;
    const std::size_t size = field.type == FieldType::integer ? sizeof(std::int32_t) : sizeof(double);
    if (!array || array->size() % (size * static_cast<std::size_t>(field.components)) != 0)
    {
        return std::nullopt;
    }
    field.values =
        field.type == FieldType::integer ? valuesOf<std::int32_t>(*array) : valuesOf<double>(*array);
    return field;
}

} // namespace drystone
