// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Each format with what it takes of a case, and what of it is lost.
#include "ExportFormats.h"

#include "contact/JointClosure.h"
#include "contact/PointsOfJoints.h"
#include "core/Log.h"
#include "effects/EffectList.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace drystone
{
namespace
{

template<int Dim>
std::string obj(const BlockExport<Dim>& blocks)
{
    return objText(blocks.solids, blocks.numbers);
}

/// The joints as built; none of the plane, where they are lines and not interfaces.
template<int Dim>
std::vector<StatedJoint<3>> jointsOf(const Assembly<Dim>& assembly)
{
    std::vector<StatedJoint<3>> joints;
    if constexpr (Dim == 3)
    {
        Assembly<3> closed = assembly;
        closeJoints(closed);
        const std::vector<ContactPoint<3>> points = findContactPoints(closed);
        for (const PointRange& range : pointsOfJoints(points))
        {
            const ContactPoint<3>& first = points[range.begin];
            joints.push_back({first.block, first.neighbour, first.normal, {}});
            for (std::size_t i = range.begin; i < range.end; ++i)
            {
                joints.back().points.push_back(points[i].position);
            }
        }
    }
    return joints;
}

template<int Dim>
std::string compasJson(const BlockExport<Dim>& blocks)
{
    const bool isAsBuilt = blocks.time.empty();
    return compasJsonText(
        blocks.solids, isAsBuilt ? jointsOf(blocks.assembly) : std::vector<StatedJoint<3>>(), blocks.numbers);
}

template<int Dim>
std::string dxf(const BlockExport<Dim>& blocks)
{
    if constexpr (Dim == 2)
    {
        return dxfText(blocks.assembly, blocks.placements, blocks.numbers);
    }
    else
    {
        return dxfText(blocks.solids, blocks.numbers);
    }
}

template<int Dim>
std::string gltf(const BlockExport<Dim>& blocks)
{
    return gltfText(blocks.solids, blocks.frames);
}

/// What the joints of the case do and an LMGC90 script does not.
void warnOfLaws(const ContactProperties& properties)
{
    std::vector<std::string_view> others;
    for (const auto& [isGiven, name] : {std::pair{properties.restitution.has_value(), "restitution"},
                                        std::pair{properties.cohesion.has_value(), "cohesion"},
                                        std::pair{properties.tension.has_value(), "tension"},
                                        std::pair{properties.crushing.has_value(), "crushing"}})
    {
        if (isGiven)
        {
            others.emplace_back(name);
        }
    }
    if (!others.empty())
    {
        printWarning(fmt::format("The script has friction alone (IQS_CLB): of constant/contactProperties it "
                                 "leaves out {}.",
                                 fmt::join(others, ", ")));
    }
    if (properties.friction && properties.friction->flowRule == FlowRule::associative)
    {
        printWarning("The script slides by Coulomb's law, without dilatancy, where flowRule of "
                     "constant/contactProperties is associative.");
    }
    if (!properties.joints.empty())
    {
        printWarning("The script has one law for all joints: what `joints` of constant/contactProperties "
                     "says of some is not in it.");
    }
}

template<int Dim>
std::string lmgc90(const BlockExport<Dim>& blocks)
{
    const ContactProperties properties = readContactProperties(blocks.caseDirectory);
    warnOfLaws(properties);
    return lmgc90Text(blocks.solids, properties.friction ? properties.friction->mu : 0);
}

template<int Dim>
std::string threeDec(const BlockExport<Dim>& blocks)
{
    info("3DEC commands have the shapes alone: which blocks are fixed stands in comments, densities and "
         "properties of joints are yours to add");
    return threeDecText(blocks.solids);
}

} // namespace

template<int Dim>
const std::vector<ExportFormat<Dim>>& exportFormats()
{
    static const std::vector<ExportFormat<Dim>> formats{
        {.name = "obj", .ending = ".obj", .text = obj<Dim>, .takesDecimals = true},
        {.name = "compasJson",
         .ending = ".json",
         .text = compasJson<Dim>,
         .written = {WrittenZones::all, Dim == 3 ? WrittenJoints::all : WrittenJoints::none},
         .takesDecimals = true},
        {.name = "dxf",
         .ending = ".dxf",
         .text = dxf<Dim>,
         .written = {.thickness = Dim == 2 ? WrittenThickness::none : WrittenThickness::all},
         .takesDecimals = true},
        {.name = "gltf", .ending = ".gltf", .text = gltf<Dim>, .takesFrames = true},
        {.name = "lmgc90",
         .ending = ".py",
         .text = lmgc90<Dim>,
         .hasDensities = true,
         .ofConcaveBlocks = "divide them before it computes"},
        {.name = "3dec", .ending = ".dat", .text = threeDec<Dim>, .ofConcaveBlocks = "they are left out"}};
    return formats;
}

template const std::vector<ExportFormat<2>>& exportFormats<2>();
template const std::vector<ExportFormat<3>>& exportFormats<3>();

} // namespace drystone
