// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// deletion { box (lower upper); }: blocks that leave a box stop there for good.
#pragma once

#include "effects/EffectType.h"

namespace drystone
{

/// Blocks that leave a box are out of the computation from then on.
template<int Dim>
struct Deletion
{
    std::pair<Vector<Dim>, Vector<Dim>> box{Vector<Dim>::Zero(),
                                            Vector<Dim>::Zero()}; ///< lower, upper corner [m]
};

template<int Dim>
void declare(Options& options, Deletion<Dim>& deletion);

/// Flags of the state: which blocks are out. It follows from where the blocks are, and is not saved: the mass
/// centre of a block that is out stays outside.
template<int Dim>
class BlockDeletion final : public Effect<Dim>
{
public:
    explicit BlockDeletion(const Deletion<Dim>& deletion) : settings(deletion) {}
    /// Idle at rest: a block leaves the box by moving.
    EffectTraits traits() const override { return {.isIdleAtRest = true}; }
    void start(const Structure<Dim>& structure, const std::vector<Placement<Dim>>& placements,
               EffectState& state) const override;
    void addLoad(const EffectContext<Dim>& context, const EffectState& state,
                 Eigen::VectorXd& load) const override;
    std::vector<int> leaveOut(const Structure<Dim>& structure, const std::vector<Placement<Dim>>& placements,
                              EffectState& state) const override;
    std::vector<EffectField> blockFields(const EffectState& state) const override;
    std::string stepText(const EffectState& before, const EffectState& after) const override;

private:
    Deletion<Dim> settings;
};

/// Its entry of the list.
template<int Dim>
EffectType<Dim> deletionType();

} // namespace drystone
