// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Scales mechanisms for display: a mechanism has a shape but no magnitude, so the magnitude is a matter of
/// presentation.
#include "io/Mechanism.h"

#include "assembly/BlockShape.h"
#include "core/Error.h"
#include "io/Frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

template<int Dim>
void checkShape(const Assembly<Dim>& assembly, const Rates<Dim>& rates)
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

/// Rate of a corner from that of its block.
Vector<2> cornerRate(const Eigen::Vector3d& rate, const Vector<2>& arm)
{
    return rate.head<2>() + rate.z() * perpendicular(arm);
}

Vector<3> cornerRate(const Eigen::Matrix<double, 6, 1>& rate, const Vector<3>& arm)
{
    const Vector<3> spin = rate.tail<3>();
    return rate.head<3>() + momentOf(spin, arm); // the cross product
}

} // namespace

template<int Dim>
Rates<Dim> ratesOfAllBlocks(const Assembly<Dim>& assembly, const Eigen::VectorXd& freeRates)
{
    constexpr int rows = freedomCount<Dim>;
    const std::vector<int> freeIndex = freeIndices(assembly);
    const auto freeBlocks =
        std::count_if(freeIndex.begin(), freeIndex.end(), [](int index) { return index >= 0; });
    if (freeRates.size() != rows * freeBlocks)
    {
        throw FatalError(fmt::format("{} displacement rates were given for {} free blocks.", freeRates.size(),
                                     freeBlocks));
    }
    Rates<Dim> rates = Rates<Dim>::Zero(rows, static_cast<Eigen::Index>(freeIndex.size()));
    for (std::size_t i = 0; i < freeIndex.size(); ++i)
    {
        if (freeIndex[i] >= 0)
        {
            rates.col(static_cast<Eigen::Index>(i)) = freeRates.segment<rows>(rows * freeIndex[i]);
        }
    }
    return rates;
}

template<int Dim>
double largestDisplacement(const Assembly<Dim>& assembly, const std::type_identity_t<Rates<Dim>>& rates)
{
    checkShape<Dim>(assembly, rates);
    double largest = 0;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Vector<Dim> centroid = blockMass(assembly.blocks[i]).centroid;
        for (const Vector<Dim>& vertex : cornersOf(assembly.blocks[i]))
        {
            const Vector<Dim> arm = vertex - centroid;
            largest = std::max(largest, cornerRate(rates.col(static_cast<Eigen::Index>(i)), arm).norm());
        }
    }
    return largest;
}

template<int Dim>
std::vector<Placement<Dim>> mechanismPlacements(const Assembly<Dim>& assembly,
                                                const std::type_identity_t<Rates<Dim>>& rates,
                                                double amplitude)
{
    const double largest = largestDisplacement(assembly, rates);
    const double factor = largest > 0 ? amplitude / largest : 0;
    std::vector<Placement<Dim>> placements(assembly.blocks.size());
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        const auto rate = rates.col(static_cast<Eigen::Index>(i));
        placements[i].translation = factor * rate.template head<Dim>();
        if constexpr (Dim == 2)
        {
            placements[i].rotation = factor * rate.z();
        }
        else
        {
            placements[i].rotation = factor * rate.template tail<3>();
        }
    }
    return placements;
}

template<int Dim>
void writeMechanism(VtkSeries& series, const Assembly<Dim>& assembly,
                    const std::type_identity_t<Rates<Dim>>& rates, const std::vector<Field>& more, int frames)
{
    const double largest = largestDisplacement(assembly, rates);
    const double factor = largest > 0 ? 1 / largest : 0;
    Field displacementRate{"displacementRate[-]", Dim, {}, FieldType::real};
    Field rotationRate{"rotationRate[rad/m]", rotationCount<Dim>, {}, FieldType::real};
    for (Eigen::Index i = 0; i < rates.cols(); ++i)
    {
        for (int row = 0; row < freedomCount<Dim>; ++row)
        {
            (row < Dim ? displacementRate : rotationRate).values.push_back(factor * rates(row, i));
        }
    }
    std::vector<Field> fields{std::move(displacementRate), std::move(rotationRate)};
    fields.insert(fields.end(), more.begin(), more.end());
    const double amplitude = 0.5 * meanBlockSize(assembly);
    const int last = largest > 0 ? std::max(1, frames - 1) : 0;
    for (int frame = 0; frame <= last; ++frame)
    {
        const double time = last == 0 ? 0 : static_cast<double>(frame) / last;
        series.write(time,
                     blockFrame(assembly, mechanismPlacements(assembly, rates, time * amplitude), fields));
    }
}

template Rates<2> ratesOfAllBlocks(const Assembly<2>& assembly, const Eigen::VectorXd& freeRates);
template double largestDisplacement(const Assembly<2>& assembly, const Rates<2>& rates);
template std::vector<Placement<2>> mechanismPlacements(const Assembly<2>& assembly, const Rates<2>& rates,
                                                       double amplitude);
template void writeMechanism(VtkSeries& series, const Assembly<2>& assembly, const Rates<2>& rates,
                             const std::vector<Field>& more, int frames);
template Rates<3> ratesOfAllBlocks(const Assembly<3>& assembly, const Eigen::VectorXd& freeRates);
template double largestDisplacement(const Assembly<3>& assembly, const Rates<3>& rates);
template std::vector<Placement<3>> mechanismPlacements(const Assembly<3>& assembly, const Rates<3>& rates,
                                                       double amplitude);
template void writeMechanism(VtkSeries& series, const Assembly<3>& assembly, const Rates<3>& rates,
                             const std::vector<Field>& more, int frames);

} // namespace drystone
