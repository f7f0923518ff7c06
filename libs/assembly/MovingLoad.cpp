// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Places of a moving load, and the blocks that it meets.
#include "assembly/MovingLoad.h"

#include "assembly/BlockShape.h"
#include "assembly/LoadTypes.h"

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
    for (const auto& [offset, factor] : axles)
    {
        const Vector<Dim> from = position.place + offset * along;
        const Landing landing = landingOf<Dim>(assembly, from, direction);
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
            pointLoad(assembly, block, Vector<Dim>(from + landing.distance * direction),
                      Vector<Dim>(factor * settings.value));
        position.live = position.live.size() == 0 ? load : Eigen::VectorXd(position.live + load);
        position.blocks.push_back(block);
    }
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
        LoadPosition<Dim> highest = loadAt(assembly, settings, distance, Choice::highest);
        const bool isOneOnly = lowest.blocks == highest.blocks;
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
