// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Moments and work of forces whose points turn with their blocks, from the first moments of the forces.
#include "assembly/TurnedLoad.h"

#include "geometry/Rotation.h"

namespace drystone
{
namespace
{

template<int Dim>
using Square = Eigen::Matrix<double, Dim, Dim>;

/// (R - 1) S of a block.
template<int Dim>
Square<Dim> changeOfFirstMoments(const Load& load, int freeIndex, const Placement<Dim>& placement)
{
    const Swing<Dim> swing(placement.rotation);
    Square<Dim> change = load.firstMoments.middleCols<Dim>(Dim * freeIndex);
    for (int column = 0; column < Dim; ++column)
    {
        change.col(column) = swing(Vector<Dim>(change.col(column)));
    }
    return change;
}

/// The sum of a x f, of S = sum a f'.
Eigen::Matrix<double, 1, 1> momentOfFirst(const Square<2>& moments)
{
    return Eigen::Matrix<double, 1, 1>(moments(0, 1) - moments(1, 0));
}
Vector<3> momentOfFirst(const Square<3>& moments)
{
    return {moments(1, 2) - moments(2, 1), moments(2, 0) - moments(0, 2), moments(0, 1) - moments(1, 0)};
}

} // namespace

template<int Dim>
Eigen::VectorXd turnedLoad(const Load& load, const std::vector<int>& free,
                           const std::vector<Placement<Dim>>& placements)
{
    Eigen::VectorXd rows = load.rows;
    for (std::size_t block = 0; load.firstMoments.size() > 0 && block < free.size(); ++block)
    {
        if (free[block] >= 0)
        {
            rows.segment<rotationCount<Dim>>(freedomCount<Dim> * free[block] + Dim) +=
                momentOfFirst(changeOfFirstMoments<Dim>(load, free[block], placements[block]));
        }
    }
    return rows;
}

template<int Dim>
double workOfTurning(const Load& load, int freeIndex, const Placement<Dim>& placement)
{
    return load.firstMoments.size() > 0 ? changeOfFirstMoments<Dim>(load, freeIndex, placement).trace() : 0;
}

template Eigen::VectorXd turnedLoad(const Load& load, const std::vector<int>& free,
                                    const std::vector<Placement<2>>& placements);
template double workOfTurning(const Load& load, int freeIndex, const Placement<2>& placement);
template Eigen::VectorXd turnedLoad(const Load& load, const std::vector<int>& free,
                                    const std::vector<Placement<3>>& placements);
template double workOfTurning(const Load& load, int freeIndex, const Placement<3>& placement);

} // namespace drystone
