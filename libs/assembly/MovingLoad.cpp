// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Places of a moving load, and the blocks that it meets.
#include "assembly/MovingLoad.h"

#include "assembly/BlockShape.h"
#include "assembly/LoadTypes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace drystone
{
namespace
{

/// Where along a ray from a point a block begins [m]; nothing where the ray misses it.
template<int Dim>
std::optional<double> entryOf(const Block<Dim>& block, const Vector<Dim>& from, const Vector<Dim>& direction,
                              double tolerance)
{
    std::optional<double> first;
    std::vector<double> places = placesToCut(block, from, direction);
    places.push_back(0);
    for (const double place : places)
    {
        if (place >= 0 && (!first || place < *first)
            && distanceFrom(block, Vector<Dim>(from + place * direction)) <= tolerance)
        {
            first = place;
        }
    }
    return first;
}

/// What an axle meets: how far along its force, and the blocks there, ascending. None: it falls past all.
struct Landing
{
    double distance = std::numeric_limits<double>::infinity(); ///< [m]
    std::vector<int> blocks;
};

template<int Dim>
Landing landingOf(const Assembly<Dim>& assembly, const Vector<Dim>& from, const Vector<Dim>& direction)
{
    const double tolerance = widthOfAJoint(assembly);
    Landing landing;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const std::optional<double> entry = entryOf(assembly.blocks[i], from, direction, tolerance);
        if (!entry || *entry > landing.distance + tolerance)
        {
            continue;
        }
        if (*entry < landing.distance - tolerance)
        {
            landing.blocks.clear();
        }
        landing.distance = std::min(landing.distance, *entry);
        landing.blocks.push_back(static_cast<int>(i));
    }
    return landing;
}

enum class Choice
{
    lowest,
    highest
};

/// A part of an axle's force on its way to the blocks.
template<int Dim>
struct Ray
{
    Vector<Dim> from = Vector<Dim>::Zero();
    Vector<Dim> direction = Vector<Dim>::Zero(); ///< of unit length
};

/// Where on [-1, 1] the middles of `count` equal parts lie.
double middleOf(int part, int count)
{
    return (2.0 * part + 1) / count - 1;
}

/// Equal parts of an axle: at u in [-1, 1] of the loaded length L the ray begins at u L/2 and goes along
/// f + u s a, with f the direction of the force, a the path's across it and s the spread: at the depth t it
/// is at u (L/2 + s t), so that the force is uniform over L + 2 s t. In space the same across the path.
template<int Dim>
std::vector<Ray<Dim>> raysOf(const MovingLoadSettings<Dim>& settings, const Vector<Dim>& place)
{
    const Vector<Dim> force = settings.value.normalized();
    if (settings.spread == 0 && settings.loadedLength == 0 && settings.loadedWidth == 0)
    {
        return {{place, force}};
    }
    const Vector<Dim> path = (settings.to - settings.from).normalized();
    const Vector<Dim> level = path - path.dot(force) * force;
    const Vector<Dim> along = level.norm() > 0 ? Vector<Dim>(level.normalized()) : Vector<Dim>::Zero();
    std::vector<Ray<Dim>> rays;
    if constexpr (Dim == 2)
    {
        constexpr int count = 400;
        for (int i = 0; i < count; ++i)
        {
            const double u = middleOf(i, count);
            rays.push_back({place + u * settings.loadedLength / 2 * path,
                            (force + u * settings.spread * along).normalized()});
        }
    }
    else
    {
        constexpr int count = 24;
        const Vector<3> across = force.cross(along);
        for (int i = 0; i < count * count; ++i)
        {
            const double u = middleOf(i / count, count);
            const double v = middleOf(i % count, count);
            rays.push_back(
                {place + u * settings.loadedLength / 2 * path + v * settings.loadedWidth / 2 * across,
                 (force + settings.spread * (u * along + v * across)).normalized()});
        }
    }
    return rays;
}

/// The load of the axles at a position, each on one of the blocks that it meets.
template<int Dim>
LoadPosition<Dim> loadAt(const Assembly<Dim>& assembly, const MovingLoadSettings<Dim>& settings,
                         double distance, Choice choice)
{
    const Vector<Dim> along = (settings.to - settings.from).normalized();
    const Vector<Dim> direction = settings.value.normalized();
    LoadPosition<Dim> position;
    position.distance = distance;
    position.place = settings.from + distance * along;
    std::vector<std::pair<double, double>> axles = settings.axles;
    if (axles.empty())
    {
        axles.emplace_back(0, 1);
    }
    double met = 0;
    double all = 0;
    for (const auto& [offset, factor] : axles)
    {
        all += factor;
        const Vector<Dim> from = position.place + offset * along;
        const std::vector<Ray<Dim>> rays = raysOf(settings, from);
        std::vector<int> carrying;
        for (const Ray<Dim>& ray : rays)
        {
            const Landing landing = landingOf<Dim>(assembly, ray.from, ray.direction);
            if (landing.blocks.empty())
            {
                continue;
            }
            const int block = choice == Choice::lowest ? landing.blocks.front() : landing.blocks.back();
            if (assembly.blocks[block].support >= 0)
            {
                continue;
            }
            const Eigen::VectorXd load =
                pointLoad(assembly, block, Vector<Dim>(ray.from + landing.distance * ray.direction),
                          Vector<Dim>(factor / static_cast<double>(rays.size()) * settings.value));
            met += factor / static_cast<double>(rays.size());
            position.live = position.live.size() == 0 ? load : Eigen::VectorXd(position.live + load);
            if (std::find(carrying.begin(), carrying.end(), block) == carrying.end())
            {
                carrying.push_back(block);
            }
        }
        position.blocks.insert(position.blocks.end(), carrying.begin(), carrying.end());
        if (!carrying.empty())
        {
            const Landing middle = landingOf<Dim>(assembly, from, direction);
            const int block = middle.blocks.empty()      ? carrying.front()
                              : choice == Choice::lowest ? middle.blocks.front()
                                                         : middle.blocks.back();
            position.axles.push_back(
                {middle.blocks.empty() ? from : Vector<Dim>(from + middle.distance * direction), block,
                 factor});
        }
    }
    position.beside = 1 - met / all;
    return position;
}

} // namespace

