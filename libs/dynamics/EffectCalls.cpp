// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The points and blocks on which effects act.
#include "dynamics/EffectCalls.h"

#include <algorithm>
#include <array>

namespace drystone
{
namespace
{

/// Which part of the points, or of the blocks, that count; 0 where none do.
struct Share
{
    long on = 0;
    long all = 0;

    void count(bool isOn)
    {
        on += isOn ? 1 : 0;
        ++all;
    }
    double value() const { return all > 0 ? static_cast<double>(on) / static_cast<double>(all) : 0; }
};

template<int Dim>
double slidingPoints(const Step<Dim>& step)
{
    const ThetaStep& result = step.solved.result;
    Share share;
    for (Eigen::Index row = 0; row < result.contactForce.size() && !step.solved.sticks; row += Dim)
    {
        const bool carries = result.contactForce[row] > 0;
        share.count(carries && result.closing.size() > 0
                    && result.closing.segment<Dim - 1>(row + 1).norm() > step.settings.contactTolerance);
    }
    return share.value();
}

template<int Dim>
double countOfColliding(const Step<Dim>& step)
{
    Share share;
    for (Eigen::Index row = 0; row < step.solved.impulse.size(); row += Dim)
    {
        share.count(!step.solved.impulse.template segment<Dim>(row).isZero(0));
    }
    return share.value();
}

template<int Dim>
double bondedPoints(const Step<Dim>& step)
{
    const StepProgram<Dim>& program = step.program;
    const Eigen::VectorXd& forces = step.solved.result.contactForce;
    Share share;
    for (std::size_t point = 0; point < program.strength.size(); ++point)
    {
        const auto force = forces.segment<Dim>(Dim * static_cast<Eigen::Index>(point));
        const double beyond = force.template tail<Dim - 1>().norm() - program.friction[point] * force[0];
        share.count(beyond > step.settings.solver.tolerance * forces.lpNorm<Eigen::Infinity>());
    }
    return share.value();
}

template<int Dim>
double movingBlocks(const Step<Dim>& step)
{
    const Eigen::VectorXd& displacement = step.solved.result.displacement;
    Share share;
    for (Eigen::Index row = 0; row < displacement.size(); row += freedomCount<Dim>)
    {
        share.count(!displacement.segment<freedomCount<Dim>>(row).isZero(0));
    }
    return share.value();
}

template<int Dim>
double everywhere(const Step<Dim>&)
{
    return 1;
}

/// Where an effect acts, in words and in numbers.
template<int Dim>
struct EffectPlaces
{
    std::string_view effect;
    std::string_view places;
    double (*share)(const Step<Dim>&);
};

template<int Dim>
constexpr std::array<EffectPlaces<Dim>, 6> effectPlaces{
    {{"friction", "points that slide", slidingPoints<Dim>},
     {"restitution", "points that collide", countOfColliding<Dim>},
     {"cohesion", "points that friction alone does not hold", bondedPoints<Dim>},
     {"tension", "points that friction alone does not hold", bondedPoints<Dim>},
     {"elasticity", "points, unless blocks and loads stay as they are", everywhere<Dim>},
     {"supportMotion", "supports, unless all stand still", everywhere<Dim>}}};

template<int Dim>
EffectPlaces<Dim> placesOfEffect(std::string_view effect)
{
    const auto& all = effectPlaces<Dim>;
    const auto found = std::find_if(all.begin(), all.end(),
                                    [effect](const EffectPlaces<Dim>& own) { return own.effect == effect; });
    return found != all.end() ? *found : EffectPlaces<Dim>{effect, "blocks that move", movingBlocks<Dim>};
}

} // namespace

std::string_view placesOf(std::string_view effect)
{
    return placesOfEffect<2>(effect).places;
}

template<int Dim>
std::vector<std::string> namesOfEffects(const DynamicCase<Dim>& scene)
{
    std::vector<std::string> names = scene.effectNames.simulated;
    if (!scene.schemes.smallDisplacements)
    {
        names.emplace_back("largeDisplacements");
    }
    return names;
}

template<int Dim>
std::vector<double> effectCalls(const Step<Dim>& step)
{
    std::vector<double> shares;
    for (const std::string& name : namesOfEffects(step.scene))
    {
        shares.push_back(placesOfEffect<Dim>(name).share(step));
    }
    return shares;
}

template std::vector<std::string> namesOfEffects(const DynamicCase<2>& scene);
template std::vector<double> effectCalls(const Step<2>& step);
template std::vector<std::string> namesOfEffects(const DynamicCase<3>& scene);
template std::vector<double> effectCalls(const Step<3>& step);

} // namespace drystone
