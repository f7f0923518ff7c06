// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Load vectors.
#include "assembly/Loads.h"

#include "assembly/BlockShape.h"
#include "assembly/CaseFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

template<int Dim>
Eigen::Index freeRows(const std::vector<int>& freeIndex)
{
    return freedomCount<
               Dim> * std::count_if(freeIndex.begin(), freeIndex.end(), [](int index) { return index >= 0; });
}

} // namespace

template<int Dim>
Eigen::VectorXd gravityLoad(const Assembly<Dim>& assembly, const std::vector<double>& masses,
                            const std::type_identity_t<Vector<Dim>>& gravity)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(freeRows<Dim>(freeIndex));
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (freeIndex[i] >= 0)
        {
            load.template segment<Dim>(freedomCount<Dim> * freeIndex[i]) = masses[i] * gravity;
        }
    }
    return load;
}

template<int Dim>
Eigen::VectorXd inertialLoad(const Assembly<Dim>& assembly, const std::vector<double>& masses,
                             const std::type_identity_t<Vector<Dim>>& gravity,
                             const std::type_identity_t<Vector<Dim>>& direction)
{
    return gravityLoad(assembly, masses, gravity.norm() * direction.normalized());
}

template<int Dim>
std::optional<int> findLoadedBlock(const Assembly<Dim>& assembly,
                                   const std::type_identity_t<Vector<Dim>>& point, double tolerance)
{
    std::optional<int> nearest;
    double least = tolerance;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<Dim>& block = assembly.blocks[i];
        if (block.support >= 0
            || !contains<Dim>(enlarged<Dim>(boundingBox(block), tolerance), {point, point}))
        {
            continue;
        }
        // Inside counts as no distance at all, so that among blocks which hold the point the first is taken.
        const double away = distanceFrom(block, point);
        if (away < least || (away <= least && !nearest))
        {
            least = away;
            nearest = static_cast<int>(i);
        }
    }
    return nearest;
}

template<int Dim>
std::vector<int> findLoadedBlocks(const Assembly<Dim>& assembly,
                                  const std::type_identity_t<Vector<Dim>>& point, double tolerance,
                                  double same)
{
    std::vector<std::pair<double, int>> found;
    double least = tolerance;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<Dim>& block = assembly.blocks[i];
        if (block.support < 0
            && contains<Dim>(enlarged<Dim>(boundingBox(block), tolerance + same), {point, point}))
        {
            const double away = distanceFrom(block, point);
            least = std::min(least, away);
            found.emplace_back(away, static_cast<int>(i));
        }
    }
    std::vector<int> blocks;
    for (const auto& [away, block] : found)
    {
        if (away <= least + same && away <= tolerance)
        {
            blocks.push_back(block);
        }
    }
    return blocks;
}

template<int Dim>
Eigen::VectorXd pointLoad(const Assembly<Dim>& assembly, int block,
                          const std::type_identity_t<Vector<Dim>>& point,
                          const std::type_identity_t<Vector<Dim>>& force)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(freeRows<Dim>(freeIndex));
    const Vector<Dim> arm = point - blockMass(assembly.blocks[block]).centroid;
    load.template segment<freedomCount<Dim>>(freedomCount<Dim> * freeIndex[block]) << force,
        momentOf(arm, force);
    return load;
}

template<int Dim>
std::optional<Eigen::VectorXd>
lineLoad(const Assembly<Dim>& assembly, const std::type_identity_t<Vector<Dim>>& from,
         const std::type_identity_t<Vector<Dim>>& to, const std::type_identity_t<Vector<Dim>>& forcePerLength,
         double tolerance)
{
    // Cut wherever the line may pass from one block to another.
    const Vector<Dim> along = to - from;
    std::vector<double> cuts{0, 1};
    const Box<Dim> reach = enlarged<Dim>({from.cwiseMin(to), from.cwiseMax(to)}, tolerance);
    for (const Block<Dim>& block : assembly.blocks)
    {
        if (block.support < 0 && meet<Dim>(reach, boundingBox(block)))
        {
            for (const double place : placesToCut(block, from, along))
            {
                if (place > 0 && place < 1)
                {
                    cuts.push_back(place);
                }
            }
        }
    }
    std::sort(cuts.begin(), cuts.end());
    std::optional<Eigen::VectorXd> load;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    {
        const double share = cuts[i + 1] - cuts[i];
        if (share <= 1e-12)
        {
            continue;
        }
        const Vector<Dim> middle = from + (cuts[i] + cuts[i + 1]) / 2 * along;
        const std::optional<int> block = findLoadedBlock(assembly, middle, tolerance);
        if (!block)
        {
            return std::nullopt;
        }
        const Eigen::VectorXd piece =
            pointLoad(assembly, *block, middle, share * along.norm() * forcePerLength);
        load = load ? Eigen::VectorXd(*load + piece) : piece;
    }
    return load;
}

template<int Dim>
double widthOfAJoint(const Assembly<Dim>& assembly)
{
    return std::max(1e-6 * meanBlockSize(assembly), assembly.closure.tolerance);
}

template Eigen::VectorXd gravityLoad(const Assembly<2>&, const std::vector<double>&, const Vector<2>&);
template Eigen::VectorXd inertialLoad(const Assembly<2>&, const std::vector<double>&, const Vector<2>&,
                                      const Vector<2>&);
template std::optional<int> findLoadedBlock(const Assembly<2>&, const Vector<2>&, double);
template std::vector<int> findLoadedBlocks(const Assembly<2>&, const Vector<2>&, double, double);
template Eigen::VectorXd pointLoad(const Assembly<2>&, int, const Vector<2>&, const Vector<2>&);
template std::optional<Eigen::VectorXd> lineLoad(const Assembly<2>&, const Vector<2>&, const Vector<2>&,
                                                 const Vector<2>&, double);
template double widthOfAJoint(const Assembly<2>&);

template Eigen::VectorXd gravityLoad(const Assembly<3>&, const std::vector<double>&, const Vector<3>&);
template Eigen::VectorXd inertialLoad(const Assembly<3>&, const std::vector<double>&, const Vector<3>&,
                                      const Vector<3>&);
template std::optional<int> findLoadedBlock(const Assembly<3>&, const Vector<3>&, double);
template std::vector<int> findLoadedBlocks(const Assembly<3>&, const Vector<3>&, double, double);
template Eigen::VectorXd pointLoad(const Assembly<3>&, int, const Vector<3>&, const Vector<3>&);
template std::optional<Eigen::VectorXd> lineLoad(const Assembly<3>&, const Vector<3>&, const Vector<3>&,
                                                 const Vector<3>&, double);
template double widthOfAJoint(const Assembly<3>&);

} // namespace drystone
