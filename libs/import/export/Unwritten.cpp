// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Groups, joints, thicknesses and tolerances for which a format has no place.
#include "import/export/Unwritten.h"

#include "import/export/ExportedSolids.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

namespace
{

template<int Dim>
void addZones(const Assembly<Dim>& assembly, std::string_view format, std::vector<std::string>& texts)
{
    const std::vector<std::vector<std::string>> names = groupsOfBlocks(assembly);
    const auto isInSeveral = [](const std::vector<std::string>& ofBlock) { return ofBlock.size() > 1; };
    const auto first = std::find_if(names.begin(), names.end(), isInSeveral);
    if (first != names.end())
    {
        texts.push_back(fmt::format(
            "{} blocks have more than one group, as block {} ({}): {} has one name for a block, and "
            "the file has the first, {}. compasJson has all of them.",
            std::count_if(names.begin(), names.end(), isInSeveral), first - names.begin(),
            fmt::join(*first, " "), format, first->front()));
    }
}

void addThickness(const Assembly<2>& assembly, std::string_view format, std::vector<std::string>& texts)
{
    const auto [least, most] =
        std::minmax_element(assembly.blocks.begin(), assembly.blocks.end(),
                            [](const Block<2>& a, const Block<2>& b) { return a.thickness < b.thickness; });
    if (least == assembly.blocks.end()
        || (least->thickness == 1 && most->thickness == 1)) // what a drawing is given that says none
    {
        return;
    }
    texts.push_back(
        least->thickness == most->thickness
            ? fmt::format("{} has no thickness: state `thickness {:.12g};` where the file is imported.",
                          format, most->thickness)
            : fmt::format(
                "{} has no thickness, and that of the blocks, from {:.12g} to {:.12g} m, is lost. obj "
                "has it: blocks are solids there.",
                format, least->thickness, most->thickness));
}
void addThickness(const Assembly<3>&, std::string_view, std::vector<std::string>&) {}

} // namespace

template<int Dim>
std::vector<std::string> unwritten(const Assembly<Dim>& assembly, std::string_view format,
                                   const WrittenProperties& written)
{
    std::vector<std::string> texts;
    if (written.zones == WrittenZones::first)
    {
        addZones(assembly, format, texts);
    }
    if (written.thickness == WrittenThickness::none)
    {
        addThickness(assembly, format, texts);
    }
    if (written.joints == WrittenJoints::none && !assembly.statedJoints.empty())
    {
        texts.push_back(fmt::format("The assembly states its {} joints, and the file has none: they are "
                                    "found from the shapes where it "
                                    "is imported. compasJson has the joints of blocks as built.",
                                    assembly.statedJoints.size()));
    }
    if (assembly.jointTolerance)
    {
        texts.push_back(
            fmt::format("The file has no jointTolerance: state `jointTolerance {:.12g};` where it "
                        "is imported.",
                        *assembly.jointTolerance));
    }
    return texts;
}

template std::vector<std::string> unwritten(const Assembly<2>& assembly, std::string_view format,
                                            const WrittenProperties& written);
template std::vector<std::string> unwritten(const Assembly<3>& assembly, std::string_view format,
                                            const WrittenProperties& written);

} // namespace drystone
