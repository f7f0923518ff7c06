// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// damping { massProportional a; }: a force -a M u on each block.
#pragma once

#include "effects/EffectType.h"

namespace drystone
{

/// The loss that a rocking block of the case has in an impact (Housner 1963), to be taken by damping instead.
struct HousnerLoss
{
    double slenderness = 0; ///< angle from a corner's vertical to the mass centre, atan(b/h) [rad]
    double radius = 0;      ///< from that corner to the mass centre [m]
    double amplitude = 0;   ///< rotation it is released from, below the slenderness [rad]
};

void declare(Options& options, HousnerLoss& loss);

/// Losses in addition to friction and impact: a force of -massProportional M v on each block.
struct Damping
{
    double massProportional = 0; ///< [1/s]
    /// Instead: the coefficient follows from it (see equivalentDamping).
    std::optional<HousnerLoss> equivalentToHousner = {};
};

void declare(Options& options, Damping& damping);

/// With the mean velocity of the step, u = y/dt, the motion M (v1 - v0) = dt (f - A c - a M y/dt) reads
///
///     (Mbar + a/dt M) y + A c = f + Mbar v0 dt:
///
/// the damping makes blocks heavier in the program, and not in the momentum that they bring along. It takes
/// a/dt y'My from the energy, never less than 0.
template<int Dim>
class MassDamping final : public Effect<Dim>
{
public:
    /// \param damping with its massProportional, whether given or equivalent
    explicit MassDamping(const Damping& damping) : settings(damping) {}
    /// Idle at rest: its force is proportional to the velocity.
    EffectTraits traits() const override
    {
        return {.actsOnBlocks = true, .isIdleAtRest = true, .damping = settings.massProportional};
    }
    void contribute(const EffectContext<Dim>& context, EffectState& state,
                    StepProgram<Dim>& program) const override;
    void account(const EffectContext<Dim>& context, const EffectSolution& solution,
                 StepEnergy& energy) const override;
    std::string startText(const Structure<Dim>& structure, const EffectState& state) const override;

private:
    Damping settings;
};

/// The coefficient a [1/s] with which a block that rocks without losing anything in impacts has the amplitude
/// theta1 after it has swung from theta0 to the other side, that Housner's block has, whose angular velocity
/// an impact multiplies by r = 1 - 3/2 sin^2 alpha.
///
/// About a corner the kinetic energy is I w^2/2, I = 4/3 m R^2, and damping takes 2 a times it per time, so
/// over a swing a I times the integral of w d theta. For slender blocks Housner's equation
/// theta'' = -p^2 (alpha - theta), p^2 = 3 g/(4 R), gives for a swing that starts or ends at rest at theta_i
///
///     w^2 = p^2 ((alpha - theta)^2 - beta_i^2),     beta_i = alpha - theta_i,
///     J_i = integral from 0 to theta_i of w/p d theta = 1/2 (alpha s_i - beta_i^2 acosh(alpha/beta_i)),
///     s_i = sqrt(alpha^2 - beta_i^2),               I p^2 s_i^2/2 the energy of such a swing at theta = 0.
///
/// The impact takes I p^2 s0^2 (1 - r^2)/2 and leaves s1 = r s0. Damping takes about a I p (J0 + J1): on the
/// way in the block is a little slower than the swing from theta0, on the way out a little faster than the
/// one to theta1, so that these errors of first order in a cancel. Both equal:
///
///     a = p (1 - r^2) s0^2 / (2 (J0 + J1)).
///
/// It depends on the amplitude: theta0 -> 0 requires a -> infinity, as rocking becomes ever quicker. Against
/// the integrals of both equations theta1 is right to 0.3% up to alpha = 0.25, and to 2.3% at 0.35.
/// \param gravity [m/s2], its magnitude
double equivalentDamping(const HousnerLoss& loss, double gravity);

/// Its entry of the list.
template<int Dim>
EffectType<Dim> dampingType();

} // namespace drystone
