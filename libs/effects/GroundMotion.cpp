// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Motions of the ground, read and evaluated.
#include "effects/GroundMotion.h"

#include "effects/RecordPlausibility.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

Eigen::Vector3d groundAcceleration(const GroundMotion& motion, double time)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const GroundMotion::Component& component : motion.components)
    {
        sum += component.acceleration->at(time) * component.direction;
    }
    return sum;
}

Eigen::Vector3d meanGroundAcceleration(const GroundMotion& motion, double from, double to)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const GroundMotion::Component& component : motion.components)
    {
        sum += component.acceleration->mean(from, to) * component.direction;
    }
    return sum;
}

double peakAcceleration(const GroundMotion& motion)
{
    double peak = 0;
    for (const GroundMotion::Component& component : motion.components)
    {
        peak = std::max(peak, component.acceleration->peak());
    }
    return peak;
}

std::string summary(const GroundMotion& motion, double gravity)
{
    if (motion.components.empty())
    {
        return "Ground motion: none\n";
    }
    std::string text;
    for (const GroundMotion::Component& component : motion.components)
    {
        const Eigen::Vector3d& d = component.direction;
        const GroundAcceleration& history = *component.acceleration;
        text += fmt::format("Ground motion along ({:.6g} {:.6g} {:.6g})\n", d.x(), d.y(), d.z());
        text += component.summary;
        text += fmt::format("    PGA         {:.6g} m/s2", history.peak());
        text += gravity > 0 ? fmt::format(" = {:.6g} g\n", history.peak() / gravity) : "\n";
        const std::vector<double> kinks = history.kinks();
        if (kinks.empty())
        {
            text += "    duration    unlimited\n";
        }
        else
        {
            text += fmt::format("    duration    {:.6g} s, from {:.6g} s to {:.6g} s\n",
                                kinks.back() - kinks.front(), kinks.front(), kinks.back());
        }
    }
    return text;
}

namespace
{

Eigen::Vector3d toVector(const std::array<double, 3>& components)
{
    return {components[0], components[1], components[2]};
}

} // namespace

void requireComponents(const Dictionary& dictionary, int dimensions)
{
    if (const Entry* direction = dictionary.find("direction"))
    {
        dimensions == 3 ? void(direction->as<Vector<3>>()) : void(direction->as<Vector<2>>());
    }
    if (const Dictionary* components = dictionary.findDict("components"))
    {
        for (const std::string& name : components->keywords())
        {
            requireComponents(components->subDict(name), dimensions);
        }
    }
}

constexpr const char* noLength = "The direction has no length. Write for instance `direction (1 0 0);`.";

void declare(Options& options, GroundComponentSettings& settings)
{
    options.required("direction", settings.direction, "of the acceleration; its length does not matter")
        .example("(1 0 0)");
    options.required("acceleration", settings.acceleration, groundAccelerationTypes(), "along the direction");
    options.check("direction",
                  [&settings] { return toVector(settings.direction).norm() > 0 ? "" : noLength; });
}

void declare(Options& options, GroundMotionSettings& settings)
{
    options.optional("direction", settings.direction, "of the acceleration; its length does not matter")
        .example("(1 0 0)");
    options.optional("acceleration", settings.acceleration, groundAccelerationTypes(), "along the direction");
    options.optional("components", settings.components,
                     "instead: several motions at once, each under a name");
    options.check(
        "direction",
        [&settings]
        {
            const bool single = settings.direction || settings.acceleration;
            if (single && !settings.components.empty())
            {
                return "Give either direction and acceleration, or components.";
            }
            if (!single && settings.components.empty())
            {
                return "The motion of the ground needs direction and acceleration. Write for instance "
                       "`direction (1 0 0); acceleration { type constant; value 3; }`.";
            }
            if (single && !(settings.direction && settings.acceleration))
            {
                return settings.direction
                           ? "The motion of the ground needs both direction and acceleration. Write "
                             "for instance `acceleration { type constant; value 3; }`."
                           : "The motion of the ground needs both direction and acceleration. Write "
                             "for instance `direction (1 0 0);`.";
            }
            return settings.direction && toVector(*settings.direction).norm() == 0 ? noLength : "";
        });
}

