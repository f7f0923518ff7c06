// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// glTF 2.0 with its buffer within: corners of each triangle with the normal of their face, about the centre
/// of the block, which the node places and an animation moves.
#include "core/Base64.h"
#include "core/Json.h"
#include "geometry/BroadPhase.h"
#include "geometry/space/Polyhedron.h"
#include "import/export/Number.h"
#include "import/export/Writers.h"

#include <Eigen/Geometry>
#include <fmt/ranges.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

namespace drystone
{

namespace
{

/// z upwards becomes y upwards; for places, displacements and rotation vectors alike.
Vector<3> upright(const Vector<3>& place)
{
    return {place.x(), place.z(), -place.y()};
}

/// Appends to a list of JSON.
template<class... Arguments>
void append(std::string& list, fmt::format_string<Arguments...> item, Arguments&&... arguments)
{
    list += list.empty() ? "" : ",\n";
    fmt::format_to(std::back_inserter(list), item, std::forward<Arguments>(arguments)...);
}

/// Whether an accessor states the least and largest numbers of its array, as places and times must.
enum class Extent
{
    absent,
    given
};

/// The numbers of the file: one buffer, a view and an accessor for each array.
class Buffer
{
public:
    /// Adds vectors, a column each. \param type SCALAR, VEC3 or VEC4 \return their accessor
    std::size_t add(const Eigen::MatrixXd& vectors, std::string_view type, Extent extent);

    std::string viewList;
    std::string accessorList;
    std::string bytes;

private:
    std::size_t count = 0;
};

std::string extentOf(const Eigen::MatrixXf& numbers)
{
    const Eigen::VectorXf lower = numbers.rowwise().minCoeff();
    const Eigen::VectorXf upper = numbers.rowwise().maxCoeff();
    return fmt::format(R"(,"min":[{}],"max":[{}])", fmt::join(lower, ","), fmt::join(upper, ","));
}

std::size_t Buffer::add(const Eigen::MatrixXd& vectors, std::string_view type, Extent extent)
{
    const Eigen::MatrixXf numbers = vectors.cast<float>();
    append(viewList, R"({{"buffer":0,"byteOffset":{},"byteLength":{}}})", bytes.size(), 4 * numbers.size());
    append(accessorList, R"({{"bufferView":{},"componentType":5126,"count":{},"type":"{}"{}}})", count,
           numbers.cols(), type, extent == Extent::given ? extentOf(numbers) : "");
    for (const float value : numbers.reshaped())
    {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        for (unsigned shift = 0; shift < 32; shift += 8) // little-endian on all machines
        {
            bytes += static_cast<char>(bits >> shift & 255U);
        }
    }
    return count++;
}

/// Corners of the triangles and normals of their faces, about a centre, a column each.
struct Triangles
{
    Eigen::Matrix3Xd places;
    Eigen::Matrix3Xd normals;
};

Triangles trianglesAbout(const Vector<3>& centre, const Polyhedron& shape)
{
    std::vector<Vector<3>> places;
    std::vector<Vector<3>> normals;
    for (const std::vector<int>& face : shape.faces)
    {
        const Vector<3> normal = upright(areaVector(shape, face).normalized());
        for (const std::array<int, 3>& corners : trianglesOf(shape, face))
        {
            for (const int vertex : corners)
            {
                places.push_back(upright(shape.vertices[static_cast<std::size_t>(vertex)] - centre));
                normals.push_back(normal);
            }
        }
    }
    Triangles triangles{Eigen::Matrix3Xd(3, places.size()), Eigen::Matrix3Xd(3, places.size())};
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        triangles.places.col(static_cast<Eigen::Index>(i)) = places[i];
        triangles.normals.col(static_cast<Eigen::Index>(i)) = normals[i];
    }
    return triangles;
}

/// From where places in the buffer are counted, as they have seven digits only: in coordinates of a map
/// stones of centimetres would be flat. \return zero unless the structure is far from there
Vector<3> originOf(const std::vector<ExportedSolid>& solids)
{
    Box<3> box;
    for (const ExportedSolid& solid : solids)
    {
        extend<3>(box, boundingBox(solid.shape));
    }
    return isFarFromOrigin(box) ? Vector<3>(((box.lower + box.upper) / 2).array().round())
                                : Vector<3>(Vector<3>::Zero());
}

std::string translationOf(const Vector<3>& place)
{
    return fmt::format(R"(,"translation":[{},{},{}])", place.x() + 0.0, place.y() + 0.0, place.z() + 0.0);
}

/// x y z w; that of the rotation which is nearer to `previous`, so that a viewer turns the short way.
Eigen::Vector4d quaternionOf(const Vector<3>& rotation, const Eigen::Vector4d& previous)
{
    const double angle = rotation.norm();
    const Eigen::Quaterniond turned(angle > 0 ? Eigen::AngleAxisd(angle, rotation / angle)
                                              : Eigen::AngleAxisd::Identity());
    const Eigen::Vector4d coefficients = turned.coeffs();
    return coefficients.dot(previous) < 0 ? Eigen::Vector4d(-coefficients) : coefficients;
}

/// Samplers and channels of an animation, three a block at most.
class Animation
{
public:
    Animation(Buffer& numbers, const std::vector<SolidFrame>& frames);

