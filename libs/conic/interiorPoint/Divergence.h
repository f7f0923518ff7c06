// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What iterates of the interior points, in the plane and in space, show where a program has no solution.
#pragma once

#include "conic/ConeProgram.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace drystone
{

/// What a program is solved for.
enum class Sought
{
    solution, ///< the live load does one unit of work on the displacements: a mechanism
    farther,  ///< likewise, where a large multiplier is no reason to find out whether there is a largest one
    fall,   ///< displacements that prove that nothing balances the loads; the live load does no work on them
    carried ///< forces that carry the live load alone, which prove that there is no largest multiplier
};

/// Multiplier, of loads that are of the same size, that ends iterations for a `solution`: other programs show
/// whether there is a largest one. Where there is none each iteration makes it hundreds of times as large.
/// Where there is, it is mostly that of a strength, and forces so large are not balanced to the tolerance in
/// units of the load.
constexpr double possiblyUnlimited = 1e4;

/// Multiplier, likewise, at which the loads are to be balanced where any that is larger is carried, too: the
/// tolerance is then still one of the dead load.
constexpr double largeMultiplier = 100;

/// Displacements on which the loads fall, but for this share of what they do there, end iterations: another
/// program proves that nothing balances the loads. Forces ten million times as large as these might.
constexpr double possibleFall = 1e-7;

/// Of the program that proves it: the complementarity, relative, at which its displacements are those of its
/// solution to a thousandth, in the metric of its inertia. They show how the structure falls; that it does is
/// proved to the tolerance.
constexpr double complementarityOfFall = 1e-6;

/// Whether displacements close nothing, B'y <= 0, while the live load does no work on them and the others do,
/// f'y > 0. Then no forces balance these, since f'y = (B s)'y = s'(B'y) <= 0 for any.
/// \param liveLoad may be empty \param closing what B'y misses the cones by, or more \param liveWork L'y
/// \param error allowed to the first two, relative, as a share of the third's
inline bool isFall(const Eigen::VectorXd& load, const Eigen::VectorXd& liveLoad,
                   const Eigen::VectorXd& displacement, double closing, double liveWork, double error)
{
    const double work = load.dot(displacement);
    if (!(work > 0))
    {
        return false;
    }
    const double size = displacement.lpNorm<Eigen::Infinity>();
    const double share =
        work / std::max(load.cwiseProduct(displacement).lpNorm<1>(), load.lpNorm<Eigen::Infinity>() * size);
    const double missed =
        std::max(closing, liveLoad.size() > 0 ? std::abs(liveWork) / liveLoad.lpNorm<1>() : 0.0) / size;
    return missed <= error * share;
}

/// How large iterates have become, scaled.
struct IterateSizes
{
    double displacement; ///< the largest
    double force;        ///< the largest
    double balance;      ///< the largest of what is left of it
    double multiplier;   ///< alpha

    double loads() const { return std::max(1.0, std::abs(multiplier)); }
};

/// Whether iterates run off along a ray.
inline bool runsOff(const IterateSizes& at)
{
    constexpr double far = 1e13;
    return std::abs(at.multiplier) > far || at.displacement > far || at.force > far * at.loads();
}

/// Whether displacements that no inertia bounds run off. They do so slowly, for the proximal term of the
/// Schur system holds them: where after many iterations they are large and the balance is not near, more show
/// no more.
inline bool runsOffSlowly(const IterateSizes& at, int iterations)
{
    constexpr int many = 30;
    constexpr double large = 1e6;
    constexpr double near = 1e-3;
    return iterations >= many && at.displacement > large && at.balance > near * at.loads();
}

/// The balance of a program's live load alone. With its gaps, as what forces at points apart would cost
/// there.
template<int Rows, int Forces>
ConeProgram<Rows, Forces> liveLoadAlone(ConeProgram<Rows, Forces> program)
{
    program.load = program.liveLoad;
    program.liveLoad.resize(0);
    return program;
}

/// The balance of a program's loads alone at a large multiplier. Where there are forces for it, and others
/// that carry the live load alone, there is no largest multiplier.
template<int Rows, int Forces>
ConeProgram<Rows, Forces> atLargeMultiplier(ConeProgram<Rows, Forces> program)
{
    const double share =
        program.load.template lpNorm<Eigen::Infinity>() / program.liveLoad.template lpNorm<Eigen::Infinity>();
    program.load += largeMultiplier * share * program.liveLoad;
    program.liveLoad.resize(0);
    program.gap.resize(0);
    return program;
}

} // namespace drystone
