// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The made-up effect: a spring to the ground.
#include "GroundSpring.h"

#include "effects/ContactProperties.h"

#include <fmt/format.h>

namespace drystone
{

void declare(Options& options, GroundSpringSettings& settings)
{
    options.required("block", settings.block, "that the spring holds").atLeast(0).example("1");
    options.required("stiffness", settings.stiffness, "of the spring").unit("N/m").above(0).example("1e4");
}

void GroundSpring::start(const Structure<2>&, const std::vector<Placement<2>>&, EffectState& state) const
{
    state.numbers = {0};
}

void GroundSpring::addLoad(const EffectContext<2>& context, const EffectState&, Eigen::VectorXd& load) const
{
    const auto block = static_cast<std::size_t>(settings.block);
    load.segment<2>(3 * context.structure.free[block]) -=
        settings.stiffness * context.placements[block].translation;
}

void GroundSpring::contribute(const EffectContext<2>& context, EffectState& state,
                              PlaneConeProgram& program) const
{
    const int body = context.structure.free[static_cast<std::size_t>(settings.block)];
    program.inertia[static_cast<std::size_t>(body)].diagonal().head<2>().array() +=
        context.theta * settings.stiffness;
    state.numbers[0] += 1;
}

void GroundSpring::account(const EffectContext<2>& context, const EffectSolution& solution,
                           StepEnergy& energy) const
{
    const auto block = static_cast<std::size_t>(settings.block);
    const Vector<2> step = solution.displacement.segment<2>(3 * context.structure.free[block]);
    const Vector<2> before = context.placements[block].translation - step;
    const double drawn = settings.stiffness * before.dot(step);
    energy.externalWork += drawn; // of the load -k u0, which is not from outside
    energy.elasticChange += drawn + 0.5 * settings.stiffness * step.squaredNorm();
    energy.algorithmicLoss += (context.theta - 0.5) * settings.stiffness * step.squaredNorm();
}

void GroundSpring::save(const EffectState& state, EffectArrays& arrays) const
{
    arrays["groundSpring"] = state.numbers;
}

void GroundSpring::restore(const EffectArrays& arrays, EffectState& state) const
{
    state.numbers = arrays.at("groundSpring");
}

std::vector<EffectField> GroundSpring::blockFields(const EffectState& state) const
{
    return {{"stepsOnSpring", state.numbers}};
}

std::string GroundSpring::startText(const Structure<2>&, const EffectState&) const
{
    return fmt::format("Spring: {:g} N/m at block {}", settings.stiffness, settings.block);
}

EffectType<2> groundSpringType()
{
    return effectType<2, GroundSpringSettings>(
        "groundSpring", "a spring from a block to the ground",
        [](const GroundSpringSettings& settings, const EffectSource<2>& source)
        {
            const std::vector<int>& free = source.structure.free;
            if (settings.block >= static_cast<int>(free.size())
                || free[static_cast<std::size_t>(settings.block)] < 0)
            {
                throw FatalIOError(
                    fmt::format("There is no free block {} for a spring to hold.", settings.block),
                    source.contact.locations.of("groundSpring/block"));
            }
            return std::make_shared<GroundSpring>(settings);
        });
}

} // namespace drystone