    /// What moves a node whose block has its centre at a place.
    void move(std::size_t node, const Vector<3>& centre);

    std::string samplerList;
    std::string channelList;

private:
    void add(std::size_t node, std::string_view path, const Eigen::MatrixXd& values);

    Buffer& buffer;
    const std::vector<SolidFrame>& moments;
    std::size_t times = 0; ///< their accessor
    std::size_t count = 0;
};

Animation::Animation(Buffer& numbers, const std::vector<SolidFrame>& frames)
    : buffer(numbers), moments(frames)
{
    Eigen::MatrixXd row(1, frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k)
    {
        row(0, static_cast<Eigen::Index>(k)) = frames[k].time;
    }
    times = buffer.add(row, "SCALAR", Extent::given);
}

void Animation::add(std::size_t node, std::string_view path, const Eigen::MatrixXd& values)
{
    const std::size_t output = buffer.add(values, path == "rotation" ? "VEC4" : "VEC3", Extent::absent);
    append(samplerList, R"({{"input":{},"output":{},"interpolation":"{}"}})", times, output,
           path == "scale" ? "STEP" : "LINEAR");
    append(channelList, R"({{"sampler":{},"target":{{"node":{},"path":"{}"}}}})", count, node, path);
    ++count;
}

void Animation::move(std::size_t node, const Vector<3>& centre)
{
    const auto frames = static_cast<Eigen::Index>(moments.size());
    Eigen::MatrixXd translation(3, frames);
    Eigen::MatrixXd rotation(4, frames);
    Eigen::MatrixXd scale = Eigen::MatrixXd::Ones(3, frames);
    Vector<3> place = upright(centre);
    Eigen::Vector4d turned(0, 0, 0, 1);
    for (Eigen::Index k = 0; k < frames; ++k)
    {
        const SolidFrame& moment = moments[static_cast<std::size_t>(k)];
        const auto column = static_cast<Eigen::Index>(node);
        const bool isShown = moment.displacement.col(column).allFinite();
        if (isShown)
        {
            place = upright(centre + moment.displacement.col(column));
            turned = quaternionOf(upright(moment.rotation.col(column)), turned);
        }
        translation.col(k) = place;
        rotation.col(k) = turned;
        scale.col(k) *= isShown ? 1 : 0;
    }
    add(node, "translation", translation);
    add(node, "rotation", rotation);
    if (scale.minCoeff() < 1)
    {
        add(node, "scale", scale);
    }
}

/// Meshes and nodes of the blocks, one each.
struct Nodes
{
    std::string meshList;
    std::string nodeList;
    std::string children; ///< of the scene
};

/// \param translation of its node, or empty
void addBlock(Nodes& nodes, Buffer& buffer, std::size_t index, const ExportedSolid& solid,
              const Vector<3>& centre, const std::string& translation)
{
    const Triangles triangles = trianglesAbout(centre, solid.shape);
    const std::size_t positions = buffer.add(triangles.places, "VEC3", Extent::given);
    const std::size_t normals = buffer.add(triangles.normals, "VEC3", Extent::absent);
    append(nodes.meshList,
           R"({{"primitives":[{{"attributes":{{"POSITION":{},"NORMAL":{}}},"material":{}}}]}})", positions,
           normals, solid.isFixed ? 1 : 0);
    append(nodes.nodeList, R"({{"name":"block_{}","mesh":{}{},"extras":{{"layer":{}}}}})", index, index,
           translation, jsonText(solid.layer));
    nodes.children += fmt::format("{}{}", index > 0 ? "," : "", index);
}

/// One more node that moves those of all blocks.
void moveAll(Nodes& nodes, std::size_t blocks, const Vector<3>& origin)
{
    append(nodes.nodeList, R"({{"name":"structure","children":[{}]{}}})", nodes.children,
           translationOf(upright(origin)));
    nodes.children = fmt::format("{}", blocks);
}

/// The animation of the blocks that are not fixed. \param centres of the blocks, from the origin
std::string animationOf(Buffer& buffer, const std::vector<ExportedSolid>& solids,
                        const std::vector<SolidFrame>& frames, const std::vector<Vector<3>>& centres)
{
    Animation animation(buffer, frames);
    for (std::size_t i = 0; i < solids.size(); ++i)
    {
        if (!solids[i].isFixed)
        {
            animation.move(i, centres[i]);
        }
    }
    return fmt::format("\"animations\":[{{\"name\":\"motion\",\"samplers\":[{}],\n\"channels\":[{}]}}],\n",
                       animation.samplerList, animation.channelList);
}

} // namespace

