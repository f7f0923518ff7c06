// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// deletion { box (lower upper); }: blocks that leave a box stop there for good.
#pragma once

#include "effects/EffectList.h"

namespace drystone
{

/// Blocks that leave a box are out of the computation from then on.
struct Deletion
{
    std::pair<std::array<double, 2>, std::array<double, 2>> box; ///< lower and upper corner [m]
};

void declare(Options& options, Deletion& deletion);

/// Flags of the state: which blocks are out. It follows from where the blocks are, and is not saved: the mass
/// centre of a block that is out stays outside.
class BlockDeletion final : public Effect
{
public:
    explicit BlockDeletion(const Deletion& deletion) : settings(deletion) {}
    void start(const Structure& structure, const std::vector<Placement<2>>& placements,
               EffectState& state) const override;
    void addLoad(const EffectContext& context, const EffectState& state,
                 Eigen::VectorXd& load) const override;
    std::vector<int> leaveOut(const Structure& structure, const std::vector<Placement<2>>& placements,
                              EffectState& state) const override;
    std::vector<EffectField> blockFields(const EffectState& state) const override;

private:
    Deletion settings;
};

/// Its entry of the list.
EffectType deletionType();

} // namespace drystone
