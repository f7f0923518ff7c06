// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rays of an axle's force that is spread, cut where the block changes that they meet.
#include "assembly/AxleRays.h"

#include "assembly/BlockShape.h"
#include "assembly/Loads.h"
#include "geometry/space/PolyhedronOverlap.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace drystone
{
namespace
{

/// A part of a ray [m].
struct Stretch
{
    double begin = 0;
    double end = std::numeric_limits<double>::infinity();
};

/// Of a ray from a point, in a box; nothing where it misses the box.
template<int Dim>
std::optional<Stretch> stretchIn(const Box<Dim>& box, const Vector<Dim>& from, const Vector<Dim>& direction)
{
    Stretch in;
    for (int axis = 0; axis < Dim; ++axis)
    {
        const double toLower = box.lower[axis] - from[axis];
        const double toUpper = box.upper[axis] - from[axis];
        if (direction[axis] == 0)
        {
            if (toLower > 0 || toUpper < 0)
            {
                return std::nullopt;
            }
            continue;
        }
        const double lower = toLower / direction[axis];
        const double upper = toUpper / direction[axis];
        in.begin = std::max(in.begin, std::min(lower, upper));
        in.end = std::min(in.end, std::max(lower, upper));
    }
    return in.begin <= in.end ? std::optional(in) : std::nullopt;
}

/// A plane of a face; outside is where the height is above 0.
template<int Dim>
struct FacePlane
{
    Vector<Dim> normal = Vector<Dim>::Zero();
    double offset = 0;
};

/// A block that rays may meet, and a box somewhat larger than what is as near to it as a joint is wide.
template<int Dim>
struct Target
{
    const Block<Dim>* shape = nullptr;
    int block = -1;
    Box<Dim> surroundings;
    std::vector<FacePlane<Dim>> faces; ///< of a convex block of space; else none
};

std::vector<FacePlane<2>> facesOf(const Block<2>& /*block*/)
{
    return {}; // distances from polygons are quick
}

std::vector<FacePlane<3>> facesOf(const Block<3>& block)
{
    std::vector<FacePlane<3>> faces;
    if (isConvex(block.shape))
    {
        for (const std::vector<int>& face : block.shape.faces)
        {
            const Vector<3> normal = areaVector(block.shape, face).normalized();
            faces.push_back(
                {normal, normal.dot(block.shape.vertices[static_cast<std::size_t>(face.front())])});
        }
    }
    return faces;
}

template<int Dim>
Target<Dim> targetOf(const Assembly<Dim>& assembly, int block, double tolerance)
{
    const Block<Dim>& shape = assembly.blocks[static_cast<std::size_t>(block)];
    return {&shape, block, enlarged<Dim>(boundingBox(shape), 2 * tolerance), facesOf(shape)};
}

/// Whether a point is on a block, or as near as a joint is wide. Far above a face of a convex block it is
/// not, and below all of them it is, which takes a tenth of the time of a distance.
template<int Dim>
bool isMet(const Target<Dim>& target, const Vector<Dim>& point, double tolerance)
{
    if (!target.faces.empty())
    {
        double height = -std::numeric_limits<double>::infinity();
        for (const FacePlane<Dim>& face : target.faces)
        {
            height = std::max(height, face.normal.dot(point) - face.offset);
        }
        if (height > tolerance || height <= 1e-3 * tolerance)
        {
            return height <= tolerance;
        }
    }
    return distanceFrom(*target.shape, point) <= tolerance;
}

/// Where along a ray from a point a block begins [m]; nothing where the ray misses it. \param in what the ray
/// has of the surroundings of the block
template<int Dim>
std::optional<double> entryOf(const Target<Dim>& target, const Vector<Dim>& from,
                              const Vector<Dim>& direction, const Stretch& in, double tolerance)
{
    std::vector<double> places = placesToCut(*target.shape, from, direction);
    places.push_back(0);
    std::sort(places.begin(), places.end());
    const auto first = std::lower_bound(places.begin(), places.end(), in.begin);
    const auto last = std::upper_bound(first, places.end(), in.end);
    const auto entry = std::find_if(first, last,
                                    [&](double place)
                                    {
                                        const Vector<Dim> point = from + place * direction;
                                        return isMet(target, point, tolerance);
                                    });
    return entry == last ? std::nullopt : std::optional(*entry);
}

/// \param among blocks in ascending order \param tolerance the width of a joint [m]
template<int Dim>
Landing landingOf(const std::vector<Target<Dim>>& among, double tolerance, const Vector<Dim>& from,
                  const Vector<Dim>& direction)
{
    Landing landing;
    for (const Target<Dim>& target : among)
    {
        const std::optional<Stretch> in = stretchIn<Dim>(target.surroundings, from, direction);
        if (!in || in->begin > landing.distance + tolerance)
        {
            continue;
        }
        const std::optional<double> entry = entryOf(target, from, direction, *in, tolerance);
        if (!entry || *entry > landing.distance + tolerance)
        {
            continue;
        }
        if (*entry < landing.distance - tolerance)
        {
            landing.blocks.clear();
        }
        landing.distance = std::min(landing.distance, *entry);
        landing.blocks.push_back(target.block);
    }
    return landing;
}

/// The force of an axle, spread: at u in [-1, 1] of the loaded length L a ray begins at u L/2 and goes along
/// f + u s a, with f the direction of the force, a the path's across it and s the spread: at the depth t it
/// is at u (L/2 + s t), so that the force is uniform over L + 2 s t. In space the same across the path, with
/// v.
template<int Dim>
struct SpreadAxle
{
    SpreadAxle(const MovingLoadSettings<Dim>& given, const Vector<Dim>& at) : settings(given), place(at)
    {
        force = settings.value.normalized();
        path = (settings.to - settings.from).normalized();
        const Vector<Dim> level = path - path.dot(force) * force;
        along = level.norm() > 0 ? Vector<Dim>(level.normalized()) : Vector<Dim>(Vector<Dim>::Zero());
    }

    Ray<Dim> ray(double u, [[maybe_unused]] double v) const
    {
        Vector<Dim> from = place + u * settings.loadedLength / 2 * path;
        Vector<Dim> direction = force + u * settings.spread * along;
        if constexpr (Dim == 3)
        {
            const Vector<3> across = force.cross(along);
            from += v * settings.loadedWidth / 2 * across;
            direction += v * settings.spread * across;
        }
        return {from, direction.normalized()};
    }

    const MovingLoadSettings<Dim>& settings;
    Vector<Dim> place;
    Vector<Dim> force;
    Vector<Dim> path;
    Vector<Dim> along;
};

/// The blocks that a spread axle can meet: those near its rays.
template<int Dim>
std::vector<Target<Dim>> targetsBelow(const Assembly<Dim>& assembly, const SpreadAxle<Dim>& axle,
                                      double tolerance)
{
    Box<Dim> box;
    extend<Dim>(box, axle.place);
    std::vector<Target<Dim>> targets;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        targets.push_back(targetOf<Dim>(assembly, static_cast<int>(i), tolerance));
        extend<Dim>(box, targets.back().surroundings.lower);
        extend<Dim>(box, targets.back().surroundings.upper);
    }
    const double farthest = (box.upper - box.lower).norm();
    Box<Dim> swept;
    for (const double u : {-1.0, 0.0, 1.0}) // the steepest is in the middle
    {
        for (const double v : {-1.0, 0.0, 1.0})
        {
            const Ray<Dim> ray = axle.ray(u, v);
            extend<Dim>(swept, ray.from);
            extend<Dim>(swept, Vector<Dim>(ray.from + 2 * farthest * ray.direction));
        }
    }
    std::erase_if(targets, [&](const Target<Dim>& target) { return !meet<Dim>(swept, target.surroundings); });
    return targets;
}

/// Cuts the force of an axle where the block changes that it meets, so that each block has its share.
template<int Dim>
class Cutting
{
public:
    Cutting(const Assembly<Dim>& ofBlocks, const SpreadAxle<Dim>& ofForce)
        : axle(ofForce), tolerance(widthOfAJoint(ofBlocks)), below(targetsBelow(ofBlocks, ofForce, tolerance))
    {
    }

    std::vector<Ray<Dim>> rays()
    {
        if constexpr (Dim == 2)
        {
            addStrip(0, 1, cutsOf(0));
        }
        else
        {
            double low = -1;
            std::vector<Cut> atLow = cutsOf(low);
            for (int i = 1; i <= strips; ++i)
            {
                const double high = 2.0 * i / strips - 1;
                std::vector<Cut> atHigh = cutsOf(high);
                addStrips(low, atLow, high, atHigh, mostHalvingsOfStrips);
                low = high;
                atLow = std::move(atHigh);
            }
        }
        return std::move(found);
    }

private:
    /// Rays along a strip, and the least of a block; strips; and how often what is between two is halved.
    static constexpr int parts = Dim == 2 ? 100 : 24;
    static constexpr int leastOfABlock = 20;
    static constexpr int strips = 24;
    static constexpr int mostHalvings = Dim == 2 ? 30 : 20;
    static constexpr int mostHalvingsOfStrips = 16;
    /// By which borders may bend within a strip, of the square of side 2 that u and v are in.
    static constexpr double leastArea = 1e-5;

    /// From where to where along a strip a block is met, or none (-1).
    struct Cut
    {
        int block;
        double begin;
        double end;
    };

    Ray<Dim> landed(double u, double v) const
    {
        Ray<Dim> ray = axle.ray(u, v);
        ray.landing = landingOf<Dim>(below, tolerance, ray.from, ray.direction);
        return ray;
    }

    int blockAt(double u, double v) const { return carrierOf(landed(u, v).landing); }

    std::vector<Cut> cutsOf(double v) const
    {
        std::vector<Cut> cuts{{blockAt(-1, v), -1, -1}};
        for (int i = 1; i <= parts; ++i)
        {
            addCuts(v, 2.0 * i / parts - 1, mostHalvings, cuts);
        }
        return cuts;
    }

    /// Goes on from the end of the last cut to `high`.
    void addCuts(double v, double high, int halvings, std::vector<Cut>& cuts) const
    {
        const int block = blockAt(high, v);
        if (block == cuts.back().block)
        {
            cuts.back().end = high;
            return;
        }
        const double middle = (cuts.back().end + high) / 2;
        if (halvings == 0)
        {
            cuts.back().end = middle;
            cuts.push_back({block, middle, high});
            return;
        }
        addCuts(v, middle, halvings - 1, cuts);
        addCuts(v, high, halvings - 1, cuts);
    }

    /// Whether the same blocks are met at both sides of a strip and in its middle, with borders that are
    /// straight in between, so that its middle stands for all of it.
    static bool areStraight(const std::vector<Cut>& atLow, const std::vector<Cut>& between,
                            const std::vector<Cut>& atHigh, double width)
    {
        if (atLow.size() != between.size() || atHigh.size() != between.size())
        {
            return false;
        }
        double bent = 0;
        for (std::size_t i = 0; i < between.size(); ++i)
        {
            if (atLow[i].block != between[i].block || atHigh[i].block != between[i].block)
            {
                return false;
            }
            bent += std::abs(atLow[i].begin + atHigh[i].begin - 2 * between[i].begin);
        }
        return bent * width <= leastArea;
    }

    /// Strips between two, finer where the blocks that they meet change, or their borders bend.
    void addStrips(double low, const std::vector<Cut>& atLow, double high, const std::vector<Cut>& atHigh,
                   int halvings)
    {
        const double middle = (low + high) / 2;
        const std::vector<Cut> between = cutsOf(middle);
        if (halvings == 0 || areStraight(atLow, between, atHigh, high - low))
        {
            addStrip(middle, (high - low) / 2, between);
            return;
        }
        addStrips(low, atLow, middle, between, halvings - 1);
        addStrips(middle, between, high, atHigh, halvings - 1);
    }

    /// \param share of the force
    void addStrip(double v, double share, const std::vector<Cut>& cuts)
    {
        for (const Cut& cut : cuts)
        {
            const double length = cut.end - cut.begin;
            const int count = std::max(leastOfABlock, static_cast<int>(std::ceil(length / 2 * parts - 1e-9)));
            for (int i = 0; cut.block >= 0 && length > 0 && i < count; ++i)
            {
                found.push_back(landed(cut.begin + (i + 0.5) / count * length, v));
                found.back().share = share * length / 2 / count;
            }
        }
    }

    const SpreadAxle<Dim>& axle;
    double tolerance; ///< the width of a joint [m]
    std::vector<Target<Dim>> below;
    std::vector<Ray<Dim>> found;
};

} // namespace

