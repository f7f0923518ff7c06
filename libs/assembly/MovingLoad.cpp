// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Places of a moving load, and its axles on the blocks that their rays meet.
#include "assembly/MovingLoad.h"

#include "assembly/AxleRays.h"
#include "assembly/LoadTypes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

namespace drystone
{
namespace
{

/// Of a place along the path, from its beginning [m].
template<int Dim>
double distanceOf(const MovingLoadSettings<Dim>& settings, int place)
{
    return place * (settings.to - settings.from).norm() / (settings.positions - 1);
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
        const std::vector<Ray<Dim>> rays = raysOf(assembly, settings, from, choice);
        // Parallel forces on a block are one, at their centre.
        std::map<int, std::pair<double, Vector<Dim>>> onBlocks;
        std::vector<int> carrying;
        for (const Ray<Dim>& ray : rays)
        {
            const int block = carrierOf(ray.landing, choice);
            if (block < 0 || assembly.blocks[block].support >= 0)
            {
                continue;
            }
            const auto [onBlock, isNew] = onBlocks.try_emplace(block, 0.0, Vector<Dim>::Zero());
            onBlock->second.first += ray.share;
            onBlock->second.second += ray.share * (ray.from + ray.landing.distance * ray.direction);
            if (isNew)
            {
                carrying.push_back(block);
            }
        }
        for (const auto& [block, parts] : onBlocks)
        {
            const Eigen::VectorXd load = pointLoad(assembly, block, Vector<Dim>(parts.second / parts.first),
                                                   Vector<Dim>(factor * parts.first * settings.value))
                                             .rows;
            met += factor * parts.first;
            position.live = position.live.size() == 0 ? load : Eigen::VectorXd(position.live + load);
        }
        position.blocks.insert(position.blocks.end(), carrying.begin(), carrying.end());
        if (!carrying.empty())
        {
            const Landing middle = landingOf<Dim>(assembly, from, direction);
            const int block = carrierOf(middle, choice);
            position.axles.push_back({block < 0 ? from : Vector<Dim>(from + middle.distance * direction),
                                      block < 0 ? carrying.front() : block, factor});
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
    for (int i = 0; i < settings.positions; ++i)
    {
        const double distance = distanceOf(settings, i);
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

template<int Dim>
std::vector<double> placesWithoutLoad(const std::vector<LoadPosition<Dim>>& positions,
                                      const MovingLoadSettings<Dim>& settings)
{
    std::vector<double> without;
    auto next = positions.begin();
    for (int i = 0; i < settings.positions; ++i)
    {
        const double distance = distanceOf(settings, i);
        if (next == positions.end() || next->distance != distance)
        {
            without.push_back(distance);
        }
        while (next != positions.end() && next->distance == distance) // twice at a joint
        {
            ++next;
        }
    }
    return without;
}

template void declare(Options& options, MovingLoadSettings<2>& settings);
template void declare(Options& options, MovingLoadSettings<3>& settings);
template std::vector<LoadPosition<2>> movingLoad(const Assembly<2>& assembly,
                                                 const MovingLoadSettings<2>& settings);
template std::vector<LoadPosition<3>> movingLoad(const Assembly<3>& assembly,
                                                 const MovingLoadSettings<3>& settings);
template std::vector<double> placesWithoutLoad(const std::vector<LoadPosition<2>>& positions,
                                               const MovingLoadSettings<2>& settings);
template std::vector<double> placesWithoutLoad(const std::vector<LoadPosition<3>>& positions,
                                               const MovingLoadSettings<3>& settings);

} // namespace drystone
