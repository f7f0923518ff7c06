// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Damping in proportion to mass.
#include "effects/MassDamping.h"

#include <fmt/format.h>

#include <cmath>

namespace drystone
{

void declare(Options& options, HousnerLoss& loss)
{
    options
        .required("slenderness", loss.slenderness,
                  "of the block, atan(width/height); small: beyond 0.35 the "
                  "equivalence is worse than 2%")
        .unit("rad")
        .above(0)
        .atMost(0.5)
        .example("0.24497866");
    options.required("radius", loss.radius, "from a corner to the mass centre")
        .unit("m")
        .above(0)
        .example("1.0307764");
    options.required("amplitude", loss.amplitude, "rotation that the block is released from")
        .unit("rad")
        .above(0)
        .example("0.1");
    options.check(
        "amplitude",
        [&loss]
        {
            return loss.amplitude < loss.slenderness
                       ? ""
                       : "A block released from beyond its slenderness overturns: amplitude must be "
                         "below slenderness.";
        });
}

void declare(Options& options, Damping& damping)
{
    options.optional("massProportional", damping.massProportional, "force over momentum of a block")
        .unit("1/s")
        .atLeast(0)
        .example("0.5");
    options.optional(
        "equivalentToHousner", damping.equivalentToHousner,
        "instead: the massProportional that takes from a rocking block, in the swing to the other "
        "side, what an impact takes from it; for joints that do not lose it themselves");
    options.check(
        "massProportional",
        [&damping]
        {
            return damping.equivalentToHousner && damping.massProportional > 0
                       ? "massProportional and equivalentToHousner are both given. Remove one of them."
                       : "";
        });
}

template<int Dim>
void MassDamping<Dim>::contribute(const EffectContext<Dim>& context, EffectState&,
                                  StepProgram<Dim>& program) const
{
    for (int body = 0; body < program.bodies; ++body)
    {
        program.inertia[static_cast<std::size_t>(body)] +=
            settings.massProportional / context.timeStep * blockOf(context.mass, body);
    }
}

template<int Dim>
void MassDamping<Dim>::account(const EffectContext<Dim>& context, const EffectSolution& solution,
                               StepEnergy& energy) const
{
    energy.dampingLoss +=
        settings.massProportional / context.timeStep * squareOf(context.mass, solution.displacement);
}

template<int Dim>
std::string MassDamping<Dim>::startText(const Structure<Dim>&, const EffectState&) const
{
    return fmt::format("Damping: massProportional {:.6g} 1/s{}", settings.massProportional,
                       settings.equivalentToHousner ? ", equivalent to Housner's loss" : "");
}

double equivalentDamping(const HousnerLoss& loss, double gravity)
{
    const double alpha = loss.slenderness;
    const double lost = 1.5 * std::pow(std::sin(alpha), 2);
    const double ratio = 1 - lost;
    // Both swings from the speed at theta = 0, over alpha p: 2 J / (alpha x)^2.
    const auto swing = [](double x)
    {
        constexpr double smallest =
            1e-3; // below it the difference is lost in rounding, and x^2/5 in the rest
        return x < smallest ? 2 * x / 3 : (x - (1 - x * x) * std::atanh(x)) / (x * x);
    };
    const double x0 = std::sqrt(loss.amplitude * (2 * alpha - loss.amplitude)) / alpha;
    const double p = std::sqrt(0.75 * gravity / loss.radius);
    return p * lost * (1 + ratio) / (swing(x0) + ratio * ratio * swing(ratio * x0));
}

template<int Dim>
EffectType<Dim> dampingType()
{
    return effectType<Dim, Damping>(
        "damping", "losses besides friction and impact, in motion; absent: none",
        [](Damping damping, const EffectSource<Dim>& source) -> std::shared_ptr<const Effect<Dim>>
        {
            if (damping.equivalentToHousner)
            {
                damping.massProportional =
                    equivalentDamping(*damping.equivalentToHousner, source.structure.gravity.norm());
            }
            return damping.massProportional > 0 ? std::make_shared<MassDamping<Dim>>(damping) : nullptr;
        });
}

template class MassDamping<2>;
template EffectType<2> dampingType<2>();
template class MassDamping<3>;
template EffectType<3> dampingType<3>();

} // namespace drystone