int carrierOf(const Landing& landing)
{
    return landing.blocks.empty() ? -1 : landing.blocks.front();
}

template<int Dim>
Landing landingOf(const Assembly<Dim>& assembly, const Vector<Dim>& from, const Vector<Dim>& direction)
{
    const double tolerance = widthOfAJoint(assembly);
    std::vector<Target<Dim>> all;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        all.push_back(targetOf<Dim>(assembly, static_cast<int>(i), tolerance));
    }
    return landingOf<Dim>(all, tolerance, from, direction);
}

template<int Dim>
std::vector<Ray<Dim>> raysOf(const Assembly<Dim>& assembly, const MovingLoadSettings<Dim>& settings,
                             const Vector<Dim>& place)
{
    if (settings.spread == 0 && settings.loadedLength == 0 && settings.loadedWidth == 0)
    {
        const Vector<Dim> direction = settings.value.normalized();
        return {{place, direction, 1, landingOf<Dim>(assembly, place, direction)}};
    }
    const SpreadAxle<Dim> axle(settings, place);
    return Cutting<Dim>(assembly, axle).rays();
}

template Landing landingOf(const Assembly<2>& assembly, const Vector<2>& from, const Vector<2>& direction);
template std::vector<Ray<2>> raysOf(const Assembly<2>& assembly, const MovingLoadSettings<2>& settings,
                                    const Vector<2>& place);
template Landing landingOf(const Assembly<3>& assembly, const Vector<3>& from, const Vector<3>& direction);
template std::vector<Ray<3>> raysOf(const Assembly<3>& assembly, const MovingLoadSettings<3>& settings,
                                    const Vector<3>& place);

} // namespace drystone
