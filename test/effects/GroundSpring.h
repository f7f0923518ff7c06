// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// groundSpring { block 1; stiffness 1e4; }: a spring from the mass centre of a block to where that was as
/// built. Not an effect of Drystone: it shows, and tests, what a new effect takes, which is its two files and
/// a line in the list.
#pragma once

#include "effects/EffectType.h"

namespace drystone
{

struct GroundSpringSettings
{
    int block = 0;        ///< index in Assembly::blocks
    double stiffness = 0; ///< k [N/m]
};
void declare(Options& options, GroundSpringSettings& settings);

/// The force of the spring where the theta method takes it, u0 + theta y from as built, is -k (u0 + theta y):
/// the first part is a load, the second theta k on the diagonal of Mbar. Over a step it takes k u0'y + theta
/// k y'y from the blocks, of which k u0'y + 1/2 k y'y is stored and the rest, none with theta 1/2, lost to
/// the time integration. The state counts the steps in which the spring was drawn, for the log and the
/// restart.
class GroundSpring final : public Effect<2>
{
public:
    explicit GroundSpring(const GroundSpringSettings& springSettings) : settings(springSettings) {}
    EffectTraits traits() const override { return {.actsOnBlocks = true}; }
    void start(const Structure<2>& structure, const std::vector<Placement<2>>& placements,
               EffectState& state) const override;
    void addLoad(const EffectContext<2>& context, const EffectState& state,
                 Eigen::VectorXd& load) const override;
    void contribute(const EffectContext<2>& context, EffectState& state,
                    PlaneConeProgram& program) const override;
    void account(const EffectContext<2>& context, const EffectSolution& solution,
                 StepEnergy& energy) const override;
    void save(const EffectState& state, EffectArrays& arrays) const override;
    void restore(const EffectArrays& arrays, EffectState& state) const override;
    std::vector<EffectField> blockFields(const EffectState& state) const override;
    std::string startText(const Structure<2>& structure, const EffectState& state) const override;

private:
    GroundSpringSettings settings;
};

/// Its entry of the list.
EffectType<2> groundSpringType();

} // namespace drystone
