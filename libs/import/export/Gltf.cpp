// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// glTF 2.0 with its buffer within: corners of each triangle with the normal of their face.
#include "import/export/Number.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace drystone
{

namespace
{

std::string base64(std::string_view bytes)
{
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve(bytes.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3)
    {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
        {
            group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k)
        {
            text += i + k <= bytes.size() ? letters[group >> (18U - 6U * k) & 63U] : '=';
        }
    }
    return text;
}

void append(std::string& bytes, float value)
{
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (unsigned shift = 0; shift < 32; shift += 8) // little-endian on all machines
    {
        bytes += static_cast<char>(bits >> shift & 255U);
    }
}

/// z upwards becomes y upwards.
Eigen::Vector3f upright(const Vector<3>& place)
{
    return Vector<3>(place.x(), place.z(), -place.y()).cast<float>();
}

} // namespace

std::string gltfText(const std::vector<ExportedSolid>& solids)
{
    std::string bytes;
    std::string views;
    std::string accessors;
    std::string meshes;
    std::string nodes;
    std::string children;
    for (std::size_t i = 0; i < solids.size(); ++i)
    {
        const Polyhedron& shape = solids[i].shape;
        std::string positions;
        std::string normals;
        Eigen::Vector3f lower = Eigen::Vector3f::Constant(3e38F);
        Eigen::Vector3f upper = -lower;
        std::size_t count = 0;
        for (const std::vector<int>& face : shape.faces)
        {
            const Eigen::Vector3f normal = upright(areaVector(shape, face).normalized());
            for (const std::array<int, 3>& triangle : trianglesOf(shape, face))
            {
                for (const int vertex : triangle)
                {
                    const Eigen::Vector3f place = upright(shape.vertices[static_cast<std::size_t>(vertex)]);
                    lower = lower.cwiseMin(place);
                    upper = upper.cwiseMax(place);
                    for (int axis = 0; axis < 3; ++axis)
                    {
                        append(positions, place[axis]);
                        append(normals, normal[axis]);
                    }
                    ++count;
                }
            }
        }
        const char* separator = i > 0 ? ",\n" : "";
        fmt::format_to(
            std::back_inserter(views),
            "{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}},{{\"buffer\":0,\"byteOffset\":{},"
            "\"byteLength\":{}}}",
            separator, bytes.size(), positions.size(), bytes.size() + positions.size(), normals.size());
        fmt::format_to(
            std::back_inserter(accessors),
            "{}{{\"bufferView\":{},\"componentType\":5126,\"count\":{},\"type\":\"VEC3\",\"min\":[{},{},{}],"
            "\"max\":[{},{},{}]}},{{\"bufferView\":{},\"componentType\":5126,\"count\":{},\"type\":\"VEC3\"}"
            "}",
            separator, 2 * i, count, lower.x(), lower.y(), lower.z(), upper.x(), upper.y(), upper.z(),
            2 * i + 1, count);
        fmt::format_to(
            std::back_inserter(meshes),
            "{}{{\"primitives\":[{{\"attributes\":{{\"POSITION\":{},\"NORMAL\":{}}},\"material\":{}}}]}}",
            separator, 2 * i, 2 * i + 1, solids[i].isFixed ? 1 : 0);
        fmt::format_to(std::back_inserter(nodes),
                       "{}{{\"name\":\"block_{}\",\"mesh\":{},\"extras\":{{\"layer\":\"{}\"}}}}", separator,
                       i, i, solids[i].layer);
        fmt::format_to(std::back_inserter(children), "{}{}", i > 0 ? "," : "", i);
        bytes += positions;
        bytes += normals;
    }
    return fmt::format(
        "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"Drystone\"}},\"scene\":0,\"scenes\":[{{\"nodes\":["
        "{}]}}],\n"
        "\"materials\":[{{\"name\":\"blocks\",\"pbrMetallicRoughness\":{{\"baseColorFactor\":[0.72,0.45,0.32,"
        "1],"
        "\"metallicFactor\":0,\"roughnessFactor\":0.9}}}},{{\"name\":\"supports\",\"pbrMetallicRoughness\":"
        "{{\"baseColorFactor\":[0.55,0.55,0.55,1],\"metallicFactor\":0,\"roughnessFactor\":0.9}}}}],\n"
        "\"nodes\":[{}],\n\"meshes\":[{}],\n\"accessors\":[{}],\n\"bufferViews\":[{}],\n"
        "\"buffers\":[{{\"byteLength\":{},\"uri\":\"data:application/octet-stream;base64,{}\"}}]}}\n",
        children, nodes, meshes, accessors, views, bytes.size(), base64(bytes));
}

} // namespace drystone
