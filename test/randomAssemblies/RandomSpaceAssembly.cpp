// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "RandomSpaceAssembly.h"
#include "../MadeStructure.h"

#include "Random.h"

#include "contact/PointAreas.h"
#include "dictionary/Dictionary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace drystone
{
namespace
{

Assembly<3> onGround(const std::vector<Polyhedron>& shapes)
{
    Assembly<3> assembly;
    assembly.supports = {{"ground", "ground"}};
    for (const Polyhedron& shape : shapes)
    {
        assembly.blocks.push_back({shape, -1});
    }
    assembly.blocks.push_back({makeBox({-50, -50, -1}, {50, 50, 0}), 0});
    return assembly;
}

/// Turned boxes on each other; some overhang too far.
Assembly<3> boxes(Random& random)
{
    std::vector<Polyhedron> shapes;
    double bottom = 0;
    Vector<2> centre(0, 0);
    const int count = 1 + random.upTo(9);
    for (int i = 0; i < count; ++i)
    {
        const Vector<2> half(random.between(0.15, 0.6), random.between(0.15, 0.6));
        const double top = bottom + (random.happens(0.1) ? 1e-3 : random.between(0.1, 0.8));
        const double angle = random.happens(0.3) ? 0 : random.between(-0.8, 0.8);
        const Vector<2> along(std::cos(angle), std::sin(angle));
        std::vector<Vector<3>> below;
        std::vector<Vector<3>> above;
        for (const auto& [u, v] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
        {
            const Vector<2> corner = centre + u * half.x() * along + v * half.y() * perpendicular(along);
            below.emplace_back(corner.x(), corner.y(), bottom);
            above.emplace_back(corner.x(), corner.y(), top);
        }
        shapes.push_back(makePrism(below, above));
        bottom = top;
        const double shift = random.happens(0.15) ? 0.9 : 0.3;
        centre += shift * half.minCoeff() * Vector<2>(random.between(-1, 1), random.between(-1, 1));
    }
    return onGround(shapes);
}

/// The part of a convex polyhedron where normal . x <= offset; nothing where a corner comes nearer to the
/// plane or to another corner than a length, unless it lies on the plane.
std::optional<Polyhedron> partBelow(const Polyhedron& whole, const Vector<3>& normal, double offset,
                                    double least)
{
    Polyhedron part;
    std::map<int, int> kept;
    std::map<std::pair<int, int>, int> crossings;
    std::vector<int> cap;
    const auto side = [&](int vertex) { return normal.dot(whole.vertices[vertex]) - offset; };
    for (std::size_t vertex = 0; vertex < whole.vertices.size(); ++vertex)
    {
        const double distance = side(static_cast<int>(vertex));
        if (std::abs(distance) < least)
        {
            return {};
        }
        if (distance < 0)
        {
            kept[static_cast<int>(vertex)] = static_cast<int>(part.vertices.size());
            part.vertices.push_back(whole.vertices[vertex]);
        }
    }
    for (const std::vector<int>& face : whole.faces)
    {
        std::vector<int> cut;
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            const int from = face[i];
            const int to = face[(i + 1) % face.size()];
            if (side(from) < 0)
            {
                cut.push_back(kept.at(from));
            }
            if (side(from) * side(to) < 0)
            {
                const auto [lower, upper] = std::minmax(from, to);
                const auto [entry, isNew] = crossings.try_emplace({lower, upper}, 0);
                if (isNew)
                {
                    const double share = side(lower) / (side(lower) - side(upper));
                    entry->second = static_cast<int>(part.vertices.size());
                    cap.push_back(entry->second);
                    part.vertices.emplace_back((1 - share) * whole.vertices[lower]
                                               + share * whole.vertices[upper]);
                }
                cut.push_back(entry->second);
            }
        }
        if (cut.size() >= 3)
        {
            part.faces.push_back(cut);
        }
    }
    if (cap.size() < 3)
    {
        return whole;
    }
    Vector<3> middle = Vector<3>::Zero();
    for (const int vertex : cap)
    {
        middle += part.vertices[vertex] / static_cast<double>(cap.size());
    }
    const Eigen::Matrix3d frame = frameOf(normal);
    const auto angle = [&](int vertex)
    {
        const Vector<3> arm = part.vertices[vertex] - middle;
        return std::atan2(arm.dot(frame.col(2)), arm.dot(frame.col(1)));
    };
    std::sort(cap.begin(), cap.end(), [&](int one, int two) { return angle(one) < angle(two); });
    part.faces.push_back(cap);
    for (std::size_t i = 0; i < part.vertices.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            if ((part.vertices[i] - part.vertices[j]).norm() < least)
            {
                return {};
            }
        }
    }
    return part;
}

/// A box cut by planes, most of them nearly level, some through all of its parts.
Assembly<3> cuts(Random& random)
{
    const Vector<3> size(random.between(0.4, 1.5), random.between(0.4, 1.5), random.between(0.5, 3));
    std::vector<Polyhedron> parts{makeBox({0, 0, 0}, size)};
    const int planes = 1 + random.upTo(5);
    for (int plane = 0; plane < planes; ++plane)
    {
        Vector<3> normal = random.direction();
        if (random.happens(0.7))
        {
            normal = (Vector<3>(0, 0, 1) + random.between(0, 0.6) * normal).normalized();
        }
        const double share = random.happens(0.6) ? 1 : 0.6;
        const Vector<3> through(size.x() * random.between(0.2, 0.8), size.y() * random.between(0.2, 0.8),
                                size.z() * random.between(0.1, 0.9));
        const double offset = normal.dot(through);
        std::vector<Polyhedron> next;
        bool isSound = true;
        for (const Polyhedron& part : parts)
        {
            const bool isMeant = random.happens(share);
            const std::optional<Polyhedron> below = partBelow(part, normal, offset, 0.01);
            const std::optional<Polyhedron> above = partBelow(part, -normal, -offset, 0.01);
            isSound = isSound && below && above;
            if (!isMeant || !below || !above || below->vertices.empty() || above->vertices.empty()
                || *below == part || *above == part)
            {
                next.push_back(part);
                continue;
            }
            next.push_back(*below);
            next.push_back(*above);
        }
        if (isSound)
        {
            parts = std::move(next);
        }
    }
    return onGround(parts);
}

Assembly<3> walls(Random& random)
{
    static const char* const bonds[] = {"running", "header", "english", "flemish", "stack"};
    const int length = 3 + random.upTo(2);
    const double width = random.between(0.1, 0.2);
    const bool hasReturn = random.happens(0.4);
    const char* bond = hasReturn ? "running" : bonds[random.upTo(4)];
    const std::string side =
        hasReturn ? fmt::format("side {{ from (0 0); direction (0 1); length {}; thickness right; }}",
                                2 + random.upTo(1))
                  : "";
    return madeStructure<3>(Dictionary::readString(
        fmt::format(
            "dimensions 3; texture {{ type walls; unit ({:.17g} {:.17g} {:.17g}); bond {}; courses {}; "
            "walls {{ front {{ from (0 0); direction (1 0); length {}; thickness left; }} {} }} }} "
            "supports {{ ground {{ type ground; }} }}",
            2 * width, width, random.between(0.06, 0.2), bond, 2 + random.upTo(4), length, side),
        "blockTextureDict"));
}

} // namespace

