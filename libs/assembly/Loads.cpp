// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Load vectors of gravity and inertia, of forces at points, and the blocks that a line of load meets.
#include "assembly/Loads.h"

#include "assembly/BlockShape.h"
#include "assembly/CaseFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    return gravityLoad(assembly, masses, gravity.norm() * direction.stableNormalized());
}

template<int Dim>
LoadedBlocks findLoadedBlocks(const Assembly<Dim>& assembly, const std::type_identity_t<Vector<Dim>>& point,
                              double tolerance)
{
    const double same = widthOfAJoint(assembly);
    std::vector<std::pair<double, int>> found;
    double least = std::numeric_limits<double>::infinity();
    bool isInFixed = false;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<Dim>& block = assembly.blocks[i];
        if (!contains<Dim>(enlarged<Dim>(boundingBox(block), tolerance + same), {point, point}))
        {
            continue;
        }
        const double away = distanceFrom(block, point);
        if (block.support >= 0)
        {
            isInFixed = isInFixed || away == 0;
        }
        else if (away <= tolerance)
        {
            least = std::min(least, away);
            found.emplace_back(away, static_cast<int>(i));
        }
    }
    LoadedBlocks loaded;
    if (isInFixed && least > same)
    {
        return loaded;
    }
    for (const auto& [away, block] : found)
    {
        if (away <= least + same)
        {
            loaded.blocks.push_back(block);
            loaded.distance = least;
        }
    }
    return loaded;
}

template<int Dim>
Load pointLoad(const Assembly<Dim>& assembly, int block, const std::type_identity_t<Vector<Dim>>& point,
               const std::type_identity_t<Vector<Dim>>& force)
{
    const std::vector<int> freeIndex = freeIndices(assembly);
    const Eigen::Index rows = freeRows<Dim>(freeIndex);
    Load load{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(Dim, rows / freedomCount<Dim> * Dim)};
    const Vector<Dim> arm = point - blockMass(assembly.blocks[block]).centroid;
    load.rows.template segment<freedomCount<Dim>>(freedomCount<Dim> * freeIndex[block]) << force,
        momentOf(arm, force);
    load.firstMoments.template middleCols<Dim>(Dim * freeIndex[block]) = arm * force.transpose();
    return load;
}

template<int Dim>
std::vector<LinePiece<Dim>> piecesOfLine(const Assembly<Dim>& assembly,
                                         const std::type_identity_t<Vector<Dim>>& from,
                                         const std::type_identity_t<Vector<Dim>>& to, double tolerance)
{
    const Vector<Dim> along = to - from;
    std::vector<double> cuts{0, 1};
    const Box<Dim> reach = enlarged<Dim>(boxAround<Dim>(from, to), tolerance);
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
    std::vector<LinePiece<Dim>> pieces;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    {
        const double share = cuts[i + 1] - cuts[i];
        if (share > 1e-12)
        {
            const Vector<Dim> middle = from + (cuts[i] + cuts[i + 1]) / 2 * along;
            pieces.push_back({middle, share * along.norm(), findLoadedBlocks(assembly, middle, tolerance)});
        }
    }
    return pieces;
}

template<int Dim>
void SumOfLoads<Dim>::add(const Load& load, double factor)
{
    const Eigen::VectorXd rows = factor * load.rows;
    const Eigen::VectorXd size = rows.cwiseAbs();
    total = total.size() == 0 ? rows : Eigen::VectorXd(total + rows);
    sizes = sizes.size() == 0 ? size : Eigen::VectorXd(sizes + size);
    if (load.firstMoments.size() > 0)
    {
        const Eigen::MatrixXd moments = factor * load.firstMoments;
        firstMoments = firstMoments.size() == 0 ? moments : Eigen::MatrixXd(firstMoments + moments);
    }
}

template<int Dim>
Load SumOfLoads<Dim>::sum() const
{
    // A moment is the difference of products of forces and arms, and rounded as these are.
    Eigen::VectorXd scale = sizes;
    const std::vector<int> freeIndex = freeIndices(assembly);
    for (std::size_t block = 0; block < freeIndex.size(); ++block)
    {
        if (freeIndex[block] >= 0)
        {
            const auto first = freedomCount<Dim> * freeIndex[block];
            const Box<Dim> box = boundingBox(assembly.blocks[block]);
            const double force = sizes.template segment<Dim>(first).sum();
            scale.template segment<Dim>(first).setConstant(force);
            scale.template segment<rotationCount<Dim>>(first + Dim).array() +=
                force * (box.upper - box.lower).norm();
        }
    }
    return {(total.array().abs() > roundingOfLoads * scale.array()).select(total, 0), firstMoments};
}

template<int Dim>
double widthOfAJoint(const Assembly<Dim>& assembly)
{
    return std::max(1e-6 * meanBlockSize(assembly), assembly.closure.tolerance);
}

template Eigen::VectorXd gravityLoad(const Assembly<2>&, const std::vector<double>&, const Vector<2>&);
template Eigen::VectorXd inertialLoad(const Assembly<2>&, const std::vector<double>&, const Vector<2>&,
                                      const Vector<2>&);
template LoadedBlocks findLoadedBlocks(const Assembly<2>&, const Vector<2>&, double);
template Load pointLoad(const Assembly<2>&, int, const Vector<2>&, const Vector<2>&);
template std::vector<LinePiece<2>> piecesOfLine(const Assembly<2>&, const Vector<2>&, const Vector<2>&,
                                                double);
template class SumOfLoads<2>;
template double widthOfAJoint(const Assembly<2>&);

template Eigen::VectorXd gravityLoad(const Assembly<3>&, const std::vector<double>&, const Vector<3>&);
template Eigen::VectorXd inertialLoad(const Assembly<3>&, const std::vector<double>&, const Vector<3>&,
                                      const Vector<3>&);
template LoadedBlocks findLoadedBlocks(const Assembly<3>&, const Vector<3>&, double);
template Load pointLoad(const Assembly<3>&, int, const Vector<3>&, const Vector<3>&);
template std::vector<LinePiece<3>> piecesOfLine(const Assembly<3>&, const Vector<3>&, const Vector<3>&,
                                                double);
template class SumOfLoads<3>;
template double widthOfAJoint(const Assembly<3>&);

} // namespace drystone
