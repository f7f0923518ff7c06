// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "RandomAssembly.h"

#include "Random.h"

#include "texture/Arch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drystone
{
namespace
{

Block<2> rectangle(double left, double bottom, double right, double top, int support = -1)
{
    return {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, 1, support};
}

Assembly<2> onGround()
{
    Assembly<2> assembly;
    assembly.supports = {{"ground", "blocks"}};
    assembly.blocks.push_back(rectangle(-50, -1, 50, 0, 0));
    return assembly;
}

/// Rectangles on each other, shifted at random; some overhang too far.
Assembly<2> stack(Random& random)
{
    Assembly<2> assembly = onGround();
    double left = 0, right = random.between(0.3, 2), top = 0;
    const int count = 1 + random.upTo(14);
    for (int block = 0; block < count; ++block)
    {
        const double height = random.happens(0.1) ? 1e-4 : random.between(0.1, 1);
        assembly.blocks.push_back(rectangle(left, top, right, top + height));
        top += height;
        const double width = random.between(0.3, 2);
        const double shift = random.happens(0.1) ? 0.95 : 0.35;
        const double centre = (left + right) / 2 + shift * (right - left) / 2 * random.between(-1, 1);
        left = centre - width / 2;
        right = centre + width / 2;
    }
    return assembly;
}

/// Courses of rectangles of random lengths, with head joints that fall where they will; here and there a
/// hole.
Assembly<2> courses(Random& random)
{
    Assembly<2> assembly = onGround();
    const double length = random.between(1.5, 4);
    const int rows = 2 + random.upTo(5);
    double bottom = 0;
    for (int row = 0; row < rows; ++row)
    {
        const double top = bottom + random.between(0.2, 0.5);
        double left = 0;
        while (left < length)
        {
            double right = left + random.between(0.25, 0.9);
            right = right > length - 0.2 ? length : right;
            const bool isHole = row > 0 && row + 1 < rows && random.happens(0.05);
            if (!isHole)
            {
                assembly.blocks.push_back(rectangle(left, bottom, right, top));
            }
            left = right;
        }
        bottom = top;
    }
    return assembly;
}

/// The part of a convex polygon on the left of a line.
Polygon cut(const Polygon& polygon, const Vector<2>& point, const Vector<2>& along)
{
    Polygon part;
    const auto side = [&](const Vector<2>& corner) { return cross(along, corner - point); };
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Vector<2>& from = polygon[i];
        const Vector<2>& to = polygon[(i + 1) % polygon.size()];
        const double a = side(from), b = side(to);
        if (a >= 0)
        {
            part.push_back(from);
        }
        if ((a > 0 && b < 0) || (a < 0 && b > 0))
        {
            // From the same end for either side, so that both parts get the same corner.
            const bool isSwapped = a < 0;
            const Vector<2> p = isSwapped ? to : from, q = isSwapped ? from : to;
            const double u = isSwapped ? b : a, v = isSwapped ? a : b;
            part.push_back(p + (q - p) * (u / (u - v)));
        }
    }
    return part;
}

double shortestEdge(const Polygon& polygon)
{
    double least = 1e9;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        least = std::min(least, (polygon[(i + 1) % polygon.size()] - polygon[i]).norm());
    }
    return least;
}

/// A rectangle cut by random lines again and again: convex polygons with T joints.
Assembly<2> polygons(Random& random)
{
    Assembly<2> assembly = onGround();
    std::vector<Polygon> pieces{{{0, 0}, {2, 0}, {2, 1.5}, {0, 1.5}}};
    const int cuts = 2 + random.upTo(18);
    for (int i = 0; i < cuts; ++i)
    {
        const auto which = static_cast<std::size_t>(random.upTo(static_cast<int>(pieces.size()) - 1));
        Vector<2> middle(0, 0);
        for (const Vector<2>& corner : pieces[which])
        {
            middle += corner / static_cast<double>(pieces[which].size());
        }
        const double angle = random.between(0, std::numbers::pi);
        const Vector<2> along(std::cos(angle), std::sin(angle));
        const Polygon left = cut(pieces[which], middle, along);
        const Polygon right = cut(pieces[which], middle, -along);
        if (left.size() >= 3 && right.size() >= 3 && shortestEdge(left) > 0.02 && shortestEdge(right) > 0.02)
        {
            pieces[which] = left;
            pieces.push_back(right);
        }
    }
    for (const Polygon& piece : pieces)
    {
        assembly.blocks.push_back({piece, 1, -1});
    }
    return assembly;
}

Assembly<2> arch(Random& random)
{
    Arch shape;
    shape.thickness = random.between(0.05, 0.4);
    shape.voussoirs = 3 + random.upTo(30);
    shape.angle = random.happens(0.5) ? 180 : random.between(60, 180);
    return makeAssembly(shape);
}

/// Size, masses and contact points of an assembly.
void finish(RandomAssembly& made, Random& random)
{
    made.size = std::pow(10, std::round(random.between(-3, 3))); // of lengths
    for (Block<2>& block : made.assembly.blocks)
    {
        for (Vector<2>& corner : block.outline)
        {
            corner *= made.size;
        }
    }
    made.blocks = blockMasses(made.assembly);
    made.free = freeIndices(made.assembly);
    const double density = std::pow(10, random.between(-2, 4));
    for (const BlockMass<2>& block : made.blocks)
    {
        made.masses.push_back(density * block.volume * (random.happens(0.1) ? 1e3 : 1));
    }
    made.points = findContactPoints(made.assembly);
}

