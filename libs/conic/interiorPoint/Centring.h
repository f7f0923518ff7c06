// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How one factorisation is used: which products s o z the correctors request. Internal to the interior
/// point.
#pragma once

#include "conic/interiorPoint/State.h"

namespace drystone
{

/// Mehrotra (1992) aims at sigma mu, where sigma is the cube of what the predictor would leave of mu. Each of
/// Gondzio's (1996) correctors requests steps so much longer than the last one allows, and pulls the products
/// s o z at their end into a box about an aim of its own. Unlike there a corrector is taken even if it
/// shortens the step, but not to less than a part: what it does for the centring pays at the next iterate.
struct Centring
{
    double partOfCube; ///< sigma over Mehrotra's
    double aim;        ///< of the correctors, times sigma mu, but at least this times mu:
    double leastAim;
    double relativeGrowth; ///< of the step requested,
    double stepGrowth;     ///< and so much on top
    double leastProduct;   ///< of the box, times the aim
    double largestProduct;
    double largestLoss; ///< what is left of a step at least
    double longStep;    ///< needs no more correctors
};

/// The best of many settings drawn at random (test/benchmark/results/TUNING.md).
constexpr Centring wide{.partOfCube = 0.25,
                        .aim = 5,
                        .leastAim = 1e-3,
                        .relativeGrowth = 1.15,
                        .stepGrowth = 0.5,
                        .leastProduct = 0.2,
                        .largestProduct = 8,
                        .largestLoss = 0.3,
                        .longStep = 0.86};

/// Where iterations begin near the solution, or those from nothing have broken down.
constexpr Centring narrow{.partOfCube = 1,
                          .aim = 1,
                          .leastAim = 1e-3,
                          .relativeGrowth = 1.075,
                          .stepGrowth = 0.3,
                          .leastProduct = 0.3,
                          .largestProduct = 3,
                          .largestLoss = 0.5,
                          .longStep = 0.95};

/// Mehrotra's corrector: D p for products that change by sigma mu e less the second-order term of the
/// predictor. \param step the predictor \param scaled the same in the scaling \return as the cones
template<int Rows, class Scalar>
VectorOf<Scalar> mehrotraPull(const State<Rows, Scalar>& state, const ConeScaling<Scalar>& scaling,
                              const Iterate<Scalar>& step, const ScaledStep<Scalar>& scaled, double sigma);

/// Gondzio's: D p for products that come into the box about `aim`, as far as the steps `primal` and `dual`
/// along `step` leave them outside. \return as the cones
template<int Rows, class Scalar>
VectorOf<Scalar> gondzioPull(const State<Rows, Scalar>& state, const ConeScaling<Scalar>& scaling,
                             const Iterate<Scalar>& step, const ScaledStep<Scalar>& scaled, double primal,
                             double dual, const Centring& centring, double aim);

} // namespace drystone