GroundMotion readGroundMotion(const Dictionary& dictionary, const std::filesystem::path& caseDirectory,
                              int dimensions)
{
    const auto settings = readOptions<GroundMotionSettings>(dictionary);
    requireComponents(dictionary, dimensions);
    GroundMotion motion;
    const auto add = [&](const std::array<double, 3>& direction, const AccelerationMaker& acceleration,
                         const Dictionary& described)
    {
        motion.components.push_back({acceleration(caseDirectory), toVector(direction).stableNormalized()});
        question(doubtsAboutRecord(motion.components.back(), described.subDict("acceleration")));
    };
    if (settings.direction)
    {
        add(*settings.direction, settings.acceleration, dictionary);
    }
    for (const auto& [name, component] : settings.components)
    {
        add(component.direction, component.acceleration, dictionary.subDict("components").subDict(name));
    }
    return motion;
}

template<int Dim>
StepBounds MovingGround<Dim>::stepBounds(double time) const
{
    StepBounds bounds;
    for (const GroundMotion::Component& component : motion.components)
    {
        bounds.tighten(component.acceleration->stepBounds(time));
    }
    return bounds;
}

template<int Dim>
void MovingGround<Dim>::addLoad(const EffectContext<Dim>& context, const EffectState&,
                                Eigen::VectorXd& load) const
{
    const Eigen::Vector3d mean =
        meanGroundAcceleration(motion, context.start, context.start + context.timeStep);
    for (Eigen::Index row = 0; row < load.size(); row += freedomCount<Dim>)
    {
        load.segment<Dim>(row) -= motion.factor * context.structure.mass[row] * mean.head<Dim>();
    }
}

template<int Dim>
std::vector<Eigen::VectorXd> MovingGround<Dim>::loadDirections(const Structure<Dim>& structure) const
{
    std::vector<Eigen::VectorXd> directions;
    for (const GroundMotion::Component& component : motion.components)
    {
        Eigen::VectorXd& load = directions.emplace_back(Eigen::VectorXd::Zero(structure.mass.size()));
        for (Eigen::Index row = 0; row < load.size(); row += freedomCount<Dim>)
        {
            load.segment<Dim>(row) = -structure.mass[row] * component.direction.head<Dim>();
        }
    }
    return directions;
}

template<int Dim>
std::string MovingGround<Dim>::startText(const Structure<Dim>& structure, const EffectState&) const
{
    return summary(motion, structure.gravity.norm());
}

template<int Dim>
GroundMotion groundMotionOf(const Effects<Dim>& effects)
{
    const auto moving = std::find_if(effects.begin(), effects.end(),
                                     [](const auto& effect) { return effect->groundMotion() != nullptr; });
    return moving != effects.end() ? *(*moving)->groundMotion() : GroundMotion{};
}

template<int Dim>
void setGroundMotion(Effects<Dim>& effects, GroundMotion motion)
{
    auto moved = std::make_shared<MovingGround<Dim>>(std::move(motion));
    const auto before = std::find_if(effects.begin(), effects.end(),
                                     [](const auto& effect) { return effect->groundMotion() != nullptr; });
    if (before != effects.end())
    {
        *before = std::move(moved);
    }
    else
    {
        effects.insert(effects.begin(), std::move(moved));
    }
}

template<int Dim>
EffectType<Dim> groundMotionType()
{
    return fileEffectType<Dim>("groundMotion",
                               [](const Dictionary& dictionary, const EffectSource<Dim>& source) {
                                   return std::make_shared<MovingGround<Dim>>(
                                       readGroundMotion(dictionary, source.caseDirectory, Dim));
                               });
}

template class MovingGround<2>;
template GroundMotion groundMotionOf(const Effects<2>& effects);
template void setGroundMotion(Effects<2>& effects, GroundMotion motion);
template EffectType<2> groundMotionType<2>();
template class MovingGround<3>;
template GroundMotion groundMotionOf(const Effects<3>& effects);
template void setGroundMotion(Effects<3>& effects, GroundMotion motion);
template EffectType<3> groundMotionType<3>();

} // namespace drystone
