// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The pulls of the corrections towards the central path: what they request in each ray and cone.
#include "conic/interiorPoint/Centring.h"

#include "core/Threads.h"

namespace drystone
{
namespace
{

/// What the product of a ray at the end of a step becomes larger by for each unit that is requested in c. In
/// Newton's equations, the other cones aside, c changes s by (1 - p) c/z and z by p c/s, where p = D b'S^-1 b
/// is the leverage of the ray, and so (s + ds)(z + dz) by c times
///     (1 - p) (z + dz)/z + p (s + ds)/s.
/// Where the one grows to three times what it was and drives the other below zero, a request for what is
/// missing moves the product too far, and where it shrinks, not far enough: the corrections then end after a
/// few, their steps short. The p of all rays are the rows of the bodies together, which is about half for
/// those that press, and nothing for those that are open: p = s / (2 (s + z)), so that the sum is (z (s + ds)
/// + (s
/// + 2z)(z + dz)) / (2z (s + z)). Its root is taken, since other rays answer too.
/// \return an expression of parts of vectors, which must outlive it
template<class Part>
auto answerOfProducts(const Part& s, const Part& z, const Part& ds, const Part& dz, double primal,
                      double dual)
{
    constexpr double least = 0.2;
    const auto force = (s + primal * ds).max(0);
    const auto opening = (z + dual * dz).max(0);
    return ((z * force + (s + 2 * z) * opening) / (2 * z * (s + z))).max(least).sqrt();
}

/// Likewise for a round cone, by the eigenvectors of its scaling: with ds and dz scaled, both from lambda, of
/// which the first component stands for all, and with p = D / (2 (D + 1)), which is s / (2 (s + z)) on a ray.
/// \return c divided by what products answer
template<class Number>
ConeVector<Number> dividedByAnswer(const NesterovToddScaling<Number>& scaling, const ConeVector<Number>& ds,
                                   const ConeVector<Number>& dz, double primal, double dual,
                                   const ConeVector<Number>& c)
{
    using std::sqrt;
    using Real = std::decay_t<decltype(leading(c[0]))>;
    constexpr double least = 0.2;
    const auto& direction = scaling.W.direction;
    const Real lambda = leading(scaling.lambda[0]);
    const Real force = leading(ds[0]);
    const Real opening = leading(dz[0]);
    const Real forceAlong = leading(Number(direction[0] * ds[1] + direction[1] * ds[2]));
    const Real openingAlong = leading(Number(direction[0] * dz[1] + direction[1] * dz[2]));
    FramedMatrix<Number> divided;
    divided.direction = direction;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double side = axis == 0 ? 1 : axis == 1 ? -1 : 0;
        const Real root = leading(scaling.W.eigenvalues[axis]);
        const Real leverage = 0.5 * root * root / (root * root + 1);
        const Real atForce = larger<Real>(1 + primal * (force + side * forceAlong) / lambda, 0);
        const Real atOpening = larger<Real>(1 + dual * (opening + side * openingAlong) / lambda, 0);
        const Real answer = (1 - leverage) * atOpening + leverage * atForce;
        divided.eigenvalues[axis] = Number(1 / sqrt(larger<Real>(answer, least)));
    }
    return divided.apply(c);
}

/// The pulls of the rays, by parts of vectors. \param ask (s, z, ds, dz) of a part: what the flexibilities
/// are multiplied by, an expression
template<int Rows, class Ask>
void pullRays(const State<Rows, double>& state, const ConeScaling<double>& scaling,
              const Iterate<double>& step, Eigen::VectorXd& pull, const Ask& ask)
{
    forParts(state.cones.rays,
             [&](long begin, long end)
             {
                 const auto part = [&](const Eigen::VectorXd& of)
                 { return of.segment(begin, end - begin).array(); };
                 const auto s = part(state.at.s);
                 const auto z = part(state.at.z);
                 const auto ds = part(step.s);
                 const auto dz = part(step.z);
                 pull.segment(begin, end - begin).array() = ask(s, z, ds, dz) * part(scaling.flexibility);
             });
}

/// The pulls of the round cones. \param ask (lambda, ds, dz) of a pack, scaled: what is requested in its
/// products
template<class Scalar, class Ask>
void pullRounds(const ConeRanges& cones, const ConeScaling<Scalar>& scaling, const ScaledStep<Scalar>& scaled,
                double primal, double dual, VectorOf<Scalar>& pull, const Ask& ask)
{
    using Number = Abreast<Scalar>;
    forPacks<Number>(cones.rounds,
                     [&](const Pack& pack)
                     {
                         const NesterovToddScaling<Number>& of = scaling.rounds[pack.number];
                         const ConeVector<Number>& ds = scaled.forces[pack.number];
                         const ConeVector<Number>& dz = scaled.openings[pack.number];
                         const ConeVector<Number> c =
                             dividedByAnswer<Number>(of, ds, dz, primal, dual, ask(of.lambda, ds, dz));
                         put(scaling.pulls[pack.number].apply(jordanDivide(of.lambda, of.determinant, c)),
                             cones.at(pack.round), pack.count, pull);
                     });
}

/// The change that brings a product into the box, no further down than the largest aim.
template<class Number>
Number intoBox(const Number& product, double least, double largest)
{
    return larger<Number>(least - product, larger<Number>(smaller<Number>(largest - product, 0), -largest));
}

} // namespace