RandomSpaceAssembly randomSpaceAssembly(unsigned seed)
{
    Random random(seed);
    RandomSpaceAssembly made;
    switch (random.upTo(2))
    {
    case 0:
        made.family = "boxes";
        made.assembly = boxes(random);
        break;
    case 1:
        made.family = "cuts";
        made.assembly = cuts(random);
        break;
    default:
        made.family = "walls";
        made.assembly = walls(random);
        break;
    }
    // A block may be held.
    if (made.assembly.blocks.size() > 3 && random.happens(0.1))
    {
        made.assembly.supports.push_back({"held", "blocks"});
        made.assembly
            .blocks[static_cast<std::size_t>(random.upTo(static_cast<int>(made.assembly.blocks.size()) - 2))]
            .support = static_cast<int>(made.assembly.supports.size()) - 1;
    }
    made.mu = 0.1 * std::pow(20.0, random.between(0, 1));
    made.blocks = blockMasses(made.assembly);
    made.free = freeIndices(made.assembly);
    made.points = findContactPoints(made.assembly);
    std::vector<double> masses;
    double height = 0;
    for (std::size_t block = 0; block < made.blocks.size(); ++block)
    {
        masses.push_back(2000 * made.blocks[block].volume);
        for (const Vector<3>& vertex : made.assembly.blocks[block].shape.vertices)
        {
            height = std::max(height, vertex.z());
        }
    }
    const Vector<3> gravity(0, 0, -9.81);
    made.loads.dead = gravityLoad(made.assembly, masses, gravity);
    const Vector<3> direction = random.direction();
    made.loads.live =
        randomLiveLoad<3>(made.assembly, masses, made.free, made.loads.dead, gravity, direction, 0.7, random);
    if (random.happens(0.4))
    {
        const double pressure = 2000 * 9.81 * height;
        Strength perArea;
        perArea.tension = random.happens(0.5) ? 0 : pressure * random.between(0, 1);
        perArea.cohesion =
            made.mu * perArea.tension + (random.happens(0.5) ? 0 : pressure * random.between(0, 1));
        if (random.happens(0.6))
        {
            perArea.crushing = pressure * std::exp(random.between(0.5, 6));
        }
        for (const double area : pointAreas(made.assembly, made.points))
        {
            made.strength.push_back(
                {perArea.cohesion * area, perArea.tension * area, perArea.crushing * area});
        }
    }
    return made;
}

} // namespace drystone
