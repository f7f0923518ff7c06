// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "RandomAssembly.h"

#include "texture/Arch.h"

#include <cmath>
#include <numbers>
#include <random>

namespace drystone
{
namespace
{

class Random
{
public:
    explicit Random(unsigned seed) : engine_(seed) {}

    /// Evenly from low to high; std::uniform_real_distribution differs among libraries.
    double between(double low, double high)
    {
        return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
    }
    int upTo(int most) { return std::min(most, static_cast<int>(between(0, most + 1.0))); }
    bool happens(double chance) { return between(0, 1) < chance; }

private:
    std::mt19937_64 engine_;
};

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
            // From the same end whichever side asks, so that both parts get the same corner.
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

    const Vector<2> gravity(0, -9.81);
    made.loads.dead = gravityLoad(made.assembly, made.masses, gravity);
    const double angle = random.between(0, 2 * std::numbers::pi);
    const Vector<2> direction(std::cos(angle), std::sin(angle));
    if (random.happens(0.5))
    {
        made.loads.live = inertialLoad(made.assembly, made.masses, gravity, direction);
    }
    else
    {
        std::vector<int> candidates;
        for (std::size_t block = 0; block < made.free.size(); ++block)
        {
            if (made.free[block] >= 0)
            {
                candidates.push_back(static_cast<int>(block));
            }
        }
        const int block =
            candidates[static_cast<std::size_t>(random.upTo(static_cast<int>(candidates.size()) - 1))];
        const Vector<2> at = made.assembly.blocks[static_cast<std::size_t>(block)].outline[0];
        made.loads.live =
            pointLoad(made.assembly, block, at, made.loads.dead.lpNorm<Eigen::Infinity>() * direction);
    }
    return made;
}

} // namespace drystone