template<int Dim>
void declare(Options& options, MovingLoadSettings<Dim>& settings)
{
    options.required("from", settings.from, "beginning of the path, above the blocks or on them")
        .unit("m")
        .example(Dim == 2 ? "(-0.9 1.2)" : "(-0.9 0.5 1.2)");
    options.required("to", settings.to, "its end")
        .unit("m")
        .example(Dim == 2 ? "(0.9 1.2)" : "(0.9 0.5 1.2)");
    options.optional("positions", settings.positions, "at equal distances along the path, both ends included")
        .atLeast(2)
        .atMost(100000);
    options
        .required("value", settings.value,
                  "force of an axle; it acts on the first block that it meets on its way from the path")
        .unit("N")
        .example(downwards<Dim>("1000"));
    options
        .optional("axles", settings.axles,
                  "offset of each axle along the path [m] and its factor on value; absent: one axle")
        .example("((0 1) (1.2 0.5))");
    options
        .optional("loadedLength", settings.loadedLength,
                  "of an axle on the path, along it: the length of a tyre")
        .unit("m")
        .atLeast(0);
    if constexpr (Dim == 3)
    {
        options.optional("loadedWidth", settings.loadedWidth, "across the path").unit("m").atLeast(0);
    }
    options
        .optional(
            "spread", settings.spread,
            "of the load through a fill: by how much it widens on each side for each metre below the path, "
            "as 0.5 for 1:2; it acts uniformly over that width")
        .atLeast(0)
        .usual(0, 1);
    options.check("to",
                  [&settings]() -> std::string
                  {
                      return settings.from == settings.to
                                 ? "A path needs two different ends. For a load at one place write `type "
                                   "force;`."
                                 : "";
                  });
    options.check("value", [&settings] { return faultOfForce<Dim>(settings.value); });
    options.check("axles",
                  [&settings]() -> std::string
                  {
                      return std::any_of(settings.axles.begin(), settings.axles.end(),
                                         [](const auto& axle) { return !(axle.second > 0); })
                                 ? "The factor of an axle must be above 0."
                                 : "";
                  });
}

template<int Dim>
std::vector<LoadPosition<Dim>> movingLoad(const Assembly<Dim>& assembly,
                                          const MovingLoadSettings<Dim>& settings)
{
    std::vector<LoadPosition<Dim>> positions;
    const double length = (settings.to - settings.from).norm();
    for (int i = 0; i < settings.positions; ++i)
    {
        const double distance = i * length / (settings.positions - 1);
        LoadPosition<Dim> lowest = loadAt(assembly, settings, distance, Choice::lowest);
        // A load that is spread over both sides of a joint is one load.
        const bool isSpread = settings.spread > 0 || settings.loadedLength > 0 || settings.loadedWidth > 0;
        LoadPosition<Dim> highest =
            isSpread ? LoadPosition<Dim>() : loadAt(assembly, settings, distance, Choice::highest);
        const bool isOneOnly = isSpread || lowest.blocks == highest.blocks;
        for (LoadPosition<Dim>* position : {&lowest, &highest})
        {
            if (!position->blocks.empty() && !(isOneOnly && position == &highest))
            {
                positions.push_back(std::move(*position));
            }
        }
    }
    return positions;
}

template void declare(Options& options, MovingLoadSettings<2>& settings);
template void declare(Options& options, MovingLoadSettings<3>& settings);
template std::vector<LoadPosition<2>> movingLoad(const Assembly<2>& assembly,
                                                 const MovingLoadSettings<2>& settings);
template std::vector<LoadPosition<3>> movingLoad(const Assembly<3>& assembly,
                                                 const MovingLoadSettings<3>& settings);

} // namespace drystone