/// A slab on pads at any places, with blocks on it.
Assembly<2> slab(Random& random)
{
    Assembly<2> assembly;
    const int pads = 2 + random.upTo(3);
    for (int pad = 0; pad < pads; ++pad)
    {
        const double middle = (pad + random.between(0.2, 0.8)) * 2 / pads;
        const double half = random.between(0.02, 0.2) * 2 / pads;
        assembly.blocks.push_back(rectangle(middle - half, -1, middle + half, 0, pad));
        assembly.supports.push_back({"pad", "blocks"});
    }
    assembly.blocks.push_back(rectangle(0, 0, 2, random.between(0.1, 0.5)));
    const double top = assembly.blocks.back().outline[2].y();
    for (double left = random.between(0, 1); left < 1.5 && random.happens(0.7);)
    {
        const double right = left + random.between(0.1, 0.4);
        assembly.blocks.push_back(rectangle(left, top, right, top + random.between(0.1, 2)));
        left = right + random.between(0, 0.3);
    }
    return assembly;
}

/// Cuts a slab of ground in two or three, each a support of its own, under the free blocks: anywhere, or just
/// below a corner or the middle of one.
void cutGround(Assembly<2>& assembly, Random& random)
{
    const auto cut = [&]
    {
        const int count = static_cast<int>(assembly.blocks.size());
        const Polygon& outline =
            assembly.blocks[static_cast<std::size_t>(1 + random.upTo(count - 2))].outline;
        const double left = outline[0].x(), right = outline[1].x();
        const double places[] = {left, right, (left + right) / 2};
        return random.happens(0.5) ? places[random.upTo(2)] : left + (right - left) * random.between(0, 1);
    };
    std::vector<double> cuts{-50, cut(), 50};
    if (random.happens(0.5))
    {
        cuts.push_back(cut());
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end(), [](double a, double b) { return b - a < 1e-3; }),
               cuts.end());
    assembly.supports.clear();
    assembly.blocks.erase(assembly.blocks.begin());
    for (std::size_t piece = 0; piece + 1 < cuts.size(); ++piece)
    {
        assembly.blocks.push_back(rectangle(cuts[piece], -1, cuts[piece + 1], 0, static_cast<int>(piece)));
        assembly.supports.push_back({"piece", "blocks"});
    }
}

} // namespace

RandomAssembly randomAssembly(unsigned seed)
{
    Random random(seed);
    RandomAssembly made;
    switch (random.upTo(3))
    {
    case 0:
        made.family = "stack";
        made.assembly = stack(random);
        break;
    case 1:
        made.family = "courses";
        made.assembly = courses(random);
        break;
    case 2:
        made.family = "polygons";
        made.assembly = polygons(random);
        break;
    default:
        made.family = "arch";
        made.assembly = arch(random);
        break;
    }
    const double special[] = {0, 1e-12, 1.5, 3};
    made.mu = random.happens(0.15) ? special[random.upTo(3)] : random.between(0.05, 1);

    finish(made, random);

    const Vector<2> gravity(0, -9.81);
    made.loads.dead = gravityLoad(made.assembly, made.masses, gravity);
    const double angle = random.between(0, 2 * std::numbers::pi);
    const Vector<2> direction(std::cos(angle), std::sin(angle));
    made.loads.live = randomLiveLoad<2>(made.assembly, made.masses, made.free, made.loads.dead, gravity,
                                        direction, 0.5, random);
    return made;
}

RandomAssembly randomSettlement(unsigned seed)
{
    Random random(seed);
    RandomAssembly made;
    switch (random.upTo(3))
    {
    case 0:
        made.family = "stack";
        made.assembly = stack(random);
        cutGround(made.assembly, random);
        break;
    case 1:
        made.family = "courses";
        made.assembly = courses(random);
        cutGround(made.assembly, random);
        break;
    case 2:
        made.family = "arch";
        made.assembly = arch(random);
        break;
    default:
        made.family = "slab";
        made.assembly = slab(random);
        break;
    }
    made.mu = random.happens(0.1) ? 0 : random.between(0.05, 1.5);
    finish(made, random);
    made.loads.dead = gravityLoad(made.assembly, made.masses, {0, -9.81});
    const double angle = random.between(0, 2 * std::numbers::pi);
    std::vector<int> touching; // the supports that bear blocks
    for (const ContactPoint<2>& point : made.points)
    {
        for (const int block : {point.block, point.neighbour})
        {
            if (const int support = made.assembly.blocks[static_cast<std::size_t>(block)].support;
                support >= 0)
            {
                touching.push_back(support);
            }
        }
    }
    made.loads.movement = SupportMovement<2>{
        touching[static_cast<std::size_t>(random.upTo(static_cast<int>(touching.size()) - 1))],
        random.happens(0.6) ? Vector<2>(0, -1) : Vector<2>(std::cos(angle), std::sin(angle))};
    return made;
}

} // namespace drystone
