// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks that are computed no further.
#include "effects/Deletion.h"

#include "effects/ContactProperties.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace drystone
{

template<int Dim>
void declare(Options& options, Deletion<Dim>& deletion)
{
    options
        .required("box", deletion.box,
                  "lower left and upper right corner; a block whose mass centre is outside is out")
        .unit("m")
        .example(Dim == 2 ? "((-10 -1) (10 20))" : "((-10 -10 -1) (10 10 20))");
    options.check("box",
                  [&deletion]
                  {
                      const auto& [lower, upper] = deletion.box;
                      return (lower.array() < upper.array()).all()
                                 ? ""
                                 : "The box is empty: give its lower left corner, then its upper right one.";
                  });
}

namespace
{

/// Whether a mass centre is outside.
template<int Dim>
bool isOutside(const Deletion<Dim>& deletion, const Vector<Dim>& centre)
{
    const auto& [lower, upper] = deletion.box;
    return (centre.array() < lower.array()).any() || (centre.array() > upper.array()).any();
}

/// A box that leaves out blocks where they were built is a mistyped one more often than not.
template<int Dim>
void questionBox(const Deletion<Dim>& deletion, const Structure<Dim>& structure, const SourceLocation& place)
{
    constexpr std::size_t most = 10;
    std::vector<std::size_t> outside;
    for (std::size_t block = 0; block < structure.free.size(); ++block)
    {
        if (structure.free[block] >= 0 && isOutside(deletion, structure.blocks[block].centroid))
        {
            outside.push_back(block);
        }
    }
    if (!outside.empty())
    {
        const std::size_t count = outside.size();
        outside.resize(std::min(count, most));
        printWarningOnce(
            fmt::format("{} of {} free blocks ({}{}) are outside of the box where they were built: unless "
                        "0/motion starts them inside, they are computed no further from the start. Enlarge "
                        "the box.",
                        count,
                        std::count_if(structure.free.begin(), structure.free.end(),
                                      [](int body) { return body >= 0; }),
                        fmt::join(outside, " "), count > most ? " ..." : ""),
            place);
    }
}

} // namespace

template<int Dim>
void BlockDeletion<Dim>::start(const Structure<Dim>& structure, const std::vector<Placement<Dim>>&,
                               EffectState& state) const
{
    state.flags.assign(structure.free.size(), false);
}

template<int Dim>
void BlockDeletion<Dim>::addLoad(const EffectContext<Dim>& context, const EffectState& state,
                                 Eigen::VectorXd& load) const
{
    for (std::size_t block = 0; block < state.flags.size(); ++block)
    {
        if (state.flags[block])
        {
            load.segment<freedomCount<Dim>>(freedomCount<Dim> * context.structure.free[block]).setZero();
        }
    }
}

template<int Dim>
std::vector<int> BlockDeletion<Dim>::leaveOut(const Structure<Dim>& structure,
                                              const std::vector<Placement<Dim>>& placements,
                                              EffectState& state) const
{
    std::vector<int> leaving;
    for (std::size_t block = 0; block < structure.free.size(); ++block)
    {
        const Vector<Dim> centre = structure.blocks[block].centroid + placements[block].translation;
        if (isOutside(settings, centre) && structure.free[block] >= 0 && !state.flags[block])
        {
            state.flags[block] = true;
            leaving.push_back(static_cast<int>(block));
        }
    }
    return leaving;
}

template<int Dim>
std::vector<EffectField> BlockDeletion<Dim>::blockFields(const EffectState& state) const
{
    return {{"deleted", {state.flags.begin(), state.flags.end()}}};
}

template<int Dim>
std::string BlockDeletion<Dim>::stepText(const EffectState& before, const EffectState& after) const
{
    std::vector<std::size_t> leaving;
    for (std::size_t block = 0; block < after.flags.size(); ++block)
    {
        if (after.flags[block] && !(block < before.flags.size() && before.flags[block]))
        {
            leaving.push_back(block);
        }
    }
    return leaving.empty()
               ? ""
               : fmt::format("Deletion: block{} {} left the box, {} are out and computed no further",
                             leaving.size() > 1 ? "s" : "", fmt::join(leaving, " "),
                             std::count(after.flags.begin(), after.flags.end(), true));
}

template<int Dim>
EffectType<Dim> deletionType()
{
    return effectType<Dim, Deletion<Dim>>(
        "deletion", "blocks that leave a box are computed no further, in motion; absent: all are",
        [](const Deletion<Dim>& deletion, const EffectSource<Dim>& source)
        {
            if (source.displacements == Displacements::small)
            {
                throw FatalIOError(
                    "With `smallDisplacements yes;` no block leaves where it was built: remove deletion, or "
                    "set `smallDisplacements no;` in system/schemes.",
                    source.contact.locations.of("deletion"));
            }
            questionBox(deletion, source.structure, source.contact.locations.of("deletion"));
            return std::make_shared<BlockDeletion<Dim>>(deletion);
        });
}

template class BlockDeletion<2>;
template EffectType<2> deletionType<2>();
template class BlockDeletion<3>;
template EffectType<3> deletionType<3>();

} // namespace drystone
