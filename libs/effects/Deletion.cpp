// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks that are computed no further.
#include "effects/Deletion.h"

namespace drystone
{

void declare(Options& options, Deletion& deletion)
{
    options
        .required("box", deletion.box,
                  "lower left and upper right corner; a block whose mass centre is outside is out")
        .unit("m")
        .example("((-10 -1) (10 20))");
    options.check("box",
                  [&deletion]
                  {
                      const auto& [lower, upper] = deletion.box;
                      return lower[0] < upper[0] && lower[1] < upper[1]
                                 ? ""
                                 : "The box is empty: give its lower left corner, then its upper right one.";
                  });
}

void BlockDeletion::start(const Structure& structure, const std::vector<Placement<2>>&,
                          EffectState& state) const
{
    state.flags.assign(structure.free.size(), false);
}

void BlockDeletion::addLoad(const EffectContext& context, const EffectState& state,
                            Eigen::VectorXd& load) const
{
    for (std::size_t block = 0; block < state.flags.size(); ++block)
    {
        if (state.flags[block])
        {
            load.segment<3>(3 * context.structure.free[block]).setZero();
        }
    }
}

std::vector<int> BlockDeletion::leaveOut(const Structure& structure,
                                         const std::vector<Placement<2>>& placements,
                                         EffectState& state) const
{
    std::vector<int> leaving;
    const auto& [lower, upper] = settings.box;
    for (std::size_t block = 0; block < structure.free.size(); ++block)
    {
        const Vector<2> centre = structure.blocks[block].centroid + placements[block].translation;
        const bool isOutside =
            centre.x() < lower[0] || centre.y() < lower[1] || centre.x() > upper[0] || centre.y() > upper[1];
        if (isOutside && structure.free[block] >= 0 && !state.flags[block])
        {
            state.flags[block] = true;
            leaving.push_back(static_cast<int>(block));
        }
    }
    return leaving;
}

std::vector<EffectField> BlockDeletion::blockFields(const EffectState& state) const
{
    return {{"deleted", {state.flags.begin(), state.flags.end()}}};
}

EffectType deletionType()
{
    return effectType<Deletion>(
        "deletion", "blocks that leave a box are computed no further, in motion; absent: all are",
        [](const Deletion& deletion, const EffectSource& source)
        {
            if (source.displacements == Displacements::small)
            {
                throw FatalIOError(
                    "With `smallDisplacements yes;` no block leaves where it was built: remove deletion, or "
                    "set `smallDisplacements no;` in system/schemes.",
                    source.locations.of("deletion"));
            }
            return std::make_shared<BlockDeletion>(deletion);
        });
}

} // namespace drystone
