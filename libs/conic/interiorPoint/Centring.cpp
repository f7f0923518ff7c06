// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/interiorPoint/Centring.h"

namespace drystone
{
namespace
{

/// What the product of a ray at the end of a step becomes larger by for each unit that is asked for in c. In
/// Newton's equations, the other cones aside, c changes s by (1 - p) c/z and z by p c/s, where p = D b'S^-1 b
/// is the leverage of the ray, and so (s + ds)(z + dz) by c times
///     (1 - p) (z + dz)/z + p (s + ds)/s.
/// Where the one grows to three times what it was and drives the other below zero, asking for what is missing
/// moves the product too far, and where it shrinks, not far enough: the corrections then end after a few,
/// their steps short. The p of all rays are the rows of the bodies together, which is about half for those
/// that press, and nothing for those that are open: p = s / (2 (s + z)), so that the sum is (z (s + ds) + (s
/// + 2z)(z + dz)) / (2z (s + z)). Its root is taken, since other rays answer too.
auto answerOfProducts(const Eigen::Ref<const Eigen::VectorXd>& s, const Eigen::Ref<const Eigen::VectorXd>& z,
                      const Eigen::Ref<const Eigen::VectorXd>& ds,
                      const Eigen::Ref<const Eigen::VectorXd>& dz, double primal, double dual)
{
    constexpr double least = 0.2;
    const auto force = (s.array() + primal * ds.array()).max(0);
    const auto opening = (z.array() + dual * dz.array()).max(0);
    return Eigen::ArrayXd(
        ((z.array() * force + (s.array() + 2 * z.array()) * opening) / (2 * z.array() * (s + z).array()))
            .max(least)
            .sqrt());
}

/// D p of a round cone for a change c of the product of scaled vectors.
template<class Scalar>
ConeVector<Scalar> weightedPull(const NesterovToddScaling<Scalar>& scaling, const FramedMatrix<Scalar>& d,
                                const ConeVector<Scalar>& c)
{
    return d.apply(scaling.applyInverse(jordanDivide(scaling.lambda, c)));
}

/// The change that brings a product into the box, no further down than the largest aim.
double intoBox(double product, double least, double largest)
{
    return std::max(least - product, std::max(std::min(largest - product, 0.0), -largest));
}

} // namespace

template<int Rows, class Scalar>
VectorOf<Scalar> mehrotraPull(const State<Rows, Scalar>& state, const ConeScaling<Scalar>& scaling,
                              const Iterate<Scalar>& step, double sigma)
{
    const ConeRanges& cones = state.cones;
    VectorOf<Scalar> pull(cones.size());
    const double aim = sigma * state.mu;
    const Eigen::Index rays = cones.rays;
    if constexpr (std::is_same_v<Scalar, double>)
    {
        const auto answer = answerOfProducts(state.at.s.head(rays), state.at.z.head(rays), step.s.head(rays),
                                             step.z.head(rays), 1, 1);
        pull.head(rays).array() = (aim - step.s.head(rays).array() * step.z.head(rays).array()) / answer
                                  * scaling.flexibility.array();
    }
    else
    {
        pull.head(rays).array() = (Scalar(aim) - step.s.head(rays).array() * step.z.head(rays).array())
                                  * scaling.flexibility.array();
    }
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const Eigen::Index at = cones.at(round);
        const auto index = static_cast<std::size_t>(round);
        const NesterovToddScaling<Scalar>& W = scaling.rounds[index];
        ConeVector<Scalar> c = -jordanProduct<Scalar>(W.applyInverse(step.s.template segment<3>(at)),
                                                      W.apply(step.z.template segment<3>(at)));
        c[0] += Scalar(aim);
        pull.template segment<3>(at) = weightedPull(W, scaling.weights.rounds[index], c);
    }
    return pull;
}

template<int Rows, class Scalar>
VectorOf<Scalar> gondzioPull(const State<Rows, Scalar>& state, const ConeScaling<Scalar>& scaling,
                             const Iterate<Scalar>& step, double primal, double dual,
                             const Centring& centring, double aim)
{
    const ConeRanges& cones = state.cones;
    const double least = centring.leastProduct * aim;
    const double largest = centring.largestProduct * aim;
    VectorOf<Scalar> pull(cones.size());
    const Eigen::Index rays = cones.rays;
    if constexpr (std::is_same_v<Scalar, double>)
    {
        const auto product = (state.at.s.head(rays) + primal * step.s.head(rays)).array()
                             * (state.at.z.head(rays) + dual * step.z.head(rays)).array();
        const auto answer = answerOfProducts(state.at.s.head(rays), state.at.z.head(rays), step.s.head(rays),
                                             step.z.head(rays), primal, dual);
        pull.head(rays).array() = (least - product).max((largest - product).min(0.0).max(-largest)) / answer
                                  * scaling.flexibility.array();
    }
    else
    {
        for (Eigen::Index ray = 0; ray < rays; ++ray)
        {
            const Scalar product = (state.at.s[ray] + Scalar(primal) * step.s[ray])
                                   * (state.at.z[ray] + Scalar(dual) * step.z[ray]);
            pull[ray] = Scalar(intoBox(leading(product), least, largest)) * scaling.flexibility[ray];
        }
    }
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const Eigen::Index at = cones.at(round);
        const auto index = static_cast<std::size_t>(round);
        const NesterovToddScaling<Scalar>& W = scaling.rounds[index];
        const ConeVector<Scalar> product =
            jordanProduct<Scalar>(W.lambda + Scalar(primal) * W.applyInverse(step.s.template segment<3>(at)),
                                  W.lambda + Scalar(dual) * W.apply(step.z.template segment<3>(at)));
        const ConeVector<Scalar> c = onEigenvalues(
            product, [&](const Scalar& value) { return Scalar(intoBox(leading(value), least, largest)); });
        pull.template segment<3>(at) = weightedPull(W, scaling.weights.rounds[index], c);
    }
    return pull;
}

template VectorOf<double> mehrotraPull(const State<3, double>&, const ConeScaling<double>&,
                                       const Iterate<double>&, double);
template VectorOf<double> mehrotraPull(const State<6, double>&, const ConeScaling<double>&,
                                       const Iterate<double>&, double);
template VectorOf<DoubleDouble> mehrotraPull(const State<3, DoubleDouble>&, const ConeScaling<DoubleDouble>&,
                                             const Iterate<DoubleDouble>&, double);
template VectorOf<DoubleDouble> mehrotraPull(const State<6, DoubleDouble>&, const ConeScaling<DoubleDouble>&,
                                             const Iterate<DoubleDouble>&, double);
template VectorOf<double> gondzioPull(const State<3, double>&, const ConeScaling<double>&,
                                      const Iterate<double>&, double, double, const Centring&, double);
template VectorOf<double> gondzioPull(const State<6, double>&, const ConeScaling<double>&,
                                      const Iterate<double>&, double, double, const Centring&, double);
template VectorOf<DoubleDouble> gondzioPull(const State<3, DoubleDouble>&, const ConeScaling<DoubleDouble>&,
                                            const Iterate<DoubleDouble>&, double, double, const Centring&,
                                            double);
template VectorOf<DoubleDouble> gondzioPull(const State<6, DoubleDouble>&, const ConeScaling<DoubleDouble>&,
                                            const Iterate<DoubleDouble>&, double, double, const Centring&,
                                            double);

} // namespace drystone
