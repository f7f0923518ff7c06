// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Scales mechanisms for display: a mechanism has a shape but no magnitude, so the magnitude is a matter of
/// presentation.
#include "io/Mechanism.h"

#include "contact/Facing.h"
#include "core/Error.h"
#include "io/Frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

void checkShape(const Assembly<2>& assembly, const Eigen::Matrix3Xd& rates)
{
    if (rates.cols() != static_cast<Eigen::Index>(assembly.blocks.size()))
    {
        throw FatalError(fmt::format("Displacement rates of {} blocks were given for {} blocks.",
                                     rates.cols(), assembly.blocks.size()));
    }
    if (!rates.allFinite())
    {
        throw FatalError("A displacement rate of the mechanism is not a finite number.");
    }
}

} // namespace

Eigen::Matrix3Xd ratesOfAllBlocks(const Assembly<2>& assembly, const Eigen::VectorXd& freeRates)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    const auto freeBlocks =
        std::count_if(freeIndex.begin(), freeIndex.end(), [](int index) { return index >= 0; });
    if (freeRates.size() != 3 * freeBlocks)
    {
        throw FatalError(fmt::format("{} displacement rates were given for {} free blocks.", freeRates.size(),
                                     freeBlocks));
    }
    Eigen::Matrix3Xd rates = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(freeIndex.size()));
    for (std::size_t i = 0; i < freeIndex.size(); ++i)
    {
        if (freeIndex[i] >= 0)
        {
            rates.col(static_cast<Eigen::Index>(i)) = freeRates.segment<3>(3 * freeIndex[i]);
        }
    }
    return rates;
}

double largestDisplacement(const Assembly<2>& assembly, const Eigen::Matrix3Xd& rates)
{
    checkShape(assembly, rates);
    double largest = 0;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const auto rate = rates.col(static_cast<Eigen::Index>(i));
        const Vector<2> centroid = areaProperties(assembly.blocks[i].outline).centroid;
        for (const Vector<2>& vertex : assembly.blocks[i].outline)
        {
            largest =
                std::max(largest, (rate.head<2>() + rate.z() * perpendicular(vertex - centroid)).norm());
        }
    }
    return largest;
}

std::vector<Placement<2>> mechanismPlacements(const Assembly<2>& assembly, const Eigen::Matrix3Xd& rates,
                                              double amplitude)
{
    const double largest = largestDisplacement(assembly, rates);
    const double factor = largest > 0 ? amplitude / largest : 0;
    std::vector<Placement<2>> placements(assembly.blocks.size());
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        const auto rate = rates.col(static_cast<Eigen::Index>(i));
        placements[i] = {factor * rate.head<2>(), factor * rate.z()};
    }
    return placements;
}

void writeMechanism(VtkSeries& series, const Assembly<2>& assembly, const Eigen::Matrix3Xd& rates, int frames)
{
    const double largest = largestDisplacement(assembly, rates);
    const double factor = largest > 0 ? 1 / largest : 0;
    Field displacementRate{"displacementRate", 2, {}, FieldType::real};
    Field rotationRate{"rotationRate", 1, {}, FieldType::real};
    for (Eigen::Index i = 0; i < rates.cols(); ++i)
    {
        displacementRate.values.push_back(factor * rates(0, i));
        displacementRate.values.push_back(factor * rates(1, i));
        rotationRate.values.push_back(factor * rates(2, i));
    }
    const double amplitude = 0.5 * meanBlockSize(assembly);
    const int last = largest > 0 ? std::max(1, frames - 1) : 0;
    for (int frame = 0; frame <= last; ++frame)
    {
        const double time = last == 0 ? 0 : static_cast<double>(frame) / last;
        series.write(time, blockFrame(assembly, mechanismPlacements(assembly, rates, time * amplitude),
                                      {displacementRate, rotationRate}));
    }
}

} // namespace drystone
