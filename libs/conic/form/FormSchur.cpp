// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limits are eliminated by hand into sums of positive terms, so that a firm limit cancels no digits.
#include "conic/form/FormSchur.h"

#include "conic/form/FormColumns.h"
#include "core/Threads.h"

#include <cmath>

namespace drystone
{
namespace
{

template<int Rows, class Scalar>
using ProductsOf = Eigen::Matrix<Scalar, Form<Rows>::columnSize, Form<Rows>::columnSize>;

/// Stiffness that a limit adds to what it limits, q = e^2 / d_w, and what is left of the weights: eliminating
/// the row of a limit from B D B' leaves, for one ray, d / (1 + q d), and for two
///
///     (diag(1/d1, 1/d2) + q [1 1; 1 1])^-1 = diag(d1, d2) / t + q d1 d2 / t [1 -1; -1 1],  t = 1 + q (d1 +
///     d2):
///
/// sums of what is positive, without cancellation however firm the limit. The last part belongs to the
/// difference of the two rays. The first component of a round cone is half the sum of the coordinates along
/// two of its eigenvectors, sqrt2 (1 1): the same with q / 2.
template<class Scalar>
struct LimitedWeights
{
    Scalar share;      ///< 1 / t
    Scalar difference; ///< q d1 d2 / t
};

template<int Rows, class Scalar>
LimitedWeights<Scalar> limitedWeights(const Form<Rows>& form, std::size_t limit, const ConeWeights<Scalar>& d)
{
    const typename Form<Rows>::Limit& at = form.limits[limit];
    Scalar q = at.factor * at.factor / d.rays[form.slack(limit)];
    Scalar one = 0;
    Scalar two = 0;
    if (at.round < 0)
    {
        one = d.rays[at.ray];
        two = at.rays == 2 ? d.rays[at.ray + 1] : Scalar(0);
    }
    else
    {
        const FramedMatrix<Scalar>& framed = d.rounds[static_cast<std::size_t>(at.round)];
        q = q / 2;
        one = framed.eigenvalues[0];
        two = framed.eigenvalues[1];
    }
    const Scalar share = 1 / (1 + q * (one + two));
    return {share, q * one * two * share};
}

/// sum d b b' over columns of a group, added to the blocks of its bodies: that of the first, the one with the
/// rows of the second and the columns of the first, and that of the second.
template<int Rows, class Scalar, class Block>
void addToFirst(const ProductsOf<Rows, Scalar>& products, Block& firstFirst)
{
    firstFirst += products.template topLeftCorner<Rows, Rows>();
}
template<int Rows, class Scalar, class Block>
void addToSecond(const ProductsOf<Rows, Scalar>& products, Block& secondFirst, Block& secondSecond)
{
    constexpr int forces = Form<Rows>::forces;
    constexpr int moments = Form<Rows>::moments;
    // With the translations of the second body opposite to those of the first.
    secondFirst.template topRows<forces>() -= products.template topLeftCorner<forces, Rows>();
    secondFirst.template bottomRows<moments>() += products.template bottomLeftCorner<moments, Rows>();
    secondSecond.template topLeftCorner<forces, forces>() +=
        products.template topLeftCorner<forces, forces>();
    secondSecond.template topRightCorner<forces, moments>() -=
        products.template topRightCorner<forces, moments>();
    secondSecond.template bottomLeftCorner<moments, forces>() -=
        products.template bottomLeftCorner<moments, forces>();
    secondSecond.template bottomRightCorner<moments, moments>() +=
        products.template bottomRightCorner<moments, moments>();
}

template<int Rows, class Scalar>
void addToBlocks(const Form<Rows>& form, const typename Form<Rows>::Group& group,
                 const ProductsOf<Rows, Scalar>& products, SchurSystem<Rows, Scalar>& system)
{
    if (group.first >= form.bodies)
    {
        return;
    }
    addToFirst<Rows, Scalar>(products, system.diagonal(group.first));
    if (group.slot >= 0)
    {
        addToSecond<Rows, Scalar>(products, system.coupling(group.slot), system.diagonal(group.second));
    }
}

/// sum of d b b' over the cones of a group.
template<int Rows, class Scalar>
ProductsOf<Rows, Scalar> productsOf(const Form<Rows>& form, const typename Form<Rows>::Group& group,
                                    const ConeWeights<Scalar>& d)
{
    ProductsOf<Rows, Scalar> products;
    bool isBegun = false; // with the first product: to set zeros takes as long as one
    const auto add = [&](const auto& product)
    {
        if (isBegun)
        {
            products.noalias() += product;
        }
        else
        {
            products.noalias() = product;
        }
        isBegun = true;
    };
    for (int ray = group.begin; ray < group.end; ++ray)
    {
        const ColumnOf<Rows, Scalar>& column = rayOf<Rows, Scalar>(form, ray);
        add((d.rays[ray] * column).lazyProduct(column.transpose()));
    }
    for (int round = group.beginRound; round < group.endRound; ++round)
    {
        const FramedMatrix<Scalar>& framed = d.rounds[static_cast<std::size_t>(round)];
        const Eigen::Matrix<Scalar, Form<Rows>::columnSize, 3> columns =
            form.rounds[static_cast<std::size_t>(round)].template cast<Scalar>().lazyProduct(framed.frame());
        const Eigen::Matrix<Scalar, Form<Rows>::columnSize, 3> weighted =
            columns * framed.eigenvalues.asDiagonal();
        add(weighted.lazyProduct(columns.transpose()));
    }
    return isBegun ? products : ProductsOf<Rows, Scalar>::Zero();
}

template<int Rows, class Scalar>
void addCones(const Form<Rows>& form, const ConeWeights<Scalar>& d, SchurSystem<Rows, Scalar>& system)
{
    if (form.shares.empty())
    {
        for (const typename Form<Rows>::Group& group : form.groups)
        {
            addToBlocks<Rows, Scalar>(form, group, productsOf<Rows, Scalar>(form, group, d), system);
        }
        return;
    }
    using Block = typename SchurSystem<Rows, Scalar>::Block;
    std::vector<Block, Eigen::aligned_allocator<Block>> lent(form.lent.size(), Block::Zero());
    const auto blockAt = [&](int place) -> Block&
    {
        return place < form.bodies ? system.diagonal(place)
                                   : lent[static_cast<std::size_t>(place - form.bodies - 1)];
    };
    carryOut(static_cast<int>(form.shares.size()),
             [&](int share, int)
             {
                 for (int at = form.shares[share].begin; at < form.shares[share].end; ++at)
                 {
                     const typename Form<Rows>::Group& group = form.groups[at];
                     if (group.first >= form.bodies)
                     {
                         continue;
                     }
                     const ProductsOf<Rows, Scalar> products = productsOf<Rows, Scalar>(form, group, d);
                     addToFirst<Rows, Scalar>(products, blockAt(form.places[at][0]));
                     if (group.slot >= 0)
                     {
                         addToSecond<Rows, Scalar>(products, system.coupling(group.slot),
                                                   blockAt(form.places[at][1]));
                     }
                 }
             });
    for (std::size_t place = 0; place < lent.size(); ++place)
    {
        system.diagonal(form.lent[place]) += lent[place];
    }
}

/// The difference of the two rays, or of the two eigenvectors, that a limit leaves; nothing for one ray.
template<int Rows, class Scalar>
ColumnOf<Rows, Scalar> limitedDifference(const Form<Rows>& form, const typename Form<Rows>::Limit& limit,
                                         const ConeWeights<Scalar>& d)
{
    if (limit.round < 0)
    {
        return rayOf<Rows, Scalar>(form, limit.ray) - rayOf<Rows, Scalar>(form, limit.ray + 1);
    }
    using std::sqrt;
    const auto& direction = d.rounds[static_cast<std::size_t>(limit.round)].direction;
    const auto& columns = form.rounds[static_cast<std::size_t>(limit.round)];
    return sqrt(Scalar(2))
           * (columns.col(1).template cast<Scalar>() * direction[0]
              + columns.col(2).template cast<Scalar>() * direction[1]);
}

/// B D e of a limit, and e'D e: the column off the diagonal of its row.
template<int Rows, class Scalar>
struct LimitColumn
{
    ColumnOf<Rows, Scalar> column;
    Scalar weight;
};

template<int Rows, class Scalar>
LimitColumn<Rows, Scalar> limitColumn(const Form<Rows>& form, const typename Form<Rows>::Limit& limit,
                                      const ConeWeights<Scalar>& d)
{
    LimitColumn<Rows, Scalar> result{ColumnOf<Rows, Scalar>::Zero(), Scalar(0)};
    if (limit.round < 0)
    {
        for (int ray = limit.ray; ray < limit.ray + limit.rays; ++ray)
        {
            result.column += d.rays[ray] * rayOf<Rows, Scalar>(form, ray);
            result.weight += d.rays[ray];
        }
        return result;
    }
    const ConeVector<Scalar> weighted = d.rounds[static_cast<std::size_t>(limit.round)].apply(
        ConeVector<Scalar>(Scalar(1), Scalar(0), Scalar(0)));
    result.column = form.rounds[static_cast<std::size_t>(limit.round)].template cast<Scalar>() * weighted;
    result.weight = weighted[0];
    return result;
}

} // namespace

template<int Rows, class Scalar>
void assembleSchur(const Form<Rows>& form, const ConeWeights<Scalar>& d, double delta, double relative,
                   SchurSystem<Rows, Scalar>& system)
{
    system.setZero();
    for (int body = 0; body < form.bodies; ++body)
    {
        auto& block = system.diagonal(body);
        if (form.hasInertia())
        {
            block = form.inertia[body].template cast<Scalar>();
        }
        block.diagonal().array() += Scalar(delta);
    }
    if (form.limits.empty())
    {
        addCones(form, d, system);
    }
    else
    {
        ConeWeights<Scalar> limited = d;
        for (std::size_t limit = 0; limit < form.limits.size(); ++limit)
        {
            const typename Form<Rows>::Limit& at = form.limits[limit];
            const Scalar share = limitedWeights(form, limit, d).share;
            if (at.round < 0)
            {
                limited.rays.segment(at.ray, at.rays) *= share;
            }
            else
            {
                limited.rounds[static_cast<std::size_t>(at.round)].eigenvalues.template head<2>() *= share;
            }
        }
        addCones(form, limited, system);
        for (std::size_t limit = 0; limit < form.limits.size(); ++limit)
        {
            const typename Form<Rows>::Limit& at = form.limits[limit];
            if (at.rays != 1)
            {
                const ColumnOf<Rows, Scalar> force = limitedDifference<Rows, Scalar>(form, at, d);
                addToBlocks<Rows, Scalar>(
                    form, form.groups[at.group],
                    limitedWeights(form, limit, d).difference * force * force.transpose(), system);
            }
        }
    }
    for (int body = 0; relative > 0 && body < form.bodies; ++body)
    {
        system.diagonal(body).diagonal() *= Scalar(1 + relative);
    }
}

/// With p = e^2 sum d + d_w on the diagonal of a limit's row and h = e B d off it, the bodies' part of
/// [S h; h' p] (y, v) = (right, r) is (S - h h'/p) y = right - h r/p, and v = (r - h'y) / p.
template<int Rows, class Scalar>
void solveWithLimits(const Form<Rows>& form, const ConeWeights<Scalar>& d, SchurSystem<Rows, Scalar>& system,
                     VectorOf<Scalar>& x)
{
    const auto diagonalOf = [&](std::size_t limit, const Scalar& weight)
    {
        const double factor = form.limits[limit].factor;
        return Scalar(factor * factor) * weight + d.rays[form.slack(limit)];
    };
    for (std::size_t limit = 0; limit < form.limits.size(); ++limit)
    {
        const typename Form<Rows>::Limit& at = form.limits[limit];
        const typename Form<Rows>::Group& group = form.groups[at.group];
        const LimitColumn<Rows, Scalar> beside = limitColumn<Rows, Scalar>(form, at, d);
        const Scalar share = at.factor * x[form.row(limit)] / diagonalOf(limit, beside.weight);
        x.template segment<Rows>(Rows * group.first) -= share * onFirst<Rows, Scalar>(beside.column);
        if (group.second < form.bodies)
        {
            x.template segment<Rows>(Rows * group.second) -= share * onSecond<Rows, Scalar>(beside.column);
        }
    }
    system.solve(x.head(Rows * form.bodies));
    for (std::size_t limit = 0; limit < form.limits.size(); ++limit)
    {
        const typename Form<Rows>::Limit& at = form.limits[limit];
        const typename Form<Rows>::Group& group = form.groups[at.group];
        const LimitColumn<Rows, Scalar> beside = limitColumn<Rows, Scalar>(form, at, d);
        const Scalar coupled =
            onFirst<Rows, Scalar>(beside.column).dot(x.template segment<Rows>(Rows * group.first))
            + onSecond<Rows, Scalar>(beside.column).dot(x.template segment<Rows>(Rows * group.second));
        x[form.row(limit)] = (x[form.row(limit)] - at.factor * coupled) / diagonalOf(limit, beside.weight);
    }
}

template void assembleSchur(const Form<3>&, const ConeWeights<double>&, double, double,
                            SchurSystem<3, double>&);
template void solveWithLimits(const Form<3>&, const ConeWeights<double>&, SchurSystem<3, double>&,
                              VectorOf<double>&);
template void assembleSchur(const Form<3>&, const ConeWeights<DoubleDouble>&, double, double,
                            SchurSystem<3, DoubleDouble>&);
template void solveWithLimits(const Form<3>&, const ConeWeights<DoubleDouble>&, SchurSystem<3, DoubleDouble>&,
                              VectorOf<DoubleDouble>&);
template void assembleSchur(const Form<6>&, const ConeWeights<double>&, double, double,
                            SchurSystem<6, double>&);
template void solveWithLimits(const Form<6>&, const ConeWeights<double>&, SchurSystem<6, double>&,
                              VectorOf<double>&);
template void assembleSchur(const Form<6>&, const ConeWeights<DoubleDouble>&, double, double,
                            SchurSystem<6, DoubleDouble>&);
template void solveWithLimits(const Form<6>&, const ConeWeights<DoubleDouble>&, SchurSystem<6, DoubleDouble>&,
                              VectorOf<DoubleDouble>&);

} // namespace drystone
