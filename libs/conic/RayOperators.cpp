// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/RayOperators.h"

#include "linear/DoubleDouble.h"

namespace drystone
{
namespace
{

template<class Scalar>
using RayOf = Eigen::Matrix<Scalar, 4, 1>;

template<class Scalar>
RayOf<Scalar> rayOf(const RayProgram& program, int ray)
{
    return program.rays[ray].template cast<Scalar>();
}

/// Stiffness that a limit adds to its rays, q = e^2 / d_w, and what is left of their weights: eliminating the
/// row of a limit from B diag(d) B' leaves, for one ray, d / (1 + q d), and for two
///
///     (diag(1/d1, 1/d2) + q [1 1; 1 1])^-1 = diag(d1, d2) / t + q d1 d2 / t [1 -1; -1 1],  t = 1 + q (d1 +
///     d2):
///
/// sums of what is positive, without cancellation however firm the limit. The last part belongs to the
/// difference of the two rays.
template<class Scalar>
struct LimitedWeights
{
    Scalar share;      ///< 1 / t
    Scalar difference; ///< q d1 d2 / t
};

template<class Scalar>
LimitedWeights<Scalar> limitedWeights(const RayProgram& program, std::size_t limit,
                                      const RayVector<Scalar>& d)
{
    const RayProgram::Limit& at = program.limits[limit];
    const Scalar q = at.factor * at.factor / d[program.slack(limit)];
    const Scalar one = d[at.ray];
    const Scalar two = at.rays == 2 ? d[at.ray + 1] : Scalar(0);
    const Scalar share = 1 / (1 + q * (one + two));
    return {share, q * one * two * share};
}

/// What a ray does to the rows of its two bodies.
template<class Scalar>
Eigen::Matrix<Scalar, 3, 1> onFirst(const RayOf<Scalar>& ray)
{
    return {ray[0], ray[1], ray[2]};
}
template<class Scalar>
Eigen::Matrix<Scalar, 3, 1> onSecond(const RayOf<Scalar>& ray)
{
    return {-ray[0], -ray[1], ray[3]};
}

/// sum d b b' over rays of a group, added to the blocks of its bodies.
template<class Scalar>
void addToBlocks(const RayProgram& program, const RayProgram::Group& group,
                 const Eigen::Matrix<Scalar, 4, 4>& products, SchurSystem<3, Scalar>& system)
{
    if (group.first >= program.bodies)
    {
        return;
    }
    system.diagonal(group.first) += products.template topLeftCorner<3, 3>();
    if (group.slot < 0)
    {
        return;
    }
    // With the translations of the second body opposite to those of the first.
    Eigen::Matrix<Scalar, 3, 3> secondFirst;
    secondFirst << -products.template topLeftCorner<2, 3>(), products.template bottomLeftCorner<1, 3>();
    system.coupling(group.slot) += secondFirst;
    Eigen::Matrix<Scalar, 3, 3> secondSecond;
    secondSecond << products.template topLeftCorner<2, 2>(), -products.template topRightCorner<2, 1>(),
        -products.template bottomLeftCorner<1, 2>(), products(3, 3);
    system.diagonal(group.second) += secondSecond;
}

} // namespace

template<class Scalar>
void applyRaysTransposed(const RayProgram& program, const RayVector<Scalar>& y, RayVector<Scalar>& out)
{
    out.resize(program.rayCount());
    for (const RayProgram::Group& group : program.groups)
    {
        const auto first = y.template segment<3>(3 * group.first);
        const auto second = y.template segment<3>(3 * group.second);
        const RayOf<Scalar> closing(first[0] - second[0], first[1] - second[1], first[2], second[2]);
        for (int ray = group.begin; ray < group.end; ++ray)
        {
            out[ray] = rayOf<Scalar>(program, ray).dot(closing);
        }
    }
    for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
    {
        const RayProgram::Limit& at = program.limits[limit];
        const Scalar change = y[program.row(limit)];
        out.segment(at.ray, at.rays).array() += Scalar(at.factor) * change;
        out[program.slack(limit)] = change;
    }
}

template<class Scalar>
void addRays(const RayProgram& program, const RayVector<Scalar>& s, RayVector<Scalar>& out)
{
    for (const RayProgram::Group& group : program.groups)
    {
        RayOf<Scalar> sum = RayOf<Scalar>::Zero();
        for (int ray = group.begin; ray < group.end; ++ray)
        {
            sum += rayOf<Scalar>(program, ray) * s[ray];
        }
        if (group.first < program.bodies)
        {
            out.template segment<3>(3 * group.first) += onFirst<Scalar>(sum);
        }
        if (group.second < program.bodies)
        {
            out.template segment<3>(3 * group.second) += onSecond<Scalar>(sum);
        }
    }
    for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
    {
        const RayProgram::Limit& at = program.limits[limit];
        out[program.row(limit)] +=
            Scalar(at.factor) * s.segment(at.ray, at.rays).sum() + s[program.slack(limit)];
    }
}

namespace
{

template<class Scalar>
void assembleRays(const RayProgram& program, const RayVector<Scalar>& d, double delta,
                  SchurSystem<3, Scalar>& system)
{
    system.setZero();
    for (int body = 0; body < program.bodies; ++body)
    {
        auto& block = system.diagonal(body);
        if (program.hasInertia())
        {
            block = program.inertia[body].template cast<Scalar>();
        }
        block.diagonal().array() += Scalar(delta);
    }
    for (const RayProgram::Group& group : program.groups)
    {
        Eigen::Matrix<Scalar, 4, 4> products = Eigen::Matrix<Scalar, 4, 4>::Zero();
        for (int ray = group.begin; ray < group.end; ++ray)
        {
            const RayOf<Scalar> force = rayOf<Scalar>(program, ray);
            products.noalias() += (d[ray] * force).lazyProduct(force.transpose());
        }
        addToBlocks<Scalar>(program, group, products, system);
    }
}

} // namespace

template<class Scalar>
void assembleSchur(const RayProgram& program, const RayVector<Scalar>& d, double delta, double relative,
                   SchurSystem<3, Scalar>& system)
{
    if (program.limits.empty())
    {
        assembleRays(program, d, delta, system);
    }
    else
    {
        RayVector<Scalar> limited = d;
        for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
        {
            const RayProgram::Limit& at = program.limits[limit];
            limited.segment(at.ray, at.rays) *= limitedWeights(program, limit, d).share;
        }
        assembleRays(program, limited, delta, system);
        for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
        {
            const RayProgram::Limit& at = program.limits[limit];
            if (at.rays == 2)
            {
                const RayOf<Scalar> force =
                    rayOf<Scalar>(program, at.ray) - rayOf<Scalar>(program, at.ray + 1);
                addToBlocks<Scalar>(program, program.groups[at.group],
                                    limitedWeights(program, limit, d).difference * force * force.transpose(),
                                    system);
            }
        }
    }
    for (int body = 0; relative > 0 && body < program.bodies; ++body)
    {
        system.diagonal(body).diagonal() *= Scalar(1 + relative);
    }
}

/// With p = e^2 sum d + d_w on the diagonal of a limit's row and h = e B d beside it, the bodies' part of
/// [S h; h' p] (y, v) = (right, r) is (S - h h'/p) y = right - h r/p, and v = (r - h'y) / p.
template<class Scalar>
void solveWithLimits(const RayProgram& program, const RayVector<Scalar>& d, SchurSystem<3, Scalar>& system,
                     RayVector<Scalar>& x)
{
    const auto weightOf = [&](std::size_t limit)
    {
        const RayProgram::Limit& at = program.limits[limit];
        return Scalar(at.factor * at.factor) * d.segment(at.ray, at.rays).sum() + d[program.slack(limit)];
    };
    for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
    {
        const RayProgram::Limit& at = program.limits[limit];
        const RayProgram::Group& group = program.groups[at.group];
        const Scalar share = at.factor * x[program.row(limit)] / weightOf(limit);
        for (int ray = at.ray; ray < at.ray + at.rays; ++ray)
        {
            x.template segment<3>(3 * group.first) -=
                share * d[ray] * onFirst<Scalar>(rayOf<Scalar>(program, ray));
            if (group.second < program.bodies)
            {
                x.template segment<3>(3 * group.second) -=
                    share * d[ray] * onSecond<Scalar>(rayOf<Scalar>(program, ray));
            }
        }
    }
    system.solve(x.head(3 * program.bodies));
    for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
    {
        const RayProgram::Limit& at = program.limits[limit];
        const RayProgram::Group& group = program.groups[at.group];
        Scalar coupled = 0;
        for (int ray = at.ray; ray < at.ray + at.rays; ++ray)
        {
            coupled +=
                d[ray]
                * (onFirst<Scalar>(rayOf<Scalar>(program, ray)).dot(x.template segment<3>(3 * group.first))
                   + onSecond<Scalar>(rayOf<Scalar>(program, ray))
                         .dot(x.template segment<3>(3 * group.second)));
        }
        x[program.row(limit)] = (x[program.row(limit)] - at.factor * coupled) / weightOf(limit);
    }
}

template void applyRaysTransposed(const RayProgram&, const RayVector<double>&, RayVector<double>&);
template void addRays(const RayProgram&, const RayVector<double>&, RayVector<double>&);
template void assembleSchur(const RayProgram&, const RayVector<double>&, double, double,
                            SchurSystem<3, double>&);
template void solveWithLimits(const RayProgram&, const RayVector<double>&, SchurSystem<3, double>&,
                              RayVector<double>&);
template void applyRaysTransposed(const RayProgram&, const RayVector<DoubleDouble>&,
                                  RayVector<DoubleDouble>&);
template void addRays(const RayProgram&, const RayVector<DoubleDouble>&, RayVector<DoubleDouble>&);
template void assembleSchur(const RayProgram&, const RayVector<DoubleDouble>&, double, double,
                            SchurSystem<3, DoubleDouble>&);
template void solveWithLimits(const RayProgram&, const RayVector<DoubleDouble>&,
                              SchurSystem<3, DoubleDouble>&, RayVector<DoubleDouble>&);

} // namespace drystone