std::string gltfText(const std::vector<ExportedSolid>& solids, const std::vector<SolidFrame>& frames)
{
    const Vector<3> origin = originOf(solids);
    Buffer buffer;
    Nodes nodes;
    std::vector<Vector<3>> centres; // from the origin
    for (std::size_t i = 0; i < solids.size(); ++i)
    {
        // Blocks that stay are written where they are.
        const Vector<3> centre = frames.empty() ? origin : volumeProperties(solids[i].shape).centroid;
        centres.emplace_back(centre - origin);
        addBlock(nodes, buffer, i, solids[i], centre,
                 frames.empty() ? "" : translationOf(upright(centres.back())));
    }
    if (!origin.isZero())
    {
        moveAll(nodes, solids.size(), origin);
    }
    const std::string animations = frames.empty() ? "" : animationOf(buffer, solids, frames, centres);
    return fmt::format(
        "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"Drystone\"}},\"scene\":0,\"scenes\":[{{\"nodes\":["
        "{}]}}],\n\"materials\":[{{\"name\":\"blocks\",\"pbrMetallicRoughness\":{{\"baseColorFactor\":[0.72,"
        "0.45,0.32,1],\"metallicFactor\":0,\"roughnessFactor\":0.9}}}},{{\"name\":\"supports\","
        "\"pbrMetallicRoughness\":{{\"baseColorFactor\":[0.55,0.55,0.55,1],\"metallicFactor\":0,"
        "\"roughnessFactor\":0.9}}}}],\n\"nodes\":[{}],\n\"meshes\":[{}],\n{}\"accessors\":[{}],"
        "\n\"bufferViews\":[{}],\n\"buffers\":[{{\"byteLength\":{},\"uri\":\"data:application/"
        "octet-stream;base64,{}\"}}]}}\n",
        nodes.children, nodes.nodeList, nodes.meshList, animations, buffer.accessorList, buffer.viewList,
        buffer.bytes.size(), base64(buffer.bytes));
}

} // namespace drystone
