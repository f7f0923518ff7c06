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

/// Offsets of the axles along the path and their factors.
template<int Dim>
std::vector<std::pair<double, double>> axlesOf(const MovingLoadSettings<Dim>& settings)
{
    return settings.axles.empty() ? std::vector<std::pair<double, double>>{{0, 1}} : settings.axles;
}

/// An axle at a position, and what it meets.
template<int Dim>
struct Axle
{
    double factor = 1;
    Vector<Dim> from = Vector<Dim>::Zero(); ///< on the path [m]
    std::vector<Ray<Dim>> rays;
    Landing middle;            ///< of the ray in its middle
    std::vector<int> carriers; ///< which it may act on, if not spread; -1: what is fixed, or none
};

/// The blocks that an axle may act on at a joint, in ascending order. Fixed ones are one choice: no load.
template<int Dim>
std::vector<int> carriersOf(const Assembly<Dim>& assembly, const Landing& landing)
{
    std::vector<int> carriers;
    for (const int met : landing.blocks)
    {
        const int block = assembly.blocks[static_cast<std::size_t>(met)].support >= 0 ? -1 : met;
        if (std::find(carriers.begin(), carriers.end(), block) == carriers.end())
        {
            carriers.push_back(block);
        }
    }
    return carriers.empty() ? std::vector<int>{-1} : carriers;
}

template<int Dim>
std::vector<Axle<Dim>> axlesAt(const Assembly<Dim>& assembly, const MovingLoadSettings<Dim>& settings,
                               const Vector<Dim>& place)
{
    const Vector<Dim> along = (settings.to - settings.from).normalized();
    std::vector<Axle<Dim>> axles;
    for (const auto& [offset, factor] : axlesOf(settings))
    {
        Axle<Dim> axle;
        axle.factor = factor;
        axle.from = place + offset * along;
        axle.rays = raysOf(assembly, settings, axle.from);
        axle.middle = landingOf<Dim>(assembly, axle.from, settings.value.normalized());
        axle.carriers = carriersOf(assembly, axle.middle);
        axles.push_back(std::move(axle));
    }
    return axles;
}

/// Which of its carriers each axle acts on, for all choices, the last axle's changing first. Of more than
/// `most` those alone in which all axles take the first, the second, ... or the last that they have.
template<int Dim>
std::vector<std::vector<int>> choicesOf(const std::vector<Axle<Dim>>& axles)
{
    constexpr std::size_t most = 64;
    std::size_t count = 1;
    std::size_t largest = 1;
    for (const Axle<Dim>& axle : axles)
    {
        largest = std::max(largest, axle.carriers.size());
        count = std::min(count, most) * axle.carriers.size();
    }
    std::vector<std::vector<int>> choices(count <= most ? count : largest);
    for (std::size_t i = 0; i < choices.size(); ++i)
    {
        std::size_t rest = i;
        for (auto axle = axles.rbegin(); axle != axles.rend(); ++axle)
        {
            const std::size_t carriers = axle->carriers.size();
            choices[i].push_back(axle->carriers[count <= most ? rest % carriers : std::min(i, carriers - 1)]);
            rest /= carriers;
        }
        std::reverse(choices[i].begin(), choices[i].end());
    }
    return choices;
}

/// The load of the axles at a position. \param carriers of each axle; without: those of its rays, as it is
/// spread
template<int Dim>
LoadPosition<Dim> loadOf(const Assembly<Dim>& assembly, const MovingLoadSettings<Dim>& settings,
                         double distance, const std::vector<Axle<Dim>>& axles,
                         const std::vector<int>& carriers)
{
    LoadPosition<Dim> position;
    position.distance = distance;
    position.place = settings.from + distance * (settings.to - settings.from).normalized();
    double met = 0;
    double all = 0;
    for (std::size_t i = 0; i < axles.size(); ++i)
    {
        const Axle<Dim>& axle = axles[i];
        all += axle.factor;
        // Parallel forces on a block are one, at their centre.
        std::map<int, std::pair<double, Vector<Dim>>> onBlocks;
        std::vector<int> carrying;
        for (const Ray<Dim>& ray : axle.rays)
        {
            const int block = carriers.empty() ? carrierOf(ray.landing) : carriers[i];
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
                                                   Vector<Dim>(axle.factor * parts.first * settings.value))
                                             .rows;
            met += axle.factor * parts.first;
            position.live = position.live.size() == 0 ? load : Eigen::VectorXd(position.live + load);
        }
        position.blocks.insert(position.blocks.end(), carrying.begin(), carrying.end());
        if (!carrying.empty())
        {
            const int block = carriers.empty() ? carrierOf(axle.middle) : carriers[i];
            position.axles.push_back(
                {block < 0 ? axle.from
                           : Vector<Dim>(axle.from + axle.middle.distance * settings.value.normalized()),
                 block < 0 ? carrying.front() : block, axle.factor});
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
        const Vector<Dim> place = settings.from + distance * (settings.to - settings.from).normalized();
        const std::vector<Axle<Dim>> axles = axlesAt(assembly, settings, place);
        // A load that is spread over both sides of a joint is one load.
        const bool isSpread = settings.spread > 0 || settings.loadedLength > 0 || settings.loadedWidth > 0;
        for (const std::vector<int>& carriers :
             isSpread ? std::vector<std::vector<int>>(1) : choicesOf(axles))
        {
            LoadPosition<Dim> position = loadOf(assembly, settings, distance, axles, carriers);
            if (!position.blocks.empty())
            {
                positions.push_back(std::move(position));
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
        while (next != positions.end() && next->distance == distance) // several at a joint
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