template<int Rows, class Scalar>
VectorOf<Scalar> mehrotraPull(const State<Rows, Scalar>& state, const ConeScaling<Scalar>& scaling,
                              const Iterate<Scalar>& step, const ScaledStep<Scalar>& scaled, double sigma)
{
    const ConeRanges& cones = state.cones;
    VectorOf<Scalar> pull(cones.size());
    const double aim = sigma * state.mu;
    const Eigen::Index rays = cones.rays;
    if constexpr (std::is_same_v<Scalar, double>)
    {
        pullRays(state, scaling, step, pull,
                 [&](const auto& s, const auto& z, const auto& ds, const auto& dz)
                 { return (aim - ds * dz) / answerOfProducts(s, z, ds, dz, 1, 1); });
    }
    else
    {
        pull.head(rays).array() = (Scalar(aim) - step.s.head(rays).array() * step.z.head(rays).array())
                                  * scaling.flexibility.array();
    }
    pullRounds(cones, scaling, scaled, 1, 1, pull,
               [&](const auto&, const auto& ds, const auto& dz)
               {
                   using Number = Abreast<Scalar>;
                   ConeVector<Number> c = -jordanProduct<Number>(ds, dz);
                   c[0] += Number(aim);
                   return c;
               });
    return pull;
}

template<int Rows, class Scalar>
VectorOf<Scalar> gondzioPull(const State<Rows, Scalar>& state, const ConeScaling<Scalar>& scaling,
                             const Iterate<Scalar>& step, const ScaledStep<Scalar>& scaled, double primal,
                             double dual, const Centring& centring, double aim)
{
    const ConeRanges& cones = state.cones;
    const double least = centring.leastProduct * aim;
    const double largest = centring.largestProduct * aim;
    VectorOf<Scalar> pull(cones.size());
    const Eigen::Index rays = cones.rays;
    if constexpr (std::is_same_v<Scalar, double>)
    {
        pullRays(state, scaling, step, pull,
                 [&](const auto& s, const auto& z, const auto& ds, const auto& dz)
                 {
                     const auto product = (s + primal * ds) * (z + dual * dz);
                     return (least - product).max((largest - product).min(0.0).max(-largest))
                            / answerOfProducts(s, z, ds, dz, primal, dual);
                 });
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
    pullRounds(cones, scaling, scaled, primal, dual, pull,
               [&](const auto& lambda, const auto& ds, const auto& dz)
               {
                   using Number = Abreast<Scalar>;
                   const ConeVector<Number> product =
                       jordanProduct<Number>(lambda + Number(primal) * ds, lambda + Number(dual) * dz);
                   return onEigenvalues(product, [&](const Number& value)
                                        { return Number(intoBox(leading(value), least, largest)); });
               });
    return pull;
}

template VectorOf<double> mehrotraPull(const State<3, double>&, const ConeScaling<double>&,
                                       const Iterate<double>&, const ScaledStep<double>&, double);
template VectorOf<double> gondzioPull(const State<3, double>&, const ConeScaling<double>&,
                                      const Iterate<double>&, const ScaledStep<double>&, double, double,
                                      const Centring&, double);
template VectorOf<double> mehrotraPull(const State<6, double>&, const ConeScaling<double>&,
                                       const Iterate<double>&, const ScaledStep<double>&, double);
template VectorOf<double> gondzioPull(const State<6, double>&, const ConeScaling<double>&,
                                      const Iterate<double>&, const ScaledStep<double>&, double, double,
                                      const Centring&, double);
template VectorOf<DoubleDouble> mehrotraPull(const State<3, DoubleDouble>&, const ConeScaling<DoubleDouble>&,
                                             const Iterate<DoubleDouble>&, const ScaledStep<DoubleDouble>&,
                                             double);
template VectorOf<DoubleDouble> gondzioPull(const State<3, DoubleDouble>&, const ConeScaling<DoubleDouble>&,
                                            const Iterate<DoubleDouble>&, const ScaledStep<DoubleDouble>&,
                                            double, double, const Centring&, double);
template VectorOf<DoubleDouble> mehrotraPull(const State<6, DoubleDouble>&, const ConeScaling<DoubleDouble>&,
                                             const Iterate<DoubleDouble>&, const ScaledStep<DoubleDouble>&,
                                             double);
template VectorOf<DoubleDouble> gondzioPull(const State<6, DoubleDouble>&, const ConeScaling<DoubleDouble>&,
                                            const Iterate<DoubleDouble>&, const ScaledStep<DoubleDouble>&,
                                            double, double, const Centring&, double);

} // namespace drystone
